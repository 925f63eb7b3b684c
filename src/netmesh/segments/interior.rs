//! Selection of the regions that are inside. With the extent all these are all, and without a rule
//! for closed curves all but region 0. With one a region has a winding number, which differs from
//! that of the region on the other side of a line by the balance of the line (for parity by whether
//! that is odd), and is 0 outside of all.

use crate::memory::{AllocResult, Lists, TryGrow, collected, filled};
use crate::netmesh::state::State;
use crate::netmesh::state::segments::chain::Line;
use crate::netmesh::state::segments::regions::{OUTSIDE, Regions};
use crate::options::{Extent, Interior};

impl<const D: usize> State<D> {
    /// Returns, for every region, true if it is inside, before seeds make holes. All regions are
    /// found.
    pub(super) fn enclosed_regions(&self) -> AllocResult<Vec<bool>> {
        let (regions, lines) = (&self.segments.regions, &self.segments.chains.lines);
        if self.parameters.extent == Extent::All {
            return filled(regions.len(), true);
        }
        match self.parameters.interior {
            Interior::Auto | Interior::Seeds => {
                collected((0..regions.len()).map(|region| region as u32 != OUTSIDE))
            }
            Interior::Parity => are_not_zero(&winding_numbers(regions, lines, |x| x & 1)?),
            Interior::Winding => are_not_zero(&winding_numbers(regions, lines, |x| x)?),
        }
    }
}

fn are_not_zero(numbers: &[Option<i64>]) -> AllocResult<Vec<bool>> {
    collected(numbers.iter().map(|number| number.is_some_and(|number| number != 0)))
}

/// Returns the winding number of every region as `reduced`. Lines are pieces of closed curves, so
/// that any way from outside gives the same; and all regions are reached, for the plane is
/// connected. O(lines).
fn winding_numbers(
    regions: &Regions,
    lines: &[Line],
    reduced: fn(i64) -> i64,
) -> AllocResult<Vec<Option<i64>>> {
    let of_line = |line: usize| [0, 1].map(|side| (regions.sides[line][side], line as u32));
    let lines_at = Lists::of_pairs(regions.len(), || (0..lines.len()).flat_map(of_line))?;
    let mut numbers = filled(regions.len(), None)?;
    let mut waiting = Vec::new();
    numbers[OUTSIDE as usize] = Some(0);
    waiting.try_push((OUTSIDE, 0))?;
    while let Some((region, number)) = waiting.pop() {
        for &line in lines_at.of(region as usize) {
            let [left, right] = regions.sides[line as usize];
            let balance = lines[line as usize].balance;
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
