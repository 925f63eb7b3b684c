//! Rounds and refinement in a partition, as far as its interface allows.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::partitions::interfaces::FEW;
use crate::netmesh::partitions::partition::Partition;
use crate::netmesh::rounds::round::tiles;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::watch::Watch;
use crate::options::Output;
use std::ops::Range;

impl<const D: usize> Partition<D> {
    /// Goes through the rest of the rounds and of the refinement.
    pub fn refine(self, watch: Watch<'_, '_>) -> Result<Self> {
        let mut mesher = Mesher::resume(self.state, watch);
        mesher.state.stage.vertices_before_final = mesher.state.delaunay.point_count();
        mesher.reported = mesher.state.progress_counts();
        mesher.run_rounds(&mut Cavity::default())?;
        Ok(Self { state: mesher.state, ..self })
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Goes through the rest of the rounds, FINISHMESH and the final refinement, as far as the
    /// interface allows.
    fn run_rounds(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.lock()?;
        self.run_rounds_locked(cavity)
    }

    /// Goes through rounds and refinement, as far as the interface allows, which is locked already.
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
            if !self.state.is_inserted(input)
                && self.state.interface.is_eligible(self.state.conflict_lists.simplex_of(input))
            {
                if !self.insert_input(input, cavity)? {
                    self.state.defer(input)?;
                }
                self.clean(cavity)?;
            }
        }
        Ok(())
    }

    /// Locks the simplices that must stay as they are. Cells are not refined at the corners of such
    /// simplices.
    pub(in crate::netmesh) fn lock(&mut self) -> Result<()> {
        let bound = self.state.delaunay.complex().simplex_bound();
        self.state.refine_list.forget(&[], bound)?;
        for simplex in SimplexId::below(bound) {
            self.watch.poll_after(1)?;
            let is_locked =
                (0..=D).any(|index| self.state.delaunay.complex().is_interface(simplex, index));
            self.state.interface.locked.try_push(is_locked)?;
            if is_locked {
                self.state.refine_list.limit(simplex);
                self.state.interface.skip(simplex)?;
            }
        }
        Ok(())
    }

    /// Locks the simplices that still have inputs: these are not redistributed any more.
    fn lock_crowded(&mut self) -> Result<()> {
        let bound = self.state.delaunay.complex().simplex_bound();
        self.state.interface.locked.cover(bound, false)?;
        for simplex in SimplexId::below(bound) {
            self.watch.poll_after(1)?;
            if self.state.conflict_lists.count(simplex) > 0 {
                self.state.interface.locked[simplex] = true;
                self.state.refine_list.limit(simplex);
            }
        }
        Ok(())
    }
}
