//! A [`Triangulation`] read with its dimension as a type.

use crate::mesh::{MAX_DIM, Triangulation};

#[derive(Clone, Copy)]
pub(crate) struct View<'a, const D: usize> {
    pub mesh: &'a Triangulation,
}

impl<'a, const D: usize> View<'a, D> {
    pub const VERTICES: usize = D + 1;

    pub fn point(self, vertex: u32) -> &'a [f64; D] {
        let start = vertex as usize * D;
        self.mesh.points[start..start + D].try_into().expect("D coordinates")
    }

    pub fn simplex(self, simplex: u32) -> &'a [u32] {
        &self.mesh.simplices[simplex as usize * Self::VERTICES..][..Self::VERTICES]
    }

    /// Returns the neighbours of a simplex, the i-th opposite vertex i.
    pub fn neighbors(self, simplex: u32) -> &'a [u32] {
        &self.mesh.neighbors[simplex as usize * Self::VERTICES..][..Self::VERTICES]
    }

    /// Returns the points of at most `D + 1` vertices; the rest of the array repeats the first.
    pub fn points_of(self, vertices: &[u32]) -> [&'a [f64; D]; MAX_DIM + 1] {
        let mut points = [self.point(vertices[0]); MAX_DIM + 1];
        for (point, &vertex) in points.iter_mut().zip(vertices) {
            *point = self.point(vertex);
        }
        points
    }
}
