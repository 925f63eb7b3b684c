//! The queue of crowded simplices, whose conflict lists are not empty, for Sparse Voronoi
//! Refinement.

use crate::complex::SimplexId;
use crate::memory::{AllocResult, enqueue};
use crate::netmesh::state::Mesher;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Queues the simplices just created that have inputs.
    pub(super) fn queue_crowded(&mut self) -> AllocResult<()> {
        for at in 0..self.scratch.created.len() {
            self.queue_if_crowded(self.scratch.created[at])?;
        }
        Ok(())
    }

    pub(in crate::netmesh) fn queue_if_crowded(&mut self, simplex: SimplexId) -> AllocResult<()> {
        if self.state.is_crowded(simplex) { enqueue(&mut self.crowded, simplex) } else { Ok(()) }
    }
}
