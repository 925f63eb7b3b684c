//! Questions about a state. They change nothing that the mesh depends on: an answer may leave a
//! shortcut in the tree of domains, or a note for the global mesh that a domain is wanted.
//!
//! - `encroachment`: the cages that a point is too close to (Definition 2).
//! - `cage_site`: the place and the size of a cage.
//! - `bad_simplex` and `quality`: the simplices that make a cell bad (Definition 4).
//! - `outer_boundary`: whether a cage would be near to facets or segments around it.
//! - `steiner_point`: the point that mends a bad simplex.
//! - `nearby`: the vertices and inputs near a point.
//! - `subsegments`: the edges that subsegments are, and the points that split them.
//! - `opposite`: the places opposite vertices of lines that run beside them.
//! - `mirror`: the places in facets beside vertices that are near to their planes.
//! - `subfacets`: whether subfacets are in the mesh, and ways through sheets.
//! - `feature_size`: the distance from an end of lines to what does not go through it.
//! - `regions`: the region of a simplex.
//! - `shields`: the balls about ends of lines that nothing is split in.
//! - `small_angles`: the simplices that small angles in space force.
//! - `exempt`: the simplices that refinement leaves alone.
//! - `permission`: the operations that the interface of a partition allows.

pub(super) mod bad_simplex;
pub(super) mod cage_site;
pub(super) mod encroachment;
pub(super) mod exempt;
pub(super) mod feature_size;
pub(super) mod mirror;
pub(super) mod nearby;
pub(super) mod opposite;
pub(super) mod outer_boundary;
pub(super) mod permission;
pub(super) mod quality;
pub(super) mod regions;
pub(super) mod shields;
pub(super) mod small_angles;
pub(super) mod steiner_point;
pub(super) mod subfacets;
pub(super) mod subsegments;
