//! Polygons that a mesh was given as triangles, without a run.

use crate::arrangement::space::{bent_polygon, triangulate};
use crate::error::{Error, Result, message};
use crate::memory::collected;
use crate::mesh::{FacetTriangulation, Facets, Mesh};

impl Mesh {
    /// Replaces the polygons that the mesh was given in space by triangles between their inputs,
    /// with the markers of their polygons: for polygons that are not plane, which a run refuses.
    /// The view of each polygon along an axis decides which triangles it becomes: that of its plane
    /// or, if it has none, the first in which it does not meet itself, beginning with that in which
    /// it is largest. Triangles in one
    /// plane are one facet of the mesh again, as of any surface. A polygon without an area becomes
    /// one triangle without one, for a run to refuse or leave out. Returns the number of polygons;
    /// 0 if triangles were given, or no facets. The result of an earlier run stays as it is. O(n
    /// log n) for n inputs of the polygons.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space; a polygon that has segments within, or meets
    /// itself: if it is not plane, along each axis), `Capacity`, `OutOfMemory`.
    pub fn triangulate_facets(&mut self) -> Result<usize> {
        let given = self.given_facets();
        if given.are_triangles || given.count() == 0 {
            self.check_in_space()?;
            return Ok(0);
        }
        let polygons = given.count();
        self.split_facets()?;
        Ok(polygons)
    }

    /// Replaces the facets by the triangles that they consist of, as [`Mesh::triangulate_facets`]
    /// does, and returns these, with the facet that each is of.
    ///
    /// # Errors
    /// Fails as [`Mesh::triangulate_facets`] does.
    pub fn split_facets(&mut self) -> Result<FacetTriangulation> {
        let (found, given) = (self.facet_triangulation()?, self.given_facets());
        let markers = found.parents.iter().map(|&parent| given.markers[parent as usize]);
        let (corners, markers) = (found.triangles.as_flattened(), collected(markers)?);
        let facets = Facets::of_triangles(self.inputs(), corners, Some(&markers))?;
        self.replace_facets(facets);
        Ok(found)
    }

    /// Returns the triangles that the facets consist of, as [`Mesh::triangulate_facets`] makes
    /// them, which stay as they are. O(n log n) for n inputs of the facets.
    ///
    /// # Errors
    /// Fails as [`Mesh::triangulate_facets`] does.
    pub fn facet_triangulation(&self) -> Result<FacetTriangulation> {
        self.check_in_space()?;
        triangulate(self.inputs(), self.given_facets(), &mut |_| Ok(()))
    }

    /// Returns the first of the polygons given in space that a run with so many degrees of
    /// [`Options::coplanar`] refuses since it is not plane; `None` if there is none, or triangles
    /// were given. O(n log n) for n inputs of the polygons.
    ///
    /// [`Options::coplanar`]: crate::options::Options::coplanar
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space), `OutOfMemory`.
    pub fn bent_polygon(&self, coplanar: f64) -> Result<Option<u32>> {
        self.check_in_space()?;
        match self.given_facets().are_triangles {
            true => Ok(None),
            false => bent_polygon(self.inputs(), self.given_facets(), coplanar, &mut |_| Ok(())),
        }
    }

    fn check_in_space(&self) -> Result<()> {
        match self.inputs().dim() {
            3 => Ok(()),
            dim => Err(Error::invalid(message!(
                "the mesh has dimension {dim}; polygons of facets are for 3D"
            ))),
        }
    }
}
