//! Triangulations of the plane as arrays, whoever made them.

use super::interpolate::Values;
use crate::error::{Error, Result, message};
use crate::mesh::{NONE, check_finite};
use std::ops::Range;

/// Triangulation of the plane as arrays. It need be neither Delaunay nor convex.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<'a> {
    /// Coordinates of the vertices, `vertices x 2`.
    pub points: &'a [f64],
    /// Vertex ids, `triangles x 3`.
    pub simplices: &'a [u32],
    /// Triangle ids, `triangles x 3`, the i-th opposite vertex i; [`NONE`] at the boundary.
    pub neighbors: &'a [u32],
}

impl<'a> Triangles<'a> {
    pub(super) fn vertex_count(self) -> usize {
        self.points.len() / 2
    }

    pub(super) fn count(self) -> usize {
        self.simplices.len() / 3
    }

    pub(super) fn point(self, vertex: u32) -> &'a [f64; 2] {
        self.points[vertex as usize * 2..][..2].try_into().expect("two coordinates")
    }

    pub(super) fn vertices(self, triangle: u32) -> &'a [u32; 3] {
        self.simplices[triangle as usize * 3..][..3].try_into().expect("three vertices")
    }

    pub(super) fn neighbors_of(self, triangle: u32) -> &'a [u32; 3] {
        self.neighbors[triangle as usize * 3..][..3].try_into().expect("three neighbours")
    }

    /// Returns true if the edge opposite vertex `i` of a triangle is not one of a neighbour with a
    /// smaller id: then it is this triangle's to tell of it.
    pub(super) fn tells_edge(self, triangle: u32, i: usize) -> bool {
        let neighbor = self.neighbors_of(triangle)[i];
        neighbor == NONE || triangle < neighbor
    }

    /// Fails unless the arrays fit together, all ids are in range, all coordinates finite, and
    /// there are values for each vertex.
    pub(super) fn check(self, values: Values<'_>) -> Result<()> {
        self.check_lengths(values)?;
        self.check_vertices(0..self.simplices.len())?;
        self.check_neighbors(0..self.neighbors.len())?;
        check_finite(2, self.points)
    }

    /// Fails as [`Self::check`] does, but for what concerns neither the asked triangles, whose ids
    /// are in range or [`NONE`], nor their neighbours: to look at all takes longer than a few
    /// answers.
    pub(super) fn check_around(self, values: Values<'_>, asked: &[u32]) -> Result<()> {
        if asked.len() >= self.count() / 4 {
            return self.check(values);
        }
        self.check_lengths(values)?;
        for &triangle in asked.iter().filter(|&&triangle| triangle != NONE) {
            self.check_corners(triangle)?;
            let at = 3 * triangle as usize;
            self.check_neighbors(at..at + 3)?;
            let neighbors = self.neighbors_of(triangle).iter();
            neighbors.filter(|&&n| n != NONE).try_for_each(|&n| self.check_corners(n))?;
        }
        Ok(())
    }

    fn check_corners(self, triangle: u32) -> Result<()> {
        let at = 3 * triangle as usize;
        self.check_vertices(at..at + 3)?;
        let corners = self.vertices(triangle).iter().flat_map(|&vertex| self.point(vertex));
        // What looks at all tells which one it is.
        if corners.copied().all(f64::is_finite) { Ok(()) } else { check_finite(2, self.points) }
    }

    fn check_lengths(self, values: Values<'_>) -> Result<()> {
        let (vertices, triangles) = (self.vertex_count(), self.count());
        let fits = self.points.len() == 2 * vertices
            && self.simplices.len() == 3 * triangles
            && self.neighbors.len() == self.simplices.len()
            && vertices < NONE as usize
            && triangles < NONE as usize;
        if !fits {
            return Err(Error::invalid(message!(
                "points, simplices and neighbors have lengths {}, {} and {}; they must be vertices \
                 x 2, triangles x 3 and triangles x 3",
                self.points.len(),
                self.simplices.len(),
                self.neighbors.len()
            )));
        }
        if values.components == 0 {
            return Err(Error::invalid(message!("components is 0; it must be at least 1")));
        }
        values.check("values", vertices, "vertices")
    }

    /// Fails unless the vertices of triangles, from some place to another, are in range.
    fn check_vertices(self, mut places: Range<usize>) -> Result<()> {
        let vertices = self.vertex_count();
        let is_outside = |&at: &usize| self.simplices[at] as usize >= vertices;
        places.find(is_outside).map_or(Ok(()), |at| {
            Err(Error::invalid(message!(
                "simplices[{}] has the vertex {}; there are {vertices}",
                at / 3,
                self.simplices[at]
            )))
        })
    }

    /// Fails unless the neighbours of triangles, from some place to another, are in range.
    fn check_neighbors(self, mut places: Range<usize>) -> Result<()> {
        let triangles = self.count();
        let is_outside = |&at: &usize| {
            let neighbor = self.neighbors[at];
            neighbor as usize >= triangles && neighbor != NONE
        };
        places.find(is_outside).map_or(Ok(()), |at| {
            Err(Error::invalid(message!(
                "neighbors[{}] has the triangle {}; there are {triangles}",
                at / 3,
                self.neighbors[at]
            )))
        })
    }
}
