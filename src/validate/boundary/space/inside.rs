//! The sides of a polygon's edges on which its inside is, by the rule of even and odd: exact, by a
//! sweep along the first axis.

use crate::memory::{AllocResult, TryGrow, collected};
use crate::validate::signs::{Robust, Signs};
use std::cmp::Ordering;

/// Edge of a polygon between two points.
#[derive(Clone, Copy)]
struct Edge {
    low: [f64; 2],
    high: [f64; 2],
    number: usize,
}

fn order(a: &[f64; 2], b: &[f64; 2]) -> Ordering {
    let by_axis = |axis: usize| a[axis].partial_cmp(&b[axis]).unwrap_or(Ordering::Equal);
    by_axis(0).then(by_axis(1))
}

/// Returns for each edge true if what the edges enclose, counted by even and odd, is on its left.
/// Edges meet only at their ends. O(n log n + n k) for at most k edges at one place of the sweep.
pub(super) fn lefts(edges: &[[[f64; 2]; 2]]) -> AllocResult<Vec<bool>> {
    let mut is_left = collected(edges.iter().map(|_| false))?;
    let mut sorted = collected(edges.iter().enumerate().map(|(number, &[a, b])| {
        let is_along = order(&a, &b) == Ordering::Less;
        Edge { low: if is_along { a } else { b }, high: if is_along { b } else { a }, number }
    }))?;
    sorted.sort_unstable_by(|a, b| order(&a.low, &b.low));
    let mut signs = Signs::<Robust>::default();
    let mut active: Vec<Edge> = Vec::new();
    for starting in sorted.chunk_by(|a, b| order(&a.low, &b.low).is_eq()) {
        active.retain(|edge| order(&edge.high, &starting[0].low).is_gt());
        active.try_extend(starting)?;
        for edge in starting {
            let mut below = 0;
            for other in active.iter().filter(|other| other.number != edge.number) {
                below += usize::from(is_below(other, edge, &mut signs)?);
            }
            // With an even number below, the inside is above: on the left on the way up.
            let is_along = order(&edges[edge.number][0], &edges[edge.number][1]).is_lt();
            is_left[edge.number] = (below % 2 == 0) == is_along;
        }
    }
    Ok(is_left)
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

    #[test]
    fn holes_and_islands_alternate() {
        let square =
            |half: f64| closed(&[[-half, -half], [half, -half], [half, half], [-half, half]]);
        let reversed = |edges: Vec<[[f64; 2]; 2]>| -> Vec<[[f64; 2]; 2]> {
            edges.into_iter().rev().map(|[a, b]| [b, a]).collect()
        };
        assert_eq!(lefts(&square(1.0)).unwrap(), [true; 4]);
        assert_eq!(lefts(&reversed(square(1.0))).unwrap(), [false; 4]);
        let nested = [square(3.0), square(2.0), reversed(square(1.0))].concat();
        let expected = [[true; 4], [false; 4], [false; 4]].concat();
        assert_eq!(lefts(&nested).unwrap(), expected);
    }

    #[test]
    fn loops_may_touch_at_a_point() {
        let triangle = closed(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]);
        let hole = closed(&[[0.0, 0.0], [1.0, 0.5], [0.5, 1.0]]);
        let beside = closed(&[[0.0, 0.0], [-1.0, -2.0], [0.0, -2.0]]);
        let all = [triangle, hole, beside].concat();
        let expected = [[true; 3], [false; 3], [true; 3]].concat();
        assert_eq!(lefts(&all).unwrap(), expected);
    }
}
