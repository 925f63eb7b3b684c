//! Facets in space (§1 and §14 expect that the method takes edges and faces; this is how): every
//! segment becomes a chain of edges, and every facet a sheet of faces, of the exactly Delaunay mesh.
//!
//! - `conform`: all of it, in order.

pub(super) mod conform;
#[cfg(test)]
mod tests;
