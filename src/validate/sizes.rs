//! Level 3: no simplex that meets the box of the inputs is larger than was asked for. What a
//! function of the caller says between the vertices is not known here; what it answered at the
//! vertices is kept with the mesh.

use super::boundary::Promised;
use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::AllocResult;
use crate::mesh::Inputs;
use crate::quality::corner::Corner;
use crate::quality::length::Length;
use crate::quality::view::View;

/// The builder compares rounded lengths; so does this, with other roundings.
const SLACK: f64 = 1e-7;

/// Checks that no simplex is larger than the sizes asked for. `of_regions` has for each simplex the
/// largest edge of its region; it is empty if no region has one.
pub(super) fn check<const D: usize>(
    inputs: &Inputs,
    view: View<'_, D>,
    promised: Promised<'_>,
    of_regions: &[f64],
    findings: &mut Findings,
) -> AllocResult<()> {
    let mesh = view.mesh;
    if of_regions.is_empty() && mesh.parameters.max_edge == 0.0 && mesh.sizes.is_empty() {
        return Ok(());
    }
    let overall = match mesh.parameters.max_edge {
        0.0 => f64::INFINITY,
        max_edge => max_edge,
    };
    let bounds = bounds::<D>(inputs);
    // What is outside of the domain is as large as it is.
    for simplex in 0..promised.count() {
        let vertices = view.simplex(simplex);
        let points = &view.points_of(vertices)[..View::<D>::VERTICES];
        let is_limited = vertices.iter().any(|&vertex| mesh.precision_limited[vertex as usize]);
        if !is_limited && meets(points, &bounds) {
            let max_edge = of_regions.get(simplex).map_or(overall, |own| own.min(overall));
            if !promised.is_flat(simplex) {
                check_radius(view, simplex, points, max_edge, findings)?;
            }
            check_edges(simplex, points, max_edge, findings);
        }
    }
    Ok(())
}

/// Returns the least and the largest coordinate of the inputs on each axis.
fn bounds<const D: usize>(inputs: &Inputs) -> [[f64; 2]; D] {
    let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; D];
    for vertex in 0..inputs.distinct() {
        for ([low, high], &x) in bounds.iter_mut().zip(inputs.distinct_point(vertex)) {
            (*low, *high) = (low.min(x), high.max(x));
        }
    }
    bounds
}

/// Returns true if the box of some points meets that of the inputs.
fn meets<const D: usize>(points: &[&[f64; D]], bounds: &[[f64; 2]; D]) -> bool {
    bounds.iter().enumerate().all(|(axis, &[low, high])| {
        let is_below = points.iter().all(|point| point[axis] < low);
        let is_above = points.iter().all(|point| point[axis] > high);
        !is_below && !is_above
    })
}

/// Checks that the circumradius is at most that of the regular simplex with edges of the least size
/// asked for.
fn check_radius<const D: usize>(
    view: View<'_, D>,
    simplex: usize,
    points: &[&[f64; D]],
    max_edge: f64,
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut size = max_edge;
    let asked = |&vertex: &u32| view.mesh.sizes.get(vertex as usize).copied();
    for asked in view.simplex(simplex).iter().filter_map(asked) {
        // A size that is no number is refused with the lengths of arrays.
        size = size.min(asked);
    }
    let radius = Corner::new(points)?.map_or(Length::INFINITE, |corner| corner.radius);
    // The squared circumradius of the simplex spanned by unit vectors, over its squared edge.
    let share = ((1.0 - 1.0 / (D as f64 + 1.0)) / 2.0).sqrt();
    let ratio = radius.ratio(Length::new(size).times(share));
    findings.check(size == f64::INFINITY || ratio <= 1.0 + SLACK, || {
        let message =
            message!("simplex {simplex} has {ratio} times the largest circumradius of size {size}");
        Violation::new(ViolationKind::SimplexSize, message).simplex(simplex)
    });
    Ok(())
}

fn check_edges<const D: usize>(
    simplex: usize,
    points: &[&[f64; D]],
    max_edge: f64,
    findings: &mut Findings,
) {
    if max_edge == f64::INFINITY {
        return;
    }
    let mut longest = Length::ZERO;
    for (i, p) in points.iter().enumerate() {
        for q in &points[..i] {
            longest = longest.max(Length::between(p, q));
        }
    }
    findings.check(longest.ratio(Length::new(max_edge)) <= 1.0 + SLACK, || {
        let length = longest.to_f64();
        let message =
            message!("simplex {simplex} has an edge of length {length}, longer than {max_edge}");
        Violation::new(ViolationKind::SimplexSize, message).simplex(simplex)
    });
}
