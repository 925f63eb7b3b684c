//! Determinants and circumcentres in some 106 bits, each with a bound of its error: for simplices
//! that are too flat for doubles, in a fraction of the time of integers.
//!
//! Differences of doubles are exact here. With u the roundoff of doubles, a sum is wrong by at most
//! 4 u^2 (|a| + |b|) and a product by 8 u^2 |a b| ([`DoubleDouble`]), beside underflow.

use crate::numerics::lengths::largest_magnitude;
use crate::numerics::power::{TINY, UNIT, biased_exponent, power_of_two};
use crate::numerics::{DoubleDouble, MAX_SIZE, laplace};

/// Edges from a vertex of a simplex to the others, each times a power of two that brings its
/// largest component to [1, 2].
struct ScaledEdges<const D: usize> {
    rows: [[DoubleDouble; D]; D],
    /// Row -> the exponent of the power of two that it was divided by.
    exponents: [i32; D],
}

/// The rows of scaled edges, and one more column of positive numbers.
struct Columns<'a, const D: usize> {
    rows: &'a [[DoubleDouble; D]; D],
    last: &'a [DoubleDouble; D],
}

/// A minor, and the permanent of the absolute values.
type Minor = (DoubleDouble, f64);

impl<const D: usize> laplace::Matrix for Columns<'_, D> {
    type Minor = Minor;
    type Sum = Minor;
    type Sign = f64;
    const ONE: Minor = (DoubleDouble { high: 1.0, low: 0.0 }, 1.0);
    const PLUS: f64 = 1.0;
    const ZERO: Minor = (DoubleDouble::ZERO, 0.0);

    #[inline(always)]
    fn add(&self, sum: &mut Minor, row: usize, column: usize, sign: f64, minor: Minor) {
        let entry = *self.rows[row].get(column).unwrap_or(&self.last[row]);
        sum.0 = sum.0 + (entry * minor.0).scaled(sign);
        sum.1 += entry.high.abs() * minor.1;
    }

    #[inline(always)]
    fn minor(&self, sum: Minor) -> Minor {
        sum
    }
}

impl<const D: usize> ScaledEdges<D> {
    /// Returns the edges from a point; `None` if one is zero, subnormal or too large.
    fn new<'a>(origin: &[f64; D], ends: impl Iterator<Item = &'a [f64; D]>) -> Option<Self> {
        let (mut rows, mut exponents) = ([[DoubleDouble::ZERO; D]; D], [0; D]);
        for ((row, exponent), end) in rows.iter_mut().zip(&mut exponents).zip(ends) {
            let edge = std::array::from_fn(|k| DoubleDouble::difference(end[k], origin[k]));
            let field = biased_exponent(largest_magnitude(&edge.map(|x| x.high)));
            if !(1..=2045).contains(&field) {
                return None;
            }
            *exponent = field - 1023;
            *row = edge.map(|x| x.scaled(power_of_two(-*exponent)));
        }
        Some(Self { rows, exponents })
    }

    /// Returns half the squared lengths in units of which the largest length has one or two. Each
    /// is wrong by at most (4 D + 4) u^2 of it, beside underflow.
    fn half_squares(&self, top: i32) -> [DoubleDouble; D] {
        std::array::from_fn(|r| {
            let squares = self.rows[r].iter().map(|&x| x * x);
            let square = squares.fold(DoubleDouble::ZERO, |sum, x| sum + x);
            square.scaled(power_of_two(self.exponents[r] - top - 1))
        })
    }

    /// Returns at place D the determinant of the edges, at place k below that with the column
    /// `last` after all and without column k; zeros there if there is no such column.
    fn determinants(&self, last: Option<&[DoubleDouble; D]>) -> [Minor; MAX_SIZE] {
        let count = D + usize::from(last.is_some());
        let columns = Columns { rows: &self.rows, last: last.unwrap_or(&[DoubleDouble::ZERO; D]) };
        match D {
            2 => chosen::<D, 8>(&columns, count),
            3 => chosen::<D, 16>(&columns, count),
            4 => chosen::<D, 32>(&columns, count),
            _ => chosen::<D, 512>(&columns, count),
        }
    }
}

