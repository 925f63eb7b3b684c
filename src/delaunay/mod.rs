//! The Delaunay complex: D-balls (§3), conflict regions, insertion, removal and relocation.
//!
//! Strict tests need no perturbation. A point conflicts only with a ball that it is strictly
//! inside. The cavity is then star-shaped from the point, and the new simplices are not flat: a
//! point on a facet's hyperplane and strictly inside one side's ball is inside the facet's disc,
//! hence inside the other side's ball.
//!
//! ```text
//! a-------b         a-------b
//! |     / |         | \   / |    The D-balls of abc and bcd hold x: these two simplices are the
//! |   x   |  ---->  |   x   |    cavity of x. Its insertion replaces them by the cone of x over
//! | /     |         | /   \ |    the facets ab, bd, dc and ca round the cavity.
//! c-------d         c-------d
//! ```

mod cavity;
mod conflict;
mod locate;
mod order;
mod overlap;
mod partition;
mod plain;
mod removal;
#[cfg(test)]
mod tests;

use crate::complex::{Complex, SimplexId, VertexId};
use crate::memory::{AllocResult, Array, TryGrow, reserve};
use crate::numerics::{Circumball, RoundedBall, Sign, orientation};
pub(crate) use cavity::Cavity;
use conflict::Conflicts;
pub(crate) use removal::Hole;
use std::sync::atomic::{AtomicU64, Ordering};

/// Number of vertices of a simplex in the largest dimension.
const MAX_SIMPLEX_VERTICES: usize = crate::mesh::MAX_DIM + 1;

pub(crate) struct Delaunay<const D: usize> {
    complex: Complex<D>,
    /// Points by vertex id, inserted or not.
    points: Array<[f64; D]>,
    /// Simplex -> its D-ball. The entry of a dead simplex is stale. An infinite simplex has none.
    balls: Array<RoundedBall<D>>,
    /// Vertex -> the number of its last insertion, from 1 on; 0 if it never was inserted.
    turns: Array<u32>,
    last_turn: u32,
    exact_fallbacks: AtomicU64,
    simplices_created: u64,
}

impl<const D: usize> Delaunay<D> {
    /// Returns a complex without simplices over `points`, which get the ids from 0 on.
    pub fn new(points: Array<[f64; D]>) -> AllocResult<Self> {
        Ok(Self {
            complex: Complex::new(points.len())?,
            turns: Array::filled(points.len(), 0)?,
            last_turn: 0,
            points,
            balls: Array::new(),
            exact_fallbacks: AtomicU64::new(0),
            simplices_created: 0,
        })
    }

    /// Removes all points and simplices, but keeps their memory.
    pub fn clear(&mut self) {
        self.complex.clear();
        self.points.clear();
        self.turns.clear();
        self.last_turn = 0;
        self.balls.clear();
    }

    pub fn complex(&self) -> &Complex<D> {
        &self.complex
    }

    #[inline]
    pub fn point(&self, vertex: VertexId) -> &[f64; D] {
        &self.points[vertex]
    }

