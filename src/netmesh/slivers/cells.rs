//! The bound of the Voronoi aspect in cells that a change would make.

use crate::complex::VertexId;
use crate::netmesh::slivers::cone::Cone;
use crate::netmesh::slivers::view::View;
use crate::netmesh::state::Cell;
use crate::numerics::{Circumball, distance};

impl Cone {
    /// Returns true if all cells that change would keep the bound of the Voronoi aspect with a
    /// vertex at `x`, or another criterion is in force. A vertex's nearest neighbour may be one
    /// that leaves: then the answer errs towards no.
    pub fn keeps_cells(&self, view: View<'_>, x: &[f64; 3]) -> bool {
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
