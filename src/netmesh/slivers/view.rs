//! The view of a mesh by which places for vertices are judged.

use crate::complex::SimplexId;
use crate::delaunay::Delaunay;
use crate::netmesh::slivers::shape::Measure;
use crate::netmesh::state::facets::Facets;
use crate::netmesh::state::hierarchy::Hierarchy;
use crate::netmesh::state::segments::SegmentState;
use crate::netmesh::state::segments::chain::Chains;
use crate::netmesh::state::segments::regions::Regions;
use crate::netmesh::state::sizes::Sizes;
use crate::netmesh::state::{Cell, State};

/// Parts of a mesh by which a place for a vertex is judged.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub delaunay: &'a Delaunay<3>,
    pub hierarchy: &'a Hierarchy<3>,
    pub cells: &'a [Cell],
    pub penalties: &'a [f32],
    pub measure: &'a Measure,
    pub sizes: Option<&'a Sizes<'a, 3>>,
    /// True if the mesh conforms to facets or segments: those of `facets` and `chains`.
    pub has_boundary: bool,
    pub facets: &'a Facets,
    pub chains: &'a Chains,
    regions: &'a Regions,
}

impl<'a> View<'a> {
    pub fn new(
        state: &'a State<3>,
        sizes: Option<&'a Sizes<'a, 3>>,
        penalties: &'a [f32],
        measure: &'a Measure,
    ) -> Self {
        let State { delaunay, hierarchy, cells, facets, segments, .. } = state;
        let SegmentState { chains, regions, .. } = segments;
        let has_boundary = segments.is_active();
        Self {
            delaunay,
            hierarchy,
            cells,
            penalties,
            measure,
            sizes,
            has_boundary,
            facets,
            chains,
            regions,
        }
    }

    /// Returns the longest edge that the region of a live simplex may have, infinite for any.
    pub fn max_edge_at(&self, simplex: SimplexId) -> f64 {
        let region = self.regions.of(simplex);
        region.map_or(f64::INFINITY, |region| self.regions.max_edges[region as usize])
    }

    /// Returns the sum of the penalties of live simplices.
    pub fn sum(&self, simplices: &[SimplexId]) -> f64 {
        simplices.iter().map(|&simplex| f64::from(self.penalties[simplex])).sum()
    }
}
