//! Segments along the boundary of the convex hull or of the bounding box of the inputs.

use super::inner::Inner;
use super::poll::Poll;
use super::ranked::{key, ordered_bits};
use super::reach::Reach;
use crate::error::{Error, Result};
use crate::memory::{TryGrow, collected, with_capacity};
use crate::mesh::{Inputs, Segments};
use crate::numerics::{Sign, coordinates, orientation};
use crate::options::Extent;

/// Number of polls' units of work for one point.
const WORK: u32 = 2;

/// Returns the caller's inputs and segments, followed by those of the extent: the corners of a box
/// that are no inputs, and the edges of a box or hull. In 2D only. O(n log n). `poll` is told of
/// work as by [`super::arrange`].
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
        Extent::Auto | Extent::All | Extent::Boundary => Vec::new(),
    };
    let point = |&number: &u32| coordinates::<2>(&points, number as usize);
    if !curve.is_empty() && !has_area(curve.iter().map(point)) {
        return Err(Error::without_area(extent));
    }
    for (at, &from) in curve.iter().enumerate() {
        all.inputs.try_push([from, curve[(at + 1) % curve.len()]])?;
        all.markers.try_push(0)?;
    }
    Ok((Inputs::new(2, points.len() / 2, &points, 0)?, all))
}

/// Returns false if the corners of a convex curve are on one line, up to rounding.
fn has_area<'a>(corners: impl Iterator<Item = &'a [f64; 2]> + Clone) -> bool {
    let ends = [0, 1].map(|axis| {
        let place = |corner: &&[f64; 2]| [corner[axis], corner[1 - axis]].map(ordered_bits);
        let extremes = [corners.clone().min_by_key(place), corners.clone().max_by_key(place)];
        extremes.map(|corner| corner.expect("a curve has corners"))
    });
    ends.iter().all(|&ends| {
        let reach = Reach::of(ends);
        let [a, b] = ends;
        corners.clone().any(|x| orientation(&[a, b, x]) != Sign::Zero && !reach.is_near(ends, x))
    })
}

/// Returns the corners of the inputs' bounding box, counterclockwise.
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

/// Returns the inputs on the convex hull, counterclockwise, among them those in the interior of its
/// edges (A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979).
/// O(n log n).
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
    use crate::error::ErrorKind;

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
        // Two of the corners are no inputs.
        assert_eq!((all.count(), all.distinct(), segments.count()), (8, 7, 4));
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
        assert!(error.message().starts_with("options.extent = Extent::Box has no area"));
    }

    #[test]
    fn work_is_told_and_can_be_ended() {
        let points: Vec<[f64; 2]> =
            (0..200).map(|i| [f64::from(i).cos(), f64::from(i).sin()]).collect();
        let polled = |most: usize| {
            let mut calls = 0;
            let mut poll = |_: u32| {
                calls += 1;
                match calls < most {
                    true => Ok(()),
                    false => Err(Error::new(ErrorKind::Cancelled, "enough")),
                }
            };
            let (inputs, none) = (inputs(&points), Segments::default());
            let made = with_extent(&inputs, &none, Extent::Hull, &mut poll);
            (made.map(drop).map_err(|error| error.kind()), calls)
        };
        let (made, all) = polled(usize::MAX);
        assert!(made.is_ok() && all >= 200, "{all}");
        for most in [1, 100, all] {
            assert_eq!(polled(most), (Err(ErrorKind::Cancelled), most));
        }
    }
}
