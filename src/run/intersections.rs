//! Intersections of the facets and segments of a mesh, found without a run.

use crate::arrangement::space::{count_duplicates, find_intersections, find_odd_edges};
use crate::error::{Error, Result, message};
use crate::mesh::{Diagnosis, Intersection, Mesh};

impl Mesh {
    /// Returns all pairs of facets and segments in space that meet in more than the vertices and
    /// edges that they share, sorted by the first feature and then by the second. Facets that meet
    /// themselves or have no area are among them. The test is exact. Without such a pair a run can
    /// keep the facets and segments.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space), `OutOfMemory`.
    pub fn intersections(&self) -> Result<Vec<Intersection>> {
        let dim = self.inputs().dim();
        if dim != 3 {
            let message = message!("the mesh has dimension {dim}; intersections are for 3D");
            return Err(Error::invalid(message));
        }
        find_intersections(self.inputs(), self.given_facets(), self.segments(), &mut |_| Ok(()))
    }

    /// Returns all that keeps the facets from being a closed surface to which a mesh can conform:
    /// the edges that are not between two facets, the pairs that meet in more than they share, the
    /// facets without an area and the triangles that are there twice. O(n log n) for n inputs of
    /// facets, and as for [`Mesh::intersections`].
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space), `OutOfMemory`.
    pub fn diagnosis(&self) -> Result<Diagnosis> {
        let intersections = self.intersections()?;
        let (inputs, facets) = (self.inputs(), self.given_facets());
        let edges = find_odd_edges(inputs, facets, &mut |_| Ok(()))?;
        Ok(Diagnosis { edges, intersections, duplicates: count_duplicates(inputs, facets)? })
    }
}
