//! Level 2: every subsegment is an edge of the triangulation, and Gabriel.

use super::exact::{Point, meets, side_of_diametral_circle, unit_in_last_place};
use super::walls::Walls;
use crate::error::message;
use crate::memory::{AllocResult, Lists};
use crate::mesh::NONE;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};
use std::cmp::Ordering;

/// Largest length along each axis, in units in the last place of the mesh's largest coordinate, of
/// a subsegment that may lack room for a vertex on it.
const SHORT: f64 = 64.0;
/// Largest distance, in such units of each axis, of an opposite vertex from a subsegment's line for
/// which the subsegment may lack room. Splits are fractions of the caller's segments, and as coarse
/// as doubles near their ends.
const NO_ROOM: f64 = 8.0;

/// Edges of the triangles that are subsegments.
pub(super) struct Edges {
    /// Vertex -> the subsegments that end there.
    pub at: Lists,
    pub walls: Walls,
}

impl Edges {
    /// Finds the subsegments among the edges. Ids must be in range. O(simplices) but for vertices
    /// with many subsegments.
    pub fn new(view: View<'_, 2>) -> AllocResult<Self> {
        let subsegments = &view.mesh.boundary.subsegments;
        let at = at_vertices(view)?;
        let walls = Walls::find(view, |edge| {
            let found = between(subsegments, &at, *edge)?;
            Some((found, subsegments[found as usize] == *edge))
        })?;
        Ok(Self { at, walls })
    }

    /// Returns the first subsegment between two vertices, and whether it runs from `a` to `b`.
    pub fn between(&self, view: View<'_, 2>, [a, b]: [u32; 2]) -> Option<(u32, bool)> {
        let subsegments = &view.mesh.boundary.subsegments;
        let found = between(subsegments, &self.at, [a, b])?;
        Some((found, subsegments[found as usize] == [a, b]))
    }
}

/// Returns for each vertex the subsegments that end there.
pub(super) fn at_vertices<const D: usize>(view: View<'_, D>) -> AllocResult<Lists> {
    Lists::of_pairs(view.vertex_count(), || {
        let ends = view.mesh.boundary.subsegments.as_flattened().iter().enumerate();
        ends.map(|(slot, &vertex)| (vertex, (slot / 2) as u32))
    })
}

/// Returns the first subsegment between two vertices.
pub(super) fn between(subsegments: &[[u32; 2]], at: &Lists, [a, b]: [u32; 2]) -> Option<u32> {
    let [of_a, of_b] = [a, b].map(|vertex| at.of(vertex as usize));
    let shorter = if of_a.len() < of_b.len() { of_a } else { of_b };
    let joins = |&&subsegment: &&u32| {
        let ends = subsegments[subsegment as usize];
        ends == [a, b] || ends == [b, a]
    };
    shorter.iter().find(joins).copied()
}

pub(super) fn check(view: View<'_, 2>, edges: &Edges, findings: &mut Findings) -> AllocResult<()> {
    let least_room = least_room(view);
    for (at, sides) in edges.walls.sides.iter().enumerate() {
        let [a, b] = view.mesh.boundary.subsegments[at];
        let is_edge = findings.check(*sides != [NONE; 2], || {
            let message = message!(
                "subsegment {at} from vertex {a} to {b} is no edge of the mesh, or is there twice"
            );
            Violation::new(ViolationKind::SubsegmentEdge, message).vertex(a as usize)
        });
        // Doubles may be too coarse there to split it.
        let is_limited = [a, b].iter().all(|&end| view.mesh.precision_limited[end as usize]);
        let is_exempt = is_limited && may_lack_room(view, [a, b], *sides, least_room)?;
        if is_edge && !is_exempt {
            check_gabriel(view, at, *sides, findings)?;
        }
    }
    Ok(())
}

/// Returns [`NO_ROOM`] units in the last place of the largest coordinate, by axis.
fn least_room(view: View<'_, 2>) -> Point {
    let coordinates = |axis: usize| view.mesh.points.iter().skip(axis).step_by(2);
    let largest = |axis: usize| coordinates(axis).fold(0.0, |most: f64, x| most.max(x.abs()));
    [0, 1].map(|axis| NO_ROOM * unit_in_last_place(largest(axis)))
}

/// Returns true if doubles may have no room for a vertex on a subsegment: it is short, or a vertex
/// opposite to it is no farther from its line than `least_room`.
fn may_lack_room(
    view: View<'_, 2>,
    ends: [u32; 2],
    sides: [u32; 2],
    least_room: Point,
) -> AllocResult<bool> {
    let [a, b]: [&Point; 2] = ends.map(|end| view.point(end));
    // What the coarser axis rounds off turns an edge whatever its direction is.
    let short = SHORT / NO_ROOM * least_room[0].max(least_room[1]);
    if (0..2).all(|axis| (b[axis] - a[axis]).abs() <= short) {
        return Ok(true);
    }
    for side in sides.into_iter().filter(|&side| side != NONE) {
        let vertices = view.simplex(side as usize);
        for &apex in vertices.iter().filter(|vertex| !ends.contains(vertex)) {
            if meets(a, b, view.point(apex), least_room.map(|room| 2.0 * room))? {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// Checks that a subsegment is Gabriel. With the mesh Delaunay, the vertices of the two triangles
/// speak for all.
fn check_gabriel(
    view: View<'_, 2>,
    at: usize,
    sides: [u32; 2],
    findings: &mut Findings,
) -> AllocResult<()> {
    let ends = view.mesh.boundary.subsegments[at];
    let [a, b]: [&Point; 2] = ends.map(|end| view.point(end));
    for &side in sides.iter().filter(|&&side| side != NONE) {
        let simplex = view.simplex(side as usize);
        for &apex in simplex.iter().filter(|vertex| !ends.contains(vertex)) {
            let sign = side_of_diametral_circle(a, b, view.point(apex))?;
            findings.check(sign != Ordering::Less, || {
                let message = message!(
                    "vertex {apex} is inside the diametral circle of subsegment {at}, from {} to \
                     {}",
                    ends[0],
                    ends[1]
                );
                let violation = Violation::new(ViolationKind::SubsegmentGabriel, message);
                violation.simplex(side as usize).vertex(apex as usize)
            });
        }
    }
    Ok(())
}
