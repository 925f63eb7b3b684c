//! Voronoi cells under changes: the bound of their aspect holds after each, and what is known of
//! them stays true.

use super::View;
use super::cone::{Cone, Side};
use crate::complex::{SimplexId, VertexId};
use crate::memory::AllocResult;
use crate::netmesh::{Cell, Mesher};
use crate::numerics::{Circumball, distance};

impl Cone {
    /// Whether all cells that have changed would keep the bound of the Voronoi aspect with a vertex
    /// at `x`, if that is the criterion. A vertex's nearest neighbour may be one that leaves: then
    /// the answer errs towards no.
    pub fn keeps_cells<const D: usize>(&self, view: View<'_, D>, x: &[f64; D]) -> bool {
        let Some(half_aspect) = view.measure.half_aspect else { return true };
        let from_x = |vertex: VertexId| distance(x, view.delaunay.point(vertex));
        let mut nearest = f64::INFINITY;
        for side in &self.sides {
            for vertex in side.base() {
                let distance = from_x(vertex);
                nearest = nearest.min(distance);
                let Cell { nearest: before, farthest } = view.cells[vertex];
                let is_worse = distance < before && farthest > half_aspect * distance;
                if is_worse && !view.hierarchy.cage_of(vertex).is_valid() {
                    return false;
                }
            }
        }
        self.sides.iter().all(|side| {
            let point = |index| {
                if index == side.apex { x } else { view.delaunay.point(side.vertices[index]) }
            };
            let radius = Circumball::of(point).radius();
            radius <= half_aspect * nearest
                && side.base().all(|vertex| {
                    let nearest = view.cells[vertex].nearest.min(from_x(vertex));
                    radius <= half_aspect * nearest || view.hierarchy.cage_of(vertex).is_valid()
                })
        })
    }
}

impl Side {
    /// The vertices of the facet.
    fn base(&self) -> impl Iterator<Item = VertexId> {
        let apex = self.apex;
        self.vertices.into_iter().enumerate().filter(move |&(at, _)| at != apex).map(|(_, v)| v)
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// After a vertex has left `x`: the cells of `neighbors` that it was the nearest of.
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
                let radius = self.state.delaunay.ball(simplex).map_or(0.0, Circumball::radius);
                cell.farthest = cell.farthest.max(radius);
            }
            self.state.cells[neighbor] = cell;
        }
        Ok(())
    }

    /// After `simplex` came.
    pub(in crate::netmesh) fn note_corner(&mut self, simplex: SimplexId) {
        let complex = self.state.delaunay.complex();
        let Some(ball) = self.state.delaunay.ball(simplex) else { return };
        if complex.is_live(simplex) {
            let radius = ball.radius();
            for &vertex in complex.vertices(simplex) {
                let cell = &mut self.state.cells[vertex];
                cell.farthest = cell.farthest.max(radius);
            }
        }
    }

    /// After `vertex` went in among `neighbors`.
    pub(super) fn note_arrival(&mut self, vertex: VertexId, neighbors: &[VertexId]) {
        let x = *self.state.delaunay.point(vertex);
        self.state.cells[vertex].nearest = f64::INFINITY;
        for &neighbor in neighbors {
            let distance = distance(&x, self.state.delaunay.point(neighbor));
            for vertex in [vertex, neighbor] {
                let cell = &mut self.state.cells[vertex];
                cell.nearest = cell.nearest.min(distance);
            }
        }
    }
}
