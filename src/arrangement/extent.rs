//! The boundary of the convex hull or of the bounding box of the inputs, as segments.

use super::Poll;
use super::frame::through_near_inputs;
use super::inner::Inner;
use super::places::key;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{TryGrow, collected, with_capacity};
use crate::mesh::{Inputs, Segments};
use crate::numerics::{Sign, orientation};
use crate::options::Extent;

/// What a point takes, as polls count it.
pub(super) const WORK: u32 = 2;

/// The inputs and segments of the caller with those of the extent after them: the corners of a box
/// that are no inputs, and the edges of a box or hull. In 2D. O(n log n); `poll` is as that of
/// [`super::arrange`].
///
/// # Errors
/// `DegenerateInput` (a hull or box without an area), `OutOfMemory`, and those of `poll`.
pub fn with_extent(
    inputs: &Inputs,
    segments: &Segments,
    extent: Extent,
    poll: Poll<'_>,
) -> Result<(Inputs, Segments)> {
    let mut points = collected((0..inputs.count()).flat_map(|input| inputs.point(input)).copied())?;
    let mut all = Segments { inputs: with_capacity(segments.count())?, ..Segments::default() };
    all.inputs.extend_from_slice(&segments.inputs);
    all.markers.try_extend(&segments.markers)?;
    let curve = match extent {
        Extent::Hull => hull(inputs, poll)?,
        Extent::Box => {
            let first = inputs.count() as u32;
            points.try_extend(box_of(inputs).as_flattened())?;
            collected(first..first + 4)?
        }
        Extent::All | Extent::Boundary => Vec::new(),
    };
    let has_area = |at: usize| {
        let point = |at: usize| -> &[f64; 2] {
            points[2 * curve[at % curve.len()] as usize..][..2].try_into().expect("two coordinates")
        };
        orientation(&[point(0), point(at), point(at + 1)]) == Sign::Positive
    };
    if !curve.is_empty() && !(1..curve.len()).any(has_area) {
        let message = message!(
            "options.extent is {}, which has no area: all inputs are on a line",
            extent.word()
        );
        return Err(Error::new(ErrorKind::DegenerateInput, message));
    }
    let curve = through_near_inputs(&points, inputs, curve, poll)?;
    for (at, &from) in curve.iter().enumerate() {
        all.inputs.try_push([from, curve[(at + 1) % curve.len()]])?;
        all.markers.try_push(0)?;
    }
    Ok((Inputs::new(2, points.len() / 2, &points, 0)?, all))
}

