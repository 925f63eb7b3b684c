//! Triangles that are no wider than roundings: two of their edges lie on the third one.

use super::super::TaskInSpace;
use super::super::isolated::Isolated;
use crate::arrangement::reach::Reach;
use crate::memory::{AllocResult, TryGrow};

/// Returns the edges of triangles that are to go through the opposite corner, and do not: it is
/// beside them by the rule of [`Reach::holds`]. Each is given by its ends with the smaller one
/// first, and the corner. O(n log n).
pub(super) fn needles(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    on: &Isolated,
) -> AllocResult<Vec<([u32; 2], u32)>> {
    let mut found = Vec::new();
    for [a, b, c] in task.triangles() {
        for ([from, to], corner) in [([a, b], c), ([b, c], a), ([c, a], b)] {
            let edge = [from.min(to), from.max(to)];
            let reach = Reach::of(edge.map(|end| &points[end as usize]));
            let goes_through = || on.chain(edge).any(|part| part.contains(&corner));
            if reach.holds(&points[corner as usize]) && !goes_through() {
                found.try_push((edge, corner))?;
            }
        }
    }
    Ok(found)
}
