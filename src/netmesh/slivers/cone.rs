//! The tetrahedra that a point would make: the cone over the boundary of its cavity.

use super::View;
use super::shape::{corners, in_space};
use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow};

/// A tetrahedron whose vertex number `apex` is the point.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub vertices: [VertexId; 4],
    pub apex: usize,
}

#[derive(Default)]
pub(super) struct Cone {
    pub sides: Vec<Side>,
}

impl Cone {
    /// Adds the tetrahedron over the facet opposite the vertex number `apex` of `vertices`.
    #[inline]
    pub fn push(&mut self, vertices: &[VertexId], apex: usize) -> AllocResult<()> {
        let vertices = std::array::from_fn(|index| vertices[index]);
        self.sides.try_push(Side { vertices, apex })
    }

    /// `gain` less what the cone of `x` adds to the objective, if that is more than `least`.
    #[inline]
    pub fn judge<const D: usize>(
        &self,
        view: View<'_, D>,
        x: &[f64; D],
        gain: f64,
        least: f64,
    ) -> Option<f64> {
        let x = in_space(x);
        let mut gain = gain;
        for side in &self.sides {
            if gain <= least {
                return None;
            }
            let mut corners = corners(view.delaunay, &side.vertices);
            corners[side.apex] = x;
            gain -= view.measure.penalty(&corners);
        }
        (gain > least).then_some(gain)
    }
}
