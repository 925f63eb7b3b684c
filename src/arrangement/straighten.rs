//! Removal of vertices that are no crossings any more. Where two segments have crossed and since
//! been bent together, the vertex between is on a single segment, which becomes straight again.

use crate::memory::{AllocResult, filled, with_capacity};
use crate::mesh::{NONE, Subsegment};

/// Removes the vertices with numbers `inputs` and more at which only two pieces of one segment end,
/// and joins these pieces. `pieces` are sorted by segment and along each. Returns false if there is
/// no such vertex.
pub(super) fn straighten(
    inputs: usize,
    points: &mut Vec<[f64; 2]>,
    pieces: &mut Vec<Subsegment>,
) -> AllocResult<bool> {
    let mut degrees = filled(points.len(), 0u32)?;
    pieces.iter().flat_map(|piece| piece.ends).for_each(|end| degrees[end as usize] += 1);
    let joins = |last: &Subsegment, next: &Subsegment| {
        let middle = next.ends[0];
        last.segment == next.segment
            && last.ends[1] == middle
            && middle as usize >= inputs
            && degrees[middle as usize] == 2
    };
    let mut joined: Vec<Subsegment> = with_capacity(pieces.len())?;
    let mut is_removed = filled(points.len(), false)?;
    for piece in &*pieces {
        match joined.last_mut() {
            Some(last) if joins(last, piece) => {
                is_removed[piece.ends[0] as usize] = true;
                last.ends[1] = piece.ends[1];
            }
            _ => joined.push(*piece),
        }
    }
    if joined.len() == pieces.len() {
        return Ok(false);
    }
    let mut numbers = filled(points.len(), NONE)?;
    let mut kept = 0;
    for vertex in 0..points.len() {
        if !is_removed[vertex] {
            (numbers[vertex], points[kept]) = (kept as u32, points[vertex]);
            kept += 1;
        }
    }
    points.truncate(kept);
    joined.iter_mut().flat_map(|piece| &mut piece.ends).for_each(|end| {
        *end = numbers[*end as usize];
    });
    *pieces = joined;
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_of_one_segment_goes_and_others_stay() {
        let piece = |from, to, segment| Subsegment { ends: [from, to], segment, balance: 1 };
        let mut points: Vec<[f64; 2]> = (0..6).map(|x| [f64::from(x), 0.0]).collect();
        // Vertex 3 is of segment 0 alone, 4 of both, 1 an input.
        let all = [piece(0, 3, 0), piece(3, 4, 0), piece(4, 1, 0), piece(1, 5, 0), piece(4, 2, 1)];
        let mut pieces = all.to_vec();
        pieces.push(piece(2, 5, 1));
        assert!(straighten(3, &mut points, &mut pieces).unwrap());
        let expected =
            [piece(0, 3, 0), piece(3, 1, 0), piece(1, 4, 0), piece(3, 2, 1), piece(2, 4, 1)];
        assert_eq!(pieces, expected);
        assert_eq!(points.iter().map(|x| x[0]).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 4.0, 5.0]);
        assert!(!straighten(3, &mut points, &mut pieces).unwrap());
    }
}
