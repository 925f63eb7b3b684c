//! The convex hull of points, which tells exactly how simplices lie with respect to it.

use super::placement::{Placement, Spot};
use super::solid::Solid;
use super::walk::Walk;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{AllocResult, filled};
use crate::mesh::{Triangulation, in_dimension};
use crate::query::check_arrays;

/// Convex hull of points, which tells exactly how simplices lie with respect to it.
pub struct ConvexHull {
    dim: usize,
    /// All extreme points and perhaps other points of the hull, `corners x dim`.
    corners: Vec<f64>,
    /// Triangulation of the hull; `None` if the points are in a hyperplane.
    solid: Option<Solid>,
}

impl ConvexHull {
    /// Returns the hull whose interior is the union of a Delaunay triangulation.
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together), `OutOfMemory`.
    pub fn of_triangulation(mesh: Triangulation) -> Result<Self> {
        let dim = mesh.dim;
        let solid = Solid::new(mesh)?;
        Ok(Self { dim, corners: solid.corners()?, solid: Some(solid) })
    }

    /// Returns the hull of points in a hyperplane, given by `points x dim` coordinates. It answers
    /// faster the fewer of the points are not extreme.
    pub fn of_flat_points(dim: usize, points: Vec<f64>) -> Self {
        Self { dim, corners: points, solid: None }
    }

    /// Returns all extreme points, and perhaps other points of the hull.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.corners.chunks_exact(self.dim)
    }

    /// Returns how each simplex of a mesh lies with respect to the hull. The union of the mesh must
    /// be convex, as that of a result is.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh of another dimension; arrays that do not fit together),
    /// `OutOfMemory`.
    pub fn placements(&self, mesh: &Triangulation, threads: u32) -> Result<Vec<Placement>> {
        check_arrays(mesh)?;
        if mesh.dim != self.dim {
            let rule = "the mesh and the hull are of different dimensions";
            return Err(Error::new(ErrorKind::InvalidArgument, rule));
        }
        let spots = match &self.solid {
            Some(solid) => solid.spots(mesh, threads)?,
            None => filled(mesh.vertex_count(), Spot::Outside)?,
        };
        let none = || Ok(Vec::new());
        Ok(in_dimension!(mesh.dim, D => self.place::<D>(mesh, &spots), _ => none())?)
    }

    fn place<const D: usize>(
        &self,
        mesh: &Triangulation,
        spots: &[Spot],
    ) -> AllocResult<Vec<Placement>> {
        let mut walk = Walk::<D>::new(mesh, spots, &self.corners, self.solid.is_some())?;
        walk.solid = self.solid.as_ref();
        walk.placements()
    }
}
