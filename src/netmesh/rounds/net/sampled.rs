//! The sampled round: a few random inputs of every conflict list. One per conflict list halves the
//! conflict lists several times over in practice, far below the generic bound on the size of a net
//! (Theorem 3); the round verifies that it did and asks for more where it did not.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::state::Mesher;
use rand_core::Rng;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns up to `per_ball` inputs of each of `lists` with more than `crowd` of them, by
    /// simplex.
    pub(super) fn select_sample(
        &mut self,
        per_ball: u32,
        crowd: u32,
        lists: &[SimplexId],
    ) -> Result<Vec<VertexId>> {
        let mut selected = Vec::new();
        for &simplex in lists {
            self.watch.poll_after(1)?;
            let count = self.state.conflict_lists.count(simplex);
            if count > crowd && self.state.interface.is_eligible(simplex) {
                self.sample(simplex, count, per_ball.min(count), &mut selected)?;
            }
        }
        Ok(selected)
    }

    /// Chooses `wanted` of the `count` inputs of `simplex`: one at random of each of `wanted`
    /// consecutive stretches of the list.
    fn sample(
        &mut self,
        simplex: SimplexId,
        count: u32,
        wanted: u32,
        selected: &mut Vec<VertexId>,
    ) -> Result<()> {
        let stretch = |i: u32| (u64::from(i) * u64::from(count) / u64::from(wanted)) as u32;
        let mut entries = self.state.conflict_lists.entries(simplex);
        let mut at = 0;
        for i in 0..wanted {
            let (begin, end) = (stretch(i), stretch(i + 1));
            let pick = begin + scaled(self.state.random.next_u32(), end - begin);
            while pick - at >= STEP {
                self.watch.poll_after(STEP / 8)?;
                entries.nth(STEP as usize - 1);
                at += STEP;
            }
            if let Some(input) = entries.nth((pick - at) as usize) {
                selected.try_push(input)?;
            }
            at = pick + 1;
        }
        Ok(())
    }
}

/// Inputs that a walk along a list passes before it polls the watch.
const STEP: u32 = 1024;

/// Maps 32 random bits to 0..bound.
fn scaled(random: u32, bound: u32) -> u32 {
    ((u64::from(random) * u64::from(bound)) >> 32) as u32
}
