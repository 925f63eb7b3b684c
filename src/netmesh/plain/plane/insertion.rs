//! A point goes into a triangulation of the plane: a walk finds its triangle, which it splits, and
//! edges flip until every circle is empty.

use super::super::ties::counts_as_inside;
use super::signs::Signs;
use super::triangles::{Edge, INFINITE, Triangles, is_infinite, next, previous};
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::Stats;
use crate::numerics::Sign;

/// A triangulation in the making: no circle through the corners of a triangle has a vertex in it.
pub(super) struct Plain<'a> {
    points: &'a [[f64; 2]],
    pub triangles: Triangles,
    signs: Signs,
    /// A triangle of the last vertex, where the next walk begins.
    last: u32,
    /// First edges of triangles that may have to flip.
    doubtful: Vec<Edge>,
    steps: u64,
    most_steps: u64,
}

impl<'a> Plain<'a> {
    /// Begins with a triangle, counterclockwise.
    pub fn new(points: &'a [[f64; 2]], first: [u32; 3]) -> Result<Self> {
        Ok(Self {
            points,
            triangles: Triangles::new(first, points.len())?,
            signs: Signs::new(points),
            last: 0,
            doubtful: Vec::new(),
            steps: 0,
            most_steps: 0,
        })
    }

    /// Inserts a point.
    pub fn insert(&mut self, vertex: u32) -> Result<()> {
        let found = self.locate(vertex);
        let parts = self.triangles.split(found, vertex)?;
        self.doubtful.clear();
        self.doubtful.try_extend(&parts)?;
        while let Some(edge) = self.doubtful.pop() {
            let other = self.triangles.twin(edge);
            if self.is_in_conflict(other, vertex) {
                self.doubtful.try_extend(&self.triangles.flip(edge))?;
            }
        }
        self.last = found;
        Ok(())
    }

    /// Returns the triangle that a point is in, or the infinite one whose edge it is strictly
    /// beyond. A walk in a Delaunay triangulation never comes back (Edelsbrunner 1990).
    fn locate(&mut self, vertex: u32) -> u32 {
        let mut steps = 1;
        let mut triangle = self.last;
        if self.triangles.is_infinite(triangle) {
            // The one on the other side of the edge of the hull.
            let corners = self.triangles.corners(triangle);
            let infinite = corners.iter().position(|&c| c == INFINITE).expect("one is") as u32;
            triangle = self.triangles.twin(next(3 * triangle + infinite)) / 3;
        }
        let mut beyond = (3 * triangle..3 * triangle + 3).find(|&e| self.is_beyond(e, vertex));
        while let Some(edge) = beyond {
            let other = self.triangles.twin(edge);
            triangle = other / 3;
            steps += 1;
            if self.triangles.is_infinite(triangle) {
                break;
            }
            // Not the edge that the walk has come through.
            beyond = match (next(other), previous(other)) {
                (after, _) if self.is_beyond(after, vertex) => Some(after),
                (_, before) if self.is_beyond(before, vertex) => Some(before),
                _ => None,
            };
        }
        self.steps += steps;
        self.most_steps = self.most_steps.max(steps);
        triangle
    }

    /// Returns true if a point is strictly on the right of an edge between finite vertices.
    #[inline]
    fn is_beyond(&mut self, edge: Edge, vertex: u32) -> bool {
        let corners = &self.triangles.triangle(edge).corners;
        let from = corners[(edge % 3) as usize] as usize;
        let to = corners[(next(edge) % 3) as usize] as usize;
        let points = self.points;
        self.signs.turn(&points[from], &points[to], &points[vertex as usize]) == Sign::Negative
    }

    /// Returns true if a point is inside the circle of the triangle of an edge. On the circle it
    /// counts as inside or not by [`counts_as_inside`]. For an infinite triangle, returns true if
    /// the point is strictly beyond its edge of the hull, or on the line and between.
    #[inline]
    fn is_in_conflict(&mut self, edge: Edge, vertex: u32) -> bool {
        let corners = self.triangles.triangle(edge).corners;
        if is_infinite(&corners) {
            return self.is_beyond_hull(corners, vertex);
        }
        let points = self.points;
        let [a, b, c] = corners;
        let circle = [&points[a as usize], &points[b as usize], &points[c as usize]];
        match self.signs.in_circle(circle, &points[vertex as usize]) {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => counts_as_inside(&corners, vertex, |place| {
                let at = |corner: usize| &points[corners[corner % 3] as usize];
                self.signs.turn(&points[vertex as usize], at(place + 1), at(place + 2))
            }),
        }
    }

    fn is_beyond_hull(&mut self, corners: [u32; 3], vertex: u32) -> bool {
        let infinite = corners.iter().position(|&corner| corner == INFINITE).expect("one is");
        let points = self.points;
        let [from, to] = [1, 2].map(|after| &points[corners[(infinite + after) % 3] as usize]);
        let point = &points[vertex as usize];
        match self.signs.turn(from, to, point) {
            Sign::Positive => true,
            Sign::Negative => false,
            // Of three points on a line one is between if it is so along some axis.
            Sign::Zero => (0..2).any(|axis| {
                let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
                low < point[axis] && point[axis] < high
            }),
        }
    }

    /// Adds what the insertions have taken.
    pub fn count_into(&self, stats: &mut Stats) {
        stats.touches = self.steps;
        stats.max_touches = self.most_steps;
        stats.exact_fallbacks = self.signs.fallbacks;
        stats.simplices_created = self.triangles.count() as u64;
    }
}
