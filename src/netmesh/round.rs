//! The main loop of NETMESH (§6.5): rounds, each of which at least halves the largest number of
//! inputs in one home, so that there are at most 1 + log2 n.

use super::Mesher;
use crate::error::Result;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(super) fn insert_rounds(&mut self) -> Result<()> {
        while self.location.remaining() > 0 {
            let target = self.location.max_count() / 2;
            self.insert_round(target)?;
            self.stats.rounds += 1;
        }
        Ok(())
    }

    /// One round: some inputs of every D-ball, then more until none holds over `target`.
    fn insert_round(&mut self, target: u32) -> Result<()> {
        let mut pass = 0;
        while pass == 0 || self.location.max_count() > target {
            for input in self.select_round(pass, target)? {
                if let Some(central) = self.central_neighbor(input)? {
                    self.insert_input(central)?;
                    self.clean()?;
                }
                self.insert_input(input)?;
                if self.parameters.algorithm != Algorithm::Delaunay {
                    self.clean()?;
                }
            }
            pass += 1;
        }
        Ok(())
    }
}
