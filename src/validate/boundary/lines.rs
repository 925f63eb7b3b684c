//! Lines: the parts of segments that nothing bends. Where segments meet or cross there is an
//! *anchor*: an input, or a vertex of several segments. Level 2: the vertices between the anchors
//! at the ends of a line are as near to it as doubles can be, and in order.

use super::edges::Edges;
use super::exact::{meets, unit_in_last_place};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, with_capacity};
use crate::mesh::{NONE, Triangulation};
use crate::options::Extent;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};
use std::cmp::Ordering;
use std::ops::Range;

/// Lines as they follow each other in the array of subsegments.
pub(super) struct Lines {
    /// Subsegment -> its line.
    pub of: Vec<u32>,
    /// Line -> its ends.
    pub ends: Vec<[u32; 2]>,
    /// Line -> its first subsegment.
    starts: Vec<u32>,
}

impl Lines {
    /// Finds the lines of the segments. Ids must be in range.
    pub fn new(mesh: &Triangulation, inputs: usize, edges: &Edges) -> AllocResult<Self> {
        let boundary = &mesh.boundary;
        let mut of = with_capacity(boundary.subsegments.len())?;
        let (mut ends, mut starts): (Vec<[u32; 2]>, Vec<u32>) = Default::default();
        for (at, &[from, to]) in boundary.subsegments.iter().enumerate() {
            let goes_on = at > 0
                && boundary.subsegments[at - 1][1] == from
                && boundary.parents[at - 1] == boundary.parents[at]
                && !is_anchor(mesh, inputs, edges, from);
            match ends.last_mut() {
                Some(last) if goes_on => last[1] = to,
                _ => {
                    ends.try_push([from, to])?;
                    starts.try_push(at as u32)?;
                }
            }
            of.push(ends.len() as u32 - 1);
        }
        Ok(Self { of, ends, starts })
    }

    /// Returns the subsegments of a line.
    fn subsegments(&self, line: usize) -> Range<usize> {
        let end = self.starts.get(line + 1).map_or(self.of.len(), |&end| end as usize);
        self.starts[line] as usize..end
    }
}

pub(super) fn is_anchor(mesh: &Triangulation, inputs: usize, edges: &Edges, vertex: u32) -> bool {
    let parent = |subsegment: u32| mesh.boundary.parents[subsegment as usize];
    match *edges.at.of(vertex as usize) {
        [first, second] => {
            (vertex as usize) < inputs
                || parent(first) != parent(second)
                || is_corner(mesh, [first, second], parent(first) != NONE)
        }
        _ => true,
    }
}

/// Returns true if two subsegments of the boundary of an extent may be of two sides of a box, which
/// meet in a corner. A side may pass through inputs next to it, so that pieces of it are not quite
/// along an axis; but they are flatter than a diagonal, or steeper. Where a segment runs along both
/// and so has them, one is along an axis. Sides of a hull meet at inputs only.
fn is_corner(mesh: &Triangulation, subsegments: [u32; 2], is_of_segment: bool) -> bool {
    let ways = subsegments.map(|subsegment| {
        let [a, b] = mesh.boundary.subsegments[subsegment as usize].map(|end| mesh.point(end));
        [0, 1].map(|axis| (0.5 * b[axis] - 0.5 * a[axis]).abs())
    });
    let [first, second] = ways.map(|[x, y]| x.total_cmp(&y));
    let may_be = match is_of_segment {
        true => first != second && ways.as_flattened().contains(&0.0),
        false => first.is_eq() || first != second,
    };
    mesh.parameters.extent == Extent::Box && may_be
}

/// Returns true if the way from `a` to `b` goes nowhere against that from `from` to `to`, on either
/// axis.
pub(super) fn advances(from: &[f64; 2], to: &[f64; 2], a: &[f64; 2], b: &[f64; 2]) -> bool {
    let agrees = |axis: usize| match (from[axis] + 0.0).total_cmp(&(to[axis] + 0.0)) {
        Ordering::Less => a[axis] <= b[axis],
        Ordering::Greater => a[axis] >= b[axis],
        Ordering::Equal => true,
    };
    agrees(0) && agrees(1) && a != b
}

pub(super) fn check(view: View<'_, 2>, lines: &Lines, findings: &mut Findings) -> AllocResult<()> {
    for (line, ends) in lines.ends.iter().enumerate() {
        let [from, to] = ends.map(|end| view.point(end));
        let subsegments = lines.subsegments(line);
        let first = subsegments.start;
        for at in subsegments {
            let [a, b] = view.mesh.boundary.subsegments[at];
            let segment = view.mesh.boundary.parents[at];
            findings.check(advances(from, to, view.point(a), view.point(b)), || {
                let message = message!("segment {segment} goes back from vertex {a} to vertex {b}");
                Violation::new(ViolationKind::SegmentChain, message).vertex(a as usize)
            });
            if at == first {
                continue;
            }
            let p = view.point(a);
            let is_near = meets(from, to, p, p.map(unit_in_last_place))?;
            findings.check(is_near, || {
                let message = message!(
                    "vertex {a} is more than half a unit in the last place off the line from \
                     vertex {} to {} of segment {segment}",
                    ends[0],
                    ends[1]
                );
                Violation::new(ViolationKind::SegmentLine, message).vertex(a as usize)
            });
        }
    }
    Ok(())
}
