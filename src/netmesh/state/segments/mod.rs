//! Segments, as the mesh knows them: chains of subsegments, and the regions that they separate in
//! the plane, and facets in space.

pub(in crate::netmesh) mod chain;
pub(in crate::netmesh) mod regions;
pub(in crate::netmesh) mod walls;

use crate::complex::SimplexId;
use crate::error::message;
use crate::mesh::{self, NONE};
use crate::netmesh::state::segments::chain::Chains;
use crate::netmesh::state::segments::regions::Regions;
use std::borrow::Cow;
use std::fmt::{self, Display, Formatter};

/// Segments of a mesh: their chains, the regions between them, and what is known of both.
#[derive(Default)]
pub(in crate::netmesh) struct SegmentState {
    pub chains: Chains,
    pub regions: Regions,
    /// The seeds of the caller in the regions where they were found.
    pub seeds: Vec<Seed>,
    /// The subsegments that a point would encroach.
    pub encroached: Vec<u32>,
    /// Encroached subsegments that would be no edges any more, although doubles are too coarse to
    /// split them.
    pub crossed: Vec<u32>,
    /// Points where segments have no room beside each other.
    pub crowded: Vec<Crowded>,
    /// Simplices that a search for a known region has visited.
    pub visited: Vec<SimplexId>,
}

/// A seed of the caller's, by its number, and the region that it is in.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Seed {
    pub number: u32,
    pub x: [f64; 3],
    pub region: u32,
}

/// A point on a segment where doubles have no room for a vertex of its own.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Crowded {
    pub segment: u32,
    /// The segment that has a vertex there, if one does.
    pub beside: Option<u32>,
    pub at: mesh::Crowded,
    /// The point in space; 0 is the third coordinate in the plane.
    pub x: [f64; 3],
}

/// Point in messages.
pub(in crate::netmesh) struct At<'a>(pub &'a [f64]);

impl Display for At<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let mut between = "(";
        for x in self.0 {
            write!(f, "{between}{x:?}")?;
            between = ", ";
        }
        f.write_str(")")
    }
}

/// Returns the name of a segment in errors.
pub(in crate::netmesh) fn name_of(segment: u32) -> Cow<'static, str> {
    match segment {
        NONE => "the boundary of the hull or box".into(),
        segment => message!("segments[{segment}]").into(),
    }
}

impl SegmentState {
    /// Returns true if the mesh has segments, and they are being recovered or have been.
    #[inline]
    pub fn is_active(&self) -> bool {
        !self.chains.is_empty()
    }
}
