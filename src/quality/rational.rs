//! Exact solutions of small linear systems, for simplices whose doubles are too ill-conditioned:
//! Cramer's rule on the coordinates as integers.

use super::corner::Gradients;
use super::length::{Offset, exponent_of, scale};
use crate::mesh::MAX_DIM;
use crate::numerics::{Column, Edges};

/// Edges `p_i - p_base` of a simplex as integers.
pub(crate) struct IntegerEdges<const D: usize>(Edges<D>);

impl<const D: usize> IntegerEdges<D> {
    /// `points`: `D + 1` points; the edge of `base` to itself is left out.
    pub fn new(points: &[&[f64; D]], base: usize) -> Self {
        let others = points.iter().enumerate().filter(|(i, _)| *i != base).map(|(_, p)| *p);
        Self(Edges::new(points[base], others))
    }

    /// The circumcentre relative to the base point; `None` if the simplex is flat.
    pub fn circumcenter(&self) -> Option<Offset<D>> {
        // The products of the edges with twice the centre are their squares.
        Some(aligned(&self.0.solve(Column::Square)?, self.0.unit - 1))
    }

    /// The gradients of the barycentric coordinates of the vertices other than the base, then that
    /// of the base, their negated sum; `None` if the simplex is flat.
    pub fn gradients(&self) -> Option<Gradients<D>> {
        let solution = |right| Some(aligned(&self.0.solve(right)?, -self.0.unit));
        let mut gradients = [Offset::ZERO; MAX_DIM + 1];
        for (i, gradient) in gradients[..D].iter_mut().enumerate() {
            *gradient = solution(Column::Unit(i))?;
        }
        let sum = solution(Column::Ones)?;
        gradients[D] = Offset { vector: sum.vector.map(|x| -x), exponent: sum.exponent };
        Some(gradients)
    }
}

fn aligned<const D: usize>(ratios: &[(f64, i64); D], exponent: i32) -> Offset<D> {
    let magnitude = |&(mantissa, own): &(f64, i64)| exponent_of(mantissa).map(|e| e + own as i32);
    let Some(largest) = ratios.iter().filter_map(magnitude).max() else {
        return Offset::ZERO;
    };
    let vector = std::array::from_fn(|k| scale(ratios[k].0, ratios[k].1 as i32 - largest));
    Offset::normalized(vector, exponent + largest)
}