/// The corners of the bounding box, counterclockwise.
fn box_of(inputs: &Inputs) -> [[f64; 2]; 4] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for input in 0..inputs.count() {
        for (axis, &x) in inputs.point(input).iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    [low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// The inputs on the hull, counterclockwise, those within its edges too (A. M. Andrew, "Another
/// efficient algorithm for convex hulls in two dimensions", 1979). O(n log n).
fn hull(inputs: &Inputs, poll: Poll<'_>) -> Result<Vec<u32>> {
    let first = |vertex: u32| inputs.first_input(vertex as usize).expect("a distinct input");
    let point = |input: u32| -> &[f64; 2] {
        inputs.point(input as usize).try_into().expect("two coordinates")
    };
    let all = || (0..inputs.distinct() as u32).map(first);
    let inner = Inner::of(all().map(point));
    let mut order = collected(all().filter(|&input| !inner.holds(point(input))))?;
    order.sort_unstable_by_key(|&input| key(point(input)));
    let mut hull: Vec<u32> = Vec::new();
    let lower = order.iter();
    let upper = order.iter().rev().skip(1);
    let mut start = 0;
    for (at, &input) in lower.chain(upper).enumerate() {
        poll(WORK)?;
        if at == order.len() {
            start = hull.len() - 1;
        }
        while let [.., a, b] = hull[start..] {
            if orientation(&[point(a), point(b), point(input)]) != Sign::Negative {
                break;
            }
            hull.pop();
        }
        hull.try_push(input)?;
    }
    hull.pop();
    Ok(hull)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs(points: &[[f64; 2]]) -> Inputs {
        Inputs::new(2, points.len(), points.as_flattened(), 0).unwrap()
    }

    fn extended(points: &[[f64; 2]], extent: Extent) -> Result<(Inputs, Segments)> {
        with_extent(&inputs(points), &Segments::default(), extent, &mut |_| Ok(()))
    }

    #[test]
    fn hulls_have_all_inputs_on_them() {
        let lattice: Vec<[f64; 2]> =
            (0..25).map(|i| [f64::from(i * 7 % 25 % 5), f64::from(i * 7 % 25 / 5)]).collect();
        let (all, segments) = extended(&lattice, Extent::Hull).unwrap();
        assert_eq!((all.distinct(), segments.count()), (25, 16));
        let on_side = |input: u32| {
            let point = all.point(input as usize);
            point.iter().any(|&x| x == 0.0 || x == 4.0)
        };
        assert!(segments.inputs.iter().flatten().all(|&input| on_side(input)));
        let step = |[from, to]: [u32; 2]| {
            let [p, q] = [from, to].map(|input| all.point(input as usize));
            (p[0] - q[0]).abs() + (p[1] - q[1]).abs()
        };
        assert!(segments.inputs.iter().all(|&ends| step(ends) == 1.0));
    }

    #[test]
    fn a_triangle_is_its_own_hull_and_has_a_box_of_four() {
        let triangle = [[0.0, 0.0], [2.0, 0.5], [1.0, 3.0], [1.0, 1.0]];
        let (_, segments) = extended(&triangle, Extent::Hull).unwrap();
        assert_eq!(segments.inputs, [[0, 1], [1, 2], [2, 0]]);
        let (all, segments) = extended(&triangle, Extent::Box).unwrap();
        // Two of the corners are no inputs, and one input is on a side.
        assert_eq!((all.count(), all.distinct(), segments.count()), (8, 7, 6));
        assert_eq!(all.point(6), [2.0, 3.0]);
    }

    #[test]
    fn what_has_no_area_is_refused() {
        let diagonal = [[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]];
        let error = extended(&diagonal, Extent::Hull).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::DegenerateInput);
        assert!(extended(&diagonal, Extent::Box).is_ok());
        let level = [[0.0, 1.0], [2.0, 1.0], [1.0, 1.0]];
        let error = extended(&level, Extent::Box).unwrap_err();
        assert!(error.message().starts_with("options.extent is box, which has no area"));
    }

    #[test]
    fn work_is_told_and_can_be_ended() {
        let points: Vec<[f64; 2]> =
            (0..200).map(|i| [f64::from(i * 37 % 200), f64::from(i * 71 % 200)]).collect();
        for extent in [Extent::Hull, Extent::Box] {
            let polled = |most: usize| {
                let mut calls = 0;
                let mut poll = |_: u32| {
                    calls += 1;
                    match calls < most {
                        true => Ok(()),
                        false => Err(Error::new(ErrorKind::Cancelled, "enough")),
                    }
                };
                let made = with_extent(&inputs(&points), &Segments::default(), extent, &mut poll);
                (made.map(drop).map_err(|error| error.kind()), calls)
            };
            let (made, all) = polled(usize::MAX);
            assert!(made.is_ok() && all >= 200, "{extent:?}: {all}");
            for most in [1, 100, all] {
                assert_eq!(polled(most), (Err(ErrorKind::Cancelled), most), "{extent:?}");
            }
        }
    }

    /// An input next to an edge is on the boundary; one farther away is not.
    #[test]
    fn inputs_next_to_an_edge_are_on_it() {
        let down = |x: f64, steps: u32| (0..steps).fold(x, |x, _| x.next_down());
        // A unit in the last place is two steps below 1.
        for steps in 0..10 {
            let points = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0], [1.0, down(1.0, steps)]];
            let third =
                [[0.0, 0.0], [1.0, 3.0], [2.0, 2.0], [0.5, 0.0], [1.0 / 3.0, down(1.0, steps)]];
            for (points, is_inside) in [(points, true), (third, false)] {
                let (_, segments) = extended(&points, Extent::Hull).unwrap();
                let is_on = segments.inputs.as_flattened().contains(&4);
                // Down is out of the second hull.
                assert_eq!(is_on, steps < 7 || !is_inside, "{steps}");
            }
            let (_, segments) = extended(&points, Extent::Box).unwrap();
            assert_eq!(segments.inputs.as_flattened().contains(&4), steps < 7, "{steps}");
        }
    }

    /// What is next to two edges may be beyond either of them.
    #[test]
    fn inputs_next_to_a_corner_are_left() {
        let tiny = 1.0f64.next_down();
        let (_, segments) =
            extended(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [tiny; 2]], Extent::Hull)
                .unwrap();
        assert_eq!(segments.inputs, [[0, 1], [1, 2], [2, 3], [3, 0]]);
    }
}
