//! Arrays ready to use, made of a result's arrays: edges, facets, hull, the simplices and the
//! neighbours of each vertex, circumcentres, volumes, Voronoi cells, and where each simplex lies
//! with respect to the inputs.
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
mod cloud;
mod convex_hull;
pub(crate) mod domains;
mod faces;
mod groups;
mod part;
mod placement;
mod selection;
mod separation;
mod stars;
#[cfg(test)]
pub(crate) mod tests;
mod volumes;
mod voronoi;
mod walk;

pub use circumcenters::Circumcenters;
pub use convex_hull::ConvexHull;
pub use faces::{Facets, Hull};
pub use groups::{Arrays, Group};
pub use part::Part;
pub use placement::{Placement, placements_in_box};
pub use selection::{Extent, Selection};
pub use voronoi::{Cells, Ridges, Voronoi};

use crate::error::Result;
pub use crate::memory::Lists;
use crate::mesh::Mesh;

/// The arrays of the whole result. All fail with `State` before a run, with `OutOfMemory` where
/// memory is refused.
impl Mesh {
    /// The whole result.
    ///
    /// # Errors
    /// `State` before a run.
    pub fn whole(&self) -> Result<Part<'_>> {
        Part::whole(self.result()?)
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
