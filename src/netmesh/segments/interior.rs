//! Selection of the regions that are inside. With the extent all these are all, and without a rule
//! for closed curves all but region 0. With one a region has a winding number, which differs from
//! that of the region on the other side of a line by the balance of the line (for parity by whether
//! that is odd), and is 0 outside of all.

use crate::memory::{AllocResult, Lists, TryGrow, collected, filled};
use crate::netmesh::state::State;
use crate::netmesh::state::segments::regions::{OUTSIDE, Regions};
use crate::netmesh::state::segments::walls::Walls;
use crate::options::{Extent, Interior};

impl<const D: usize> State<D> {
    /// Returns, for every region, true if it is inside, before seeds make holes. All regions are
    /// found.
    pub(super) fn enclosed_regions(&self) -> AllocResult<Vec<bool>> {
        let regions = &self.segments.regions;
        if self.parameters.extent == Extent::All {
            return filled(regions.len(), true);
        }
        let walls = Walls { chains: &self.segments.chains, facets: &self.facets };
        let balances = || collected((0..walls.count(D)).map(|wall| walls.balance(D, wall)));
        match self.parameters.interior {
            Interior::Auto | Interior::Seeds => {
                collected((0..regions.len()).map(|region| region as u32 != OUTSIDE))
            }
            Interior::Parity => are_not_zero(&winding_numbers(regions, &balances()?, |x| x & 1)?),
            Interior::Winding => are_not_zero(&winding_numbers(regions, &balances()?, |x| x)?),
        }
    }
}

fn are_not_zero(numbers: &[Option<i64>]) -> AllocResult<Vec<bool>> {
    collected(numbers.iter().map(|number| number.is_some_and(|number| number != 0)))
}

/// Returns the winding number of every region as `reduced`. Walls are pieces of closed curves or
/// surfaces, so that any way from outside gives the same; and all regions are reached, for what
/// they separate is connected. O(walls).
fn winding_numbers(
    regions: &Regions,
    balances: &[i64],
    reduced: fn(i64) -> i64,
) -> AllocResult<Vec<Option<i64>>> {
    let of_wall = |wall: usize| [0, 1].map(|side| (regions.sides[wall][side], wall as u32));
    let walls_at = Lists::of_pairs(regions.len(), || (0..balances.len()).flat_map(of_wall))?;
    let mut numbers = filled(regions.len(), None)?;
    let mut waiting = Vec::new();
    numbers[OUTSIDE as usize] = Some(0);
    waiting.try_push((OUTSIDE, 0))?;
    while let Some((region, number)) = waiting.pop() {
        for &wall in walls_at.of(region as usize) {
            let [left, right] = regions.sides[wall as usize];
            let balance = balances[wall as usize];
            let (beyond, step) = if left == region { (right, -balance) } else { (left, balance) };
            let next = reduced(number + step);
            match numbers[beyond as usize] {
                Some(known) => debug_assert_eq!(known, next, "curves are closed"),
                None => {
                    numbers[beyond as usize] = Some(next);
                    waiting.try_push((beyond, next))?;
                }
            }
        }
    }
    Ok(numbers)
}
