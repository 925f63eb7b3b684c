//! The length of a vector and the distance of two points.

use crate::numerics::power::{biased_exponent, scale_by_power};

/// Largest magnitudes of numbers whose sum of squares is safe: no overflow, and an underflow is far
/// below the roundoff of the sum.
const SAFE: std::ops::RangeInclusive<f64> =
    f64::from_bits((1023 - 500) << 52)..=f64::from_bits((1023 + 500) << 52);

/// Returns the Euclidean distance of two finite points, in the coordinates' unit; infinite only if
/// the true distance, rounded, exceeds `f64::MAX`. Relative error at most D + 4 units of roundoff
/// (2^-53), or 2^-1074 absolutely where the result is subnormal. Zero iff the points are equal.
#[inline]
pub fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    // A component that overflows is longer than f64::MAX by itself.
    norm(&std::array::from_fn::<f64, D, _>(|i| a[i] - b[i]))
}

/// Returns what coordinates are to be multiplied by so that no difference of them overflows: 1
/// mostly, since halves of the smallest doubles are nothing, and 1/2 for the largest.
pub fn scale_of_differences<'a, const D: usize>(
    points: impl IntoIterator<Item = &'a [f64; D]>,
) -> f64 {
    let is_large = |x: &f64| x.abs() > 0.5 * f64::MAX;
    if points.into_iter().flatten().any(is_large) { 0.5 } else { 1.0 }
}

/// Returns a power of two: numbers are to be multiplied by it before they are multiplied by others
/// of about 1, and the result divided. It is 1 mostly, and 2^200 for the least doubles, of which
/// products would lose bits.
pub fn scale_of_products(numbers: [f64; 2]) -> f64 {
    const LEAST: f64 = f64::from_bits((1023 - 900) << 52);
    const UP: f64 = f64::from_bits((1023 + 200) << 52);
    if numbers.iter().all(|x| x.abs() < LEAST) { UP } else { 1.0 }
}

/// Returns the Euclidean length of a vector; infinite only if a component is or if the true length,
/// rounded, exceeds `f64::MAX`. Relative error at most n + 3 units of roundoff for n components, or
/// 2^-1074 absolutely where the result is subnormal. Zero iff all components are.
#[inline]
pub fn norm(vector: &[f64]) -> f64 {
    let largest = largest_magnitude(vector);
    if SAFE.contains(&largest) { root_of_squares(vector) } else { scaled_norm(vector, largest) }
}

#[cold]
#[inline(never)]
fn scaled_norm(vector: &[f64], largest: f64) -> f64 {
    // Zero and infinity stay what they are. For subnormals the exponent is that of the smallest
    // normal number: near enough.
    let exponent = i64::from(biased_exponent(largest).max(1)) - 1023;
    let scaled = vector.iter().map(|x| scale_by_power(*x, -exponent));
    let sum = scaled.fold(0.0, |sum, x| sum + x * x);
    scale_by_power(sum.sqrt(), exponent)
}

/// Returns the largest magnitude in `vector`, zero if it is empty. A plain comparison, since
/// `f64::max` pays for NaN, which does not occur here.
#[inline]
pub fn largest_magnitude(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |largest, x| if x.abs() > largest { x.abs() } else { largest })
}

#[inline]
fn root_of_squares(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |sum, x| sum + x * x).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALLEST: f64 = f64::from_bits(1);

    fn assert_close(value: f64, expected: f64) {
        let bound = 8.0 * f64::EPSILON * expected + 2.0 * SMALLEST;
        assert!((value - expected).abs() <= bound, "{value:e} is not {expected:e}");
    }

    #[test]
    fn every_scale_gives_the_same_triangle() {
        for exponent in -1074..=1020 {
            let unit = scale_by_power(1.0, exponent);
            assert_close(distance(&[unit, -unit], &[4.0 * unit, 3.0 * unit]), 5.0 * unit);
            assert_close(norm(&[2.0 * unit, -3.0 * unit, 6.0 * unit]), 7.0 * unit);
        }
    }

    #[test]
    fn limits_do_not_overflow_or_vanish() {
        assert_eq!(distance(&[0.5 * f64::MAX, 0.0], &[-0.5 * f64::MAX, 0.0]), f64::MAX);
        // Each difference overflows on its own, or only the sum of their squares does.
        assert_eq!(distance(&[f64::MAX, 0.0], &[-f64::MAX, 0.0]), f64::INFINITY);
        assert_eq!(distance(&[f64::MAX, 0.0], &[0.0, f64::MAX]), f64::INFINITY);
        let third = f64::MAX / 3.0;
        assert_close(distance(&[third, third, 0.0], &[-third, 0.0, 0.0]), third * 5f64.sqrt());
        assert_eq!(distance(&[SMALLEST, 0.0], &[0.0, 0.0]), SMALLEST);
        assert_eq!(distance(&[1e-300, 1.0], &[-1e-300, 1.0]), 2e-300);
        assert_eq!(distance(&[0.0, 1.0], &[-0.0, 1.0]), 0.0);
        assert_eq!((norm(&[]), norm(&[0.0, -0.0])), (0.0, 0.0));
        assert_eq!(norm(&[1.0, f64::NEG_INFINITY]), f64::INFINITY);
    }
}
