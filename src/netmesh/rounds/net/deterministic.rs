//! The round of the deterministic ordering: NET(1/(2d), inputs) of every conflict list, or of
//! smaller parts where that did not halve the conflict lists. No random number is used, here or
//! elsewhere in such a run.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{TryGrow, collected};
use crate::netmesh::rounds::net::greedy::Net;
use crate::netmesh::state::Mesher;

/// Simplices with at most this number times 1 / eps inputs give all of them. A net for eps often
/// has as many points, and costs more.
const EXHAUSTED: u32 = 4;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns the net of the inputs of each of `lists` for eps = 2^-pass / (2 D). Small conflict
    /// lists are exhausted.
    pub(super) fn select_nets(&mut self, pass: u32, lists: &[SimplexId]) -> Result<Vec<VertexId>> {
        let share = (2 * D as u32) << pass.min(24);
        let mut net = Net::new()?;
        let (mut inputs, mut points) = (Vec::new(), Vec::new());
        let mut selected = Vec::new();
        for &start in lists {
            self.watch.poll_after(1)?;
            let count = self.state.conflict_lists.count(start);
            if count == 0 || !self.state.interface.is_eligible(start) {
                continue;
            }
            inputs.clear();
            for input in self.state.conflict_lists.entries(start) {
                self.watch.poll_after(1)?;
                inputs.try_push(input)?;
            }
            if count <= EXHAUSTED * share {
                selected.try_extend(&inputs)?;
                continue;
            }
            points.clear();
            for &input in &inputs {
                points.try_push(*self.state.delaunay.point(input))?;
            }
            let finite = self.state.delaunay.finite_near(start);
            let vertices = self.state.delaunay.complex().vertices(finite);
            let anchors = collected(vertices.iter().map(|&v| *self.state.delaunay.point(v)))?;
            for &i in net.choose(&anchors, &points, count.div_ceil(share), &mut self.watch)? {
                selected.try_push(inputs[i])?;
            }
        }
        Ok(selected)
    }
}
