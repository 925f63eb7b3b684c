//! Exact solutions of small linear systems, for simplices whose doubles are too ill-conditioned:
//! fraction-free Gauss-Jordan elimination (Bareiss) on the coordinates as integers.

use super::corner::Gradients;
use super::length::{Offset, exponent_of, scale};
use crate::mesh::MAX_DIM;
use dashu_int::IBig;
use dashu_int::ops::BitTest;

/// Edges `p_i - p_base` of a simplex as integers, in units of `2^exponent`.
pub(crate) struct IntegerEdges<const D: usize> {
    edges: Vec<[IBig; D]>,
    exponent: i32,
}

impl<const D: usize> IntegerEdges<D> {
    /// `points`: `D + 1` points; the edge of `base` to itself is left out.
    pub fn new(points: &[&[f64; D]], base: usize) -> Self {
        let lowest = |x: &f64| exponent_of(*x).map(|e| e.max(-1022) - 52);
        let exponent = points.iter().flat_map(|p| p.iter()).filter_map(lowest).min().unwrap_or(0);
        let integer = |x: f64| integer(x, exponent);
        let edge = |p: &[f64; D]| -> [IBig; D] {
            std::array::from_fn(|k| integer(p[k]) - integer(points[base][k]))
        };
        let others = points.iter().enumerate().filter(|(i, _)| *i != base);
        Self { edges: others.map(|(_, p)| edge(p)).collect(), exponent }
    }

    /// The circumcentre relative to the base point; `None` if the simplex is flat.
    pub fn circumcenter(&self) -> Option<Offset<D>> {
        let rows = self.edges.iter().map(|edge| {
            let squared: IBig = edge.iter().map(|x| x * x).sum();
            edge.iter().map(|x| x * IBig::from(2)).chain([squared]).collect()
        });
        let (solution, determinant) = solve(rows.collect(), 1)?;
        let ratios: Vec<_> = solution.iter().map(|row| ratio(&row[0], &determinant)).collect();
        Some(aligned(&ratios, self.exponent))
    }

    /// The gradients of the barycentric coordinates of the vertices other than the base, then that
    /// of the base, their negated sum; `None` if the simplex is flat.
    pub fn gradients(&self) -> Option<Gradients<D>> {
        let rows = self.edges.iter().enumerate().map(|(i, edge)| {
            let unit = (0..D).map(|j| IBig::from(u8::from(i == j)));
            edge.iter().cloned().chain(unit).collect()
        });
        let (solution, determinant) = solve(rows.collect(), D)?;
        let column = |i: usize| -> Vec<IBig> { solution.iter().map(|r| r[i].clone()).collect() };
        let mut columns: Vec<Vec<IBig>> = (0..D).map(column).collect();
        let negated_sum = |row: &Vec<IBig>| -row.iter().sum::<IBig>();
        columns.push(solution.iter().map(negated_sum).collect());
        let offset = |column: &Vec<IBig>| {
            let ratios: Vec<_> = column.iter().map(|x| ratio(x, &determinant)).collect();
            aligned(&ratios, -self.exponent)
        };
        let mut gradients = [Offset::ZERO; MAX_DIM + 1];
        gradients.iter_mut().zip(&columns).for_each(|(to, column)| *to = offset(column));
        Some(gradients)
    }
}

/// `value` in units of `2^exponent`; it must be a multiple of the unit.
fn integer(value: f64, exponent: i32) -> IBig {
    let Some(own) = exponent_of(value) else {
        return IBig::ZERO;
    };
    let unit = own.max(-1022) - 52;
    IBig::from(scale(value, -unit) as i64) << (unit - exponent) as usize
}

/// Solves the `n x (n + right)` system; returns the right sides times the determinant, and it.
fn solve(mut rows: Vec<Vec<IBig>>, right: usize) -> Option<(Vec<Vec<IBig>>, IBig)> {
    let n = rows.len();
    let mut previous = IBig::ONE;
    for k in 0..n {
        let pivot = (k..n).find(|&i| rows[i][k] != IBig::ZERO)?;
        rows.swap(k, pivot);
        let pivot_row = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i == k {
                continue;
            }
            let factor = row[k].clone();
            for (entry, above) in row.iter_mut().zip(&pivot_row) {
                *entry = (&*entry * &pivot_row[k] - &factor * above) / &previous;
            }
        }
        previous = pivot_row[k].clone();
    }
    let solution = rows.iter().map(|row| row[n..n + right].to_vec()).collect();
    Some((solution, previous))
}

/// `numerator / denominator` as a mantissa and an exponent, to about 60 bits before rounding.
fn ratio(numerator: &IBig, denominator: &IBig) -> (f64, i32) {
    let shift = 64 + denominator.bit_len() as i64 - numerator.bit_len() as i64;
    let quotient = match shift {
        0.. => (numerator << shift as usize) / denominator,
        _ => numerator / (denominator << (-shift) as usize),
    };
    let mantissa = i128::try_from(&quotient).map_or(0.0, |q| q as f64);
    (mantissa, -shift as i32)
}

fn aligned<const D: usize>(ratios: &[(f64, i32)], exponent: i32) -> Offset<D> {
    let magnitude = |&(mantissa, own): &(f64, i32)| exponent_of(mantissa).map(|e| e + own);
    let Some(largest) = ratios.iter().filter_map(magnitude).max() else {
        return Offset::ZERO;
    };
    let vector = std::array::from_fn(|k| scale(ratios[k].0, ratios[k].1 - largest));
    Offset::normalized(vector, exponent + largest)
}
