//! The regions that walls separate, and that of a simplex.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::state::segments::SegmentState;
use crate::netmesh::state::segments::walls::Walls;
use crate::netmesh::state::{Mesher, State};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Finds all regions. All of the boundary is recovered.
    pub(in crate::netmesh) fn find_regions(&mut self) -> Result<()> {
        let State { delaunay, segments, facets, .. } = &mut self.state;
        let SegmentState { regions, chains, visited, .. } = segments;
        let tick = |work| self.watch.poll_after(work);
        regions.find(delaunay, Walls { chains, facets }, visited, tick)
    }
}

impl<const D: usize> State<D> {
    /// Collects the conflicts of `x` from `start` on, which is one of them: those in its region, if
    /// that is known, and of other regions the first ones, until there are `most`. Beyond a wall
    /// that `x` crosses there may be thousands, as long as nothing is refined there.
    pub(in crate::netmesh) fn find_cavity_in_region(
        &mut self,
        start: SimplexId,
        x: &[f64; D],
        most: usize,
        cavity: &mut Cavity,
    ) -> AllocResult<()> {
        let regions = &self.segments.regions;
        match regions.of(start) {
            None => self.delaunay.find_cavity(start, x, cavity),
            Some(own) => self.delaunay.find_cavity_within(start, x, cavity, |simplex, found| {
                found < most || regions.of(simplex).is_none_or(|region| region == own)
            }),
        }
    }

    /// Returns the region of a live simplex. All of the boundary is recovered.
    pub(in crate::netmesh) fn region_of(&mut self, simplex: SimplexId) -> AllocResult<u32> {
        let State { delaunay, segments, facets, .. } = self;
        let SegmentState { regions, chains, visited, .. } = segments;
        regions.resolve(simplex, delaunay.complex(), Walls { chains, facets }, visited)
    }
}
