//! Level 3: the triangles with one label have the area of the polygons that bound them, exactly.

use super::edges::Edges;
use super::sum::Sum;
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// A subsegment with the triangles of a label on one of its sides only.
#[derive(Clone, Copy)]
struct Bound {
    label: i32,
    subsegment: u32,
    is_on_left: bool,
}

/// Checks that the area of each label is what its bounding edges enclose. The first `count`
/// triangles are those in the domain.
pub(super) fn check(
    view: View<'_, 2>,
    edges: &Edges,
    count: usize,
    findings: &mut Findings,
) -> AllocResult<()> {
    let labels = &view.mesh.boundary.simplex_regions;
    let mut order = collected(0..count as u32)?;
    order.sort_unstable_by_key(|&simplex| labels[simplex as usize]);
    let bounds = bounds(view, edges, count)?;
    let (mut next, mut sum) = (0, Sum::zero());
    for triangles in order.chunk_by(|&a, &b| labels[a as usize] == labels[b as usize]) {
        let label = labels[triangles[0] as usize];
        for &triangle in triangles {
            add_triangle(view, edges, triangle as usize, &mut sum);
        }
        while let Some(bound) = bounds.get(next).filter(|bound| bound.label == label) {
            let [a, b] = view.mesh.boundary.subsegments[bound.subsegment as usize];
            let [from, to] = if bound.is_on_left { [b, a] } else { [a, b] };
            sum.add_edge(view.point(from), view.point(to));
            next += 1;
        }
        let is_equal = findings.check(sum.is_zero(), || {
            let message = message!(
                "the simplices with the label {label} have another area than the subsegments \
                 about them enclose"
            );
            Violation::new(ViolationKind::RegionArea, message).simplex(triangles[0] as usize)
        });
        if !is_equal {
            sum = Sum::zero();
        }
    }
    Ok(())
}

/// Adds a triangle's doubled area, and takes away what is beyond its edges on the hull.
fn add_triangle(view: View<'_, 2>, edges: &Edges, triangle: usize, sum: &mut Sum) {
    let vertices = view.simplex(triangle);
    for slot in 0..3 {
        let [a, b] = [1, 2].map(|step| view.point(vertices[(slot + step) % 3]));
        sum.add_edge(a, b);
        if view.neighbors(triangle)[slot] == NONE && edges.across(triangle, slot) == NONE {
            sum.add_edge(b, a);
        }
    }
}

/// Returns the edges that bound the triangles of each label, sorted by label.
fn bounds(view: View<'_, 2>, edges: &Edges, count: usize) -> AllocResult<Vec<Bound>> {
    let labels = &view.mesh.boundary.simplex_regions;
    let label = |side: u32| ((side as usize) < count).then(|| labels[side as usize]);
    let mut bounds = Vec::new();
    for (subsegment, sides) in edges.sides.iter().enumerate() {
        let [left, right] = sides.map(label);
        for (label, is_on_left) in [(left, true), (right, false)] {
            if let (Some(label), true) = (label, left != right) {
                bounds.try_push(Bound { label, subsegment: subsegment as u32, is_on_left })?;
            }
        }
    }
    bounds.sort_unstable_by_key(|bound| bound.label);
    Ok(bounds)
}
