//! Sorting in buckets, for sorts that are long and must be watched.

use super::{AllocError, filled, with_capacity};

/// Number of values that are looked at between two ticks.
const PART: usize = 1024;

/// Units of work of a tick for a part: some 10 ns for each value.
const WORK: u32 = 100;

/// Returns `values` sorted. `key` rises with their order, and values with keys that are near each
/// other are sorted together: O(n) expected if no more than some values have the same key, and O(n
/// log n) in any case. `tick` is told of the work, in units of some 100 ns, and may end it.
///
/// # Errors
/// Fails as `tick` does, or for want of memory.
pub(crate) fn sorted_in_buckets<T: Copy + Ord, E: From<AllocError>>(
    values: &[T],
    key: impl Fn(&T) -> u32,
    mut tick: impl FnMut(u32) -> Result<(), E>,
) -> Result<Vec<T>, E> {
    let Some(&first) = values.first() else { return Ok(with_capacity(0)?) };
    let count = values.len();
    let buckets = count / 4 + 1;
    let keys = u64::from(values.iter().map(&key).max().unwrap_or(0)) + 1;
    // Below `buckets`, since a key is below `keys`.
    let bucket = |value: &T| (u64::from(key(value)) * buckets as u64 / keys) as usize;
    // Bucket -> the number of its values, then where it begins, then where it ends.
    let mut places = filled(buckets + 1, 0usize)?;
    for part in values.chunks(PART) {
        part.iter().for_each(|value| places[bucket(value) + 1] += 1);
        tick(WORK)?;
    }
    for at in 0..buckets {
        places[at + 1] += places[at];
    }
    let mut sorted = filled(count, first)?;
    for part in values.chunks(PART) {
        for value in part {
            let place = &mut places[bucket(value)];
            sorted[*place] = *value;
            *place += 1;
        }
        tick(WORK)?;
    }
    let mut begin = 0;
    for part in places[..buckets].chunks(PART) {
        for &end in part {
            sorted[begin..end].sort_unstable();
            begin = end;
        }
        tick(WORK)?;
    }
    Ok(sorted)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(values: &[(u32, u32)]) -> Result<Vec<(u32, u32)>, AllocError> {
        sorted_in_buckets(values, |value| value.0, |_| Ok(()))
    }

    #[test]
    fn order_is_that_of_a_sort() {
        let mut state = 1u32;
        for most in [1, 2, 7, 1000, u32::MAX] {
            for count in [0, 1, 2, 100, 5000] {
                let mut next = || {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (state >> 3) % most
                };
                let values: Vec<_> = (0..count).map(|_| (next(), next())).collect();
                let mut expected = values.clone();
                expected.sort_unstable();
                assert_eq!(sorted(&values).unwrap(), expected);
            }
        }
        let extremes = [(u32::MAX, 1), (0, 2), (u32::MAX, 0)];
        assert_eq!(sorted(&extremes).unwrap(), [(0, 2), (u32::MAX, 0), (u32::MAX, 1)]);
    }

    #[test]
    fn a_tick_ends_each_of_its_passes() {
        let values: Vec<u32> = (0..3000).rev().collect();
        let ticks = |last: u32| {
            let mut count = 0;
            let tick = |_| {
                count += 1;
                if count > last { Err(AllocError::Memory) } else { Ok(()) }
            };
            sorted_in_buckets(&values, |&value| value, tick)
        };
        (0..7).for_each(|last| assert!(ticks(last).is_err()));
        assert!(ticks(7).is_ok_and(|sorted| sorted.is_sorted()));
    }
}
