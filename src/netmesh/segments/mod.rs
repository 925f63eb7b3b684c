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
//! - `clusters`: what is concentrated, and gets a cage.
//! - `chain`: the subsegments, and which edges they are.
//! - `split`: where a subsegment is split; the shells about sharp corners.
//! - `recover`: what is done until all subsegments are recovered.
//! - `regions`: the parts of the plane that segments separate, kept while the mesh changes.
//! - `interior`: which of them are inside.
//! - `seeds`: what the caller's seeds say of them.
//! - `exempt`: what refinement leaves alone: what is outside, and what a sharp corner forces.
//! - `coarsen`: away with vertices that the bound does not need.
//! - `ring`: the neighbours of a vertex, and whether they need it.
//! - `cut`: the result, with what belongs to segments and regions.

mod chain;
mod clusters;
mod coarsen;
mod conform;
mod cut;
mod exempt;
mod interior;
mod points;
mod recover;
mod regions;
mod ring;
mod seeds;
mod split;
#[cfg(test)]
mod tests;

use crate::complex::SimplexId;
use crate::error::message;
use crate::mesh::{self, NONE};
use chain::Chains;
pub(in crate::netmesh) use cut::cut;
use regions::Regions;
use std::borrow::Cow;

/// What a mesh with segments has beside the points.
#[derive(Default)]
pub(in crate::netmesh) struct Segments {
    pub chains: Chains,
    pub regions: Regions,
    /// The seeds of the caller in the regions where they were found.
    seeds: Vec<Seed>,
    /// The subsegments that a point would encroach.
    encroached: Vec<u32>,
    /// Those of them that would be no edges any more, although doubles are too coarse to split
    /// them.
    crossed: Vec<u32>,
    /// Where segments have no room beside each other.
    pub crowded: Vec<Crowded>,
    /// Where a search for what is known of a region has been.
    visited: Vec<SimplexId>,
}

/// A seed of the caller's, by its number, and the region that it is in.
#[derive(Clone, Copy)]
struct Seed {
    number: u32,
    x: [f64; 2],
    region: u32,
}

/// A point on a segment where doubles have no room for a vertex of its own.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Crowded {
    segment: u32,
    /// The segment that has a vertex there, if one does.
    beside: Option<u32>,
    pub at: mesh::Crowded,
}

/// What an error calls a segment.
fn name_of(segment: u32) -> Cow<'static, str> {
    match segment {
        NONE => "the boundary of the hull or box".into(),
        segment => message!("segments[{segment}]").into(),
    }
}

impl Segments {
    /// Whether the mesh has segments, and they are being recovered or have been.
    #[inline]
    pub fn is_active(&self) -> bool {
        !self.chains.is_empty()
    }
}
