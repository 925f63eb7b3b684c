//! Triangles of the plane that share edges. What is outside of the hull is triangles as well, with
//! a vertex at infinity: each edge of the hull has one.

use crate::error::Result;
use crate::memory::{TryGrow, with_capacity};

/// The vertex at infinity.
pub(super) const INFINITE: u32 = u32::MAX;

/// An edge of a triangle: three times its triangle, and which of the three it is. Edge `i` runs
/// from corner `i` to the next.
pub(super) type Edge = u32;

/// Corners counterclockwise, and for each edge the edge of the other triangle there.
#[derive(Clone, Copy)]
pub(super) struct Triangle {
    pub corners: [u32; 3],
    pub twins: [Edge; 3],
}

pub(super) struct Triangles {
    triangles: Vec<Triangle>,
}

/// Returns the edge after one of a triangle.
#[inline]
pub(super) fn next(edge: Edge) -> Edge {
    if edge % 3 == 2 { edge - 2 } else { edge + 1 }
}

/// Returns the edge before one of a triangle.
#[inline]
pub(super) fn previous(edge: Edge) -> Edge {
    if edge % 3 == 0 { edge + 2 } else { edge - 1 }
}

/// Returns true if one of the corners is at infinity.
#[inline]
pub(super) fn is_infinite(corners: &[u32; 3]) -> bool {
    corners[0] == INFINITE || corners[1] == INFINITE || corners[2] == INFINITE
}

impl Triangles {
    /// Makes a triangle of corners that run counterclockwise, with room for `vertices`.
    pub fn new([a, b, c]: [u32; 3], vertices: usize) -> Result<Self> {
        // As many as there are edges on a sphere with one vertex more, less a third.
        let mut triangles = with_capacity(2 * vertices)?;
        triangles.push(Triangle { corners: [a, b, c], twins: [3, 6, 9] });
        // Beyond each edge lies one that ends at infinity; they follow each other clockwise.
        triangles.push(Triangle { corners: [b, a, INFINITE], twins: [0, 11, 7] });
        triangles.push(Triangle { corners: [c, b, INFINITE], twins: [1, 5, 10] });
        triangles.push(Triangle { corners: [a, c, INFINITE], twins: [2, 8, 4] });
        Ok(Self { triangles })
    }

    pub fn count(&self) -> usize {
        self.triangles.len()
    }

    pub fn all(&self) -> &[Triangle] {
        &self.triangles
    }

    #[inline]
    pub fn triangle(&self, edge: Edge) -> &Triangle {
        &self.triangles[(edge / 3) as usize]
    }

    #[inline]
    pub fn corners(&self, triangle: u32) -> &[u32; 3] {
        &self.triangles[triangle as usize].corners
    }

    #[inline]
    pub fn twin(&self, edge: Edge) -> Edge {
        self.triangle(edge).twins[(edge % 3) as usize]
    }

    #[inline]
    pub fn is_infinite(&self, triangle: u32) -> bool {
        is_infinite(self.corners(triangle))
    }

    /// Makes two edges the sides of one.
    #[inline]
    fn join(&mut self, edge: Edge, other: Edge) {
        self.triangles[(edge / 3) as usize].twins[(edge % 3) as usize] = other;
        self.triangles[(other / 3) as usize].twins[(other % 3) as usize] = edge;
    }

    /// Splits a triangle at a vertex in it. Returns the first edges of the three parts, which are
    /// the old triangle's; the vertex is the last corner of each.
    pub fn split(&mut self, triangle: u32, vertex: u32) -> Result<[Edge; 3]> {
        let Triangle { corners: [a, b, c], twins: [ab, bc, ca] } =
            self.triangles[triangle as usize];
        let first = 3 * triangle;
        let second = 3 * self.triangles.len() as u32;
        let third = second + 3;
        let part = |corners, outer, inner: [Edge; 2]| Triangle {
            corners,
            twins: [outer, inner[0], inner[1]],
        };
        self.triangles[triangle as usize] = part([a, b, vertex], ab, [second + 2, third + 1]);
        self.triangles.try_push(part([b, c, vertex], bc, [third + 2, first + 1]))?;
        self.triangles.try_push(part([c, a, vertex], ca, [first + 2, second + 1]))?;
        self.join(second, bc);
        self.join(third, ca);
        Ok([first, second, third])
    }

    /// Flips the first edge of a triangle whose last corner is a new vertex. Returns the first
    /// edges of the two triangles that the vertex then has there, again its last corner.
    pub fn flip(&mut self, edge: Edge) -> [Edge; 2] {
        debug_assert_eq!(edge % 3, 0);
        let Triangle { corners: [from, to, vertex], twins: [other, to_vertex, _] } =
            *self.triangle(edge);
        let (after, before) = (next(other), previous(other));
        let (after_twin, before_twin) = (self.twin(after), self.twin(before));
        let beyond = self.triangle(other).corners[(before % 3) as usize];
        let (own, taken) = ((edge / 3) as usize, (other / 3) as usize);
        let second = 3 * (other / 3);
        let Triangle { corners, twins } = &mut self.triangles[own];
        *corners = [from, beyond, vertex];
        twins[1] = second + 2;
        self.triangles[taken] =
            Triangle { corners: [beyond, to, vertex], twins: [before_twin, to_vertex, edge + 1] };
        self.join(edge, after_twin);
        self.join(second, before_twin);
        self.join(second + 1, to_vertex);
        [edge, second]
    }
}
