//! The sides of a polygon's edges on which its inside is, and which other edges are inside, by the
//! rule of even and odd: exact, by a sweep along the first axis.

use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

/// Edge between two points, the first before the second in the order of the sweep.
#[derive(Clone, Copy)]
struct Edge {
    low: [f64; 2],
    high: [f64; 2],
    number: usize,
    is_of_rim: bool,
}

/// Answers for the edges of a polygon and for others.
pub(super) struct Sides {
    /// Edge of the polygon -> true if its inside is on the edge's left.
    pub lefts: Vec<bool>,
    /// Other edge -> true if it is inside.
    pub insides: Vec<bool>,
}

fn order(a: &[f64; 2], b: &[f64; 2]) -> Ordering {
    let by_axis = |axis: usize| a[axis].partial_cmp(&b[axis]).unwrap_or(Ordering::Equal);
    by_axis(0).then(by_axis(1))
}

/// Finds the sides of the edges of `rim` on which what they enclose is, counted by even and odd,
/// and which of the edges and points `others` are inside. Edges meet only at their ends. O(n log n
/// + n k) for at most k edges at one place of the sweep.
pub(super) fn sides(rim: &[[[f64; 2]; 2]], others: &[[[f64; 2]; 2]]) -> AllocResult<Sides> {
    let (mut lefts, mut insides) = (filled(rim.len(), false)?, filled(others.len(), false)?);
    let mut sorted = collected(rim.iter().chain(others).enumerate().map(|(number, &[a, b])| {
        let [low, high] = if order(&a, &b).is_lt() { [a, b] } else { [b, a] };
        Edge { low, high, number, is_of_rim: number < rim.len() }
    }))?;
    sorted.sort_unstable_by(|a, b| order(&a.low, &b.low));
    let mut signs = Signs::<Robust>::default();
    let mut active: Vec<Edge> = Vec::new();
    for starting in sorted.chunk_by(|a, b| order(&a.low, &b.low).is_eq()) {
        active.retain(|edge| order(&edge.high, &starting[0].low).is_gt());
        for edge in starting.iter().filter(|edge| edge.is_of_rim) {
            active.try_push(*edge)?;
        }
        for edge in starting {
            let mut below = 0;
            for other in active.iter().filter(|other| other.number != edge.number) {
                below += usize::from(is_below(other, edge, &mut signs)?);
            }
            if edge.is_of_rim {
                // With an even number below, the inside is above: on the left on the way up.
                let [from, to] = &rim[edge.number];
                lefts[edge.number] = (below % 2 == 0) == order(from, to).is_lt();
            } else {
                insides[edge.number - rim.len()] = below % 2 == 1;
            }
        }
    }
    Ok(Sides { lefts, insides })
}

/// Returns true if an edge that begins no later than another passes below it, just after that
/// begins.
fn is_below(edge: &Edge, other: &Edge, signs: &mut Signs<Robust>) -> AllocResult<bool> {
    let at_low = signs.orientation(&[&edge.low, &edge.high, &other.low])?;
    let sign = match at_low {
        Ordering::Equal => signs.orientation(&[&edge.low, &edge.high, &other.high])?,
        sign => sign,
    };
    Ok(sign == Ordering::Greater)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(points: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
        (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]]).collect()
    }

    fn lefts(edges: &[[[f64; 2]; 2]]) -> Vec<bool> {
        sides(edges, &[]).unwrap().lefts
    }

    #[test]
    fn others_are_inside_or_not() {
        let outer = closed(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        let hole = closed(&[[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]);
        let others = [
            [[0.0, 0.0], [1.0, 1.0]],
            [[3.0, 1.0], [1.0, 3.0]],
            [[0.0, 0.0], [-1.0, 0.0]],
            [[3.5, 3.5]; 2],
            [[2.0, 2.0]; 2],
            [[4.0, 4.0], [5.0, 0.0]],
        ];
        let found = sides(&[outer, hole].concat(), &others).unwrap().insides;
        assert_eq!(found, [true, false, false, true, false, false]);
    }

    #[test]
    fn holes_and_islands_alternate() {
        let square =
            |half: f64| closed(&[[-half, -half], [half, -half], [half, half], [-half, half]]);
        let reversed = |edges: Vec<[[f64; 2]; 2]>| -> Vec<[[f64; 2]; 2]> {
            edges.into_iter().rev().map(|[a, b]| [b, a]).collect()
        };
        assert_eq!(lefts(&square(1.0)), [true; 4]);
        assert_eq!(lefts(&reversed(square(1.0))), [false; 4]);
        let nested = [square(3.0), square(2.0), reversed(square(1.0))].concat();
        let expected = [[true; 4], [false; 4], [false; 4]].concat();
        assert_eq!(lefts(&nested), expected);
    }

    #[test]
    fn loops_may_touch_at_a_point() {
        let triangle = closed(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]);
        let hole = closed(&[[0.0, 0.0], [1.0, 0.5], [0.5, 1.0]]);
        let beside = closed(&[[0.0, 0.0], [-1.0, -2.0], [0.0, -2.0]]);
        let all = [triangle, hole, beside].concat();
        let expected = [[true; 3], [false; 3], [true; 3]].concat();
        assert_eq!(lefts(&all), expected);
    }
}
