//! Determinants, circumcentres and sides of spheres in some 106 bits, each with a bound of its
//! error: for simplices that are too flat for doubles and points that are nearly on spheres, in a
//! fraction of the time of integers.
//!
//! Differences of doubles are exact here. With u the roundoff of doubles, a sum is wrong by at most
//! 4 u^2 (|a| + |b|) and a product by 8 u^2 |a b| ([`DoubleDouble`]), beside underflow.

use super::determinant::certain_sign;
use crate::numerics::lengths::largest_magnitude;
use crate::numerics::power::{TINY, UNIT, biased_exponent, power_of_two};
use crate::numerics::{DoubleDouble, MAX_SIZE, Sign, laplace};

/// Edges from a vertex of a simplex to the others, each times a power of two that brings its
/// largest component to [1, 2].
struct ScaledEdges<const D: usize> {
    rows: [[DoubleDouble; D]; D],
    /// Row -> the exponent of the power of two that it was divided by.
    exponents: [i32; D],
}

/// Rows of edges, and one more column of positive numbers.
struct Columns<'a, const D: usize> {
    rows: &'a [[DoubleDouble; D]],
    last: &'a [DoubleDouble],
}

impl<const D: usize> laplace::Matrix for Columns<'_, D> {
    type Minor = DoubleDouble;
    type Sum = DoubleDouble;
    type Sign = f64;
    const ONE: DoubleDouble = DoubleDouble { high: 1.0, low: 0.0 };
    const PLUS: f64 = 1.0;
    const ZERO: DoubleDouble = DoubleDouble::ZERO;

    #[inline(always)]
    fn add(
        &self,
        sum: &mut DoubleDouble,
        row: usize,
        column: usize,
        sign: f64,
        minor: DoubleDouble,
    ) {
        let entry = if column < D { self.rows[row][column] } else { self.last[row] };
        // The minor of no rows is one.
        let product = if row == 0 { entry } else { entry * minor };
        *sum = *sum + product.scaled(sign);
    }

    #[inline(always)]
    fn minor(&self, sum: DoubleDouble) -> DoubleDouble {
        sum
    }
}

impl<const D: usize> Columns<'_, D> {
    /// Returns no less than the permanent of the absolute values of the rows: the product of their
    /// sums.
    fn permanent(&self) -> f64 {
        self.rows.iter().map(sum_of_magnitudes).product()
    }

    /// Returns no less than the permanent of the absolute values of the rows with the last column
    /// in place of another one, or after all if there is one row more.
    fn permanent_with_last(&self) -> f64 {
        let sums = || self.rows.iter().map(sum_of_magnitudes);
        let without = |row: usize| sums().enumerate().filter(move |(other, _)| *other != row);
        let product = |row: usize| without(row).map(|(_, sum)| sum).product::<f64>();
        (0..self.rows.len()).map(|row| self.last[row].high * product(row)).sum()
    }
}

fn sum_of_magnitudes<const D: usize>(row: &[DoubleDouble; D]) -> f64 {
    row.iter().fold(0.0, |sum, x| sum + x.high.abs())
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
        let unit = |r: usize| power_of_two(self.exponents[r] - top - 1);
        std::array::from_fn(|r| square(&self.rows[r]).scaled(unit(r)))
    }
}

fn square<const D: usize>(row: &[DoubleDouble; D]) -> DoubleDouble {
    row.iter().fold(DoubleDouble::ZERO, |sum, &x| sum + x * x)
}

/// Returns determinants with the last column: at place k that without column k, at place D that
/// without the last one; of D + 1 rows at place 0 that of all columns.
fn determinants<const D: usize>(columns: &Columns<'_, D>) -> [DoubleDouble; MAX_SIZE] {
    match D {
        2 => expanded::<D, 8>(columns),
        3 => expanded::<D, 16>(columns),
        4 => expanded::<D, 32>(columns),
        _ => expanded::<D, 512>(columns),
    }
}

#[inline(always)]
fn expanded<const D: usize, const SETS: usize>(
    columns: &Columns<'_, D>,
) -> [DoubleDouble; MAX_SIZE] {
    let mut minors = [DoubleDouble::ZERO; SETS];
    let (all, count) = ((1 << (D + 1)) - 1, columns.rows.len());
    // Without a last column the sets of the others are enough.
    let end = if columns.last.is_empty() { 1 << D } else { all + usize::from(count > D) };
    laplace::expand(columns, end, &mut minors);
    let without = |k: usize| if count > D { minors[all] } else { minors[all ^ 1 << k] };
    std::array::from_fn(|k| without(k.min(D)))
}

/// Returns the largest error of a determinant of so many rows. A level of the expansion with k
/// products adds at most 8 + 4 (k - 1) units to those of its factors, n of them 2 n^2 + 6 n; an
/// entry of the last column brings 4 D + 4. Twice that pays for the roundings of the permanent.
fn bound<const D: usize>(rows: usize, permanent: f64) -> f64 {
    let units = (2 * rows * rows + 6 * rows + 4 * D + 4) as f64;
    2.0 * units * UNIT * UNIT * permanent + TINY
}

