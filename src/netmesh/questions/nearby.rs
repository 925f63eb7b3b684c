//! The vertices and inputs near a point that is to go in, by its cavity.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::distance;

impl<const D: usize> State<D> {
    pub(in crate::netmesh) fn find_cavity_of_input(
        &mut self,
        input: VertexId,
        cavity: &mut Cavity,
    ) -> AllocResult<()> {
        let q = *self.delaunay.point(input);
        let start = self.conflict_lists.simplex_of(input);
        self.delaunay.find_cavity(start, &q, cavity)
    }

    pub(in crate::netmesh) fn nearest_vertex_distance(&self, x: &[f64; D], cavity: &Cavity) -> f64 {
        let distances = cavity.vertices.ids.iter().map(|&v| distance(x, self.delaunay.point(v)));
        distances.fold(f64::INFINITY, f64::min)
    }

    pub(in crate::netmesh) fn is_crowded(&self, simplex: SimplexId) -> bool {
        self.conflict_lists.count(simplex) > 0
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns the uninserted input nearest to `x` within `max_distance`, among the conflict lists
    /// of
    /// `cavity`, which is that of `x`. An input at `x` itself is within any distance, also one that
    /// has become zero among subnormal numbers: no other vertex may take its place.
    pub(in crate::netmesh) fn input_near(
        &mut self,
        x: &[f64; D],
        max_distance: f64,
        cavity: &Cavity,
    ) -> Result<Option<VertexId>> {
        if self.state.conflict_lists.remaining() == 0 {
            return Ok(None);
        }
        let mut best = None;
        let mut least = max_distance;
        for at in 0..cavity.simplices.len() {
            let simplex = cavity.simplices[at];
            for input in self.state.conflict_lists.entries(simplex) {
                self.watch.poll_after(1)?;
                let distance = distance(x, self.state.delaunay.point(input));
                if distance < least || distance == 0.0 {
                    least = distance;
                    best = Some(input);
                }
            }
        }
        Ok(best)
    }
}
