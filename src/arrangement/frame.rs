//! The boundary of an extent and the vertices near it. The boundary bends through them as segments
//! do, except at its corners: bent through a vertex near both edges of a corner, it would leave the
//! corner outside.

use super::reach::Reach;
use crate::memory::{AllocResult, filled};
use crate::mesh::{NONE, Subsegment};
use crate::numerics::orientation;

/// Boundary of an extent: a convex curve whose edges follow each other counterclockwise.
pub(super) struct Frame<'a> {
    segments: &'a [Subsegment],
    reaches: &'a [Reach<2>],
    /// Number of the caller's segments; the edges of the boundary follow them.
    own: u32,
    /// Vertex -> the boundary edge that begins there, or [`NONE`].
    starting: Vec<u32>,
}

impl<'a> Frame<'a> {
    /// Builds the boundary from the segments with numbers `own` and more, whose ends are among the
    /// first `vertices` vertices.
    pub fn new(
        segments: &'a [Subsegment],
        own: usize,
        reaches: &'a [Reach<2>],
        vertices: usize,
    ) -> AllocResult<Self> {
        let mut starting = filled(if own < segments.len() { vertices } else { 0 }, NONE)?;
        for edge in &segments[own..] {
            starting[edge.ends[0] as usize] = edge.segment;
        }
        Ok(Self { segments, reaches, own: own as u32, starting })
    }

    /// Returns true if a piece is not bent through a vertex near it, which then stays inside the
    /// boundary. This is asked for pieces of the boundary, and for the caller's pieces between the
    /// ends of a boundary edge. Near a corner a vertex is near two edges, and goes on one of them
    /// at most: on the piece if it would be outside otherwise, or if a segment of the caller's
    /// leads to it along there.
    pub fn passes(&self, points: &[[f64; 2]], part: &Subsegment, vertex: u32) -> bool {
        let Some(edge) = self.edge_of(part) else { return false };
        let point = |vertex: u32| &points[vertex as usize];
        let count = self.segments.len() as u32 - self.own;
        let beside = [count - 1, 1].map(|step| self.own + (edge - self.own + step) % count);
        let is_near = |&other: &u32| self.reaches[other as usize].holds(point(vertex));
        let Some(other) = beside.into_iter().find(is_near) else { return false };
        let reach = &self.reaches[edge as usize];
        let [mut from, mut to] = part.ends.map(point);
        if reach.position(from) > reach.position(to) {
            (from, to) = (to, from);
        }
        let is_outside = orientation(&[from, to, point(vertex)]).is_negative();
        let leads = |edge: u32| self.leads_to(points, vertex, edge);
        !is_outside && !(leads(edge) && (edge < other || !leads(other)))
    }

    /// Returns the boundary edge that a piece belongs to or coincides with.
    fn edge_of(&self, part: &Subsegment) -> Option<u32> {
        if part.segment >= self.own {
            return Some(part.segment);
        }
        let [a, b] = part.ends;
        [[a, b], [b, a]].into_iter().find_map(|[from, to]| {
            let edge = *self.starting.get(from as usize).filter(|&&edge| edge != NONE)?;
            (self.segments[edge as usize].ends[1] == to).then_some(edge)
        })
    }

    /// Returns true if one of the caller's segments leads to a vertex along a boundary edge.
    fn leads_to(&self, points: &[[f64; 2]], vertex: u32, edge: u32) -> bool {
        let ends = self.segments[edge as usize].ends;
        let is_on = |end: u32| {
            ends.contains(&end) || self.reaches[edge as usize].holds(&points[end as usize])
        };
        self.segments[..self.own as usize].iter().any(|own| match own.ends {
            [end, other] if end == vertex => is_on(other),
            [other, end] if end == vertex => is_on(other),
            _ => false,
        })
    }
}
