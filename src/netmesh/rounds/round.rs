//! The main loop of NETMESH (§6.5): rounds, each of which at least halves the length of the longest
//! conflict list, so that there are at most 1 + log2 n rounds.

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::Mesher;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(in crate::netmesh) fn insert_rounds(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.insert_rounds_until(|_| false, cavity)?;
        self.state.conflict_lists.free_lists();
        Ok(())
    }

    /// Rounds until all inputs are in, or enough is done.
    pub(in crate::netmesh) fn insert_rounds_until(
        &mut self,
        is_done: impl Fn(&Self) -> bool,
        cavity: &mut Cavity,
    ) -> Result<()> {
        while self.state.conflict_lists.remaining() > 0 && !is_done(self) {
            let before = self.state.conflict_lists.max_count();
            self.insert_round(before / 2, cavity)?;
            self.state.stats.rounds += 1;
            let left = f64::from(self.state.conflict_lists.max_count()) / f64::from(before);
            self.state.stats.worst_halving = self.state.stats.worst_halving.max(left);
            self.report_progress()?;
        }
        Ok(())
    }

    /// One round: some inputs of every D-ball, then more until none holds over `target`.
    fn insert_round(&mut self, target: u32, cavity: &mut Cavity) -> Result<()> {
        let mut pass = 0;
        while pass == 0 || self.state.conflict_lists.max_count() > target {
            self.insert_pass(pass, target, cavity)?;
            pass += 1;
        }
        Ok(())
    }

    /// Inserts what [`Self::select_round`] selects.
    pub(in crate::netmesh) fn insert_pass(
        &mut self,
        pass: u32,
        target: u32,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let mut selected = self.select_round(pass, target)?;
        // Ids are in an order of locality.
        selected.sort_unstable();
        for input in selected {
            if !self.state.interface.is_eligible(self.state.conflict_lists.simplex_of(input)) {
                continue;
            }
            if !self.insert_input(input, cavity)? {
                self.defer(input)?;
            }
            if self.state.parameters.algorithm != Algorithm::Delaunay {
                self.clean(cavity)?;
            }
        }
        self.state.stats.passes += 1;
        Ok(())
    }
}