/// Returns the sign of [`in_ball`](super::in_ball), if this arithmetic can tell it; never
/// `Some(Sign::Zero)`.
pub fn precise_in_ball<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Sign> {
    let (mut rows, mut squares) =
        ([[DoubleDouble::ZERO; D]; MAX_SIZE], [DoubleDouble::ZERO; MAX_SIZE]);
    let ends = simplex[1..].iter().copied().chain([q]);
    let mut largest = 0.0f64;
    for (row, end) in rows.iter_mut().zip(ends) {
        *row = std::array::from_fn(|k| DoubleDouble::difference(end[k], simplex[0][k]));
        largest = row.iter().fold(largest, |largest, x| largest.max(x.high.abs()));
    }
    // One scale for all, so that the largest is in [1, 2], changes no sign.
    let field = biased_exponent(largest);
    if !(1..=2045).contains(&field) {
        return None;
    }
    let scale = power_of_two(1023 - field);
    for (row, own) in rows[..=D].iter_mut().zip(&mut squares) {
        *row = row.map(|x| x.scaled(scale));
        *own = square(row);
    }
    let columns = Columns { rows: &rows[..=D], last: &squares[..=D] };
    let determinant = determinants(&columns)[0].high;
    let error = bound::<D>(D + 1, columns.permanent_with_last()) + UNIT * determinant.abs();
    certain_sign((determinant, error)).map(Sign::flip)
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
    let columns = Columns { rows: &edges.rows, last: &[] };
    let determinant = determinants(&columns)[D].high;
    let error = bound::<D>(D, columns.permanent()) + UNIT * determinant.abs();
    // False if anything is NaN.
    let is_accepted = error <= accepted * determinant.abs();
    let exponent = edges.exponents.iter().map(|&e| i64::from(e)).sum();
    is_accepted.then_some((determinant, exponent))
}

/// Returns the circumcentre relative to `points[anchor]` as x * 2^e: x, a bound of the error of its
/// components, and e; `None` for lengths out of range. The bound holds if it is at most a
/// thousandth of the largest component; it is larger, infinite or NaN for a simplex that is too
/// flat.
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
    let columns = Columns { rows: &edges.rows, last: &edges.half_squares(top) };
    let determinants = determinants(&columns);
    let denominator = determinants[D];
    let quotient = |k: usize| {
        (determinants[k] / denominator).high * if (D - 1 - k) % 2 == 0 { 1.0 } else { -1.0 }
    };
    let solution: [f64; D] = std::array::from_fn(quotient);
    let size = largest_magnitude(&solution);
    // With a result of at most `size / 1000` the denominator is right to a thousandth, which 1.01
    // pays for; three units are for the division and for the lower half that is left out.
    let wrong =
        bound::<D>(D, columns.permanent_with_last()) + size * bound::<D>(D, columns.permanent());
    Some((solution, 1.01 * wrong / denominator.high.abs() + 3.0 * UNIT * size, top))
}

#[cfg(test)]
mod tests {
    use super::super::{determinant_filtered, in_ball_with_care};
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
        check::<3>(200, 140);
        // The bound grows with the dimension: most are left to integers, then all.
        check::<4>(60, 12);
        check::<6>(10, 0);
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
            assert!(told * 10 >= trials * 9, "{D}D: {told} of {trials}");
        }
        check::<2>(400);
        check::<3>(200);
        check::<4>(60);
        check::<6>(10);
    }

    /// Returns points on the unit sphere but for roundings.
    fn on_sphere<const D: usize>(count: usize, random: &mut Random) -> Vec<[f64; D]> {
        let mut point = || -> [f64; D] {
            let way: [f64; D] = std::array::from_fn(|_| random.unit());
            let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            way.map(|x| x / length)
        };
        (0..count).map(|_| point()).collect()
    }

    fn sides_are_right<const D: usize>(trials: usize) {
        let agrees = |points: &[[f64; D]]| {
            let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
            let side = precise_in_ball(&simplex, q);
            let expected = in_ball_oracle(&simplex, q);
            assert!(side.is_none_or(|side| side == expected), "{points:?}");
            assert_eq!(in_ball_with_care(&simplex, q), expected, "{points:?}");
            side.is_some()
        };
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 70 + D as u64);
            (0..trials).for_each(|_| _ = agrees(&points::<D>(family, D + 2, &mut random)));
        }
        let mut random = Random(D as u64);
        let told = (0..trials).filter(|_| agrees(&on_sphere(D + 2, &mut random))).count();
        assert!(told * 20 > trials * 19, "{D}D: {told} of {trials}");
    }

    #[test]
    fn sides_of_nearly_cospherical_points_are_told() {
        sides_are_right::<2>(400);
        sides_are_right::<3>(200);
        sides_are_right::<4>(60);
        sides_are_right::<6>(10);
    }

    /// Points of a circle of radius one and one that is off it by a part of its bound.
    #[test]
    fn sides_within_the_bound_are_left_to_integers() {
        let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
        // Edges (-1, 1), (-2, 0) and (-1 - h, -1), half of them for the scale.
        let told = |h: f64| precise_in_ball(&references(&corners), &[-h, -1.0]);
        assert_eq!([told(0.0), told(2f64.powi(-120))], [None; 2]);
        // The power of the point is h^2.
        assert_eq!([told(1e-14), told(-1e-14)], [Some(Sign::Negative); 2]);
        assert_eq!(told(1e-17), None);
    }

    /// The edges (1, 1 + h, 0), (2, 2 + h, 0) / 2 and (0, 0, 1) have the determinant -h / 2, and
    /// sums of magnitudes whose product is four: the bound is what the comment counts.
    #[test]
    fn what_is_lost_in_the_bound_is_left_to_integers() {
        let error = bound::<3>(3, 4.0) / FLAT;
        let told = |h: f64| {
            let points = [[0.0, -h, 0.0], [1.0, 1.0, 0.0], [2.0, 2.0, 0.0], [0.0, -h, 1.0]];
            precise_determinant(&references(&points), FLAT)
        };
        // Twice 2 * 9 + 6 * 3 for the levels and 4 * 3 + 4 for an entry.
        assert_eq!(bound::<3>(3, 4.0), 4.0 * 104.0 * UNIT * UNIT + TINY);
        assert_eq!(told(1.9 * error), None);
        assert_eq!(told(2.1 * error), Some((-1.05 * error, 1)));
    }
}
