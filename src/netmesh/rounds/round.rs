//! The main loop of NETMESH (§6.5): rounds, each of which at least halves the length of the longest
//! conflict list, so that there are at most 1 + log2 n rounds.
//!
//! A round over a large mesh visits all of it, and little of that is in the cache. So rounds over
//! the whole make a coarse mesh only. From then on all rounds that a tile needs come before those
//! of the next tile. A tile is a run of inputs in the order of locality
//! ([`crate::netmesh::state::order`]), and its rounds halve the longest of the conflict lists that
//! have one of them. An input is in the rounds of the few tiles that its conflict list has inputs
//! of. Each halves that list, so they are O(log n) together.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::state::{Mesher, State};
use crate::options::Algorithm;
use std::ops::Range;

/// The number of inputs of a tile, and of a mesh that is made without tiles.
const TILE: usize = 1 << 12;

const SMALL: usize = 1 << 14;

/// The coarse mesh has one input of this number.
const COARSE: usize = 128;

/// Numbers of rounds that came one after the other, and of their passes.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Rounds {
    count: u64,
    passes: u64,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Does rounds until all inputs are in.
    pub(in crate::netmesh) fn insert_rounds(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.insert_coarse_rounds(cavity)?;
        let mut most = Rounds::default();
        for tile in tiles(self.state.inputs) {
            most = most.max(self.insert_rounds_until(|_| false, &tile, cavity)?);
        }
        self.state.count_rounds(most);
        self.state.conflict_lists.free_lists();
        Ok(())
    }

    /// Does rounds over the whole mesh until it is coarse, if tiles or partitions come next.
    pub(in crate::netmesh) fn insert_coarse_rounds(&mut self, cavity: &mut Cavity) -> Result<()> {
        let all = 0..self.state.inputs;
        if all.len() > SMALL || self.state.partition_count().is_some() {
            let rounds = self.insert_rounds_until(Self::is_coarse, &all, cavity)?;
            self.state.count_rounds(rounds);
        }
        Ok(())
    }

    fn is_coarse(&self) -> bool {
        let inserted = self.state.inputs - self.state.conflict_lists.remaining();
        inserted >= self.state.inputs / COARSE
    }

    /// Does rounds until all inputs of `tile` are in, or enough is done. Returns their numbers.
    fn insert_rounds_until(
        &mut self,
        is_done: impl Fn(&Self) -> bool,
        tile: &Range<usize>,
        cavity: &mut Cavity,
    ) -> Result<Rounds> {
        let mut rounds = Rounds::default();
        let mut lists = self.lists_of(tile)?;
        while !lists.is_empty() && !is_done(self) {
            let before = self.state.longest(&lists);
            rounds.passes += self.insert_round(before / 2, tile, &mut lists, cavity)?;
            rounds.count += 1;
            let left = f64::from(self.state.longest(&lists)) / f64::from(before);
            self.state.stats.worst_halving = self.state.stats.worst_halving.max(left);
            self.report_progress()?;
        }
        Ok(rounds)
    }

    /// Does one round: inserts some inputs of each of the `lists`, which are those of `tile`, then
    /// more until none holds over `target`. Returns the number of passes.
    fn insert_round(
        &mut self,
        target: u32,
        tile: &Range<usize>,
        lists: &mut Vec<SimplexId>,
        cavity: &mut Cavity,
    ) -> Result<u64> {
        let mut pass = 0;
        while pass == 0 || self.state.longest(lists) > target {
            self.insert_pass(pass, target, lists, cavity)?;
            *lists = self.lists_of(tile)?;
            pass += 1;
        }
        Ok(u64::from(pass))
    }

    /// Inserts what [`Self::select_round`] selects of `lists`.
    pub(in crate::netmesh) fn insert_pass(
        &mut self,
        pass: u32,
        target: u32,
        lists: &[SimplexId],
        cavity: &mut Cavity,
    ) -> Result<()> {
        let mut selected = self.select_round(pass, target, lists)?;
        // Ids are in an order of locality.
        selected.sort_unstable();
        for input in selected {
            if !self.state.interface.is_eligible(self.state.conflict_lists.simplex_of(input)) {
                continue;
            }
            if !self.insert_input(input, cavity)? {
                self.state.defer(input)?;
            }
            if self.state.parameters.algorithm != Algorithm::Delaunay {
                self.clean(cavity)?;
            }
        }
        Ok(())
    }

    /// Returns the simplices whose conflict lists have inputs of `tile`, in rising order.
    pub(in crate::netmesh) fn lists_of(&mut self, tile: &Range<usize>) -> Result<Vec<SimplexId>> {
        let mut lists = Vec::new();
        if tile.len() == self.state.inputs {
            for simplex in self.state.delaunay.complex().simplices() {
                self.watch.poll_after(1)?;
                if self.state.conflict_lists.count(simplex) > 0 {
                    lists.try_push(simplex)?;
                }
            }
            return Ok(lists);
        }
        for input in VertexId::range(tile.clone()) {
            self.watch.poll_after(1)?;
            let simplex = self.state.conflict_lists.simplex_of(input);
            if simplex.is_valid() {
                lists.try_push(simplex)?;
            }
        }
        lists.sort_unstable();
        lists.dedup();
        Ok(lists)
    }
}

