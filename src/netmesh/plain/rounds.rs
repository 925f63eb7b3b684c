//! The order in which inputs go in: rounds, each a sample of three times as many as all before it,
//! and each in the order of locality.

use crate::error::Result;
use crate::memory::{TryGrow, with_capacity};
use crate::numerics::mixed;

/// Rounds of one input for each of `4^MOST` are as good as none.
const MOST: u32 = 12;

/// Returns the inputs of each round but those of the first simplex. An input is in the last round
/// with probability 3/4, in the one before with 3/16, and so on.
pub(super) fn rounds(count: usize, seed: u64, first: &[u32]) -> Result<Vec<Vec<u32>>> {
    let levels = (count.max(4).ilog2() / 2).min(MOST);
    let level = |input: u32| (mixed(seed ^ u64::from(input)).trailing_zeros() / 2).min(levels);
    let others = || (0..count as u32).filter(|input| !first.contains(input));
    let mut counts = [0usize; MOST as usize + 1];
    others().for_each(|input| counts[level(input) as usize] += 1);
    let mut rounds: Vec<Vec<u32>> = with_capacity(levels as usize + 1)?;
    for count in counts[..=levels as usize].iter().rev() {
        rounds.push(with_capacity(*count)?);
    }
    for input in others() {
        rounds[(levels - level(input)) as usize].try_push(input)?;
    }
    Ok(rounds)
}
