//! Arrays derived from those of a result, ready to use: edges, facets, hull, the simplices and the
//! neighbours of each vertex, circumcentres, volumes, Voronoi cells, and how each simplex lies with
//! respect to the inputs.
//!
//! Each is made of a [`Part`]: the whole result ([`Part::whole`], or directly a function of
//! [`Mesh`]), or the simplices that a [`Selection`] picks. A part is a mesh of its own: its hull is
//! its boundary. But its ids are those of the whole mesh.
//!
//! | function | array | shape |
//! |---|---|---|
//! | [`Part::simplices`] | ids of the part's simplices, ascending | simplices |
//! | [`Part::edges`] | two vertices, the smaller first; lexicographic order | edges x 2 |
//! | [`Part::facets`] | vertices, and the one or two simplices | facets x dim, facets x 2 |
//! | [`Part::hull`] | facets of one simplex, oriented outwards, and it | facets x dim, facets |
//! | [`Part::vertex_simplices`] | simplices of each vertex, ascending | a list a vertex |
//! | [`Part::vertex_neighbors`] | vertices round each vertex, ascending | a list a vertex |
//! | [`Part::circumcenters`] | circumcentres and radii | simplices x dim, simplices |
//! | [`Part::volumes`] | volumes | simplices |
//! | [`Part::regions`] | simplices at the corners of each Voronoi cell | a list a vertex |
//! | [`Part::cells`] | which cells are bounded, their volumes | vertices |
//! | [`Part::ridges`] | facets of Voronoi cells | edges x 2, a list an edge |
//! | [`ConvexHull::placements`], [`placements_in_box`] | how simplices lie | simplices |

mod bounding_box;
mod circumcenters;
mod cloud;
mod convex_hull;
pub(crate) mod domains;
mod faces;
mod groups;
mod part;
mod placement;
mod plane;
mod selection;
mod separation;
mod solid;
mod stars;
#[cfg(test)]
pub(crate) mod tests;
mod volumes;
mod voronoi;
mod walk;

pub use bounding_box::placements_in_box;
pub use circumcenters::Circumcenters;
pub(crate) use circumcenters::center_within;
pub use convex_hull::ConvexHull;
pub use faces::{Facets, Hull};
pub use groups::{Arrays, Group};
pub use part::Part;
pub use placement::Placement;
pub use selection::{Selection, SelectionExtent};
pub use voronoi::{Cells, Ridges, Voronoi};

use crate::error::Result;
pub use crate::memory::Lists;
use crate::mesh::Mesh;

/// Arrays of the whole result. All fail with `State` before a run, and with `OutOfMemory` if memory
/// is refused.
impl Mesh {
    /// Returns the whole result as a part, from which all arrays are made.
    ///
    /// # Errors
    /// `State` before a run.
    pub fn whole(&self) -> Result<Part<'_>> {
        Part::whole(self.result()?)
    }

    /// Returns the edges of the mesh: see [`Part::edges`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn edges(&self) -> Result<Vec<u32>> {
        self.whole()?.edges()
    }

    /// Returns the facets of the mesh and their simplices: see [`Part::facets`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn facets(&self) -> Result<Facets> {
        self.whole()?.facets()
    }

    /// Returns the facets on the hull of the mesh and their simplices: see [`Part::hull`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn hull(&self) -> Result<Hull> {
        self.whole()?.hull()
    }

    /// Returns the simplices at each vertex: see [`Part::vertex_simplices`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn vertex_simplices(&self) -> Result<Lists> {
        self.whole()?.vertex_simplices()
    }

    /// Returns the vertices that have an edge with each vertex: see [`Part::vertex_neighbors`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn vertex_neighbors(&self) -> Result<Lists> {
        self.whole()?.vertex_neighbors()
    }

    /// Returns the circumcentres and circumradii of the simplices: see [`Part::circumcenters`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn circumcenters(&self) -> Result<Circumcenters> {
        self.whole()?.circumcenters()
    }

    /// Returns the volumes of the simplices: see [`Part::volumes`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn volumes(&self) -> Result<Vec<f64>> {
        self.whole()?.volumes()
    }

    /// Returns the Voronoi diagram of the vertices: see [`Part::voronoi`].
    ///
    /// # Errors
    /// `State`, `OutOfMemory`.
    pub fn voronoi(&self) -> Result<Voronoi> {
        self.whole()?.voronoi()
    }
}
