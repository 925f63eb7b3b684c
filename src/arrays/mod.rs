//! Arrays ready to use, made of a result's arrays: edges, facets, hull, the simplices and the
//! neighbours of each vertex, circumcentres, volumes, Voronoi cells, and where each simplex lies with
//! respect to the inputs.
//!
//! Each is made of a [`Part`]: the whole result ([`Part::whole`], or directly a function of
//! [`Mesh`]), or the simplices that a [`Selection`] picks. A part is a mesh of its own: its hull is
//! its boundary. Ids are those of the whole mesh all the same.
//!
//! | function | array | shape |
//! |---|---|---|
//! | [`Part::simplices`] | ids of the part's simplices, ascending | simplices |
//! | [`Part::edges`] | two vertices each, the less first; lexicographic order | edges x 2 |
//! | [`Part::facets`] | vertices, and the one or two simplices that have it | facets x dim, facets x 2 |
//! | [`Part::hull`] | facets of one simplex, oriented outwards, and that simplex | facets x dim, facets |
//! | [`Part::vertex_simplices`] | simplices of each vertex, ascending | a list a vertex |
//! | [`Part::vertex_neighbors`] | vertices round each vertex, ascending | a list a vertex |
//! | [`Part::circumcenters`] | circumcentres and radii | simplices x dim, simplices |
//! | [`Part::volumes`] | volumes | simplices |
//! | [`Part::regions`] | simplices whose circumcentres are the corners of each vertex's Voronoi cell | a list a vertex |
//! | [`Part::cells`] | which cells are bounded, their volumes | vertices |
//! | [`Part::ridges`] | facets of Voronoi cells | edges x 2, a list an edge |
//! | [`ConvexHull::placements`], [`placements_in_box`] | where each simplex lies | simplices |

mod circumcenters;
pub(crate) mod domains;
mod faces;
mod placement;
mod selection;
mod separation;
mod stars;
#[cfg(test)]
pub(crate) mod tests;
mod volumes;
mod voronoi;

pub use circumcenters::Circumcenters;
pub use faces::{Facets, Hull};
pub use placement::{ConvexHull, Placement, placements_in_box};
pub use selection::{Extent, Selection};
pub use stars::Lists;
pub use voronoi::{Cells, Ridges, Voronoi};

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Mesh, NONE, Triangulation};
use crate::query::check_arrays;

/// A result, or some of its simplices.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    mesh: &'a Triangulation,
    chosen: Option<Chosen>,
}

/// Simplices that are picked.
#[derive(Clone, Debug)]
struct Chosen {
    /// Ascending.
    ids: Vec<u32>,
    /// Simplex -> whether it is picked.
    is_chosen: Vec<bool>,
}

impl<'a> Part<'a> {
    /// All simplices.
    ///
    /// # Errors
    /// `InvalidArgument`: arrays that do not fit together, or ids out of range.
    pub fn whole(mesh: &'a Triangulation) -> Result<Self> {
        check_arrays(mesh)?;
        Ok(Self { mesh, chosen: None })
    }

    /// How many simplices there are.
    pub fn simplex_count(&self) -> usize {
        self.chosen.as_ref().map_or(self.mesh.simplex_count(), |chosen| chosen.ids.len())
    }

    /// The ids of the simplices, ascending.
    pub fn simplices(&self) -> impl ExactSizeIterator<Item = u32> + Clone + '_ {
        let chosen = self.chosen.as_ref();
        let id = move |at| chosen.map_or(at as u32, |chosen| chosen.ids[at]);
        (0..self.simplex_count()).map(id)
    }

    /// The neighbour across facet `i` of a simplex; [`NONE`] also if it is not in the part.
    fn neighbor(&self, simplex: u32, i: usize) -> u32 {
        let neighbor = self.mesh.neighbors_of(simplex as usize)[i];
        match &self.chosen {
            Some(chosen) if neighbor != NONE && !chosen.is_chosen[neighbor as usize] => NONE,
            _ => neighbor,
        }
    }
}

/// The arrays of the whole result. All fail with `State` before a run, with `OutOfMemory` where
/// memory is refused.
impl Mesh {
    /// The whole result.
    ///
    /// # Errors
    /// `State` before a run.
    pub fn whole(&self) -> Result<Part<'_>> {
        let error = || Error::new(ErrorKind::State, "the mesh has no result yet; run it first");
        Part::whole(self.triangulation().ok_or_else(error)?)
    }

    /// As [`Part::edges`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn edges(&self) -> Result<Vec<u32>> {
        self.whole()?.edges()
    }

    /// As [`Part::facets`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn facets(&self) -> Result<Facets> {
        self.whole()?.facets()
    }

    /// As [`Part::hull`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn hull(&self) -> Result<Hull> {
        self.whole()?.hull()
    }

    /// As [`Part::vertex_simplices`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn vertex_simplices(&self) -> Result<Lists> {
        self.whole()?.vertex_simplices()
    }

    /// As [`Part::vertex_neighbors`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn vertex_neighbors(&self) -> Result<Lists> {
        self.whole()?.vertex_neighbors()
    }

    /// As [`Part::circumcenters`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn circumcenters(&self) -> Result<Circumcenters> {
        self.whole()?.circumcenters()
    }

    /// As [`Part::volumes`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn volumes(&self) -> Result<Vec<f64>> {
        self.whole()?.volumes()
    }

    /// As [`Part::voronoi`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn voronoi(&self) -> Result<Voronoi> {
        self.whole()?.voronoi()
    }
}
