//! The regions that walls separate, and that of a simplex.

use crate::complex::SimplexId;
use crate::memory::AllocResult;
use crate::netmesh::state::State;
use crate::netmesh::state::segments::SegmentState;
use crate::netmesh::state::segments::walls::Walls;

impl<const D: usize> State<D> {
    /// Finds all regions. All of the boundary is recovered.
    pub(in crate::netmesh) fn find_regions(&mut self) -> AllocResult<()> {
        let State { delaunay, segments, facets, .. } = self;
        let SegmentState { regions, chains, visited, .. } = segments;
        regions.find(delaunay, Walls { chains, facets }, visited)
    }

    /// Returns the region of a live simplex. All of the boundary is recovered.
    pub(in crate::netmesh) fn region_of(&mut self, simplex: SimplexId) -> AllocResult<u32> {
        let State { delaunay, segments, facets, .. } = self;
        let SegmentState { regions, chains, visited, .. } = segments;
        regions.resolve(simplex, delaunay.complex(), Walls { chains, facets }, visited)
    }
}
