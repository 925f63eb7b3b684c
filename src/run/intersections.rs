//! Intersections of the facets and segments of a mesh and faults of edges, found without a run.

use crate::arrangement::space::{count_duplicates, find_intersections, find_odd_edges};
use crate::error::{Error, Result, message};
use crate::mesh::{Diagnosis, Intersection, Mesh, OddEdge};

impl Mesh {
    /// Returns all pairs of facets and segments in space that meet in more than the vertices and
    /// edges that they share, sorted by the first feature and then by the second. Facets that meet
    /// themselves or have no area are among them. The test is exact. Without such a pair a run can
    /// keep the facets and segments.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space), `OutOfMemory`.
    pub fn intersections(&self) -> Result<Vec<Intersection>> {
        self.require_space("intersections")?;
        find_intersections(self.inputs(), self.given_facets(), self.segments(), &mut |_| Ok(()))
    }

    /// Returns the edges of facets in space that are not one of two facets which run through them
    /// in opposite directions, sorted. Triangles without an area have no edges. Without such an
    /// edge the facets are closed surfaces, oriented alike. O(n log n) for n inputs of facets.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space), `OutOfMemory`.
    pub fn odd_edges(&self) -> Result<Vec<OddEdge>> {
        self.require_space("edges of facets")?;
        find_odd_edges(self.inputs(), self.given_facets(), &mut |_| Ok(()))
    }

    /// Returns all that keeps the facets from being a closed surface to which a mesh can conform:
    /// the edges that are not between two facets, the pairs that meet in more than they share, the
    /// facets without an area and the facets that are there twice. O(n log n) for n inputs of
    /// facets, and as for [`Mesh::intersections`].
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space), `OutOfMemory`.
    pub fn diagnosis(&self) -> Result<Diagnosis> {
        let intersections = self.intersections()?;
        let duplicates = count_duplicates(self.inputs(), self.given_facets())?;
        Ok(Diagnosis { edges: self.odd_edges()?, intersections, duplicates })
    }

    fn require_space(&self, what: &str) -> Result<()> {
        match self.inputs().dim() {
            3 => Ok(()),
            dim => {
                let message = message!("the mesh has dimension {dim}; {what} are for 3D");
                Err(Error::invalid(message))
            }
        }
    }
}
