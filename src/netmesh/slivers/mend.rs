//! The work on slivers: every one in turn, then passes over those left, with more and more effort.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{Array, TryGrow};
use crate::netmesh::slivers::candidates::Candidates;
use crate::netmesh::slivers::queue::{Failed, Queue, Sliver, UNTRIED};
use crate::netmesh::slivers::random::Random;
use crate::netmesh::slivers::shape::Measure;
use crate::netmesh::slivers::stars::Stars;
use crate::netmesh::slivers::work::{LEAST_GAIN, LEAST_GAIN_BEYOND, POINTS, Slivers};
use crate::netmesh::state::Mesher;
use crate::options::GivesWay;
use crate::parameters::Parameters;

/// Passes over the slivers that are left, with each effort. An effort tries four times as many
/// places as the one before.
const PASSES: [u32; 6] = [8, 4, 2, 1, 1, 1];

/// An effort for which all slivers that are left would take more is not made: where that many are
/// left, it is not for want of effort. In units of the places of one sliver with the least effort,
/// beside as many as there were slivers at first.
const MOST_PLACES: usize = 1 << 12;

/// Exact tests that the work may take, and as many again for each sliver: where doubles decide
/// little, as among subnormals, the slivers that are left by then stay.
const EXACT_TESTS: u64 = 20_000;

const EXACT_TESTS_OF_SLIVER: u64 = 250;

/// Work that a sliver takes, in the units of the watch.
const WORK: u32 = 400;

/// Factors of the bound when it gives way, in turn.
const LOOSER: [f64; 4] = [1.25, 1.5, 2.0, f64::INFINITY];

impl Mesher<'_, '_, 3> {
    /// Mends the slivers as far as that can be done.
    pub(in crate::netmesh) fn remove_slivers(&mut self) -> Result<()> {
        let slivers = &mut self.find_slivers()?;
        let first = self.state.delaunay.point_count();
        self.mend_waiting(slivers)?;
        self.thin_out(first, slivers)?;
        self.mend_waiting(slivers)?;
        self.mend_with_effort(slivers)?;
        if self.state.parameters.gives_way == GivesWay::Bound {
            self.let_bound_give_way(slivers)?;
        }
        self.ask_all_sizes()?;
        self.state.removed = std::mem::take(&mut slivers.free);
        self.state.removed.sort_unstable();
        self.state.stage.sliver_fraction = 1.0;
        self.report_progress()
    }

