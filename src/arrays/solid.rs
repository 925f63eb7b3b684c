//! The triangulation of a convex hull, which locates points and has the facets at each corner.

use super::placement::Spot;
use super::plane::Plane;
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, filled};
use crate::mesh::{NONE, Triangulation};
use crate::query::view::View;
use crate::query::{Index, Place};

/// Delaunay triangulation of the corners of a hull, and perhaps of other points of it.
pub(super) struct Solid {
    mesh: Triangulation,
    index: Index,
    /// Vertex -> the simplices that have it on a facet of the hull.
    outer: Lists,
}

impl Solid {
    /// Prepares a Delaunay triangulation, whose union is the hull.
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together), `OutOfMemory`.
    pub fn new(mesh: Triangulation) -> Result<Self> {
        let index = Index::new(&mesh)?;
        Ok(Self { outer: outer_simplices(&mesh)?, mesh, index })
    }

    /// Returns the coordinates of the vertices that are on the hull, one vertex after the other.
    pub fn corners(&self) -> AllocResult<Vec<f64>> {
        let mut corners = Vec::new();
        for vertex in (0..self.mesh.vertex_count() as u32).filter(|&v| self.is_on_hull(v)) {
            corners.try_extend(self.mesh.point(vertex))?;
        }
        Ok(corners)
    }

    /// Returns where the vertices of another mesh lie with respect to the hull.
    pub fn spots(&self, mesh: &Triangulation, threads: u32) -> Result<Vec<Spot>> {
        let mut places = filled(mesh.vertex_count(), Place::OUTSIDE)?;
        self.index.places(&self.mesh, &mesh.points, threads, &mut places)?;
        let mut spots = filled(places.len(), Spot::Outside)?;
        spots.iter_mut().zip(&places).for_each(|(spot, &place)| *spot = self.spot(place));
        Ok(spots)
    }

    /// Returns where a point lies with respect to the hull, given its place in the triangulation.
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
            _ => Spot::Contained,
        }
    }

    fn is_on_hull(&self, vertex: u32) -> bool {
        !self.outer.of(vertex as usize).is_empty()
    }

    /// Fills `at_corner` with the facets of the hull at a vertex, unless it has them already.
    pub fn look_around<const D: usize>(
        &self,
        vertex: u32,
        at_corner: &mut HullCorner<D>,
    ) -> AllocResult<()> {
        if at_corner.vertex == vertex {
            return Ok(());
        }
        let view = View::<D> { mesh: &self.mesh };
        at_corner.vertex = vertex;
        at_corner.facets.clear();
        at_corner.neighbors.clear();
        for &simplex in self.outer.of(vertex as usize) {
            let (vertices, neighbors) = (view.simplex(simplex), view.neighbors(simplex));
            let points = view.points_of(vertices);
            for i in (0..=D).filter(|&i| neighbors[i] == NONE && vertices[i] != vertex) {
                at_corner.facets.try_push(Plane::of_facet(&points[..=D], i).turned())?;
                let others = (0..=D).filter(|&k| k != i).map(|k| (vertices[k], *points[k]));
                { others }.try_for_each(|other| at_corner.neighbors.try_push(other))?;
            }
        }
        Ok(())
    }
}

/// Facets of a hull at one of its vertices.
pub(super) struct HullCorner<const D: usize> {
    pub vertex: u32,
    /// Planes of the facets, with the hull on their negative side.
    pub facets: Vec<Plane<D>>,
    /// Vertices of the facets with their coordinates, one entry for each facet that has them; the
    /// vertex itself is among them.
    pub neighbors: Vec<(u32, [f64; D])>,
}

impl<const D: usize> Default for HullCorner<D> {
    fn default() -> Self {
        Self { vertex: NONE, facets: Vec::new(), neighbors: Vec::new() }
    }
}

/// Returns for each vertex the simplices that have it on a facet of the hull.
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
