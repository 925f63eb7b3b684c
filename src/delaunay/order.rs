//! The choice among the Delaunay complexes of cospherical points, by the order of insertion.
//!
//! A point on a D-ball's sphere does not conflict with it. So every insertion lifts its point by an
//! infinitesimal that is larger than all before it, in the sense of Edelsbrunner and Mücke,
//! "Simulation of Simplicity" (1990): a point on the sphere then counts as outside. The complex is
//! the regular triangulation of the lifted points, which is unique. So the order of insertion alone
//! decides each simplex of it, for a removal as well.

use super::conflict::Conflicts;
use super::{Delaunay, MAX_SIMPLEX_VERTICES};
use crate::complex::VertexId;
use crate::memory::{AllocError, AllocResult};
use crate::numerics::{Sign, in_ball_with_care, orientation};
use std::sync::atomic::Ordering;

impl<const D: usize> Delaunay<D> {
    /// Records that `vertex` is the last one that was inserted.
    pub(super) fn note_insertion(&mut self, vertex: VertexId) -> AllocResult<()> {
        let turn = self.last_turn.checked_add(1).ok_or(AllocError::Ids)?;
        self.last_turn = turn;
        self.turns[vertex] = turn;
        Ok(())
    }

    /// Returns a key that sorts vertices by their insertion. Vertices of different partitions may
    /// have the same turn: their order does not matter, for no cavity has two of them.
    pub(super) fn turn(&self, vertex: VertexId) -> (u32, VertexId) {
        (self.turns[vertex], vertex)
    }

    /// Returns true if `vertex` is inside the sphere of a positively oriented simplex, by exact
    /// signs. For a vertex on the sphere: if it is inside after all points are lifted.
    #[cold]
    #[inline(never)]
    pub(super) fn is_inside_with_care(&self, simplex: &[VertexId], vertex: VertexId) -> bool {
        let conflicts: Conflicts<'_, D> = self.conflicts();
        conflicts.exact_fallbacks.fetch_add(1, Ordering::Relaxed);
        let points = conflicts.vertex_points(simplex);
        match in_ball_with_care(&points[..=D], self.point(vertex)) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => self.is_inside_by_order(simplex, vertex),
        }
    }

    /// Returns true if a vertex on the sphere of a simplex is inside after all points are lifted.
    /// The point inserted last decides if it can: lifting `vertex` puts it outside; lifting a
    /// vertex of the simplex lifts the sphere's hyperplane at `vertex` by the barycentric
    /// coordinate.
    fn is_inside_by_order(&self, simplex: &[VertexId], vertex: VertexId) -> bool {
        let mut order: [usize; MAX_SIMPLEX_VERTICES] = std::array::from_fn(|index| index);
        let order = &mut order[..=D];
        order.sort_unstable_by_key(|&index| std::cmp::Reverse(self.turn(simplex[index])));
        let mut points = self.vertex_points(simplex);
        for &index in order.iter() {
            if self.turn(simplex[index]) < self.turn(vertex) {
                return false;
            }
            let kept = std::mem::replace(&mut points[index], self.point(vertex));
            match orientation(&points[..=D]) {
                Sign::Positive => return true,
                Sign::Negative => return false,
                Sign::Zero => points[index] = kept,
            }
        }
        false
    }
}