impl<const D: usize> State<D> {
    fn count_rounds(&mut self, rounds: Rounds) {
        self.stats.rounds += rounds.count;
        self.stats.passes += rounds.passes;
    }

    fn longest(&self, lists: &[SimplexId]) -> u32 {
        let counts = lists.iter().map(|&simplex| self.conflict_lists.count(simplex));
        counts.max().unwrap_or(0)
    }

    /// Defers `input`, in a partition, and the others of its simplex.
    pub(in crate::netmesh) fn defer(&mut self, input: VertexId) -> AllocResult<()> {
        if self.interface.is_some() {
            self.interface.skip(self.conflict_lists.simplex_of(input))
        } else {
            Ok(())
        }
    }
}

/// Returns the inputs of each tile, as ids; those of a small mesh are one.
pub(in crate::netmesh) fn tiles(inputs: usize) -> impl Iterator<Item = Range<usize>> {
    let length = if inputs > SMALL { TILE } else { inputs.max(1) };
    (0..inputs).step_by(length).map(move |begin| begin..inputs.min(begin + length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Inputs;
    use crate::netmesh::state::watch::Watch;
    use crate::numerics::testing::Random;
    use crate::options::Options;
    use crate::parameters::Parameters;

    #[test]
    fn every_input_is_in_one_tile() {
        for inputs in [0, 1, SMALL, SMALL + 1, 5 * TILE, 5 * TILE + 7] {
            let all: Vec<Range<usize>> = tiles(inputs).collect();
            assert!(all.iter().cloned().flatten().eq(0..inputs), "{inputs}");
            let is_small = inputs <= SMALL;
            assert!(all.iter().all(|tile| is_small || tile.len() <= TILE), "{inputs}");
            assert!(!is_small || all.len() <= 1, "{inputs}");
        }
    }

    /// A tile goes through all of its rounds before the next one begins.
    #[test]
    fn the_rounds_of_a_tile_insert_its_inputs() {
        let (count, mut random) = (SMALL + TILE, Random(3));
        let points: Vec<f64> = (0..2 * count).map(|_| random.unit()).collect();
        let inputs = Inputs::new(2, count, &points, 0).unwrap();
        let parameters = Parameters::resolve(2, &Options::default()).unwrap();
        let mut mesher = Mesher::<2>::new(&inputs, parameters, Watch::new(None)).unwrap();
        let mut cavity = Cavity::default();
        mesher.start_netmesh(&mut cavity).unwrap();
        mesher.insert_coarse_rounds(&mut cavity).unwrap();
        let coarse = count - mesher.state.conflict_lists.remaining();
        assert!((count / COARSE..count / 8).contains(&coarse), "{coarse}");
        for tile in tiles(count) {
            let lists = mesher.lists_of(&tile).unwrap();
            let all = mesher.lists_of(&(0..count)).unwrap();
            let has_own = |&simplex: &SimplexId| {
                let mut entries = mesher.state.conflict_lists.entries(simplex);
                entries.any(|input| tile.contains(&input.index()))
            };
            assert!(all.iter().copied().filter(has_own).eq(lists.iter().copied()));
            let rounds = mesher.insert_rounds_until(|_| false, &tile, &mut cavity).unwrap();
            assert!(rounds.count > 1 && rounds.passes >= rounds.count);
            assert!(mesher.lists_of(&tile).unwrap().is_empty());
            let later = mesher.state.conflict_lists.remaining();
            assert!(later <= count - tile.end && later + count / 4 > count - tile.end, "{later}");
        }
        assert!(mesher.state.stats.worst_halving <= 0.5);
    }
}
