//! Large meshes in parts, on as many threads as the caller allows. The rounds (§6.5) begin as always; once
//! they have made a coarse mesh, the inputs at walls between parts go in (`walls`), the mesh is cut there,
//! and each part goes through the rest of the rounds and of the refinement as a mesh of its own. What
//! would change simplices at a part's rim is left undone (`rim`). Then the parts join, and the whole does
//! what is left.
//!
//! The paper inserts the inputs of a round, and refines, in any order (§6.3, §6.4), so this is one of the
//! orders that it allows, but for the bound on rounds: an input at a rim waits for the whole's.
//!
//! Parts are the same, and join in the same order, whatever the number of threads: so is the mesh.

mod cut;
pub(super) mod interface;
mod interfaces;
mod join;
mod reserves;
mod schedule;
#[cfg(test)]
mod tests;
pub(super) mod workers;

use crate::complex::{GlobalToLocal, LocalToGlobal};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{Array, with_room};
use crate::mesh::NONE;
use crate::netmesh::cages::domains::DomainsToGlobal;
use crate::netmesh::{Mesher, State};
use crate::options::{Algorithm, Output};

/// In higher dimensions rims are most of the mesh.
const MAX_DIM: usize = 3;

/// One of so many inputs is in the coarse mesh, before those at walls.
const COARSE: usize = 128;

/// A part's rounds end when one inserts no more than one of so many inputs.
const FEW: usize = 32;

/// A part of the mesh, all that it takes to go on with it.
struct Partition<const D: usize> {
    local_to_global: LocalToGlobal,
    domains: DomainsToGlobal,
    /// Vertex -> whether other partitions have simplices at it. Vertices that are made later are not
    /// there.
    shared: Vec<bool>,
    state: State<D>,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Whether the inputs are many enough for parts, and the mesh is fine enough.
    pub(in crate::netmesh) fn is_ready_for_partitions(&self) -> bool {
        self.is_partitioned()
            && self.state.inputs - self.state.conflict_lists.remaining()
                >= self.state.inputs / COARSE
    }

    /// Whether the last refinement was done in parts, but for what was left at rims.
    pub(in crate::netmesh) fn is_nearly_final(&self) -> bool {
        self.is_partitioned() && self.state.parameters.output == Output::Hierarchical
    }

    pub(in crate::netmesh) fn is_partitioned(&self) -> bool {
        self.state.parameters.algorithm == Algorithm::Netmesh
            && D <= MAX_DIM
            && self.state.inputs >= 2 * self.state.parameters.inputs_per_partition
    }

    /// Inserts most inputs, and refines most of the mesh unless cages are to be dissolved before.
    pub(in crate::netmesh) fn insert_in_partitions(&mut self, cavity: &mut Cavity) -> Result<()> {
        if !self.is_partitioned() || self.state.conflict_lists.remaining() == 0 {
            return Ok(());
        }
        // Two threads, or four, do even numbers of parts in the same time.
        let count = self
            .state
            .inputs
            .div_ceil(self.state.parameters.inputs_per_partition)
            .next_multiple_of(2);
        let interfaces = self.interfaces(count)?;
        self.insert_at_interfaces(&interfaces, cavity)?;
        let runs = self.between(&interfaces)?;
        let complex = self.state.delaunay.complex();
        let mut moved = Array::filled(complex.simplex_bound(), NONE)?;
        let mut ids =
            GlobalToLocal::new(complex.simplex_bound(), self.state.delaunay.point_count())?;
        let mut partitions = with_room(runs.len())?;
        for run in runs {
            partitions.push(self.cut(run, &mut ids)?);
        }
        drop(ids);
        self.watch.poll()?;
        self.refine_partitions(partitions, &mut moved)?;
        let watch = &mut self.watch;
        self.state.delaunay.replace_joined(&moved, || watch.poll_after(1))?;
        self.make_deferred_room(cavity)
    }

    /// What parts could not do for inputs that a cage of theirs yielded to.
    fn make_deferred_room(&mut self, cavity: &mut Cavity) -> Result<()> {
        for (cage, input) in std::mem::take(&mut self.state.interface.deferred) {
            self.make_room_outside(cage, &[input], cavity)?;
        }
        self.clean(cavity)
    }

    /// The rest of the rounds, and of the refinement, as far as the rim lets.
    fn run_rounds(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.lock()?;
        loop {
            let before = self.state.conflict_lists.remaining();
            self.insert_pass(0, 0, cavity)?;
            if before - self.state.conflict_lists.remaining() <= before / FEW {
                break;
            }
        }
        self.insert_stragglers(cavity)?;
        if self.state.parameters.output == Output::Hierarchical {
            self.lock_crowded()?;
            self.state.conflict_lists.suspend();
            self.refine_partition_finally(cavity)?;
            self.state.conflict_lists.resume();
        }
        Ok(())
    }

    /// Inserts what can be inserted, when rounds are not worth it any more.
    fn insert_stragglers(&mut self, cavity: &mut Cavity) -> Result<()> {
        for input in 0..self.state.inputs as u32 {
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
