//! Exact solutions of small linear systems, for simplices whose doubles are too ill-conditioned.

use super::exact::{RightSide, Solution, ratio, solve};
use super::length::{Offset, exponent_of, scale};
use crate::memory::AllocResult;
use crate::mesh::MAX_DIM;

/// One gradient for each vertex of a simplex; what follows is zero.
pub(super) type Gradients<const D: usize> = [Offset<D>; MAX_DIM + 1];

/// Returns the circumcentre of `D + 1` points relative to that at `base`; `None` if the simplex is
/// flat.
pub(crate) fn circumcenter<const D: usize>(
    points: &[&[f64; D]],
    base: usize,
) -> AllocResult<Option<Offset<D>>> {
    // The products of the edges with twice the centre are their squares.
    let solution = solve(points[base], &others(points, base), &[RightSide::Square])?;
    Ok(solution.map(|(solution, unit)| quotient(&solution, 0, unit - 1)))
}

/// Returns the gradients of the barycentric coordinates of the vertices other than that at `base`,
/// then that of the base, their negated sum; `None` if the simplex is flat.
pub(crate) fn gradients<const D: usize>(
    points: &[&[f64; D]],
    base: usize,
) -> AllocResult<Option<Gradients<D>>> {
    let mut sides = [RightSide::Ones; MAX_DIM + 1];
    (0..D).for_each(|i| sides[i] = RightSide::Unit(i));
    let solution = solve(points[base], &others(points, base), &sides[..=D])?;
    Ok(solution.map(|(solution, unit)| {
        let mut gradients = [Offset::ZERO; MAX_DIM + 1];
        (0..=D).for_each(|i| gradients[i] = quotient(&solution, i, -unit));
        gradients[D].vector = gradients[D].vector.map(|x| -x);
        gradients
    }))
}

/// Returns the points except that at `base`.
fn others<'a, const D: usize>(points: &[&'a [f64; D]], base: usize) -> [&'a [f64; D]; D] {
    std::array::from_fn(|k| points[k + usize::from(k >= base)])
}

/// Returns the solution for one of the sides, in units of `2^exponent`.
fn quotient<const D: usize>(solution: &Solution, side: usize, exponent: i32) -> Offset<D> {
    let part = |k: usize| ratio(solution.numerator(k, side), solution.denominator());
    let ratios: [(f64, i64); D] = std::array::from_fn(part);
    let magnitude = |&(mantissa, own): &(f64, i64)| exponent_of(mantissa).map(|e| e + own as i32);
    let Some(largest) = ratios.iter().filter_map(magnitude).max() else {
        return Offset::ZERO;
    };
    let vector = std::array::from_fn(|k| scale(ratios[k].0, ratios[k].1 as i32 - largest));
    Offset::normalized(vector, exponent + largest)
}
