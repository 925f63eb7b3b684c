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
//! What divides the work of one mesh belongs here: `schedule` runs the partitions, `reserves` gives
//! them memory to grow in, and `workers` share work that changes nothing.

mod cut;
pub(super) mod interface;
mod interfaces;
mod join;
mod permission;
mod reserves;
mod schedule;
#[cfg(test)]
mod tests;
pub(super) mod workers;

use crate::complex::{LocalToGlobal, SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::Array;
use crate::netmesh::cages::domains::DomainsToGlobal;
use crate::netmesh::rounds::round::tiles;
use crate::netmesh::{Mesher, State};
use crate::options::{Algorithm, Output};
use crate::parameters::Parameters;
use std::ops::Range;

/// In higher dimensions most of the mesh is at interfaces.
const MAX_DIM: usize = 3;

/// The rounds of a tile end when one inserts no more than one input of this number.
const FEW: usize = 32;

/// A partition of the mesh, and all that it takes to go on with it.
struct Partition<const D: usize> {
    local_to_global: LocalToGlobal,
    domains: DomainsToGlobal,
    /// Vertex -> whether other partitions have simplices at it. Vertices that are made later are
    /// not there.
    shared: Vec<bool>,
    state: State<D>,
}

/// Whether a mesh of so many `inputs` is made in partitions.
fn is_partitioned<const D: usize>(parameters: &Parameters, inputs: usize) -> bool {
    parameters.algorithm == Algorithm::Netmesh
        && D <= MAX_DIM
        && inputs >= 2 * parameters.inputs_per_partition
}

impl<const D: usize> Mesher<'_, '_, D> {
    pub(in crate::netmesh) fn is_partitioned(&self) -> bool {
        is_partitioned::<D>(&self.state.parameters, self.state.inputs)
    }

    /// Inserts most inputs, and refines most of the mesh; dissolves most cages before that, if none
    /// is to be left.
    pub(in crate::netmesh) fn insert_in_partitions(&mut self, cavity: &mut Cavity) -> Result<()> {
        if !self.is_partitioned() || self.state.conflict_lists.remaining() == 0 {
            return Ok(());
        }
        // Two threads, or four, do even numbers of partitions in the same time.
        let count = self
            .state
            .inputs
            .div_ceil(self.state.parameters.inputs_per_partition)
            .next_multiple_of(2);
        let interfaces = self.interfaces(count)?;
        self.insert_at_interfaces(&interfaces, cavity)?;
        let runs = self.between(&interfaces)?;
        let complex = self.state.delaunay.complex();
        let mut moved = Array::filled(complex.simplex_bound(), SimplexId::NONE)?;
        let partitions = self.cut(runs)?;
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

    /// Goes through the rest of the rounds, FINISHMESH and the final refinement, as far as the
    /// interface allows.
    fn run_rounds(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.lock()?;
        self.run_rounds_locked(cavity)
    }

    /// The same where the interface is locked already.
    pub(in crate::netmesh) fn run_rounds_locked(&mut self, cavity: &mut Cavity) -> Result<()> {
        for tile in tiles(self.state.inputs) {
            self.insert_most(&tile, cavity)?;
        }
        self.insert_stragglers(cavity)?;
        self.lock_crowded()?;
        self.state.conflict_lists.suspend();
        if self.state.parameters.output == Output::WellSpaced {
            self.finish_mesh(cavity)?;
        }
        self.refine_partition_finally(cavity)?;
        self.state.conflict_lists.resume();
        Ok(())
    }

    /// Passes over the eligible inputs of `tile`, until one inserts few of them.
    fn insert_most(&mut self, tile: &Range<usize>, cavity: &mut Cavity) -> Result<()> {
        loop {
            let mut lists = self.lists_of(tile)?;
            lists.retain(|&simplex| self.state.interface.is_eligible(simplex));
            let count = |&simplex: &SimplexId| self.state.conflict_lists.count(simplex) as usize;
            let waiting: usize = lists.iter().map(count).sum();
            let before = self.state.conflict_lists.remaining();
            self.insert_pass(0, 0, &lists, cavity)?;
            if before - self.state.conflict_lists.remaining() <= waiting / FEW {
                return Ok(());
            }
        }
    }

    /// Inserts the eligible inputs that are left, when rounds insert too few.
    fn insert_stragglers(&mut self, cavity: &mut Cavity) -> Result<()> {
        for input in VertexId::below(self.state.inputs) {
            self.watch.poll_after(1)?;
            if !self.is_inserted(input)
                && self.state.interface.is_eligible(self.state.conflict_lists.simplex_of(input))
            {
                if !self.insert_input(input, cavity)? {
                    self.defer(input)?;
                }
                self.clean(cavity)?;
            }
        }
        Ok(())
    }
}
