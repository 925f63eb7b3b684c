//! The hole that a vertex leaves when it is removed, and the simplices that fill it.

use super::{Complex, Facet, SimplexId, VertexId};
use crate::memory::{AllocResult, Array, TryGrow};

/// Neighbour of a simplex of the filling across one of its facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Beside {
    /// Another simplex of the filling, by its number.
    Filling(u32),
    /// Facet of the hole's boundary, by its number.
    Boundary(u32),
}

/// Simplices that fill a hole, oriented as those of the complex.
#[derive(Default)]
pub(crate) struct Filling<const D: usize> {
    vertices: Array<VertexId>,
    beside: Vec<Beside>,
}

impl<const D: usize> Filling<D> {
    const VERTICES: usize = D + 1;

    pub fn clear(&mut self) {
        self.vertices.clear();
        self.beside.clear();
    }

    /// Returns the number of simplices.
    pub fn len(&self) -> usize {
        self.vertices.len() / Self::VERTICES
    }

    /// Adds a simplex and returns its number. Its neighbours are set afterwards.
    pub fn push(&mut self, vertices: &[VertexId]) -> AllocResult<u32> {
        let number = self.len();
        self.vertices.try_extend(vertices)?;
        self.beside.cover((number + 1) * Self::VERTICES, Beside::Boundary(u32::MAX))?;
        Ok(number as u32)
    }

    pub fn vertices(&self, number: u32) -> &[VertexId] {
        &self.vertices[number as usize * Self::VERTICES..][..Self::VERTICES]
    }

    /// Returns the neighbours of a simplex opposite each of its vertices.
    pub fn beside(&self, number: u32) -> &[Beside] {
        &self.beside[number as usize * Self::VERTICES..][..Self::VERTICES]
    }

    pub fn join(&mut self, number: u32, index: u32, beside: Beside) {
        self.beside[number as usize * Self::VERTICES + index as usize] = beside;
    }
}

impl<const D: usize> Complex<D> {
    /// Replaces `star`, all simplices at `vertex`, by `filling`, for which memory is reserved.
    /// `boundary` has the facets round the star; `created[i]` becomes simplex number i of the
    /// filling. The vertex is not in the complex afterwards.
    pub fn fill(
        &mut self,
        vertex: VertexId,
        star: &[SimplexId],
        boundary: &[Facet],
        filling: &Filling<D>,
        created: &mut Vec<SimplexId>,
    ) {
        created.clear();
        created.extend((0..filling.len()).map(|_| self.allocate()));
        for (number, &simplex) in (0..).zip(created.iter()) {
            self.vertices_mut(simplex).copy_from_slice(filling.vertices(number));
            for (index, &beside) in filling.beside(number).iter().enumerate() {
                let neighbor = match beside {
                    Beside::Filling(other) => created[other as usize],
                    Beside::Boundary(at) => {
                        let facet = boundary[at as usize];
                        self.neighbors_mut(facet.beyond)[facet.mirror as usize] = simplex;
                        facet.beyond
                    }
                };
                self.neighbors_mut(simplex)[index] = neighbor;
            }
        }
        self.touch_vertices(created);
        self.incident[vertex] = SimplexId::NONE;
        for &simplex in star {
            self.release(simplex);
        }
    }
}
