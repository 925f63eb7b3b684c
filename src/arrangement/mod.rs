//! The caller's segments as segments that meet only at their ends, exactly: duplicates merged.

use crate::error::Result;
use crate::memory::{AllocResult, collected, filled, with_capacity};
use crate::mesh::{Arrangement, Inputs, Segments, Subsegment};
use crate::options::Crossings;

/// The arrangement of segments between inputs in the plane.
///
/// # Errors
/// `InvalidArgument` (segments that cross, where `crossings` refuses them), `OutOfMemory`.
pub fn arrange(inputs: &Inputs, segments: &Segments, _crossings: Crossings) -> Result<Arrangement> {
    let ends = |segment: u32| segments.inputs[segment as usize].map(|input| vertex(inputs, input));
    let is_duplicate = duplicates(segments.count() as u32, ends)?;
    let mut subsegments = with_capacity(segments.count())?;
    for segment in 0..segments.count() as u32 {
        if !is_duplicate[segment as usize] {
            subsegments.push(Subsegment { ends: ends(segment), segment });
        }
    }
    let duplicate_segments = (segments.count() - subsegments.len()) as u64;
    Ok(Arrangement { subsegments, duplicate_segments, ..Arrangement::default() })
}

fn vertex(inputs: &Inputs, input: u32) -> u32 {
    inputs.vertices()[input as usize]
}

/// Whether an earlier segment has the same ends, in either order.
fn duplicates(count: u32, ends: impl Fn(u32) -> [u32; 2]) -> AllocResult<Vec<bool>> {
    let key = |segment: u32| {
        let [from, to] = ends(segment);
        (from.min(to), from.max(to), segment)
    };
    let mut keys = collected((0..count).map(key))?;
    keys.sort_unstable();
    let mut is_duplicate = filled(count as usize, false)?;
    for pair in keys.windows(2) {
        let same = (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
        is_duplicate[pair[1].2 as usize] = same;
    }
    Ok(is_duplicate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn duplicates_belong_to_the_first() {
        // Inputs 0 and 3 are the same point.
        let inputs = Inputs::new(2, 4, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0], 0).unwrap();
        let segments = Segments {
            inputs: vec![[1, 0], [0, 2], [3, 1], [1, 2], [2, 1]],
            markers: vec![1, 2, 3, 4, 5],
        };
        let arrangement = arrange(&inputs, &segments, Crossings::Refuse).unwrap();
        let piece = |from, to, segment| Subsegment { ends: [from, to], segment };
        assert_eq!(arrangement.subsegments, [piece(1, 0, 0), piece(0, 2, 1), piece(1, 2, 3)]);
        assert_eq!(arrangement.duplicate_segments, 2);
    }
}
