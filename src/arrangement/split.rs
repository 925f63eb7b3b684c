//! Vertices at crossings, and the pieces that end there.

use super::ranked::{RankedVertices, key, key_along};
use super::sweep::{Found, LinePart, OnLine, Swept};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{TryGrow, collected, with_capacity};
use crate::mesh::{NONE, Subsegment};

/// Splits the parts of a sweep at its accepted crossings and returns the pieces; appends new
/// vertices to `points`.
pub(super) fn split(
    ranked: &RankedVertices,
    mut swept: Swept,
    is_accepted: &[bool],
    points: &mut Vec<[f64; 2]>,
) -> Result<Vec<Subsegment>> {
    let known = points.len();
    let accepted = swept.found.iter().zip(is_accepted).filter(|&(_, &is_accepted)| is_accepted);
    let on_lines = accepted.flat_map(|(&Found { lines, falls, point }, _)| {
        [0, 1].map(|slot| OnLine { line: lines[slot], falls: falls[slot], point })
    });
    let mut found = collected(on_lines.chain(swept.snapped))?;
    add_crossings(ranked, &found, points)?;
    let new = &points[known..];
    let vertex = |point: &[f64; 2]| match ranked.find(point) {
        Some(rank) => ranked.vertices[rank as usize],
        None => (known + new.partition_point(|other| key(other) < key(point))) as u32,
    };
    swept.parts.sort_unstable_by_key(|part| (part.line, part.ends[0]));
    let place = |found: &OnLine| (found.line, key_along(&found.point, [false, found.falls]));
    found.sort_unstable_by_key(place);
    let mut pieces = with_capacity(swept.parts.len() + found.len())?;
    let mut found = found.iter().peekable();
    for &LinePart { line, ends: [start, end], segment, balance } in &swept.parts {
        let (mut from, mut from_point) = (ranked.vertices[start as usize], ranked.point(start));
        let (end, end_point) = (ranked.vertices[end as usize], ranked.point(end));
        let is_within =
            |found: &&OnLine| place(found) < (line, key_along(end_point, [false, found.falls]));
        while let Some(OnLine { line: other, point, .. }) = found.next_if(is_within) {
            // A crossing that is not between is rounded to an end.
            let is_between = (0..2).all(|k| {
                let (a, b) = (from_point[k], end_point[k]);
                a.min(b) <= point[k] && point[k] <= a.max(b)
            });
            let to = vertex(point);
            if *other == line && is_between && to != from && to != end {
                pieces.try_push(Subsegment { ends: [from, to], segment, balance })?;
                (from, from_point) = (to, point);
            }
        }
        pieces.try_push(Subsegment { ends: [from, end], segment, balance })?;
    }
    Ok(pieces)
}

/// Appends the crossings at which there is no vertex yet, each once.
fn add_crossings(
    ranked: &RankedVertices,
    found: &[OnLine],
    points: &mut Vec<[f64; 2]>,
) -> Result<()> {
    let known = points.len();
    let mut new = Vec::new();
    for found in found {
        if ranked.find(&found.point).is_none() {
            new.try_push(found.point)?;
        }
    }
    new.sort_unstable_by_key(key);
    new.dedup();
    if known + new.len() >= NONE as usize {
        let message = message!(
            "{} inputs and crossings; at most {} vertices fit 32-bit ids",
            known + new.len(),
            NONE - 1
        );
        return Err(Error::new(ErrorKind::Capacity, message));
    }
    Ok(points.try_extend(&new)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Splits two lines at the crossings `found` and returns the pieces and the number of vertices.
    /// Line 0 goes from (0, 0) to (4, 4), line 1 from (0, 1) to (4, 5).
    fn pieces(found: &[(u32, [f64; 2])]) -> (Vec<[u32; 2]>, usize) {
        let mut points = vec![[0.0, 0.0], [4.0, 4.0], [0.0, 1.0], [4.0, 5.0]];
        let ranked = RankedVertices::new(&points).unwrap();
        let part = |line: u32| {
            let ends = [2 * line, 2 * line + 1].map(|vertex| ranked.ranks[vertex as usize]);
            LinePart { line, ends, segment: line, balance: 1 }
        };
        // The other line has a number of its own, and no part.
        let found = found.iter().zip(2..).map(|(&(line, point), other)| Found {
            lines: [line, other],
            falls: [false; 2],
            point,
        });
        let swept =
            Swept { parts: vec![part(1), part(0)], found: found.collect(), snapped: Vec::new() };
        let pieces = split(&ranked, swept, &[true; 9], &mut points).unwrap();
        (pieces.iter().map(|piece| piece.ends).collect(), points.len())
    }

    #[test]
    fn parts_are_split_in_order_and_only_between_their_ends() {
        let whole = [[0, 1], [2, 3]];
        // Vertices 4 and 5 in the order of sweeps; twice found is once there.
        let found = [(0, [2.0, 2.0]), (0, [1.0, 1.0]), (0, [2.0, 2.0])];
        assert_eq!(pieces(&found), (vec![[0, 4], [4, 5], [5, 1], [2, 3]], 6));
        // Before the last one in y, or past the end: not on the way.
        let (back, past) = ((0, [2.0, 0.5]), (0, [3.0, 4.5]));
        assert_eq!(pieces(&[(0, [1.0, 1.0]), back]).0, [[0, 4], [4, 1], [2, 3]]);
        assert_eq!(pieces(&[past]).0, whole);
    }

    #[test]
    fn what_is_at_the_end_of_a_line_does_not_split_the_next() {
        // Its key is past the end of line 0, and it is between the ends of line 1.
        assert_eq!(pieces(&[(0, [4.0, 4.5])]).0, [[0, 1], [2, 3]]);
        assert_eq!(pieces(&[(0, [4.0, 4.0]), (1, [0.0, 1.0])]).0, [[0, 1], [2, 3]]);
    }

    #[test]
    fn a_line_that_falls_is_split_from_above_where_it_is_level() {
        let mut points = vec![[0.0, 4.0], [1e-300, 0.0]];
        let ranked = RankedVertices::new(&points).unwrap();
        let parts = vec![LinePart { line: 0, ends: [0, 1], segment: 0, balance: 1 }];
        let found =
            [1.0, 3.0].map(|y| Found { lines: [0, 1], falls: [true, false], point: [0.0, y] });
        let swept = Swept { parts, found: found.to_vec(), snapped: Vec::new() };
        let pieces = split(&ranked, swept, &[true; 2], &mut points).unwrap();
        let ends: Vec<_> = pieces.iter().map(|piece| piece.ends).collect();
        assert_eq!(ends, [[0, 3], [3, 2], [2, 1]]);
        assert_eq!(points[2..], [[0.0, 1.0], [0.0, 3.0]]);
    }
}
