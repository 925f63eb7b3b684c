//! Location of a point that is in no conflict list (a cage vertex), by a visibility walk with exact
//! signs from a simplex nearby. It is slow from far away.

use super::{Delaunay, MAX_SIMPLEX_VERTICES};
use crate::complex::{SimplexId, VertexId};
use crate::memory::{AllocResult, TryGrow};
use crate::numerics::{Sign, orientation};

impl<const D: usize> Delaunay<D> {
    /// Returns a simplex in conflict with `q`, by a walk from the live simplex `start`. `None` iff
    /// `q` is a vertex already, or outside the partition that this complex is. A visibility walk in
    /// a Delaunay triangulation cannot cycle except among cospherical simplices; a bound of its
    /// steps and a scan of all simplices cover those.
    pub fn locate(&self, start: SimplexId, q: &[f64; D]) -> Option<SimplexId> {
        self.locate_and_count(start, q, &mut 0)
    }

    /// Returns the result of [`Self::locate`], and adds the number of D-balls that `q` was tested
    /// against to `tests`.
    pub fn locate_and_count(
        &self,
        start: SimplexId,
        q: &[f64; D],
        tests: &mut u32,
    ) -> Option<SimplexId> {
        if let Some(found) = self.walk_to_conflict(start, q, tests) {
            return Some(found);
        }
        self.complex
            .simplices()
            .filter(|&simplex| self.complex.is_live(simplex))
            .inspect(|_| *tests += 1)
            .find(|&simplex| self.in_conflict(simplex, q))
    }

    /// Returns a simplex in conflict with `q` if a walk from the live simplex `start` reaches one.
    /// In a partition the walk may end at the interface, with such a simplex behind a bend of it.
    pub fn walk_to_conflict(
        &self,
        start: SimplexId,
        q: &[f64; D],
        tests: &mut u32,
    ) -> Option<SimplexId> {
        let mut current = self.finite_near(start);
        for _ in 0..self.complex.simplex_count() {
            *tests += 1;
            if self.in_conflict(current, q) {
                return Some(current);
            }
            match self.step_towards(current, q) {
                Some(next) if next == current => break,
                Some(next) if !self.has_ball(next) => return Some(next),
                Some(next) => current = next,
                None => break,
            }
        }
        None
    }

    /// Returns the finite simplex whose closure contains `q`, by a walk from the live simplex
    /// `start` nearby; `None` if `q` is outside the hull.
    pub fn simplex_at(&self, start: SimplexId, q: &[f64; D]) -> Option<SimplexId> {
        let mut current = self.finite_near(start);
        for _ in 0..self.complex.simplex_count() {
            match self.step_towards(current, q) {
                None => return Some(current),
                Some(next) if next == current || self.complex.is_infinite(next) => return None,
                Some(next) => current = next,
            }
        }
        None
    }

    /// Returns the simplex with the smallest id of those whose closures contain `q`, which must be
    /// in the hull. The result does not depend on `start`.
    pub fn first_simplex_at(
        &self,
        start: SimplexId,
        q: &[f64; D],
    ) -> AllocResult<Option<SimplexId>> {
        let is_at = |&simplex: &SimplexId| {
            let is_finite = self.complex.is_live(simplex) && !self.complex.is_infinite(simplex);
            is_finite && self.step_towards(simplex, q).is_none()
        };
        let found = self.simplex_at(start, q).or_else(|| self.complex.simplices().find(is_at));
        let Some(found) = found else { return Ok(None) };
        // Mostly `q` is in its interior, and the loop ends at once.
        let mut all = Vec::new();
        all.try_push(found)?;
        let mut next = 0;
        while next < all.len() {
            let simplex = all[next];
            next += 1;
            for index in 0..=D {
                let beyond = self.complex.neighbors(simplex)[index];
                if self.is_on_facet(simplex, index, q) && !all.contains(&beyond) && is_at(&beyond) {
                    all.try_push(beyond)?;
                }
            }
        }
        Ok(all.into_iter().min())
    }

    /// Returns true if `q` is on the hyperplane of the facet of `simplex` opposite its vertex
    /// number `index`.
    fn is_on_facet(&self, simplex: SimplexId, index: usize, q: &[f64; D]) -> bool {
        let mut points: [&[f64; D]; MAX_SIMPLEX_VERTICES] =
            self.vertex_points(self.complex.vertices(simplex));
        points[index] = q;
        orientation(&points[..=D]) == Sign::Zero
    }

    /// Returns the vertex at `q`, by a walk from the live simplex `start` nearby; `None` if there
    /// is none.
    pub fn vertex_at(&self, start: SimplexId, q: &[f64; D]) -> Option<VertexId> {
        let vertices = self.complex.vertices(self.simplex_at(start, q)?);
        vertices.iter().copied().find(|&vertex| self.point(vertex) == q)
    }

    /// Returns `start` if it is finite, else its finite neighbour.
    pub fn finite_near(&self, start: SimplexId) -> SimplexId {
        match self.complex.vertices(start).iter().position(|&v| v == VertexId::INFINITE) {
            Some(infinite) => self.complex.neighbors(start)[infinite],
            None => start,
        }
    }

    /// Returns the neighbour across a facet that has `q` strictly on its other side; `None` if `q`
    /// is in the closure of `simplex`.
    fn step_towards(&self, simplex: SimplexId, q: &[f64; D]) -> Option<SimplexId> {
        let vertices = self.complex.vertices(simplex);
        let mut points: [&[f64; D]; MAX_SIMPLEX_VERTICES] = self.vertex_points(vertices);
        for index in 0..=D {
            let kept = std::mem::replace(&mut points[index], q);
            if orientation(&points[..=D]) == Sign::Negative {
                return Some(self.complex.neighbors(simplex)[index]);
            }
            points[index] = kept;
        }
        None
    }
}
