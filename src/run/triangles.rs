//! Polygons that a mesh was given as triangles, without a run.

use crate::arrangement::space::triangulate;
use crate::error::Result;
use crate::mesh::{Facets, Mesh};

impl Mesh {
    /// Replaces the polygons that the mesh was given in space by triangles between their inputs,
    /// with the markers of their polygons: for polygons that are not plane, which a run refuses.
    /// The view of each polygon along an axis decides which triangles it becomes. Triangles in one
    /// plane are one facet of the mesh again, as of any surface. Returns the number of polygons; 0
    /// if triangles were given, or no facets. The result of an earlier run stays as it is. O(n log
    /// n) for n inputs of the polygons.
    ///
    /// # Errors
    /// `InvalidArgument` (a polygon that meets itself, has no area or has segments within),
    /// `Capacity`, `OutOfMemory`.
    pub fn triangulate_facets(&mut self) -> Result<usize> {
        let given = self.given_facets();
        let polygons = given.count();
        if given.are_triangles || polygons == 0 {
            return Ok(0);
        }
        let found = triangulate(self.inputs(), given, &mut |_| Ok(()))?;
        let corners = found.triangles.as_flattened();
        let facets = Facets::of_triangles(self.inputs(), corners, Some(&found.markers))?;
        self.replace_facets(facets);
        Ok(polygons)
    }
}
