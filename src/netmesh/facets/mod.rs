//! Facets in space (§1 and §14 expect that the method takes edges and faces; this is how): every
//! segment becomes a chain of edges, and every facet a sheet of faces, of the exactly Delaunay
//! mesh.
//!
//! - `conform`: all of it, in order.
//! - `components`: the concentrated sets of vertices that no facet leaves, which get cages.
//! - `corner_angles`: the angles between facets at a vertex.
//! - `fins`: facets that meet at a vertex alone at a tiny angle, with none between them.
//! - `sharp`: the lines at which facets or segments meet at small angles.

mod components;
pub(super) mod conform;
mod corner_angles;
mod fins;
pub(super) mod sharp;
