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

mod crew;
mod cut;
mod join;
mod rooms;
#[cfg(test)]
mod tests;
mod walls;

use super::domains::{DomainNames, Hierarchy};
use super::location::Location;
use super::refine::RefineList;
use super::rim::Rim;
use super::{Cell, Mesher};
use crate::complex::{Ids, Names};
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::memory::{Array, with_room};
use crate::mesh::{NONE, Stats};
use crate::options::{Algorithm, Output};
use crate::parameters::Parameters;

/// In higher dimensions rims are most of the mesh.
const MAX_DIM: usize = 3;

/// One of so many inputs is in the coarse mesh, before those at walls.
const COARSE: usize = 128;

/// A part's rounds end when one inserts no more than one of so many inputs.
const FEW: usize = 32;

/// A part of the mesh, all that it takes to go on with it.
struct Part<const D: usize> {
    names: Names,
    domains: DomainNames,
    /// Vertex -> whether other parts have simplices at it; vertices that are made later are not there.
    shared: Vec<bool>,
    delaunay: Delaunay<D>,
    hierarchy: Hierarchy<D>,
    location: Location,
    refine: RefineList,
    cells: Array<Cell>,
    precision_limited: Vec<bool>,
    rim: Rim,
    template: Vec<[f64; D]>,
    parameters: Parameters,
    stats: Stats,
    /// What its random numbers start from.
    number: u64,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Whether the inputs are many enough for parts, and the mesh is fine enough.
    pub(super) fn is_ready_for_parts(&self) -> bool {
        self.goes_in_parts() && self.inputs - self.location.remaining() >= self.inputs / COARSE
    }

    /// Whether the last refinement was done in parts, but for what was left at rims.
    pub(super) fn is_nearly_closed(&self) -> bool {
        self.goes_in_parts() && self.parameters.output == Output::Hierarchical
    }

    pub(super) fn goes_in_parts(&self) -> bool {
        self.parameters.algorithm == Algorithm::Netmesh
            && D <= MAX_DIM
            && self.inputs >= 2 * self.parameters.inputs_of_part
    }

    /// Inserts most inputs, and refines most of the mesh unless cages are to be dissolved before.
    pub(super) fn insert_in_parts(&mut self) -> Result<()> {
        if !self.goes_in_parts() || self.location.remaining() == 0 {
            return Ok(());
        }
        // Two threads, or four, do even numbers of parts in the same time.
        let count = self.inputs.div_ceil(self.parameters.inputs_of_part).next_multiple_of(2);
        let walls = self.walls(count)?;
        self.insert_at_walls(&walls)?;
        let runs = self.between(&walls)?;
        let complex = self.delaunay.complex();
        let mut moved = Array::filled(complex.simplex_bound(), NONE)?;
        let mut ids = Ids::new(complex.simplex_bound(), self.delaunay.point_count())?;
        let mut parts = with_room(runs.len())?;
        for run in runs {
            parts.push(self.cut(run, &mut ids)?);
        }
        drop(ids);
        self.watch.poll()?;
        self.refine_parts(parts, &mut moved)?;
        let watch = &mut self.watch;
        self.delaunay.replace_joined(&moved, || watch.poll_after(1))?;
        self.make_postponed_room()
    }

    /// What parts could not do for inputs that a cage of theirs yielded to.
    fn make_postponed_room(&mut self) -> Result<()> {
        for (cage, input) in std::mem::take(&mut self.rim.postponed) {
            self.make_room_outside(cage, &[input])?;
        }
        self.clean()
    }

    /// The rest of the rounds, and of the refinement, as far as the rim lets.
    fn refine_part(&mut self) -> Result<()> {
        self.freeze()?;
        loop {
            let before = self.location.remaining();
            self.insert_pass(0, 0)?;
            if before - self.location.remaining() <= before / FEW {
                break;
            }
        }
        self.insert_stragglers()?;
        if self.parameters.output == Output::Hierarchical {
            self.freeze_homes()?;
            self.location.rest();
            self.close_part()?;
            self.location.go_on();
        }
        Ok(())
    }

    /// Inserts what can be inserted, when rounds are not worth it any more.
    fn insert_stragglers(&mut self) -> Result<()> {
        for input in 0..self.inputs as u32 {
            self.watch.poll_after(1)?;
            if !self.is_inserted(input) && self.rim.admits(self.location.home(input)) {
                if !self.insert_input(input)? {
                    self.postpone(input)?;
                }
                self.clean()?;
            }
        }
        Ok(())
    }
}