/// Expands the first `count` columns, D or all.
#[inline(always)]
fn chosen<const D: usize, const SETS: usize>(
    columns: &Columns<'_, D>,
    count: usize,
) -> [Minor; MAX_SIZE] {
    let mut minors = [(DoubleDouble::ZERO, 0.0); SETS];
    let all = (1 << (D + 1)) - 1;
    laplace::expand(columns, all.min(1 << count), &mut minors);
    std::array::from_fn(|k| if k <= D { minors[all ^ 1 << k] } else { minors[0] })
}

/// Returns the largest error of a determinant. A level of the expansion with k products adds at
/// most 8 + 4 (k - 1) units to those of its factors, D of them 2 D^2 + 6 D; an entry of the last
/// column brings 4 D + 4. Twice that pays for the rounding of the permanent.
fn bound<const D: usize>(permanent: f64) -> f64 {
    let units = (2 * D * D + 10 * D + 4) as f64;
    2.0 * units * UNIT * UNIT * permanent + TINY
}

/// Returns det[p1 - p0, ..., pD - p0] as m * 2^e, if this arithmetic can tell it with a relative
/// error of at most `accepted`.
#[cold]
#[inline(never)]
pub fn precise_determinant<const D: usize>(
    simplex: &[&[f64; D]],
    accepted: f64,
) -> Option<(f64, i64)> {
    let edges = ScaledEdges::new(simplex[0], simplex[1..].iter().copied())?;
    let (determinant, permanent) = edges.determinants(None)[D];
    let error = bound::<D>(permanent) + UNIT * determinant.high.abs();
    // False if anything is NaN.
    let is_accepted = error <= accepted * determinant.high.abs();
    let exponent = edges.exponents.iter().map(|&e| i64::from(e)).sum();
    is_accepted.then_some((determinant.high, exponent))
}

/// Returns the circumcentre relative to `points[anchor]` as x * 2^e: x, a bound of the error of its
/// components, and e; `None` for lengths out of range. The bound holds if it is at most a thousandth
/// of the largest component; it is larger, infinite or NaN for a simplex that is too flat.
#[cold]
#[inline(never)]
pub fn precise_circumcenter<const D: usize>(
    points: &[&[f64; D]],
    anchor: usize,
) -> Option<([f64; D], f64, i32)> {
    let others = points[..anchor].iter().chain(&points[anchor + 1..]).copied();
    let edges = ScaledEdges::new(points[anchor], others)?;
    let (top, bottom) =
        edges.exponents.iter().fold((-1023, 1023), |(top, bottom), &e| (top.max(e), bottom.min(e)));
    if top - bottom > 900 {
        return None;
    }
    // Cramer's rule for v.x = |v|^2 / 2: the last column in place of column k, as many places on.
    let determinants = edges.determinants(Some(&edges.half_squares(top)));
    let (denominator, permanent) = determinants[D];
    let quotient = |k: usize| {
        let (numerator, _) = determinants[k];
        (numerator / denominator).high * if (D - 1 - k) % 2 == 0 { 1.0 } else { -1.0 }
    };
    let solution: [f64; D] = std::array::from_fn(quotient);
    let size = largest_magnitude(&solution);
    let largest = determinants[..D].iter().fold(0.0f64, |largest, minor| largest.max(minor.1));
    // With a result of at most `size / 1000` the denominator is right to a thousandth, which 1.01
    // pays for; three units are for the division and for the lower half that is left out.
    let wrong = bound::<D>(largest) + size * bound::<D>(permanent);
    Some((solution, 1.01 * wrong / denominator.high.abs() + 3.0 * UNIT * size, top))
}

#[cfg(test)]
mod tests {
    use super::super::determinant_filtered;
    use super::*;
    use crate::numerics::testing::*;
    use dashu_int::IBig;

