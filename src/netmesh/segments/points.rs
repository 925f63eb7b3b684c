//! The Delaunay triangulation of the inputs, in the outer cage: what segments come to. It has no
//! Steiner vertices. In the plane a Delaunay triangulation is small whatever the spread of the
//! points, so nothing is lost without the refinement that goes along with `rounds`; and all that
//! would have been put near segments would be in their way.
//!
//! The inputs come in rounds, each of which has about three times as many as those before together,
//! chosen at random (N. Amenta, S. Choi and G. Rote, "Incremental constructions con BRIO", 2003),
//! so that the expected time is O(n log n) for all points. In a round they come in their order of
//! locality, and a walk finds each from the one before it in that order that is in the mesh.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, collected};
use crate::netmesh::state::hierarchy::ROOT;
use crate::netmesh::state::{Cell, Mesher, State};
use crate::numerics::distance;
use crate::options::NetOrdering;
use rand_core::Rng;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts all inputs. `center` is the one that is in already.
    pub(super) fn insert_points(&mut self, center: VertexId, cavity: &mut Cavity) -> Result<()> {
        let rounds = self.state.rounds_of_inputs()?;
        let count = rounds.iter().copied().max().unwrap_or(0);
        self.state.conflict_lists.dismiss_unassigned();
        for round in (0..=count).rev() {
            let mut near = center;
            for (input, &own) in VertexId::below(rounds.len()).zip(&rounds) {
                self.watch.poll_after(1)?;
                if own == round && input != center {
                    self.insert_by_walk(input, near, cavity)?;
                }
                if own >= round {
                    near = input;
                }
            }
            self.state.stats.rounds += 1;
            self.report_progress()?;
        }
        let bound = self.state.delaunay.complex().simplex_bound();
        self.state.refine_list.forget(&[], bound)?;
        self.measure_cells()
    }

    fn insert_by_walk(
        &mut self,
        input: VertexId,
        near: VertexId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let State { delaunay, conflict_lists, hierarchy, .. } = &mut self.state;
        let x = *delaunay.point(input);
        let start = delaunay.complex().incident(near);
        let found = delaunay.locate_and_count(start, &x, conflict_lists.touches_mut(input));
        delaunay.find_cavity(found.expect("inputs are distinct"), &x, cavity)?;
        hierarchy.set_domain(input, ROOT);
        delaunay.insert(input, cavity, &mut self.scratch.created)?;
        conflict_lists.dismiss_unassigned();
        if self.watch.is_due(4 * cavity.boundary.len() as u32) {
            self.report_progress()?;
        }
        Ok(())
    }

    /// Measures the extent of all cells.
    fn measure_cells(&mut self) -> Result<()> {
        self.state.cells.iter_mut().for_each(|cell| *cell = Cell::NEW);
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let State { delaunay, cells, .. } = &mut self.state;
            let Some(radius) = delaunay.radius(simplex) else { continue };
            if !delaunay.complex().is_live(simplex) {
                continue;
            }
            let vertices = delaunay.complex().vertices(simplex);
            for (at, &vertex) in vertices.iter().enumerate() {
                cells[vertex].farthest = cells[vertex].farthest.max(radius);
                for &other in &vertices[..at] {
                    let length = distance(delaunay.point(vertex), delaunay.point(other));
                    cells[vertex].nearest = cells[vertex].nearest.min(length);
                    cells[other].nearest = cells[other].nearest.min(length);
                }
            }
        }
        Ok(())
    }
}

impl<const D: usize> State<D> {
    /// Returns, for every input, the number of rounds that come after its own.
    fn rounds_of_inputs(&mut self) -> AllocResult<Vec<u8>> {
        let ordering = self.parameters.ordering;
        collected((0..self.inputs as u32).map(|input| {
            let bits = match ordering {
                NetOrdering::SampledNet => self.random.next_u32(),
                // The fractions of multiples of the golden ratio.
                NetOrdering::DeterministicNet => input.wrapping_mul(0x9e37_79b9),
            };
            // Three of four inputs are of the last round.
            (bits.leading_zeros() / 2) as u8
        }))
    }
}
