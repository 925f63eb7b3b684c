//! Level 3: the simplices with one label have the area or the volume that the walls about them
//! enclose, exactly.

use super::sum::Sum;
use super::walls::{Walls, facet, noun, vertices};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// A wall with the simplices of a label on one of its sides only.
#[derive(Clone, Copy)]
struct Bound {
    label: i32,
    wall: u32,
    is_first_side: bool,
}

/// Checks that the measure of each label is what the walls about it enclose. The first `count`
/// simplices are those in the domain.
pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    count: usize,
    findings: &mut Findings,
) -> AllocResult<()> {
    let labels = &view.mesh.boundary.simplex_regions;
    let mut order = collected(0..count as u32)?;
    order.sort_unstable_by_key(|&simplex| labels[simplex as usize]);
    let bounds = bounds(view, walls, count)?;
    let (mut next, mut sum) = (0, Sum::zero());
    for simplices in order.chunk_by(|&a, &b| labels[a as usize] == labels[b as usize]) {
        let label = labels[simplices[0] as usize];
        for &simplex in simplices {
            add_simplex(view, walls, simplex as usize, &mut sum);
        }
        while let Some(bound) = bounds.get(next).filter(|bound| bound.label == label) {
            let mut points = vertices::<D>(view.mesh, bound.wall as usize).map(|v| view.point(v));
            // What the simplices have is taken away.
            if bound.is_first_side {
                points.swap(0, 1);
            }
            sum.add_facet(points);
            next += 1;
        }
        let is_equal = findings.check(sum.is_zero(), || {
            let (kind, measure) = match D {
                2 => (ViolationKind::RegionArea, "area"),
                _ => (ViolationKind::RegionVolume, "volume"),
            };
            let noun = noun::<D>();
            let message = message!(
                "the simplices with the label {label} have another {measure} than the {noun}s \
                 about them enclose"
            );
            Violation::new(kind, message).simplex(simplices[0] as usize)
        });
        if !is_equal {
            sum = Sum::zero();
        }
    }
    Ok(())
}

/// Adds the measure of a simplex, and takes away what is beyond its facets on the hull.
fn add_simplex<const D: usize>(view: View<'_, D>, walls: &Walls, simplex: usize, sum: &mut Sum) {
    for slot in 0..View::<D>::VERTICES {
        let mut points = facet(view, simplex, slot).map(|vertex| view.point(vertex));
        sum.add_facet(points);
        if view.neighbors(simplex)[slot] == NONE && walls.across(simplex, slot) == NONE {
            points.swap(0, 1);
            sum.add_facet(points);
        }
    }
}

/// Returns the walls that bound the simplices of each label, sorted by label.
fn bounds<const D: usize>(
    view: View<'_, D>,
    walls: &Walls,
    count: usize,
) -> AllocResult<Vec<Bound>> {
    let labels = &view.mesh.boundary.simplex_regions;
    let label = |side: u32| ((side as usize) < count).then(|| labels[side as usize]);
    let mut bounds = Vec::new();
    for (wall, sides) in (0..).zip(&walls.sides) {
        let [first, second] = sides.map(label);
        for (label, is_first_side) in [(first, true), (second, false)] {
            if let (Some(label), true) = (label, first != second) {
                bounds.try_push(Bound { label, wall, is_first_side })?;
            }
        }
    }
    bounds.sort_unstable_by_key(|bound| bound.label);
    Ok(bounds)
}
