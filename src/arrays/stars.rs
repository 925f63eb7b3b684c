//! The simplices and the neighbours of each vertex.

use super::Part;
use crate::error::Result;
use crate::memory::{Lists, TryGrow, filled};
use crate::mesh::NONE;

impl Part<'_> {
    /// Returns for each vertex of the mesh the simplices that have it, ascending. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn vertex_simplices(&self) -> Result<Lists> {
        let of_simplex = |simplex: u32| {
            let vertices = self.mesh.simplex(simplex as usize);
            vertices.iter().map(move |&vertex| (vertex, simplex))
        };
        let pairs = || self.simplices().flat_map(of_simplex);
        Ok(Lists::of_pairs(self.mesh.vertex_count(), pairs)?)
    }

    /// Returns for each vertex of the mesh the vertices that have an edge with it, ascending.
    /// O(simplices + edges log edges).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn vertex_neighbors(&self) -> Result<Lists> {
        self.neighbors_from(|_| 0)
    }

    /// Returns for each vertex its neighbours with numbers of at least `first(vertex)`, ascending.
    pub(super) fn neighbors_from(&self, first: impl Fn(u32) -> u32) -> Result<Lists> {
        let stars = self.vertex_simplices()?;
        let count = self.mesh.vertex_count();
        let mut seen_from = filled(count, NONE)?;
        let mut lists = Lists::with_capacity(count)?;
        for vertex in 0..count as u32 {
            // So that it is not its own neighbour.
            seen_from[vertex as usize] = vertex;
            let start = lists.ids.len();
            for &simplex in stars.of(vertex as usize) {
                for &other in self.mesh.simplex(simplex as usize) {
                    if seen_from[other as usize] != vertex && other >= first(vertex) {
                        seen_from[other as usize] = vertex;
                        lists.ids.try_push(other)?;
                    }
                }
            }
            lists.ids[start..].sort_unstable();
            lists.end_list()?;
        }
        Ok(lists)
    }
}
