//! The extents of Voronoi cells where vertices come and go one by one, in meshes without conflict
//! lists.

use crate::complex::{SimplexId, VertexId};
use crate::memory::AllocResult;
use crate::netmesh::state::{Cell, Mesher, State};
use crate::numerics::distance;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Measures the cells of those of `neighbors` whose nearest vertex may have been the one that
    /// has left `x`.
    pub(in crate::netmesh) fn note_departure(
        &mut self,
        x: &[f64; D],
        neighbors: &[VertexId],
    ) -> AllocResult<()> {
        for &neighbor in neighbors {
            let point = *self.state.delaunay.point(neighbor);
            if distance(x, &point) > self.state.cells[neighbor].nearest {
                continue;
            }
            let mut cell = Cell::NEW;
            self.state.delaunay.star(neighbor, &mut self.scratch.star)?;
            for &simplex in &self.scratch.star {
                for &other in self.state.delaunay.complex().vertices(simplex) {
                    if other.is_valid() && other != neighbor {
                        let other = self.state.delaunay.point(other);
                        cell.nearest = cell.nearest.min(distance(&point, other));
                    }
                }
                let radius = self.state.delaunay.radius(simplex).unwrap_or(0.0);
                cell.farthest = cell.farthest.max(radius);
            }
            self.state.cells[neighbor] = cell;
        }
        Ok(())
    }
}

impl<const D: usize> State<D> {
    /// Lets the cells of the vertices of `simplex`, which is new, reach as far as its corner.
    pub(in crate::netmesh) fn note_corner(&mut self, simplex: SimplexId) {
        let complex = self.delaunay.complex();
        let Some(radius) = self.delaunay.radius(simplex) else { return };
        if complex.is_live(simplex) {
            for &vertex in complex.vertices(simplex) {
                let cell = &mut self.cells[vertex];
                cell.farthest = cell.farthest.max(radius);
            }
        }
    }

    /// Updates the nearest distances of `vertex`, which went in among `neighbors`, and of those.
    pub(in crate::netmesh) fn note_arrival(&mut self, vertex: VertexId, neighbors: &[VertexId]) {
        let x = *self.delaunay.point(vertex);
        self.cells[vertex].nearest = f64::INFINITY;
        for &neighbor in neighbors {
            let distance = distance(&x, self.delaunay.point(neighbor));
            for vertex in [vertex, neighbor] {
                let cell = &mut self.cells[vertex];
                cell.nearest = cell.nearest.min(distance);
            }
        }
    }
}
