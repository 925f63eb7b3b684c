//! The boundary of an extent beside the vertices near it. It goes through them as segments do, but
//! at a corner: a vertex near both edges there would leave the corner outside.

use super::reach::Reach;
use crate::memory::{AllocResult, filled};
use crate::mesh::{NONE, Subsegment};
use crate::numerics::orientation;

/// The boundary of an extent, a convex curve whose edges follow each other counterclockwise.
pub(super) struct Frame<'a> {
    segments: &'a [Subsegment],
    reaches: &'a [Reach<2>],
    /// The number of the caller's segments; the edges follow them.
    own: u32,
    /// Vertex -> the edge that begins there, or [`NONE`].
    starting: Vec<u32>,
}

impl<'a> Frame<'a> {
    /// Builds the boundary of the segments from number `own` on, between the first of so many
    /// vertices.
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

    /// Returns true if a piece of the boundary, or one of the caller's between the same ends,
    /// leaves a vertex near it inside. One that is near the next edge as well, at a corner, is on
    /// one of them at most: on the piece if it would be outside, or if a segment of the caller's
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
        if reach.place(from) > reach.place(to) {
            (from, to) = (to, from);
        }
        let is_outside = orientation(&[from, to, point(vertex)]).is_negative();
        let leads = |edge: u32| self.leads_to(points, vertex, edge);
        !is_outside && !(leads(edge) && (edge < other || !leads(other)))
    }

    /// Returns the edge that a piece belongs to, or is the same as.
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

    /// Returns true if a segment of the caller's leads to a vertex along an edge.
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
