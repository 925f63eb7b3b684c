//! What is round each vertex.

use super::Part;
use crate::error::Result;
use crate::memory::{AllocResult, Incidence, TryGrow, filled, with_capacity};
use crate::mesh::NONE;

/// A list of ids for each vertex, or for another thing: list `i` is
/// `ids[starts[i]..starts[i + 1]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists {
    /// One more than there are lists; the last is the length of `ids`.
    pub starts: Vec<usize>,
    pub ids: Vec<u32>,
}

impl Lists {
    /// No list yet, with a reserve for `lists` of them.
    pub(super) fn with_capacity(lists: usize) -> AllocResult<Self> {
        let mut starts = with_capacity(lists + 1)?;
        starts.push(0);
        Ok(Self { starts, ids: Vec::new() })
    }

    /// Ends the list that consists of the ids added since the last one ended.
    pub(super) fn end_list(&mut self) -> AllocResult<()> {
        self.starts.try_push(self.ids.len())
    }

    /// The number of lists.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn of(&self, at: usize) -> &[u32] {
        &self.ids[self.starts[at]..self.starts[at + 1]]
    }

    /// All lists in turn.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        (0..self.count()).map(|at| self.of(at))
    }
}

impl Part<'_> {
    /// For each vertex of the mesh the simplices that have it, ascending. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn vertex_simplices(&self) -> Result<Lists> {
        let (starts, ids) = self.stars()?.into_parts();
        Ok(Lists { starts, ids })
    }

    /// For each vertex of the mesh the vertices that have an edge with it, ascending.
    /// O(simplices + edges log edges).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn vertex_neighbors(&self) -> Result<Lists> {
        Ok(self.neighbors_from(|_| 0)?)
    }

    /// Vertex -> the part's simplices there, ascending.
    pub(super) fn stars(&self) -> AllocResult<Incidence> {
        let of_simplex = |simplex: u32| {
            let vertices = self.mesh.simplex(simplex as usize);
            vertices.iter().map(move |&vertex| (vertex, simplex))
        };
        Incidence::new(self.mesh.vertex_count(), || self.simplices().flat_map(of_simplex))
    }

    /// For each vertex its neighbours from `first` of it on, ascending.
    pub(super) fn neighbors_from(&self, first: impl Fn(u32) -> u32) -> AllocResult<Lists> {
        let stars = self.stars()?;
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
