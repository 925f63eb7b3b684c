//! Triangulations of the plane as arrays, whoever made them.

use super::interpolate::Values;
use crate::error::{Error, Result, message};
use crate::mesh::{NONE, check_finite};

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
        let (vertices, triangles) = (self.vertex_count(), self.count());
        let refuse = |message: String| Err(Error::invalid(message));
        let fits = self.points.len() == 2 * vertices
            && self.simplices.len() == 3 * triangles
            && self.neighbors.len() == self.simplices.len()
            && vertices < NONE as usize
            && triangles < NONE as usize;
        if !fits {
            return refuse(message!(
                "points, simplices and neighbors have lengths {}, {} and {}; they must be vertices \
                 x 2, triangles x 3 and triangles x 3",
                self.points.len(),
                self.simplices.len(),
                self.neighbors.len()
            ));
        }
        if let Some(at) = self.simplices.iter().position(|&v| v as usize >= vertices) {
            return refuse(message!(
                "simplices[{}] has the vertex {}; there are {vertices}",
                at / 3,
                self.simplices[at]
            ));
        }
        let is_outside = |&n: &u32| n as usize >= triangles && n != NONE;
        if let Some(at) = self.neighbors.iter().position(is_outside) {
            return refuse(message!(
                "neighbors[{}] has the triangle {}; there are {triangles}",
                at / 3,
                self.neighbors[at]
            ));
        }
        check_finite(2, self.points)?;
        if values.components == 0 {
            return refuse(message!("components is 0; it must be at least 1"));
        }
        values.check("values", vertices, "vertices")
    }
}
