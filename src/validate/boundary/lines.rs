//! Lines: the parts of segments that nothing bends, from anchor to anchor. Level 2: the vertices
//! between the ends of a line are as near to it as doubles can be, and in order.

use super::anchors::Anchors;
use super::exact::{meets, unit_in_last_place};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, with_capacity};
use crate::mesh::Triangulation;
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
    pub fn new(mesh: &Triangulation, anchors: &Anchors<'_>) -> AllocResult<Self> {
        let boundary = &mesh.boundary;
        let mut of = with_capacity(boundary.subsegments.len())?;
        let (mut ends, mut starts): (Vec<[u32; 2]>, Vec<u32>) = Default::default();
        for (at, &[from, to]) in boundary.subsegments.iter().enumerate() {
            let goes_on = at > 0
                && boundary.subsegments[at - 1][1] == from
                && boundary.parents[at - 1] == boundary.parents[at]
                && !anchors.holds(from);
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
