//! Insertion with a relaxation: a point that is worth it only when vertices near it have moved. If
//! it is not worth it then, all is undone.

use super::insertions::Insertion;
use super::queue::Sliver;
use super::random::Random;
use super::vacancy::Place;
use super::{LEAST_GAIN, Slivers};
use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::Mesher;

/// Points that are tried, and moves after each.
const POINTS: usize = 3;
const MOVES: usize = 8;

/// What a point may cost before vertices move.
const COST: f64 = 4.0;

/// Changes since something was begun that may be undone.
#[derive(Default)]
pub(super) struct Journal<const D: usize> {
    pub steps: Vec<Step<D>>,
    /// Slivers that came with them, which are not queued.
    pub fresh: Vec<Sliver>,
}

#[derive(Clone, Copy)]
pub(super) enum Step<const D: usize> {
    Inserted(VertexId),
    /// From where.
    Moved(VertexId, [f64; D]),
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts a point for `sliver`, of `count`, and moves vertices such that the objective falls.
    /// Returns whether that could be done.
    pub(super) fn relax(
        &mut self,
        sliver: &Sliver,
        count: usize,
        random: &mut Random,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let numbers = [POINTS, count];
        let points = self.best_insertions(sliver, numbers, -COST, random, slivers, cavity)?;
        for Insertion { x, gain } in points {
            // What was undone has come back by other ids.
            let Some(start) = self.find_simplex(&sliver.vertices)? else { break };
            slivers.journal = Some(Journal::default());
            self.insert_point(start, &x, slivers, cavity)?;
            let total = gain + self.move_around(LEAST_GAIN - gain, random, slivers, cavity)?;
            let journal = slivers.journal.take().unwrap_or_default();
            if total >= LEAST_GAIN {
                for sliver in journal.fresh {
                    if self.is_current(&sliver, &slivers.penalties) {
                        slivers.queue.push(sliver)?;
                    }
                }
                return Ok(true);
            }
            self.undo(&journal.steps, slivers, cavity)?;
        }
        Ok(false)
    }

    /// Moves vertices of the slivers that came, the worst first, until that is worth `wanted`.
    /// Returns what it was worth.
    fn move_around(
        &mut self,
        wanted: f64,
        random: &mut Random,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<f64> {
        let (mut total, mut tried) = (0.0, 0);
        while total < wanted && tried < MOVES {
            let Some(journal) = &mut slivers.journal else { break };
            let fresh = &mut journal.fresh;
            let worst = (0..fresh.len()).max_by_key(|&at| fresh[at]);
            let Some(sliver) = worst.map(|at| fresh.swap_remove(at)) else { break };
            if self.is_current(&sliver, &slivers.penalties) {
                tried += 1;
                let gain = self.mend_by_move(&sliver, 1, random, slivers, cavity)?;
                total += gain.unwrap_or(0.0);
            }
        }
        Ok(total)
    }

    /// Undoes `steps`, the last one first. The slivers that come back wait for another pass.
    fn undo(
        &mut self,
        steps: &[Step<D>],
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        slivers.journal = Some(Journal::default());
        for &step in steps.iter().rev() {
            let vertex = match step {
                Step::Inserted(vertex) | Step::Moved(vertex, _) => vertex,
            };
            let is_found = self.state.delaunay.find_hole(vertex, &mut slivers.vacancy.hole)?;
            debug_assert!(is_found, "it came inside the hull");
            if !is_found {
                break;
            }
            match step {
                Step::Inserted(vertex) => self.take_out(vertex, slivers)?,
                Step::Moved(vertex, x) => self.move_back(vertex, &x, slivers, cavity)?,
            }
        }
        for sliver in slivers.journal.take().unwrap_or_default().fresh {
            if self.is_current(&sliver, &slivers.penalties) {
                slivers.queue.fail(sliver)?;
            }
        }
        Ok(())
    }

    /// Removes the vertex with the last id, and forgets the id.
    fn take_out(&mut self, vertex: VertexId, slivers: &mut Slivers<D>) -> Result<()> {
        let x = *self.state.delaunay.point(vertex);
        let mut filled = std::mem::take(&mut slivers.filled);
        self.state.delaunay.remove(vertex, &slivers.vacancy.hole, &mut filled)?;
        self.weigh(&filled, slivers)?;
        slivers.filled = filled;
        self.note_departure(&x, &slivers.vacancy.hole.vertices.ids)?;
        self.forget_last_vertex();
        Ok(())
    }

    fn move_back(
        &mut self,
        vertex: VertexId,
        x: &[f64; D],
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let near = slivers.vacancy.filling_at(&self.state.delaunay, x);
        debug_assert!(near.is_some(), "no vertex is where this one was");
        let Some(near) = near else { return Ok(()) };
        let place = Place { x: *x, gain: 0.0, near, is_clean: false };
        self.move_vertex(vertex, &place, slivers, cavity)
    }

    /// Takes the last id back.
    fn forget_last_vertex(&mut self) {
        self.state.stats.off_centers -= 1;
        self.state.delaunay.pop_point();
        self.state.hierarchy.pop_vertex();
        self.state.cells.truncate(self.state.delaunay.point_count());
        self.state.precision_limited.truncate(self.state.delaunay.point_count());
    }

    /// A live simplex, given its vertices in rising order.
    fn find_simplex(&mut self, vertices: &[VertexId; 4]) -> AllocResult<Option<SimplexId>> {
        self.state.delaunay.star(vertices[0], &mut self.scratch.star)?;
        let complex = self.state.delaunay.complex();
        let is_it =
            |&&s: &&SimplexId| complex.vertices(s).iter().all(|vertex| vertices.contains(vertex));
        Ok(self.scratch.star.iter().find(is_it).copied())
    }
}
