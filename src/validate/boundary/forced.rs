//! Level 3: a triangle that is excused because a small angle of the caller's forces it has its
//! shortest edge between the two sides of such an angle, at the same distance from where they
//! meet. To shorten neither side below that distance is what ends the splitting of the sides.

use super::anchors::Anchors;
use super::edges::Edges;
use super::lines::Lines;
use crate::error::message;
use crate::memory::AllocResult;
use crate::mesh::NONE;
use crate::quality::corner::Corner;
use crate::quality::length::{Length, Offset};
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Lengths within this of each other, relative to the larger, are one: the builder's are rounded.
const SLACK: f64 = 1e-7;
/// The ends of such an edge are on one shell about the apex, on which vertices may have been put
/// with the precision of a double or, by a caller, of some digits.
const SAME_DISTANCE: f64 = 2e-3;
/// The cosine of 61.5 degrees: sides of 60 or more can be split without an end to the bound.
const SMALL_ANGLE: f64 = 0.477;

pub(super) fn check(
    view: View<'_, 2>,
    edges: &Edges,
    lines: &Lines,
    anchors: &Anchors<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    for &simplex in &view.mesh.boundary.forced {
        let vertices = view.simplex(simplex as usize);
        check_bound(view, simplex, findings)?;
        let length = |[a, b]: [u32; 2]| Length::between(view.point(a), view.point(b));
        let pairs = [[0, 1], [1, 2], [2, 0]].map(|pair| pair.map(|at: usize| vertices[at]));
        let shortest = pairs.map(length).into_iter().fold(Length::INFINITE, Length::min);
        let is_forced = pairs.iter().any(|&pair| {
            length(pair) <= shortest.times(1.0 + SLACK) && spans(view, edges, lines, anchors, pair)
        });
        findings.check(is_forced, || {
            let message = message!(
                "simplex {simplex} is no forced one: its shortest edge does not span a small angle"
            );
            Violation::new(ViolationKind::ForcedSimplex, message).simplex(simplex as usize)
        });
    }
    Ok(())
}

/// Checks that a simplex which is given as forced does not keep the bound.
pub(super) fn check_bound<const D: usize>(
    view: View<'_, D>,
    simplex: u32,
    findings: &mut Findings,
) -> AllocResult<()> {
    let limit = view.mesh.parameters.quality_bound;
    let corner = Corner::new(&view.points_of(view.simplex(simplex as usize))[..=D])?;
    let ratio = corner.map_or(f64::INFINITY, |corner| corner.radius.ratio(corner.shortest_edge));
    findings.check(ratio >= limit * (1.0 - SLACK), || {
        let message = message!("simplex {simplex} keeps the bound {limit}, and is no forced one");
        Violation::new(ViolationKind::ForcedSimplex, message).simplex(simplex as usize)
    });
    Ok(())
}

/// Returns true if two vertices are between the ends of two lines, at the same distance from an end
/// of both where these make a small angle.
fn spans(
    view: View<'_, 2>,
    edges: &Edges,
    lines: &Lines,
    anchors: &Anchors<'_>,
    pair: [u32; 2],
) -> bool {
    if pair.iter().any(|&vertex| anchors.holds(vertex)) {
        return false;
    }
    let [first, second] = pair.map(|vertex| {
        let line = lines.of[edges.at.of(vertex as usize)[0] as usize];
        lines.ends[line as usize]
    });
    let apex = first.into_iter().find(|end| second.contains(end)).unwrap_or(NONE);
    if apex == NONE || first == second {
        return false;
    }
    let [near, far] = pair.map(|vertex| Length::between(view.point(vertex), view.point(apex)));
    let ratio = near.min(far).ratio(near.max(far));
    let side = |ends: [u32; 2]| {
        let other = if ends[0] == apex { ends[1] } else { ends[0] };
        Offset::between(view.point(other), view.point(apex))
    };
    ratio >= 1.0 - SAME_DISTANCE && cosine(&side(first), &side(second)) > SMALL_ANGLE
}

fn cosine(a: &Offset<2>, b: &Offset<2>) -> f64 {
    let dot = a.vector[0] * b.vector[0] + a.vector[1] * b.vector[1];
    dot / (a.squared_mantissa() * b.squared_mantissa()).sqrt()
}