    /// Returns the number of points with an id, inserted or not.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    pub fn exact_fallbacks(&self) -> u64 {
        self.exact_fallbacks.load(Ordering::Relaxed)
    }

    /// Returns the number of simplices made so far, infinite ones and those destroyed again
    /// included.
    pub fn simplices_created(&self) -> u64 {
        self.simplices_created
    }

    /// Reserves memory for `simplices` simplices and `points` points, if the system grants it.
    pub fn expect(&mut self, simplices: usize, points: usize) {
        self.complex.expect(simplices, points);
        self.balls.expect(simplices);
        self.points.expect(points);
        self.turns.expect(points);
    }

    /// Adds a point without inserting it, and returns its id.
    pub fn add_point(&mut self, point: [f64; D]) -> AllocResult<VertexId> {
        self.points.try_push(point)?;
        self.turns.try_push(0)?;
        self.complex.add_vertex()
    }

    /// Sets the point of a vertex that is not inserted.
    pub fn set_point(&mut self, vertex: VertexId, point: [f64; D]) {
        debug_assert!(!self.complex.contains_vertex(vertex));
        self.points[vertex] = point;
    }

    /// Starts a search of a caller's: afterwards no simplex is marked.
    pub fn begin_marks(&mut self) -> AllocResult<()> {
        self.complex.begin_marks()
    }

    /// Marks a simplex as one that a search has reached.
    pub fn mark(&mut self, simplex: SimplexId) -> AllocResult<()> {
        self.complex.mark_inside(simplex)
    }

    /// Collects the simplices at a vertex: see [`Complex::star`].
    pub fn star(&mut self, vertex: VertexId, star: &mut Array<SimplexId>) -> AllocResult<()> {
        self.complex.star(vertex, star)
    }

    /// Returns true if a simplex at a vertex has all of some others: see [`Complex::star_has`].
    pub fn star_has(
        &mut self,
        vertex: VertexId,
        others: &[VertexId],
        star: &mut Array<SimplexId>,
    ) -> AllocResult<bool> {
        self.complex.star_has(vertex, others, star)
    }

    /// Starts the complex with D + 1 affinely independent points.
    pub fn begin(&mut self, first: &[VertexId]) -> AllocResult<()> {
        let mut ordered = [VertexId::NONE; MAX_SIMPLEX_VERTICES];
        let ordered = &mut ordered[..=D];
        ordered.copy_from_slice(first);
        let sign = orientation(&self.vertex_points(ordered)[..=D]);
        debug_assert!(sign != Sign::Zero, "the first simplex has a volume");
        if sign == Sign::Negative {
            ordered.swap(0, 1);
        }
        self.complex.begin(ordered)?;
        self.simplices_created += self.complex.simplex_count() as u64;
        self.cover_balls()?;
        for simplex in self.complex.simplices() {
            self.compute_ball(simplex);
        }
        first.iter().try_for_each(|&vertex| self.note_insertion(vertex))
    }

    /// Returns true if a live simplex is not infinite.
    #[inline]
    pub fn has_ball(&self, simplex: SimplexId) -> bool {
        self.balls[simplex].is_ball()
    }

    /// Returns the radius of the D-ball of a live simplex, or a little more, 2^-22 of itself at
    /// most. `None` if the simplex is infinite.
    #[inline(always)]
    pub fn radius(&self, simplex: SimplexId) -> Option<f64> {
        self.balls[simplex].radius()
    }

    /// Returns the D-ball of a live simplex in doubles, made anew. `None` if the simplex is
    /// infinite.
    pub fn circumball(&self, simplex: SimplexId) -> Option<Circumball<D>> {
        let vertices = self.complex.vertices(simplex);
        self.has_ball(simplex).then(|| Circumball::of(|i| self.point(vertices[i])))
    }

    /// Returns the D-ball of a live simplex as [`Self::circumball`] does, and its anchor.
    fn circumball_and_anchor(&self, simplex: SimplexId) -> Option<(Circumball<D>, &[f64; D])> {
        let ball = self.circumball(simplex)?;
        Some((ball, self.point(self.complex.vertices(simplex)[ball.anchor])))
    }

    /// Returns the corner of the Voronoi diagram dual to `simplex`, rounded; its coordinates are
    /// not finite if out of range. `None` for an infinite simplex.
    pub fn corner(&self, simplex: SimplexId) -> Option<[f64; D]> {
        let (ball, anchor) = self.circumball_and_anchor(simplex)?;
        Some(ball.center_point(anchor))
    }

    /// Returns the distance of the corner dual to `simplex` from `x`, or a little more, 2^-20 of
    /// the radius at most; NaN or infinite if out of range. `None` for an infinite simplex.
    pub fn corner_distance(&self, simplex: SimplexId, x: &[f64; D]) -> Option<f64> {
        let ball = self.balls[simplex].ball()?;
        let anchor = self.point(self.complex.vertices(simplex)[ball.anchor]);
        Some(ball.center_distance(anchor, x) + (D as f64).sqrt() * ball.error * ball.unit())
    }

    /// Returns true if `q` is in conflict with `simplex`: see [`Conflicts::test`].
    #[inline(always)]
    pub fn in_conflict(&self, simplex: SimplexId, q: &[f64; D]) -> bool {
        self.conflicts().test(self.complex.records(), simplex, q)
    }

    #[inline]
    fn conflicts(&self) -> Conflicts<'_, D> {
        let Self { points, balls, exact_fallbacks, .. } = self;
        Conflicts { points, balls, exact_fallbacks }
    }

    /// Returns the approximate power of `q` with respect to the D-ball of `simplex`: the lower, the
    /// further inside. Infinite or NaN for an infinite simplex and out of range. In doubles: near a
    /// vertex powers of single precision lead a walk astray.
    pub fn power(&self, simplex: SimplexId, q: &[f64; D]) -> f64 {
        match self.circumball_and_anchor(simplex) {
            Some((ball, anchor)) => ball.power(anchor, q),
            None => f64::INFINITY,
        }
    }

    /// Inserts the point `vertex`, whose conflicts are `cavity`; `created[i]` is the new simplex on
    /// `cavity.boundary[i]`. O(cavity). The complex is unusable after an error.
    pub fn insert(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
        created: &mut Vec<SimplexId>,
    ) -> AllocResult<()> {
        self.note_insertion(vertex)?;
        self.complex.reserve(cavity.boundary.len(), cavity.simplices.len())?;
        created.clear();
        reserve(created, cavity.boundary.len())?;
        self.complex.retriangulate(
            vertex,
            &cavity.simplices,
            &cavity.boundary,
            &cavity.vertices,
            created,
        )?;
        self.simplices_created += created.len() as u64;
        self.cover_balls()?;
        for pair in created.chunks(2) {
            self.compute_balls([pair[0], pair[pair.len() - 1]]);
        }
        Ok(())
    }

    /// Makes the array of D-balls as long as that of the simplices.
    fn cover_balls(&mut self) -> AllocResult<()> {
        self.balls.cover(self.complex.simplex_bound(), RoundedBall::NONE)
    }

    #[inline(always)]
    fn compute_balls(&mut self, [first, second]: [SimplexId; 2]) {
        let (a, b) = (self.complex.vertices(first), self.complex.vertices(second));
        let is_finite =
            |vertices: &[VertexId]| vertices.iter().all(|&v| v.index() < self.points.len());
        let pair = match is_finite(a) && is_finite(b) {
            true => RoundedBall::ordinary_pair(|i| self.point(a[i]), |i| self.point(b[i])),
            false => None,
        };
        match pair {
            Some(balls) => (self.balls[first], self.balls[second]) = balls.into(),
            None => [first, second].into_iter().for_each(|simplex| self.compute_ball(simplex)),
        }
    }

    #[inline(never)]
    fn compute_ball(&mut self, simplex: SimplexId) {
        let vertices = self.complex.vertices(simplex);
        self.balls[simplex] = match vertices.contains(&VertexId::INFINITE) {
            true => RoundedBall::NONE,
            false => RoundedBall::new(&Circumball::of(|i| self.point(vertices[i]))),
        };
    }

    /// Frees the memory of the D-balls, after which nothing can be inserted or located.
    pub fn forget_balls(&mut self) {
        self.balls = Array::new();
    }

    /// Forgets the simplices from `bound` on: see [`Complex::forget_from`].
    pub fn forget_from(&mut self, bound: SimplexId) {
        self.complex.forget_from(bound);
    }

    fn vertex_points(&self, vertices: &[VertexId]) -> [&[f64; D]; MAX_SIMPLEX_VERTICES] {
        self.conflicts().vertex_points(vertices)
    }
}
