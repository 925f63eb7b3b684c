//! SELECTROUND (§6.5): the inputs that a pass inserts.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::options::NetOrdering;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns the inputs of `lists` that pass number `pass` of a round inserts, by conflict list.
    /// Conflict lists with at most `target` inputs need not halve again after the first pass.
    pub(in crate::netmesh) fn select_round(
        &mut self,
        pass: u32,
        target: u32,
        lists: &[SimplexId],
    ) -> Result<Vec<VertexId>> {
        match self.state.parameters.ordering {
            NetOrdering::SampledNet => {
                let crowd = if pass == 0 { 0 } else { target };
                self.select_sample(1 << pass.min(31), crowd, lists)
            }
            NetOrdering::DeterministicNet => self.select_nets(pass, lists),
        }
    }
}
