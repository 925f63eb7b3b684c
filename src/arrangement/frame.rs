//! Inputs next to the edges of a hull or box. Doubles have no room for edges as short as such an input
//! is far from the boundary, which a boundary past it would need; so the boundary goes through it.

use super::Poll;
use super::extent::WORK;
use super::inner::Inner;
use super::places::{Key, key_along};
use crate::error::Result;
use crate::memory::{TryGrow, filled, with_capacity};
use crate::mesh::Inputs;
use crate::numerics::crossing;

/// An input is next to an edge if the edge meets the rectangle about it that reaches so many units in
/// the last place of the edge's larger coordinates.
const NEXT_TO: f64 = 3.0;
/// Where that is more than this part of the edge, doubles are too coarse for all of it.
const COARSE: f64 = 1e-6;

/// Edges of a convex curve that advance most along one axis, and one way: no two of them have the same
/// place there but their ends.
struct Side<'a> {
    axis: usize,
    /// By their lesser ends on the axis.
    edges: Vec<Edge<'a>>,
}

struct Edge<'a> {
    /// In the direction of the curve.
    ends: [&'a [f64; 2]; 2],
    /// Its number on the curve.
    number: u32,
}

/// An input next to an edge, by its place on the curve.
type Found = (u32, Key, u32);

/// The convex `curve` through points by their numbers, `points` flat, and through the inputs next to
/// one of its edges as well. O(n log n).
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub(super) fn through_near_inputs(
    points: &[f64],
    inputs: &Inputs,
    curve: Vec<u32>,
    poll: Poll<'_>,
) -> Result<Vec<u32>> {
    let point = |number: u32| -> &[f64; 2] {
        points[2 * number as usize..][..2].try_into().expect("two coordinates")
    };
    let mut is_on_curve = filled(points.len() / 2, false)?;
    curve.iter().for_each(|&number| is_on_curve[number as usize] = true);
    let ends = |at: usize| [curve[at], curve[(at + 1) % curve.len()]].map(point);
    let sides = sides(curve.len(), ends)?;
    let inner = Inner::of(curve.iter().map(|&number| point(number)));
    let mut found: Vec<Found> = Vec::new();
    for vertex in 0..inputs.distinct() {
        poll(WORK)?;
        let input = inputs.first_input(vertex).expect("a distinct input");
        let x = point(input);
        if is_on_curve[input as usize] || inner.holds(x) {
            continue;
        }
        let mut next_to = sides.iter().filter_map(|side| side.next_to(x));
        // Next to a corner it may be beyond an edge that leads through it.
        if let (Some((edge, place)), None) = (next_to.next(), next_to.next()) {
            found.try_push((edge, place, input))?;
        }
    }
    found.sort_unstable();
    let mut through = with_capacity(curve.len() + found.len())?;
    let mut found = found.iter().peekable();
    for (at, &number) in curve.iter().enumerate() {
        through.push(number);
        let ([_, end], mut last) = (ends(at), point(number));
        while let Some(&(_, _, input)) = found.next_if(|found| found.0 == at as u32) {
            // Chains go back on no axis.
            let x = point(input);
            if advances(ends(at), last, x) && advances(ends(at), x, end) {
                through.push(input);
                last = x;
            }
        }
    }
    Ok(through)
}

fn sides<'a>(count: usize, ends: impl Fn(usize) -> [&'a [f64; 2]; 2]) -> Result<[Side<'a>; 4]> {
    let mut sides = [0, 0, 1, 1].map(|axis| Side { axis, edges: Vec::new() });
    for at in 0..count {
        let ends = ends(at);
        // Half of it, which does not overflow.
        let way = |axis: usize| (0.5 * ends[1][axis] - 0.5 * ends[0][axis]).abs();
        let axis = usize::from(way(1) > way(0));
        let side = 2 * axis + usize::from(falls(ends)[axis]);
        sides[side].edges.try_push(Edge { ends, number: at as u32 })?;
    }
    for side in &mut sides {
        let axis = side.axis;
        side.edges.sort_unstable_by(|a, b| a.low(axis).total_cmp(&b.low(axis)));
    }
    Ok(sides)
}

fn falls([from, to]: [&[f64; 2]; 2]) -> [bool; 2] {
    [0, 1].map(|axis| to[axis] < from[axis])
}

/// Whether the way from `a` to `b` goes nowhere against that from end to end.
fn advances(ends: [&[f64; 2]; 2], a: &[f64; 2], b: &[f64; 2]) -> bool {
    let agrees = |axis: usize| match ends[0][axis] == ends[1][axis] {
        true => true,
        false if falls(ends)[axis] => a[axis] >= b[axis],
        false => a[axis] <= b[axis],
    };
    agrees(0) && agrees(1)
}

impl Edge<'_> {
    fn low(&self, axis: usize) -> f64 {
        self.ends[0][axis].min(self.ends[1][axis]) + 0.0
    }

    fn high(&self, axis: usize) -> f64 {
        self.ends[0][axis].max(self.ends[1][axis])
    }

    /// Orders points along the edge.
    fn place(&self, axis: usize, x: &[f64; 2]) -> Key {
        let key = key_along(x, falls(self.ends));
        [key[axis], key[1 - axis]]
    }

    /// Whether `x`, which is between the ends on the axis, is next to the edge.
    fn is_next_to(&self, axis: usize, x: &[f64; 2]) -> bool {
        let other = 1 - axis;
        let [from, to] = self.ends;
        let unit = |axis: usize| {
            let largest = from[axis].abs().max(to[axis].abs());
            largest.next_up() - largest
        };
        let length = (to[axis] - from[axis]).abs();
        let slope = (to[other] - from[other]).abs() / length;
        let reach = NEXT_TO * (unit(other) + if slope <= 1.0 { slope * unit(axis) } else { 0.0 });
        if reach > COARSE * length {
            return false;
        }
        // Most are far away, and doubles tell. What overflows does not.
        let part = (x[axis] - from[axis]) / (to[axis] - from[axis]);
        let place = from[other] + part * (to[other] - from[other]);
        if (x[other] - place).abs() > 16.0 * reach && length.is_finite() {
            return false;
        }
        let mut far = *x;
        far[other] = if x[other] == 0.0 { 1.0 } else { 0.0 };
        let place = crossing([[from, to], [x, &far]]);
        place.is_some_and(|place| (x[other] - place[other]).abs() <= reach)
    }
}

impl Side<'_> {
    /// The number of the edge that `x` is next to, and the place there.
    fn next_to(&self, x: &[f64; 2]) -> Option<(u32, Key)> {
        let after = self.edges.partition_point(|edge| edge.low(self.axis) <= x[self.axis]);
        let edge = self.edges.get(after.checked_sub(1)?)?;
        let is_within = x[self.axis] <= edge.high(self.axis);
        (is_within && edge.is_next_to(self.axis, x))
            .then(|| (edge.number, edge.place(self.axis, x)))
    }
}
