//! Bending of pieces of segments through the vertices near them, until no vertex is so near: see
//! [`super::reach`]. Pieces are bent one by one, since the vertices stay where they are.
//!
//! This ends: the vertices of a bent segment follow each other in its order.

use super::near::Near;
use super::poll::Poll;
use super::reach::Reach;
use crate::error::Result;
use crate::memory::{Lists, TryGrow, with_capacity};
use crate::mesh::Subsegment;

/// Number of polls' units of work for one piece.
const WORK: u32 = 8;

/// Bends pieces through vertices near them.
pub(super) struct Bender<'a, const D: usize> {
    vertices: &'a [[f64; D]],
    reaches: &'a [Reach<D>],
    near: Near<D>,
    /// Other ends of the pieces that end at each vertex.
    others: Lists,
    /// Vertices near the piece that is being bent.
    found: Vec<u32>,
    /// Pieces that may have to be bent again, the next one last.
    waiting: Vec<[u32; 2]>,
}

impl<'a, const D: usize> Bender<'a, D> {
    /// Builds the tree of the vertices, to bend `pieces` of the segments with these `reaches`. O(n
    /// log n) for n vertices and pieces.
    pub fn new(
        vertices: &'a [[f64; D]],
        reaches: &'a [Reach<D>],
        pieces: &[Subsegment],
    ) -> Result<Self> {
        let near = Near::new(vertices)?;
        let pairs = || pieces.iter().flat_map(|&Subsegment { ends: [a, b], .. }| [(a, b), (b, a)]);
        let others = Lists::of_pairs(vertices.len(), pairs)?;
        let (found, waiting) = Default::default();
        Ok(Self { vertices, reaches, near, others, found, waiting })
    }

    /// Returns the pieces led through the vertices near them, each in its own direction, except for
    /// vertices for which `passes` is true. Vertices for which `is_shared` is true attract from
    /// farther off. `bent` is called with each vertex that a piece now goes through, and with the
    /// piece's segment.
    ///
    /// # Errors
    /// `OutOfMemory`, and those of `poll`.
    pub fn bend(
        &mut self,
        pieces: &[Subsegment],
        poll: Poll<'_>,
        is_shared: impl Fn(&[f64; D]) -> bool,
        passes: impl Fn(&Subsegment, u32) -> bool,
        mut bent: impl FnMut(u32, u32),
    ) -> Result<Vec<Subsegment>> {
        let mut all = with_capacity(pieces.len())?;
        for piece in pieces {
            self.waiting.clear();
            self.waiting.try_push(piece.ends)?;
            while let Some(ends) = self.waiting.pop() {
                poll(WORK)?;
                let part = Subsegment { ends, ..*piece };
                self.find(&part, &is_shared)?;
                self.found.retain(|&vertex| !passes(&part, vertex));
                if self.found.is_empty() {
                    all.try_push(part)?;
                    continue;
                }
                self.found.iter().for_each(|&vertex| bent(vertex, piece.segment));
                let mut to = ends[1];
                for &from in self.found.iter().rev() {
                    self.waiting.try_push([from, to])?;
                    to = from;
                }
                self.waiting.try_push([ends[0], to])?;
            }
        }
        Ok(all)
    }

    /// Fills `found` with the vertices near a piece, from its first end to its second.
    fn find(&mut self, part: &Subsegment, is_shared: impl Fn(&[f64; D]) -> bool) -> Result<()> {
        let Self { vertices, reaches, near, others, found, .. } = self;
        let reach = &reaches[part.segment as usize];
        let point = |vertex: u32| &vertices[vertex as usize];
        let piece = part.ends.map(point);
        let positions = piece.map(|end| reach.position(end));
        let (low, high) = (positions[0].min(positions[1]), positions[0].max(positions[1]));
        found.clear();
        near.collect(reach, piece, found)?;
        let is_between = |x: &[f64; D]| {
            let position = reach.position(x);
            low < position && position < high
        };
        // Two lines that run so closely beside each other share their vertices: a mesh between
        // them would have as many as the gap fits into their length.
        let runs_along = |vertex: u32| {
            others.of(vertex as usize).iter().any(|&other| {
                reach.is_parallel(piece, [vertex, other].map(point))
                    && (part.ends.contains(&other) || is_between(point(other)))
            })
        };
        found.retain(|&vertex| {
            let x = point(vertex);
            is_between(x)
                && (reach.is_near(piece, x)
                    || reach.is_beside(piece, x) && (is_shared(x) || runs_along(vertex))
                    || is_shared(x) && reach.passes(piece, x))
        });
        let mut kept = 0;
        for at in 0..found.len() {
            let x = point(found[at]);
            if is_shared(x) || !near.has_beside(x, &reach.grain())? {
                found[kept] = found[at];
                kept += 1;
            }
        }
        found.truncate(kept);
        found.sort_unstable_by_key(|&vertex| reach.position(point(vertex)));
        if positions[0] > positions[1] {
            found.reverse();
        }
        Ok(())
    }
}
