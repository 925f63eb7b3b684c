//! Choice of the crossings that become vertices. Of lines through nearly one point each pair
//! crosses a few roundings away from it, the farther the smaller their angle is. Bent through one
//! vertex they no longer cross.

use super::near::Near;
use super::ranked::{key, key_along};
use super::reach::Reach;
use super::sweep::Found;
use crate::memory::{AllocResult, Lists, collected, filled};
use crate::mesh::NONE;

/// Largest number of crossings that a search for a vertex on a line passes on either side.
const FARTHEST: usize = 1000;

/// Line between two points, with the reach of its segment.
pub(super) struct Straight<'a> {
    pub ends: [&'a [f64; 2]; 2],
    pub reach: &'a Reach<2>,
}

/// Returns for each crossing true if it becomes a vertex. Crossings at large angles are accepted
/// first. A later one is refused if the vertex next to it on one of its lines is near the other
/// line, which will go through that vertex too.
///
/// O(k log k) for k crossings, unless very many are close to each other.
pub(super) fn accept<'a>(
    found: &[Found],
    lines: usize,
    line: impl Fn(u32) -> Straight<'a>,
) -> AllocResult<Vec<bool>> {
    let of_lines =
        || (0u32..).zip(found).flat_map(|(at, found)| found.lines.map(|line| (line, at)));
    let mut on_lines = Lists::of_pairs(lines, of_lines)?;
    // Crossing -> where each of its lines has it.
    let mut positions = filled(found.len(), [0usize; 2])?;
    for number in 0..lines {
        let range = on_lines.starts[number]..on_lines.starts[number + 1];
        let own = &mut on_lines.ids[range];
        let slot = |at: u32| usize::from(found[at as usize].lines[1] == number as u32);
        own.sort_unstable_by_key(|&at| {
            let Found { point, falls, .. } = &found[at as usize];
            (key_along(point, [false, falls[slot(at)]]), at)
        });
        for (position, &at) in own.iter().enumerate() {
            positions[at as usize][slot(at)] = position;
        }
    }
    let sine = |found: &Found| {
        let [first, second] = found.lines.map(&line);
        -first.reach.sine(first.ends, second.ends)
    };
    let order = (0u32..).zip(found).map(|(at, found)| (sine(found), key(&found.point), at));
    let mut order = collected(order)?;
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut is_accepted = filled(found.len(), false)?;
    // Crossing -> the accepted one that both of its lines go through, once that is known.
    let mut vertices = filled(found.len(), NONE)?;
    for &(_, _, at) in &order {
        let Found { lines, .. } = found[at as usize];
        // Returns the vertex next to the crossing on one of its lines, on either side, that is near
        // the other line.
        let vertex_of = |slot: usize| {
            let own = on_lines.of(lines[slot] as usize);
            let other = line(lines[1 - slot]);
            let is_near =
                |&vertex: &u32| other.reach.is_near(other.ends, &found[vertex as usize].point);
            let (before, after) = own.split_at(positions[at as usize][slot]);
            let known = |&at: &u32| Some(vertices[at as usize]).filter(|&vertex| vertex != NONE);
            let last = before.iter().rev().take(FARTHEST).find_map(known);
            let next = after.iter().take(FARTHEST).find_map(known);
            last.filter(is_near).or(next.filter(is_near))
        };
        let vertex = vertex_of(0).or_else(|| vertex_of(1));
        is_accepted[at as usize] = vertex.is_none();
        vertices[at as usize] = vertex.unwrap_or(at);
    }
    let accepted = order.iter().map(|&(_, _, at)| at).filter(|&at| is_accepted[at as usize]);
    let accepted = collected(accepted)?;
    keep_apart(found, &accepted, line, &mut is_accepted)?;
    Ok(is_accepted)
}

/// Withdraws each of the `accepted` crossings that is so near to an earlier one that both of its
/// lines go through the earlier one.
fn keep_apart<'a>(
    found: &[Found],
    accepted: &[u32],
    line: impl Fn(u32) -> Straight<'a>,
    is_accepted: &mut [bool],
) -> AllocResult<()> {
    let points = collected(accepted.iter().map(|&at| found[at as usize].point))?;
    let mut near = Near::new(&points)?;
    let mut beside = Vec::new();
    for (rank, &at) in accepted.iter().enumerate() {
        let Found { lines, point, .. } = &found[at as usize];
        let reaches = lines.map(|number| line(number).reach);
        beside.clear();
        near.collect(reaches[0], [point, point], &mut beside)?;
        let is_first = |&other: &u32| {
            (other as usize) < rank
                && is_accepted[accepted[other as usize] as usize]
                && reaches.iter().all(|reach| reach.are_close(point, &points[other as usize]))
        };
        is_accepted[at as usize] = !beside.iter().any(is_first);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_at_large_angles_are_accepted_first() {
        // Lines 1 and 2 cross line 0 within a unit of each other, the second at a small angle.
        let lines =
            [[[0.0, 1.0], [10.0, 1.0]], [[5.0, -4.0], [5.0, 6.0]], [[0.0, 0.9], [10.0, 1.1]]];
        let reaches = lines.each_ref().map(|[from, to]| Reach::of([from, to]));
        let line = |number: u32| {
            let number = number as usize;
            Straight { ends: lines[number].each_ref(), reach: &reaches[number] }
        };
        let found =
            |other: u32, x: f64| Found { lines: [0, other], falls: [false; 2], point: [x, 1.0] };
        let (steep, shallow) = (found(1, 5.0), found(2, 5f64.next_down()));
        assert_eq!(accept(&[shallow, steep], 3, line).unwrap(), [false, true]);
        assert_eq!(accept(&[steep, shallow], 3, line).unwrap(), [true, false]);
        assert_eq!(accept(&[shallow], 3, line).unwrap(), [true], "alone it is a vertex");
    }
}
