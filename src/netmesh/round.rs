//! The main loop of NETMESH (§6.5): rounds, each of which at least halves the largest number of
//! inputs in one home, so that there are at most 1 + log2 n.

use super::Mesher;
use crate::error::Result;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(super) fn insert_rounds(&mut self) -> Result<()> {
        self.insert_rounds_until(|_| false)?;
        self.location.forget_homes();
        Ok(())
    }

    /// Rounds until all inputs are in, or enough is done.
    pub(super) fn insert_rounds_until(&mut self, is_done: impl Fn(&Self) -> bool) -> Result<()> {
        while self.location.remaining() > 0 && !is_done(self) {
            let before = self.location.max_count();
            self.insert_round(before / 2)?;
            self.stats.rounds += 1;
            let left = f64::from(self.location.max_count()) / f64::from(before);
            self.stats.worst_halving = self.stats.worst_halving.max(left);
            self.report_progress()?;
        }
        Ok(())
    }

    /// One round: some inputs of every D-ball, then more until none holds over `target`.
    fn insert_round(&mut self, target: u32) -> Result<()> {
        let mut pass = 0;
        while pass == 0 || self.location.max_count() > target {
            self.insert_pass(pass, target)?;
            pass += 1;
        }
        Ok(())
    }

    /// Inserts what [`Self::select_round`] selects.
    pub(super) fn insert_pass(&mut self, pass: u32, target: u32) -> Result<()> {
        let mut selected = self.select_round(pass, target)?;
        // Ids are in an order of locality.
        selected.sort_unstable();
        for input in selected {
            if !self.rim.admits(self.location.home(input)) {
                continue;
            }
            if !self.insert_input(input)? {
                self.postpone(input)?;
            }
            if self.parameters.algorithm != Algorithm::Delaunay {
                self.clean()?;
            }
        }
        self.stats.passes += 1;
        Ok(())
    }
}
