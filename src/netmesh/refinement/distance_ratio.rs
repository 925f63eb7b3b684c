//! Refinement by the distance to the inputs (the epsilon-refinement of B. Hudson, G. L. Miller,
//! S. Y. Oudot and D. R. Sheehy, "Topological Inference via Meshing", 2010): a cell reaches no
//! farther than a given part of its vertex's distance from the nearest input. Cells that have the
//! same nearest input everywhere may be larger, those of inputs among them: the filtration of a
//! mesh follows the distance exactly in them (docs/topology.md). Else no such mesh would end, for a
//! cell beside that of an input reaches at least half as far as the input is.
//!
//! It ends: a cell that is refined holds a point x with two nearest inputs p and q, so that f, the
//! distance from the nearest input, is at least |p - q| / 2 there. The new vertex, a corner, is at
//! the cell's out-radius R > ratio f(v) from all others, and f(v) >= f(x) - R. So R is at least
//! ratio / (1 + ratio) |p - q| / 2.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, collected};
use crate::nearest::{Tree, nearest};
use crate::netmesh::state::hierarchy::ROOT;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::distance;

/// Relative error that rounding may add to the distance of a corner.
const SLACK: f64 = 1e-11;

/// Distances from the inputs, with which the out-radii of cells are compared.
struct Distances {
    inputs: Tree,
    ratio: f64,
    /// Balls of this radius round all inputs have a point in common; cells that are farther away
    /// do not matter.
    end: f64,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines until each cell keeps the ratio that the caller asked for, and the bound. Cells only
    /// shrink, so each vertex is looked at once, those that come meanwhile in their turn.
    pub(in crate::netmesh) fn refine_by_distance(&mut self, cavity: &mut Cavity) -> Result<()> {
        if self.state.parameters.distance_ratio == 0.0 {
            return Ok(());
        }
        let distances = self.state.distances()?;
        let mut vertex = self.state.inputs;
        while vertex < self.state.delaunay.point_count() {
            self.watch.poll_after(1)?;
            match self.far_corner(VertexId::new(vertex), &distances)? {
                Some(simplex) => {
                    self.insert_corner(simplex, cavity)?;
                    self.clean(cavity)?;
                }
                None => {
                    vertex += 1;
                    self.note_progress();
                }
            }
        }
        self.report_progress()
    }

    /// Returns the simplex with the farthest corner, of those well inside the root's cage, of a
    /// cell that is to be refined.
    fn far_corner(
        &mut self,
        vertex: VertexId,
        distances: &Distances,
    ) -> AllocResult<Option<SimplexId>> {
        if !self.state.is_inserted(vertex) {
            return Ok(None);
        }
        let (input, distance) = nearest(&distances.inputs, self.state.delaunay.point(vertex));
        let allowed = distances.ratio * distance;
        // No point of the cell is nearer to an input than half the distance.
        if self.state.cells[vertex].farthest <= allowed || distance >= 2.0 * distances.end {
            return Ok(None);
        }
        self.state.delaunay.star(vertex, &mut self.scratch.star)?;
        let max_distance =
            self.state.parameters.corner_restriction() * self.state.sphere_radius(ROOT);
        let mut farthest = (allowed, None);
        for &simplex in self.scratch.star.iter() {
            // The cells of the hull are unbounded.
            let Some(radius) = self.state.delaunay.radius(simplex) else { return Ok(None) };
            let is_inside = |corner: [f64; D]| {
                self.state.hierarchy.distance_to_center(ROOT, &corner) <= max_distance
            };
            // Doubles may be too coarse for one corner and not for the next.
            if radius > farthest.0
                && !self.state.refine_list.is_limited(simplex)
                && self.state.delaunay.corner(simplex).is_some_and(is_inside)
            {
                farthest = (radius, Some(simplex));
            }
        }
        let (reach, simplex) = farthest;
        let is_refined = distance - reach < distances.end
            && !self.is_in_group(VertexId::new(input as usize), distances);
        Ok(simplex.filter(|_| is_refined))
    }

    /// Returns true if `input` is the nearest input of all corners in the scratch star, and so of
    /// the whole cell.
    fn is_in_group(&self, input: VertexId, distances: &Distances) -> bool {
        let input = self.state.delaunay.point(input);
        self.scratch.star.iter().all(|&simplex| {
            self.state.delaunay.corner(simplex).is_some_and(|corner| {
                let (_, least) = nearest(&distances.inputs, &corner);
                distance(&corner, input) <= least * (1.0 + SLACK)
            })
        })
    }
}

impl<const D: usize> State<D> {
    fn distances(&self) -> AllocResult<Distances> {
        let inputs = (0..self.inputs).map(VertexId::new);
        let points = collected(inputs.flat_map(|input| *self.delaunay.point(input)))?;
        let parameters = &self.parameters;
        Ok(Distances {
            inputs: Tree::of_all::<D>(&points)?,
            ratio: parameters.distance_ratio,
            end: self.hierarchy.node(ROOT).radius / parameters.root_scale,
        })
    }
}
