//! The view of a mesh by which places for vertices are judged.

use crate::complex::SimplexId;
use crate::delaunay::Delaunay;
use crate::netmesh::slivers::shape::Measure;
use crate::netmesh::state::hierarchy::Hierarchy;
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
}

impl<'a> View<'a> {
    pub fn new(
        state: &'a State<3>,
        sizes: Option<&'a Sizes<'a, 3>>,
        penalties: &'a [f32],
        measure: &'a Measure,
    ) -> Self {
        let State { delaunay, hierarchy, cells, .. } = state;
        Self { delaunay, hierarchy, cells, penalties, measure, sizes }
    }

    /// Returns the sum of the penalties of live simplices.
    pub fn sum(&self, simplices: &[SimplexId]) -> f64 {
        simplices.iter().map(|&simplex| f64::from(self.penalties[simplex])).sum()
    }
}
