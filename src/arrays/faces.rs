//! Edges, facets and the hull.

use super::Part;
use crate::error::Result;
use crate::memory::{TryGrow, with_capacity};
use crate::mesh::NONE;

/// Facets with the simplices that have them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facets {
    /// `facets x dim` vertex ids. They are oriented as on the boundary of the first simplex: its
    /// opposite vertex before them makes a positively oriented simplex. So they go counterclockwise
    /// round that simplex in 2D, and counterclockwise for who looks at it from outside in 3D.
    pub vertices: Vec<u32>,
    /// `facets x 2` simplex ids, the less first; the second is [`NONE`] if there is only one.
    pub simplices: Vec<u32>,
}

/// The facets that only one simplex has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hull {
    /// `facets x dim` vertex ids, oriented outwards: counterclockwise in 2D, counterclockwise seen
    /// from outside in 3D; in any dimension a point inside before them makes a positively oriented
    /// simplex.
    pub vertices: Vec<u32>,
    /// The simplex of each facet.
    pub simplices: Vec<u32>,
}

impl Part<'_> {
    /// `edges x 2` vertex ids, the less first; the edges in lexicographic order.
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

    /// The facets, ordered by their first simplex and within that by the opposite vertex's place.
    /// O(simplices).
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

    /// The facets on the hull: the boundary of the part. In the order of [`Part::facets`].
    /// O(simplices).
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

    /// Calls `act` with each simplex, the place of each vertex of it, and the neighbour there.
    fn each_facet(&self, mut act: impl FnMut(u32, usize, u32) -> Result<()>) -> Result<()> {
        for simplex in self.simplices() {
            (0..=self.mesh.dim).try_for_each(|i| act(simplex, i, self.neighbor(simplex, i)))?;
        }
        Ok(())
    }

    /// Appends the vertices of facet `i` of a simplex, oriented outwards.
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
