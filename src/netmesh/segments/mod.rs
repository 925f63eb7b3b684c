//! Segments in the plane (§1 and §14 expect that the method takes edges and faces; this is how):
//! every segment becomes a chain of edges of the exactly Delaunay mesh.
//!
//! Conformity is that of J. Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional
//! mesh generation" (1995), as Sparse Voronoi Refinement has it: a *subsegment* is an edge between
//! neighbouring vertices of a segment; it is recovered when no vertex is in the ball of which it is
//! a diameter, for then it is an edge of every Delaunay triangulation. A vertex in that ball
//! *encroaches*. A subsegment that is not recovered is split; a Steiner point that would encroach
//! one is not inserted, the subsegment is split instead.
//!
//! The Delaunay triangulation of the points comes first, without Steiner vertices. What is
//! concentrated in it gets a cage, but where a segment leads out: a component moves into a domain
//! as a whole, or into none.
//!
//! - `conform`: all of it, in order.
//! - `points`: the Delaunay triangulation of the points.
//! - `clusters`: the concentrated sets of vertices, which get cages.
//! - `sharp_ends`: the ends of lines at which they make sharp angles.
//! - `interior`: the regions that are inside.
//! - `labels`: the numbers of regions without a seed.
//! - `seeds`: the labels, sizes and holes that the caller's seeds give regions.
//! - `coarsen`: the removal of vertices that the bound does not need.
//! - `ring`: the neighbours of a vertex, and whether they need it.

pub(super) mod clusters;
pub(super) mod coarsen;
pub(super) mod conform;
pub(super) mod interior;
mod labels;
pub(super) mod points;
pub(super) mod ring;
pub(super) mod seeds;
pub(super) mod sharp_ends;
#[cfg(test)]
mod tests;
