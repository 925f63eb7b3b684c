//! The convex hull of points, for exact questions.

use super::placement::{Placement, Spot};
use super::separation::Plane;
use super::walk::Walk;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{AllocResult, Lists, TryGrow, filled};
use crate::mesh::{NONE, Triangulation, in_dimension};
use crate::query::view::View;
use crate::query::{Index, Place, check_arrays};

/// The convex hull of points, for exact questions.
pub struct ConvexHull {
    dim: usize,
    /// `corners x dim`: all extreme points, and perhaps others of the hull.
    corners: Vec<f64>,
    /// Unless the points lie in a hyperplane.
    solid: Option<Solid>,
}

/// The Delaunay triangulation of the corners and perhaps of other points of the hull.
pub(super) struct Solid {
    mesh: Triangulation,
    index: Index,
    /// Vertex -> the simplices that have it on a facet of the hull.
    outer: Lists,
}

impl ConvexHull {
    /// The union of a Delaunay triangulation.
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together), `OutOfMemory`.
    pub fn of_triangulation(mesh: Triangulation) -> Result<Self> {
        let index = Index::new(&mesh)?;
        let solid = Solid { outer: outer_simplices(&mesh)?, mesh, index };
        let mut corners = Vec::new();
        for vertex in (0..solid.mesh.vertex_count() as u32).filter(|&v| solid.is_on_hull(v)) {
            corners.try_extend(solid.mesh.point(vertex))?;
        }
        Ok(Self { dim: solid.mesh.dim, corners, solid: Some(solid) })
    }

    /// The hull of points in a hyperplane, `points x dim`; the fewer that are not extreme, the
    /// faster.
    pub fn of_flat_points(dim: usize, points: Vec<f64>) -> Self {
        Self { dim, corners: points, solid: None }
    }

    /// Points of the hull, all extreme ones among them.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.corners.chunks_exact(self.dim)
    }

    /// Where each simplex lies. The union of the mesh must be convex, as that of a result is.
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
        let mut spots = filled(mesh.vertex_count(), Spot::Outside)?;
        if let Some(solid) = &self.solid {
            let mut places = filled(mesh.vertex_count(), Place::OUTSIDE)?;
            solid.index.places(&solid.mesh, &mesh.points, threads, &mut places)?;
            spots.iter_mut().zip(&places).for_each(|(spot, &place)| *spot = solid.spot(place));
        }
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

impl Solid {
    /// Where a point is of which its place is known.
    fn spot(&self, place: Place) -> Spot {
        let Some(dimension) = place.dimension() else { return Spot::Outside };
        let simplex = place.simplex as usize;
        let (vertices, dim) = (self.mesh.simplex(simplex), self.mesh.dim);
        let is_inner = match dimension as usize {
            whole if whole == dim => true,
            // A facet is on the hull just if it has one simplex.
            facet if facet + 1 == dim => {
                self.mesh.neighbors_of(simplex)[place.face.trailing_ones() as usize] != NONE
            }
            _ => (0..=dim).any(|i| place.face >> i & 1 == 1 && !self.is_on_hull(vertices[i])),
        };
        match dimension {
            _ if is_inner => Spot::Interior,
            0 => Spot::Corner(vertices[place.face.trailing_zeros() as usize]),
            _ => Spot::In,
        }
    }

    fn is_on_hull(&self, vertex: u32) -> bool {
        !self.outer.of(vertex as usize).is_empty()
    }

    /// The facets of the hull at a vertex.
    pub fn look_around<const D: usize>(
        &self,
        vertex: u32,
        around: &mut Around<D>,
    ) -> AllocResult<()> {
        if around.vertex == vertex {
            return Ok(());
        }
        let view = View::<D> { mesh: &self.mesh };
        around.vertex = vertex;
        around.facets.clear();
        around.neighbors.clear();
        for &simplex in self.outer.of(vertex as usize) {
            let (vertices, neighbors) = (view.simplex(simplex), view.neighbors(simplex));
            let points = view.points_of(vertices);
            for i in (0..=D).filter(|&i| neighbors[i] == NONE && vertices[i] != vertex) {
                around.facets.try_push(Plane::of_facet(&points[..=D], i).turned())?;
                let others = (0..=D).filter(|&k| k != i).map(|k| (vertices[k], *points[k]));
                { others }.try_for_each(|other| around.neighbors.try_push(other))?;
            }
        }
        Ok(())
    }
}

/// What a hull is like at a vertex.
pub(super) struct Around<const D: usize> {
    pub vertex: u32,
    /// The planes of the facets there, with the hull on their negative side.
    pub facets: Vec<Plane<D>>,
    /// Their vertices, that one among them, each as often as facets have it.
    pub neighbors: Vec<(u32, [f64; D])>,
}

impl<const D: usize> Default for Around<D> {
    fn default() -> Self {
        Self { vertex: NONE, facets: Vec::new(), neighbors: Vec::new() }
    }
}

/// Vertex -> the simplices that have it on a facet of the hull.
fn outer_simplices(mesh: &Triangulation) -> AllocResult<Lists> {
    let of_simplex = |simplex: usize| {
        let neighbors = mesh.neighbors_of(simplex);
        let is_outer = move |&(i, _): &(usize, &u32)| {
            neighbors.iter().enumerate().any(|(k, &neighbor)| k != i && neighbor == NONE)
        };
        let vertices = mesh.simplex(simplex).iter().enumerate().filter(is_outer);
        vertices.map(move |(_, &vertex)| (vertex, simplex as u32))
    };
    Lists::of_pairs(mesh.vertex_count(), || (0..mesh.simplex_count()).flat_map(of_simplex))
}
