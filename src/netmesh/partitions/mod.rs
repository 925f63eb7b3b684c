//! Large meshes are made in partitions, on as many threads as the caller allows.
//!
//! The rounds (§6.5) begin as always. Once they have made a coarse mesh, the inputs at the
//! interfaces between partitions are inserted (`interfaces`) and the mesh is cut there (`cut`).
//! Each partition goes through the rest of the rounds and of the refinement as a mesh of its own.
//! It defers whatever would change a simplex at its interface (`interface`, `permission`). Then the
//! partitions join (`join`), and the global mesh does what they deferred.
//!
//! The paper inserts the inputs of a round, and refines, in any order (§6.3, §6.4). This is one of
//! the orders that it allows, except for the bound on rounds: a deferred input waits for the rounds
//! of the global mesh.
//!
//! Partitions depend on the inputs only, and join in a fixed order. So the mesh does not depend on
//! the number of threads.
//!
//! Everything that divides the work of one mesh belongs here: `schedule` runs the partitions,
//! `reserves` gives them memory to grow in, and `workers` share work that changes nothing.

pub(super) mod extract;
pub(super) mod interfaces;
pub(super) mod join;
pub(super) mod partition;
pub(super) mod reserves;
pub(super) mod rounds;
pub(super) mod schedule;

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::Array;
use crate::netmesh::state::Mesher;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts most inputs, and refines most of the mesh; dissolves most cages before that, if none
    /// is to be left.
    pub(in crate::netmesh) fn insert_in_partitions(&mut self, cavity: &mut Cavity) -> Result<()> {
        let has_inputs = self.state.conflict_lists.remaining() > 0;
        let Some(count) = self.state.partition_count().filter(|_| has_inputs) else {
            return Ok(());
        };
        let interfaces = self.state.interfaces(count)?;
        self.insert_at_interfaces(&interfaces, cavity)?;
        let runs = self.between(&interfaces)?;
        let complex = self.state.delaunay.complex();
        let mut moved = Array::filled(complex.simplex_bound(), SimplexId::NONE)?;
        let partitions = self.extract(runs)?;
        self.watch.poll()?;
        self.refine_partitions(partitions, &mut moved)?;
        let watch = &mut self.watch;
        self.state.delaunay.replace_joined(&moved, || watch.poll_after(1))?;
        self.make_deferred_room(cavity)
    }

    /// Grows the cages that partitions deferred, for inputs that a cage of theirs yielded to.
    fn make_deferred_room(&mut self, cavity: &mut Cavity) -> Result<()> {
        for (cage, input) in std::mem::take(&mut self.state.interface.deferred) {
            self.make_room_outside(cage, &[input], cavity)?;
        }
        self.clean(cavity)
    }
}

#[cfg(test)]
mod tests;
