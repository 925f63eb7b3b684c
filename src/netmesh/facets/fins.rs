//! Facets that meet at a vertex alone at a tiny angle, with nothing of the surface between them.

use crate::memory::{AllocResult, TryGrow, collected};

/// Returns true if two facets at a vertex are fins: at a tiny angle, and no fan leads from one to
/// the other, of facets that share lines there one after the other and are nearly flat at these,
/// each at a tiny angle to the first. Needles about a vertex make a fan: there a facet between two
/// has the vertices that these ask each other for.
///
/// `joined` are the pairs that are flat at a line of the vertex, `tiny` those at a tiny angle that
/// share no line there, the lower number first. O(n k log n) for n pairs of k facets.
pub(super) fn are_any(
    joined: impl Iterator<Item = [u32; 2]>,
    tiny: &[[u32; 2]],
) -> AllocResult<bool> {
    if tiny.is_empty() {
        return Ok(false);
    }
    let joined = either_way(joined)?;
    let tiny = either_way(tiny.iter().copied())?;
    let (mut reached, mut waiting) = (Vec::new(), Vec::new());
    for own in tiny.chunk_by(|a, b| a[0] == b[0]) {
        let first = own[0][0];
        let is_at = |pairs: &[[u32; 2]], facet: u32| pairs.binary_search(&[first, facet]).is_ok();
        reached.clear();
        reached.try_push(first)?;
        waiting.try_push(first)?;
        while let Some(facet) = waiting.pop() {
            let begin = joined.partition_point(|pair| pair[0] < facet);
            for &[_, next] in joined[begin..].iter().take_while(|pair| pair[0] == facet) {
                if !reached.contains(&next) && (is_at(&joined, next) || is_at(own, next)) {
                    reached.try_push(next)?;
                    waiting.try_push(next)?;
                }
            }
        }
        if own.iter().any(|&[_, other]| other > first && !reached.contains(&other)) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Returns pairs, each either way round, sorted.
fn either_way(pairs: impl Iterator<Item = [u32; 2]>) -> AllocResult<Vec<[u32; 2]>> {
    let mut all = collected(pairs.flat_map(|[a, b]| [[a, b], [b, a]]))?;
    all.sort_unstable();
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::are_any;

    fn are_fins(joined: &[[u32; 2]], tiny: &[[u32; 2]]) -> bool {
        are_any(joined.iter().copied(), tiny).unwrap()
    }

    #[test]
    fn facets_at_a_tiny_angle_are_fins_unless_a_fan_is_between_them() {
        // Two facets alone, and two with another between them.
        assert!(are_fins(&[], &[[3, 5]]));
        assert!(!are_fins(&[], &[]));
        assert!(!are_fins(&[[3, 4], [4, 5]], &[[3, 5]]));
        // A fan of six needles, of which any three in a row are at a tiny angle.
        let fan = [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5]];
        assert!(!are_fins(&fan, &[[0, 2], [1, 3], [2, 4], [3, 5]]));
        // A surface about the vertex whose sides come near each other leads round by facets that
        // are at no tiny angle.
        let ring = [[0, 1], [1, 2], [2, 3], [0, 3]];
        assert!(!are_fins(&ring, &[[0, 2]]));
        let ring = [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [0, 5]];
        assert!(are_fins(&ring, &[[0, 3]]));
        assert!(!are_fins(&ring, &[[0, 3], [0, 2]]));
    }
}
