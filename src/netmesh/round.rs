//! The main loop of NETMESH (§6.5): rounds, each of which at least halves the largest number of
//! inputs in one home, so that there are at most 1 + log2 n.

use super::Mesher;
use crate::error::Result;
use crate::options::Algorithm;

/// Inputs that a round takes of each D-ball at first.
const PER_BALL: u32 = 1;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(super) fn insert_rounds(&mut self) -> Result<()> {
        while self.location.remaining() > 0 {
            let target = self.location.max_count() / 2;
            self.insert_round(target)?;
            self.stats.rounds += 1;
        }
        Ok(())
    }

    /// One round: some inputs of every D-ball, then more of those that still hold over `target`.
    fn insert_round(&mut self, target: u32) -> Result<()> {
        let mut per_ball = PER_BALL;
        let mut crowd = 0;
        loop {
            for input in self.select_round(per_ball, crowd)? {
                self.insert_input(input)?;
                if self.parameters.algorithm != Algorithm::Delaunay {
                    self.clean()?;
                }
            }
            if self.location.max_count() <= target {
                return Ok(());
            }
            crowd = target;
            per_ball *= 2;
        }
    }
}
