//! Points for slivers that no move mends. They go in by what they are worth, the best first: one
//! point may mend slivers all round it, and where it went in, moves may mend what is left.

use crate::error::Result;
use crate::netmesh::slivers::candidates::{Candidate, class};
use crate::netmesh::slivers::queue::Sliver;
use crate::netmesh::slivers::random::Random;
use crate::netmesh::slivers::work::{POINTS, Slivers};
use crate::netmesh::state::Mesher;

impl Mesher<'_, '_, 3> {
    /// Returns the next sliver to mend. Where none waits, points go in until one does.
    pub(super) fn next_sliver(&mut self, slivers: &mut Slivers) -> Result<Option<Sliver>> {
        loop {
            if self.state.is_exhausted(slivers) {
                return Ok(None);
            }
            if let Some(sliver) = slivers.queue.pop() {
                return Ok(Some(sliver));
            }
            let Some(candidate) = slivers.candidates.0.pop() else { return Ok(None) };
            self.try_candidate(&candidate, slivers)?;
        }
    }

    /// Finds a point for `sliver`, which waits for another pass if there is none.
    pub(super) fn add_candidate(&mut self, sliver: &Sliver, slivers: &mut Slivers) -> Result<()> {
        let random = &mut Random::of(sliver, 0);
        let numbers = [1, POINTS];
        let points = self.best_insertions(sliver, numbers, slivers.least_gain, random, slivers)?;
        let time = self.state.now();
        match points.first() {
            Some(point) => {
                let class = class(point.gain);
                slivers.candidates.push(Candidate { sliver: *sliver, x: point.x, class, time })?;
            }
            None => slivers.queue.fail(*sliver, time)?,
        }
        Ok(())
    }

    /// Inserts the point of an candidate if it is worth as much as it was. Moves come first where
    /// something has changed since.
    fn try_candidate(&mut self, candidate: &Candidate, slivers: &mut Slivers) -> Result<()> {
        let Candidate { sliver, x, class: expected, time } = candidate;
        if !self.state.is_current(sliver, &slivers.penalties) {
            return Ok(());
        }
        let is_new = |&vertex: &_| slivers.stars.has_changed_since(*time, vertex);
        if sliver.vertices.iter().any(is_new) {
            return Ok(slivers.queue.push(*sliver)?);
        }
        self.state.delaunay.find_cavity(sliver.simplex, x, &mut slivers.cavity)?;
        let worth = self.judge_insertion(x, slivers.least_gain, slivers)?;
        if worth.is_none_or(|(gain, _)| class(gain) < *expected) {
            return self.add_candidate(sliver, slivers);
        }
        self.insert_point(sliver.simplex, x, slivers)?;
        if self.state.is_current(sliver, &slivers.penalties) {
            slivers.queue.push(*sliver)?;
        }
        Ok(())
    }
}
