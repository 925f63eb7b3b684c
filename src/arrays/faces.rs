//! Edges, facets and the hull.

use super::Part;
use crate::error::Result;
use crate::memory::{TryGrow, with_capacity};
use crate::mesh::NONE;

/// Facets, and the simplices that have them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facets {
    /// Vertex ids, `facets x dim`. Facets are oriented as on the boundary of their first simplex:
    /// the opposite vertex followed by the facet is a positively oriented simplex. So a facet goes
    /// counterclockwise round its first simplex in 2D, and counterclockwise seen from outside that
    /// simplex in 3D.
    pub vertices: Vec<u32>,
    /// Simplex ids, `facets x 2`, the smaller first; the second is [`NONE`] if there is only one.
    pub simplices: Vec<u32>,
}

/// Facets that only one simplex has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hull {
    /// Vertex ids, `facets x dim`. Facets are oriented outwards: counterclockwise in 2D, and
    /// counterclockwise seen from outside in 3D. In any dimension a point inside followed by the
    /// facet is a positively oriented simplex.
    pub vertices: Vec<u32>,
    /// Id of the simplex that has each facet.
    pub simplices: Vec<u32>,
}

impl Part<'_> {
    /// Returns the edges as `edges x 2` vertex ids, the smaller first, in lexicographic order.
    /// O(simplices + edges log edges).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn edges(&self) -> Result<Vec<u32>> {
        let above = self.neighbors_from(|vertex| vertex)?;
        let mut edges = with_capacity(2 * above.ids.len())?;
        for (vertex, others) in above.iter().enumerate() {
            edges.extend(others.iter().flat_map(|&other| [vertex as u32, other]));
        }
        Ok(edges)
    }

    /// Returns the facets, ordered by their first simplex, and within it by the position of the
    /// opposite vertex. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn facets(&self) -> Result<Facets> {
        let mut facets = Facets { vertices: Vec::new(), simplices: Vec::new() };
        self.each_facet(|simplex, i, neighbor| {
            if neighbor < simplex {
                return Ok(());
            }
            facets.simplices.try_extend(&[simplex, neighbor])?;
            self.add_facet(simplex, i, &mut facets.vertices)
        })?;
        Ok(facets)
    }

    /// Returns the facets on the hull, which is the boundary of the part, in the order of
    /// [`Part::facets`]. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn hull(&self) -> Result<Hull> {
        let mut hull = Hull { vertices: Vec::new(), simplices: Vec::new() };
        self.each_facet(|simplex, i, neighbor| {
            if neighbor != NONE {
                return Ok(());
            }
            hull.simplices.try_push(simplex)?;
            self.add_facet(simplex, i, &mut hull.vertices)
        })?;
        Ok(hull)
    }

    /// Calls `act` with each simplex, the position of each of its vertices, and the neighbour
    /// across the facet opposite that vertex.
    fn each_facet(&self, mut act: impl FnMut(u32, usize, u32) -> Result<()>) -> Result<()> {
        for simplex in self.simplices() {
            (0..=self.mesh.dim).try_for_each(|i| act(simplex, i, self.neighbor(simplex, i)))?;
        }
        Ok(())
    }

    /// Appends the vertices of the facet opposite vertex `i` of a simplex, oriented outwards.
    fn add_facet(&self, simplex: u32, i: usize, vertices: &mut Vec<u32>) -> Result<()> {
        let of_simplex = self.mesh.simplex(simplex as usize);
        let start = vertices.len();
        vertices.try_extend(&of_simplex[..i])?;
        vertices.try_extend(&of_simplex[i + 1..])?;
        // The opposite vertex passes `i` others on its way to the front.
        if i % 2 == 1 {
            vertices.swap(start, start + 1);
        }
        Ok(())
    }
}
