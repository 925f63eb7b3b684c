//! Conflict tests: is a point inside a D-ball.

use super::MAX_SIMPLEX_VERTICES;
use crate::complex::{Records, SimplexId, VertexId, position};
use crate::memory::prefetch_at;
use crate::numerics::{Circumball, RoundedBall, Sign, in_ball_with_care, orientation};
use std::sync::atomic::{AtomicU64, Ordering};

/// Points and D-balls that conflict tests read, beside the records of the simplices.
#[derive(Clone, Copy)]
pub(super) struct Conflicts<'a, const D: usize> {
    pub points: &'a [[f64; D]],
    pub balls: &'a [RoundedBall<D>],
    pub exact_fallbacks: &'a AtomicU64,
}

impl<'a, const D: usize> Conflicts<'a, D> {
    /// Returns true if `q` is strictly inside the D-ball of `simplex`. For an infinite simplex:
    /// strictly beyond its facet, or on the facet's hyperplane and strictly inside the facet's
    /// disc.
    #[inline(always)]
    pub fn test(&self, records: Records<'_, D>, simplex: SimplexId, q: &[f64; D]) -> bool {
        self.side(records, simplex, q).unwrap_or_else(|| self.test_with_care(records, simplex, q))
    }

    /// Returns the result of [`Self::test`] if the rounded D-ball decides it, else `None`.
    #[inline(always)]
    pub fn side(&self, records: Records<'_, D>, simplex: SimplexId, q: &[f64; D]) -> Option<bool> {
        let vertices = records.vertices(simplex);
        self.balls[simplex].side(|index| &self.points[vertices[index]], q)
    }

    /// Returns the result of [`Self::test`] for simplices whose rounded D-ball does not decide it:
    /// by the D-ball in doubles, and then by exact signs.
    #[cold]
    #[inline(never)]
    pub fn test_with_care(
        &self,
        records: Records<'_, D>,
        simplex: SimplexId,
        q: &[f64; D],
    ) -> bool {
        let vertices = records.vertices(simplex);
        match vertices.contains(&VertexId::INFINITE) {
            true => self.beyond_hull(records, simplex, q),
            false => {
                let points = self.vertex_points(vertices);
                let ball = Circumball::of(|index| points[index]);
                ball.side(points[ball.anchor], q).unwrap_or_else(|| {
                    self.exact_fallbacks.fetch_add(1, Ordering::Relaxed);
                    in_ball_with_care(&points[..=D], q) == Sign::Positive
                })
            }
        }
    }

    /// Returns true if `q` is in conflict with an infinite simplex. A point on the facet's
    /// hyperplane is inside its disc iff it is inside the ball of the finite neighbour.
    fn beyond_hull(&self, records: Records<'_, D>, simplex: SimplexId, q: &[f64; D]) -> bool {
        let vertices = records.vertices(simplex);
        let infinite = position(vertices, VertexId::INFINITE);
        let mut points = self.vertex_points(vertices);
        points[infinite] = q;
        match orientation(&points[..=D]) {
            Sign::Positive => true,
            Sign::Negative => false,
            // In a partition that ends there: unknown, and a cavity with such a simplex is left
            // alone.
            Sign::Zero if records.is_interface(simplex, infinite) => true,
            Sign::Zero => self.test(records, records.neighbors(simplex)[infinite], q),
        }
    }

    /// Returns the points of a simplex' vertices; that of the infinite vertex is arbitrary.
    pub fn vertex_points(&self, vertices: &[VertexId]) -> [&'a [f64; D]; MAX_SIMPLEX_VERTICES] {
        let mut of_vertices = [&self.points[0]; MAX_SIMPLEX_VERTICES];
        for (point, &vertex) in of_vertices.iter_mut().zip(vertices) {
            if vertex != VertexId::INFINITE {
                *point = &self.points[vertex];
            }
        }
        of_vertices
    }

    /// Prefetches the D-ball of `simplex`.
    #[inline(always)]
    pub fn prefetch(&self, simplex: SimplexId) {
        prefetch_at(self.balls, simplex.index(), 1);
    }
}
