//! The smallest circumscribing ball of a face in integers.

use super::radius::Radius;
use crate::memory::AllocResult;
use crate::quality::exact::{Integer, Matrix, Number, Refusal, ratio, unbounded, unit};
use std::cmp::Ordering;

/// Returns the barycentric coordinates of the circumcentre of `points` that are negative, as bits;
/// `None` if the face is flat.
pub(super) fn negative_coordinates<const D: usize>(
    points: &[&[f64; D]],
) -> AllocResult<Option<u16>> {
    let unit = unit(points[0], &points[1..]);
    match negative_in::<i128, D>(points, unit) {
        Err(Refusal::TooLarge) => unbounded(negative_in::<Integer, D>(points, unit)),
        Err(Refusal::Memory(error)) => Err(error),
        Ok(negative) => Ok(negative),
    }
}

/// Finds the negative coordinates with numbers of one type. With `x` such that the products of the
/// edges from the first point with the sum of `x_i edge_i` are their squares, the coordinates are
/// `x_i / 2`, and what is left to 1 for the first point.
fn negative_in<N: Number, const D: usize>(
    points: &[&[f64; D]],
    unit: i32,
) -> Result<Option<u16>, Refusal> {
    let k = points.len() - 1;
    let mut matrix = Matrix::<N>::products(points[0], &points[1..], unit)?;
    // The determinant of products of independent edges is positive.
    if matrix.eliminate(true)? != Ordering::Greater {
        return Ok(None);
    }
    let determinant = matrix.at(k - 1, k - 1);
    let mut first = determinant.plus(determinant)?;
    let mut negative = 0;
    for i in 0..k {
        let coordinate = matrix.at(i, k);
        first = first.minus(coordinate)?;
        negative |= u16::from(coordinate.sign() == Ordering::Less) << (i + 1);
    }
    Ok(Some(negative | u16::from(first.sign() == Ordering::Less)))
}

/// Computes the radius in the form that is wanted; `None` if the face is flat.
pub(super) fn radius<const D: usize>(
    points: &[&[f64; D]],
    wanted: Radius,
) -> AllocResult<Option<f64>> {
    let k = points.len() - 1;
    let unit = unit(points[0], &points[1..]);
    let products = || unbounded(Matrix::<Integer>::products(points[0], &points[1..], unit));
    let (squares, mut solved) = (products()?, products()?);
    if unbounded(solved.eliminate(true))? != Ordering::Greater {
        return Ok(None);
    }
    // A quarter of the sum of the squares times x.
    let mut sum = unbounded(Integer::shifted(0, 0))?;
    for i in 0..k {
        let term = unbounded(squares.at(i, k).times(solved.at(i, k)))?;
        sum = unbounded(sum.plus(&term))?;
    }
    let (exponent, determinant) = (2 * i64::from(unit) - 2, solved.at(k - 1, k - 1));
    if wanted == Radius::Square {
        return Ok(Some(unbounded(rounded(&sum, determinant, exponent))?));
    }
    // In a unit where it is about 1.
    let half = ratio(&sum, determinant).1 / 2;
    let square = unbounded(rounded(&sum, determinant, -2 * half))?;
    Ok(wanted.of_square(square, (half + exponent / 2) as i32))
}

/// Returns `numerator / denominator * 2^exponent` for positive numbers, rounded to the nearest
/// double, to the even one of two.
fn rounded(numerator: &Integer, denominator: &Integer, exponent: i64) -> Result<f64, Refusal> {
    let exact = Quotient { numerator, denominator, exponent };
    let (about, shift) = ratio(numerator, denominator);
    let mut nearest = scaled(about, shift + exponent).min(f64::MAX);
    while exact.is_above_midpoint(nearest)? {
        nearest = nearest.next_up();
        if nearest == f64::INFINITY {
            return Ok(nearest);
        }
    }
    while nearest > 0.0 && !exact.is_above_midpoint(nearest.next_down())? {
        nearest = nearest.next_down();
    }
    Ok(nearest)
}

struct Quotient<'a> {
    numerator: &'a Integer,
    denominator: &'a Integer,
    exponent: i64,
}

impl Quotient<'_> {
    /// Returns true if the quotient rounds to what is above `x`: it is above the midpoint of `x`
    /// and the next double, or it is there and `x` is odd.
    fn is_above_midpoint(&self, x: f64) -> Result<bool, Refusal> {
        let field = (x.to_bits() >> 52) as i64;
        let fraction = (x.to_bits() & ((1 << 52) - 1)) as i64;
        let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
        // The midpoint is (2 mantissa + 1) 2^(field - 1076).
        let shift = self.exponent - (field.max(1) - 1076);
        let power = |shift: i64| Integer::shifted(1, shift.max(0) as u32);
        let left = self.numerator.times(&power(shift)?)?;
        let midpoint = Integer::shifted(2 * mantissa + 1, 0)?.times(&power(-shift)?)?;
        Ok(match left.minus(&self.denominator.times(&midpoint)?)?.sign() {
            Ordering::Equal => mantissa % 2 == 1,
            order => order == Ordering::Greater,
        })
    }
}

/// Returns `value * 2^exponent`, rounded.
fn scaled(value: f64, exponent: i64) -> f64 {
    crate::query::unit::scaled(value, exponent.clamp(-2200, 2200) as i32)
}
