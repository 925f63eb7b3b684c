//! Vertices of crossings, and pieces that end there.

use super::places::{Places, key, key_along};
use super::sweep::{Found, Part, Swept};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{TryGrow, with_capacity};
use crate::mesh::{NONE, Subsegment};

/// The parts of a sweep, split where crossings were found; appends new vertices to `points`.
pub(super) fn split(
    places: &Places,
    mut swept: Swept,
    points: &mut Vec<[f64; 2]>,
) -> Result<Vec<Subsegment>> {
    let known = points.len();
    add_crossings(places, &swept, points)?;
    let new = &points[known..];
    let vertex = |point: &[f64; 2]| match places.find(point) {
        Some(rank) => places.vertices[rank as usize],
        None => (known + new.partition_point(|other| key(other) < key(point))) as u32,
    };
    swept.parts.sort_unstable_by_key(|part| (part.line, part.ends[0]));
    let place = |found: &Found| (found.line, key_along(&found.point, [false, found.falls]));
    swept.found.sort_unstable_by_key(place);
    let mut found = swept.found.iter().peekable();
    let mut pieces = with_capacity(swept.parts.len() + swept.found.len())?;
    for &Part { line, ends: [start, end], segment } in &swept.parts {
        let (mut from, mut from_point) = (places.vertices[start as usize], places.point(start));
        let (end, end_point) = (places.vertices[end as usize], places.point(end));
        let is_within =
            |found: &&Found| place(found) < (line, key_along(end_point, [false, found.falls]));
        while let Some(Found { line: other, point, .. }) = found.next_if(is_within) {
            // What is not between is rounded to an end, or snapped to where another part is.
            let is_between = (0..2).all(|k| {
                let (a, b) = (from_point[k], end_point[k]);
                a.min(b) <= point[k] && point[k] <= a.max(b)
            });
            let to = vertex(point);
            if *other == line && is_between && to != from && to != end {
                pieces.try_push(Subsegment { ends: [from, to], segment })?;
                (from, from_point) = (to, point);
            }
        }
        pieces.try_push(Subsegment { ends: [from, end], segment })?;
    }
    Ok(pieces)
}

/// Appends the crossings that are no vertices yet, each once.
fn add_crossings(places: &Places, swept: &Swept, points: &mut Vec<[f64; 2]>) -> Result<()> {
    let known = points.len();
    let mut new = Vec::new();
    for found in &swept.found {
        if places.find(&found.point).is_none() {
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
