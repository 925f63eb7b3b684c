//! Selection of the D-balls that may still cover a ball with too many points.
//!
//! The D-ball cover theorem (Theorem 10; its proof is Theorem 43 in A.3) says more than its
//! statement: an empty ball B is covered by at most d of the D-balls around one edge uv, those
//! whose centres are corners of the Voronoi facet of u and v; or by at most d of the unbounded ones
//! at one hull vertex v, which are those around the edge from v to the infinite vertex. So B holds
//! fewer than t points if for every edge the d fullest D-balls around it have fewer than t points
//! in sum, or all the D-balls around it in union. Balls without bound, half-spaces, are among the
//! B.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Delaunay;
use crate::memory::{AllocResult, Array, TryGrow};
use crate::netmesh::rounds::net::PointId;

/// Counts points around the edges at a vertex; keeps its buffers.
pub(in crate::netmesh) struct Rings<const D: usize> {
    star: Array<SimplexId>,
    /// The other ends of the edges; the one after the last vertex stands for the infinite vertex.
    others: Vec<VertexId>,
    /// Other end -> the D largest counts of points in the D-balls around the edge.
    largest: Vec<[u32; D]>,
    /// Other end -> the simplex with the largest.
    fullest: Vec<SimplexId>,
    /// Point -> the last union that it was counted in.
    marks: Vec<u32>,
    unions: u32,
}

impl<const D: usize> Default for Rings<D> {
    fn default() -> Self {
        Self {
            star: Array::new(),
            others: Vec::new(),
            largest: Vec::new(),
            fullest: Vec::new(),
            marks: Vec::new(),
            unions: 0,
        }
    }
}

impl<const D: usize> Rings<D> {
    /// Prepares for `points` other points.
    pub fn restart(&mut self, points: usize) -> AllocResult<()> {
        self.marks.clear();
        self.unions = 0;
        self.marks.cover(points, 0)
    }

    /// Returns the fullest of the D-balls around the edges at `vertex` that may cover a ball with
    /// `threshold` points: it has at least a D-th of `threshold`. `inside` are the points in each
    /// D-ball.
    pub fn fullest(
        &mut self,
        delaunay: &mut Delaunay<D>,
        inside: &[Vec<PointId>],
        vertex: VertexId,
        threshold: u32,
    ) -> AllocResult<Option<SimplexId>> {
        self.count(delaunay, inside, vertex)?;
        let mut best = None;
        let mut most = 0;
        for at in 0..self.others.len() {
            let other = self.others[at];
            let largest = &self.largest[other];
            let sum: u64 = largest.iter().map(|&count| u64::from(count)).sum();
            if largest[0] > most
                && sum >= u64::from(threshold)
                && (largest[0] >= threshold || self.union(delaunay, inside, other) >= threshold)
            {
                (best, most) = (Some(self.fullest[other]), self.largest[other][0]);
            }
        }
        Ok(best)
    }

    /// Fills in the largest counts around the edges at `vertex`.
    fn count(
        &mut self,
        delaunay: &mut Delaunay<D>,
        inside: &[Vec<PointId>],
        vertex: VertexId,
    ) -> AllocResult<()> {
        let infinite = after_last(delaunay);
        for &other in &self.others {
            self.largest[other] = [0; D];
        }
        self.others.clear();
        self.largest.cover(infinite.index() + 1, [0; D])?;
        self.fullest.cover(infinite.index() + 1, SimplexId::NONE)?;
        delaunay.star(vertex, &mut self.star)?;
        for &simplex in &self.star {
            let count = inside[simplex].len() as u32;
            for &end in delaunay.complex().vertices(simplex) {
                if count == 0 || end == vertex {
                    continue;
                }
                let other = if end == VertexId::INFINITE { infinite } else { end };
                let largest = &mut self.largest[other];
                if largest[0] == 0 {
                    self.others.try_push(other)?;
                }
                if count > largest[0] {
                    self.fullest[other] = simplex;
                }
                let mut count = count;
                for slot in largest.iter_mut() {
                    if count > *slot {
                        std::mem::swap(slot, &mut count);
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the number of points in the D-balls around the edge to `other`.
    fn union(&mut self, delaunay: &Delaunay<D>, inside: &[Vec<PointId>], other: VertexId) -> u32 {
        let end = if other == after_last(delaunay) { VertexId::INFINITE } else { other };
        if self.unions == u32::MAX {
            self.marks.fill(0);
            self.unions = 0;
        }
        self.unions += 1;
        let mut union = 0;
        for &simplex in &self.star {
            if delaunay.complex().vertices(simplex).contains(&end) {
                for &point in &inside[simplex] {
                    let mark = &mut self.marks[point];
                    union += u32::from(*mark != self.unions);
                    *mark = self.unions;
                }
            }
        }
        union
    }
}

/// Returns the id that stands for the infinite vertex in arrays by vertex.
fn after_last<const D: usize>(delaunay: &Delaunay<D>) -> VertexId {
    VertexId::new(delaunay.point_count())
}
