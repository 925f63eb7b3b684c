//! The insertion of one vertex, whose cavity is found and whose domain is set, and all that the
//! state has to learn from it.
//!
//! - `insert`: the Delaunay triangulation, conflict lists, and then the rest.
//! - `update`: distances to nearest neighbours, and clearances of cages.
//! - `examine`: new simplices are tested, and bad ones put on REFINELIST.
//! - `near_segments`: the subsegments that the vertex encroaches, and the regions of new simplices.
//! - `near_facets`: the subsegments and subfacets of space that the vertex encroaches or crosses.
//! - `sheets`: a vertex goes into the sheets of facets.
//! - `crowded`: the queue of Sparse Voronoi Refinement.
//! - `cells`: the extents of cells where a vertex comes or goes without the rest.

pub(super) mod cells;
pub(super) mod crowded;
pub(super) mod examine;
pub(super) mod insert;
pub(super) mod near_facets;
pub(super) mod near_segments;
pub(super) mod sheets;
pub(super) mod update;
