//! A [`Triangulation`] read with its dimension as a type.

use crate::memory::{AllocResult, Lists, filled};
use crate::mesh::{MAX_DIM, NONE, Triangulation};

#[derive(Clone, Copy)]
pub(crate) struct View<'a, const D: usize> {
    pub mesh: &'a Triangulation,
}

impl<'a, const D: usize> View<'a, D> {
    pub const VERTICES: usize = D + 1;

    pub fn vertex_count(self) -> usize {
        self.mesh.kinds.len()
    }

    pub fn simplex_count(self) -> usize {
        self.mesh.simplices.len() / Self::VERTICES
    }

    pub fn point(self, vertex: u32) -> &'a [f64; D] {
        let start = vertex as usize * D;
        self.mesh.points[start..start + D].try_into().expect("D coordinates")
    }

    /// Returns the `D + 1` vertices of a simplex.
    pub fn simplex(self, simplex: usize) -> &'a [u32] {
        &self.mesh.simplices[simplex * Self::VERTICES..][..Self::VERTICES]
    }

    /// Returns the `D + 1` neighbours of a simplex, the i-th opposite vertex i.
    pub fn neighbors(self, simplex: usize) -> &'a [u32] {
        &self.mesh.neighbors[simplex * Self::VERTICES..][..Self::VERTICES]
    }

    /// Returns the points of `vertices` (at most `D + 1`); the rest of the array repeats the first.
    pub fn points_of(self, vertices: &[u32]) -> [&'a [f64; D]; MAX_DIM + 1] {
        let mut points = [self.point(vertices[0]); MAX_DIM + 1];
        for (point, &vertex) in points.iter_mut().zip(vertices) {
            *point = self.point(vertex);
        }
        points
    }

    /// Returns for each vertex the simplices at it, ascending. O(simplices).
    pub fn stars(self) -> AllocResult<Lists> {
        self.stars_of(|_| true)
    }

    /// Returns for each vertex that `is_wanted` the simplices at it, ascending. O(simplices).
    pub fn stars_of(self, is_wanted: impl Fn(u32) -> bool) -> AllocResult<Lists> {
        Lists::of_pairs(self.vertex_count(), || {
            let slots = self.mesh.simplices.iter().enumerate();
            let slots = slots.filter(|&(_, &vertex)| is_wanted(vertex));
            slots.map(|(index, &vertex)| (vertex, (index / Self::VERTICES) as u32))
        })
    }

    /// Returns for each vertex whether it is on the hull.
    pub fn hull_vertices(self) -> AllocResult<Vec<bool>> {
        let mut on_hull = filled(self.vertex_count(), false)?;
        self.for_each_at_hull(|vertex| on_hull[vertex as usize] = true);
        Ok(on_hull)
    }

    /// Returns for each vertex the number of facets of the hull at it.
    pub fn hull_facets(self) -> AllocResult<Vec<u32>> {
        let mut facets = filled(self.vertex_count(), 0)?;
        self.for_each_at_hull(|vertex| facets[vertex as usize] += 1);
        Ok(facets)
    }

    /// Calls `visit` with the vertices of each facet of the hull.
    fn for_each_at_hull(self, mut visit: impl FnMut(u32)) {
        for s in 0..self.simplex_count() {
            let (vertices, neighbors) = (self.simplex(s), self.neighbors(s));
            if !neighbors.contains(&NONE) {
                continue;
            }
            for i in (0..Self::VERTICES).filter(|&i| neighbors[i] == NONE) {
                for (_, &v) in vertices.iter().enumerate().filter(|&(j, _)| j != i) {
                    visit(v);
                }
            }
        }
    }
}
