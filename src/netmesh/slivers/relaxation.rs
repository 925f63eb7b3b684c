//! Insertion with a relaxation: a point that is worth it only when vertices near it have moved. If
//! it is not worth it then, all is undone.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::slivers::insertions::Insertion;
use crate::netmesh::slivers::log::Log;
use crate::netmesh::slivers::queue::Sliver;
use crate::netmesh::slivers::random::Random;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::Mesher;

/// Points that are tried, and slivers whose vertices are moved after each.
const POINTS: usize = 3;

const SLIVERS: usize = 8;

/// Largest cost of a point before vertices move.
const COST: f64 = 4.0;

impl Mesher<'_, '_, 3> {
    /// Inserts a point for `sliver`, of `count`, and moves vertices such that the objective falls.
    /// Returns whether that could be done.
    pub(super) fn relax(
        &mut self,
        sliver: &Sliver,
        count: usize,
        random: &mut Random,
        slivers: &mut Slivers,
    ) -> Result<bool> {
        let numbers = [POINTS, count];
        let points = self.best_insertions(sliver, numbers, -COST, random, slivers)?;
        for Insertion { x, gain } in points {
            // What was undone has come back by other ids.
            let Some(start) = self.find_simplex(&sliver.vertices)? else { break };
            slivers.log = Some(Log::default());
            self.insert_point(start, &x, slivers)?;
            let wanted = slivers.least_gain - gain;
            if self.move_around(wanted, random, slivers)? >= wanted {
                self.state.keep_changes(slivers)?;
                return Ok(true);
            }
            self.undo_changes(slivers)?;
        }
        Ok(false)
    }

    /// Moves vertices of the slivers that came, the worst first, until that is worth `wanted`.
    /// Returns what it was worth.
    pub(super) fn move_around(
        &mut self,
        wanted: f64,
        random: &mut Random,
        slivers: &mut Slivers,
    ) -> Result<f64> {
        let (mut total, mut tried) = (0.0, 0);
        while total < wanted && tried < SLIVERS {
            let Some(log) = &mut slivers.log else { break };
            let fresh = &mut log.fresh;
            let worst = (0..fresh.len()).max_by_key(|&at| fresh[at]);
            let Some(sliver) = worst.map(|at| fresh.swap_remove(at)) else { break };
            if self.state.is_current(&sliver, &slivers.penalties) {
                tried += 1;
                let gain = self.mend_by_move(&sliver, 1, random, slivers)?;
                total += gain.unwrap_or(0.0);
                if let Some(log) = &mut slivers.log {
                    log.failed.try_push(sliver)?;
                }
            }
        }
        Ok(total)
    }

    /// Returns a live simplex, given its vertices in rising order.
    fn find_simplex(&mut self, vertices: &[VertexId; 4]) -> AllocResult<Option<SimplexId>> {
        self.state.delaunay.star(vertices[0], &mut self.scratch.star)?;
        let complex = self.state.delaunay.complex();
        let is_it =
            |&&s: &&SimplexId| complex.vertices(s).iter().all(|vertex| vertices.contains(vertex));
        Ok(self.scratch.star.iter().find(is_it).copied())
    }
}