    const FLAT: f64 = 1e-12;

    fn edges_of<const D: usize>(points: &[[f64; D]]) -> Vec<Vec<IBig>> {
        let edge = |p: &[f64; D]| (0..D).map(|k| integer(p[k]) - integer(points[0][k])).collect();
        points[1..].iter().map(edge).collect()
    }

    /// Checks determinants against integers; returns how many of the nearly flat ones were told,
    /// and how many of these doubles tell.
    fn determinants_are_right<const D: usize>(trials: usize) -> [usize; 2] {
        let mut told = [0; 2];
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 1, &mut random);
                let Some((value, exponent)) = precise_determinant(&references(&points), FLAT)
                else {
                    continue;
                };
                if family == Family::NearlyFlat {
                    told[0] += 1;
                    told[1] +=
                        usize::from(determinant_filtered(&references(&points), FLAT).is_some());
                }
                // What is less is finer than `is_close` can look.
                if exponent > -3000 {
                    let exact = determinant_oracle(&edges_of(&points));
                    let quotient = (&exact, &(IBig::ONE << (1074 * (D - 1))));
                    let bound = FLAT * value.abs();
                    assert!(is_close(value, bound, exponent, quotient), "{family:?} {points:?}");
                }
            }
        }
        told
    }

    #[test]
    fn determinants_of_flat_simplices_are_told() {
        fn check<const D: usize>(trials: usize, least: usize) {
            let [told, by_doubles] = determinants_are_right::<D>(trials);
            assert!(told >= least && by_doubles == 0, "{D}D: {told} of {trials}");
        }
        check::<2>(400, 360);
        check::<3>(200, 160);
        check::<4>(60, 48);
        // Their bound is larger.
        check::<6>(10, 1);
    }

    /// Checks centres against exact fractions; returns how many of the nearly flat simplices have
    /// one with a small error.
    fn centers_are_right<const D: usize>(trials: usize) -> usize {
        let mut told = 0;
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 50 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 1, &mut random);
                let anchor = random.integer(0, D as i64) as usize;
                let simplex = references(&points);
                let Some((center, error, top)) = precise_circumcenter(&simplex, anchor) else {
                    continue;
                };
                // False for NaN.
                let is_bounded = error <= 1e-3 * largest_magnitude(&center);
                if !is_bounded {
                    continue;
                }
                let is_small = error <= 1e-9 * largest_magnitude(&center);
                told += usize::from(is_small && family == Family::NearlyFlat);
                let (numerators, denominator) = circumcenter_oracle(&simplex, anchor);
                for (x, numerator) in center.iter().zip(&numerators) {
                    let quotient = (numerator, &denominator);
                    let is_right = is_close(*x, error, i64::from(top), quotient);
                    assert!(is_right, "{family:?} {points:?}");
                }
            }
        }
        told
    }

    #[test]
    fn centers_of_flat_simplices_are_within_their_bounds() {
        fn check<const D: usize>(trials: usize) {
            let told = centers_are_right::<D>(trials);
            assert!(told * 10 > trials * 9, "{D}D: {told} of {trials}");
        }
        check::<2>(400);
        check::<3>(200);
        check::<4>(60);
        check::<6>(10);
    }

    /// The edges (1, 1 + h, 0), (2, 2 + h, 0) / 2 and (0, 0, 1) have the determinant -h / 2, of a
    /// permanent of two: the bound is what the comment counts.
    #[test]
    fn what_is_lost_in_the_bound_is_left_to_integers() {
        let error = bound::<3>(2.0) / FLAT;
        let told = |h: f64| {
            let points = [[0.0, -h, 0.0], [1.0, 1.0, 0.0], [2.0, 2.0, 0.0], [0.0, -h, 1.0]];
            precise_determinant(&references(&points), FLAT)
        };
        assert!((1e-18..1e-17).contains(&error), "{error}");
        assert_eq!(told(1.9 * error), None);
        assert_eq!(told(2.1 * error), Some((-1.05 * error, 1)));
    }
}