    /// Passes over the slivers that are left, with more and more effort.
    fn mend_with_effort(&mut self, slivers: &mut Slivers) -> Result<()> {
        let most = MOST_PLACES + slivers.found;
        for (effort, passes) in (0..).zip(PASSES) {
            for _ in 0..passes {
                self.drop_hopeless(effort, slivers)?;
                let is_too_much = slivers.queue.failed() * places(effort) > most;
                if is_too_much || !self.mend_failed(effort, slivers)? {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Mends slivers that are left, as near to the bound as that can be done.
    fn let_bound_give_way(&mut self, slivers: &mut Slivers) -> Result<()> {
        let Parameters { min_dihedral, criterion, quality_bound, .. } = self.state.parameters;
        slivers.least_gain = LEAST_GAIN_BEYOND;
        for factor in LOOSER {
            slivers.measure = Measure::new(min_dihedral, criterion, factor * quality_bound);
            self.mend_with_effort(slivers)?;
        }
        Ok(())
    }

    /// Measures all tetrahedra, and queues the slivers.
    fn find_slivers(&mut self) -> Result<Slivers> {
        let parameters = &self.state.parameters;
        let Parameters { min_dihedral, criterion, quality_bound, .. } = *parameters;
        let mut slivers = Slivers {
            measure: Measure::new(min_dihedral, criterion, quality_bound),
            least_gain: LEAST_GAIN,
            penalties: Array::with_capacity(self.state.delaunay.complex().simplex_bound())?,
            stars: Stars::new(self.state.delaunay.point_count())?,
            queue: Queue::default(),
            candidates: Candidates::default(),
            found: 0,
            most_exact: 0,
            vacancy: Default::default(),
            cone: Default::default(),
            cavity: Cavity::default(),
            filled: Vec::new(),
            free: Vec::new(),
            log: None,
        };
        // From now on equal labels tell equal domains.
        for vertex in VertexId::below(self.state.delaunay.point_count()) {
            self.watch.poll_after(1)?;
            self.state.hierarchy.domain_of(vertex);
        }
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let penalty = self.state.penalty(simplex, &slivers.measure)?;
            slivers.penalties.try_push(penalty)?;
            if penalty > 0.0 {
                slivers.queue.push(self.state.sliver(simplex, penalty))?;
            }
        }
        slivers.found = slivers.queue.len();
        let allowed = EXACT_TESTS + EXACT_TESTS_OF_SLIVER * slivers.found as u64;
        slivers.most_exact = self.state.delaunay.exact_fallbacks() + allowed;
        Ok(slivers)
    }

    /// Takes every sliver that waits, and those that come, with the least effort.
    fn mend_waiting(&mut self, slivers: &mut Slivers) -> Result<()> {
        while let Some(sliver) = self.next_sliver(slivers)? {
            if self.watch.is_due(WORK) {
                let left =
                    (slivers.queue.len() + slivers.candidates.len()) as f64 / slivers.found as f64;
                let fraction = self.state.stage.sliver_fraction.max(1.0 - left);
                self.state.stage.sliver_fraction = fraction;
                self.report_progress()?;
            }
            if !self.state.is_current(&sliver, &slivers.penalties) {
                continue;
            }
            let random = &mut Random::of(&sliver, 0);
            let is_moved = self.mend_by_move(&sliver, 1, random, slivers)?.is_some();
            if !is_moved && self.state.is_left_alone(sliver.simplex)? {
                // Points for it wait until all moves have been made: many would come in vain, and
                // as many would be tried for what they make.
                slivers.queue.fail(sliver, UNTRIED)?;
            } else if !is_moved {
                self.add_candidate(&sliver, slivers)?;
            } else if self.state.is_current(&sliver, &slivers.penalties) {
                slivers.queue.push(sliver)?;
            }
        }
        Ok(())
    }

    /// Drops those of the slivers left that are gone or, where a small angle of the input forces
    /// them, worth no more than the least effort.
    fn drop_hopeless(&mut self, effort: u32, slivers: &mut Slivers) -> Result<()> {
        for failed in slivers.queue.take_failed() {
            let is_current = self.state.is_current(&failed.sliver, &slivers.penalties);
            if is_current && (effort == 0 || !self.state.is_left_alone(failed.sliver.simplex)?) {
                slivers.queue.fail(failed.sliver, failed.time)?;
            }
        }
        Ok(())
    }

    /// Takes every sliver that was left, with `effort`. Returns whether any was mended.
    fn mend_failed(&mut self, effort: u32, slivers: &mut Slivers) -> Result<bool> {
        let mut any = false;
        for Failed { sliver, time } in slivers.queue.take_failed() {
            if self.state.is_exhausted(slivers) {
                return Ok(false);
            }
            if !self.state.is_current(&sliver, &slivers.penalties) {
                continue;
            }
            // The least effort would try the same places once more. Those that are not forced see
            // what has changed farther away.
            let is_forced = effort == 0 && self.state.is_left_alone(sliver.simplex)?;
            let is_tried = is_forced && time != UNTRIED;
            if is_tried && !self.state.has_changed_since(time, &sliver, &slivers.stars) {
                slivers.queue.fail(sliver, time)?;
                continue;
            }
            if self.mend(&sliver, effort, slivers)? {
                any = true;
                if self.state.is_current(&sliver, &slivers.penalties) {
                    slivers.queue.push(sliver)?;
                }
                self.mend_waiting(slivers)?;
            } else {
                slivers.queue.fail(sliver, self.state.now())?;
            }
        }
        Ok(any)
    }

    /// Makes a change at `sliver` that lets the objective fall; whether there was one.
    fn mend(&mut self, sliver: &Sliver, effort: u32, slivers: &mut Slivers) -> Result<bool> {
        let random = &mut Random::of(sliver, effort);
        let times = places(effort);
        let is_moved = self.mend_by_move(sliver, times, random, slivers)?.is_some();
        if is_moved {
            return Ok(true);
        }
        let numbers = [1, POINTS * times];
        let points = self.best_insertions(sliver, numbers, slivers.least_gain, random, slivers)?;
        if let Some(point) = points.first() {
            self.insert_point(sliver.simplex, &point.x, slivers)?;
            return Ok(true);
        }
        if effort == 0 {
            return Ok(false);
        }
        self.relax(sliver, POINTS * times, random, slivers)
    }
}

/// Returns the number of places that an effort tries for each that the least effort tries.
fn places(effort: u32) -> usize {
    4usize.pow(effort)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Inputs;
    use crate::netmesh::slivers::shape::tetrahedron;
    use crate::netmesh::state::watch::Watch;
    use crate::numerics::testing::Random;
    use crate::options::Options;

    /// They are beside cages, where nothing may move: efforts for them would be for nothing.
    #[test]
    fn slivers_of_several_domains_are_not_queued() {
        let mut random = Random(4);
        let points: Vec<f64> = (0..3 * 100).map(|_| random.unit()).collect();
        let near = points.iter().map(|x| x + 2f64.powi(-20));
        let points: Vec<f64> = points.iter().copied().chain(near).collect();
        let inputs = Inputs::new(3, 200, &points, 0).unwrap();
        let options = Options { min_dihedral: 15.0, ..Options::default() };
        let parameters = Parameters::resolve(3, &options).unwrap();
        let mut mesher = Mesher::<3>::new(&inputs, parameters, Watch::new(None)).unwrap();
        let mut cavity = Cavity::default();
        mesher.start_netmesh(&mut cavity).unwrap();
        mesher.insert_rounds(&mut cavity).unwrap();
        mesher.refine_finally(&mut cavity).unwrap();
        let slivers = mesher.find_slivers().unwrap();
        // Of one domain, and of several.
        let mut counts = [0; 2];
        let complex = mesher.state.delaunay.complex();
        for simplex in complex.simplices().filter(|&simplex| complex.is_live(simplex)) {
            let vertices = complex.vertices(simplex);
            if !complex.is_infinite(simplex)
                && slivers.measure.penalty(&tetrahedron(&mesher.state.delaunay, vertices)) > 0.0
            {
                let is_of_one = mesher.state.hierarchy.same_domain(vertices);
                counts[usize::from(!is_of_one)] += 1;
                assert_eq!(slivers.penalties[simplex] > 0.0, is_of_one);
            }
        }
        assert!(counts[0] > 50 && counts[1] > 100, "{counts:?}");
        assert_eq!(slivers.queue.len(), counts[0]);
    }
}
