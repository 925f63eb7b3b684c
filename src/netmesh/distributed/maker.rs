//! The maker of partitions of pieces, which is the same on all processes.

use crate::error::Result;
use crate::memory::{TryGrow, copied};
use crate::mesh::Triangulation;
use crate::netmesh::distributed::assembly::{Assembly, First};
use crate::netmesh::distributed::names::is_input;
use crate::netmesh::distributed::piece::Piece;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::order::InputId;
use crate::netmesh::state::watch::Watch;
use crate::options::{Output, ProgressFn};
use crate::parameters::Parameters;
use std::time::Instant;

/// The options of the run in full, and the template of its cages.
pub struct Maker<const D: usize> {
    pub(super) parameters: Parameters,
    pub(super) template: Vec<[f64; D]>,
}

impl<const D: usize> Maker<D> {
    pub(super) fn assemble(
        &self,
        pieces: &[Piece<D>],
        first: First,
        number: u32,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Assembly<D>> {
        Assembly::new(pieces, first, &self.parameters, copied(&self.template)?, number, watch)
    }

    /// Puts `pieces` together and goes through rounds and refinement, as far as their interface
    /// allows. `number`: that of the partition, different for all that are made, from 1 on.
    ///
    /// # Errors
    /// `Limit`, `OutOfMemory`, `Cancelled`.
    pub fn refine(
        &self,
        pieces: Vec<Piece<D>>,
        number: u32,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<Piece<D>> {
        let mut watch = Watch::new(progress);
        let assembly = self.assemble(&pieces, First::Waiting, number, &mut watch)?;
        drop(pieces);
        assembly.refine(number, watch)
    }

    /// Returns true if nothing is left to do in `piece`, and there are no pieces that it has not
    /// joined.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn is_done(&self, piece: &Piece<D>) -> Result<bool> {
        let is_finished = match self.parameters.output {
            Output::WellSpaced => piece.domains.len() <= 1,
            Output::Auto | Output::Hierarchical => true,
        };
        Ok(is_finished && piece.is_settled()?)
    }

    /// Returns the mesh that `pieces` are together, for one process to have. Names of inputs must
    /// be the numbers from 0 on.
    ///
    /// # Errors
    /// `OutOfMemory`, `Limit`.
    pub fn whole(&self, pieces: Vec<Piece<D>>) -> Result<Triangulation> {
        let begun = Instant::now();
        let mut watch = Watch::new(None);
        let assembly = self.assemble(&pieces, First::Inputs, u32::MAX, &mut watch)?;
        drop(pieces);
        let mut order = Vec::new();
        for name in assembly.names.iter().copied().take_while(|&name| is_input(name)) {
            order.try_push(InputId::new(name as usize))?;
        }
        let mut mesher = Mesher::resume(assembly.state, watch);
        mesher.order = order;
        mesher.into_triangulation(begun)
    }
}
