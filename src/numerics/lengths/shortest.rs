//! The shortest distance among a few points.

use super::distance;

/// Sums of squares of safe numbers, which have lost no significant digits.
const SAFE_SQUARE: std::ops::RangeInclusive<f64> =
    f64::from_bits((1023 - 900) << 52)..=f64::from_bits((1023 + 900) << 52);

/// Returns two different points among at least two that are nearest to each other, by their
/// numbers, the larger one first, and their [`distance`]. If rounding makes pairs equally near, it
/// is one of the first.
#[inline]
pub fn shortest_distance<const D: usize>(points: &[&[f64; D]]) -> (usize, usize, f64) {
    let square = |a: usize, b: usize| {
        (0..D).fold(0.0, |sum, i| {
            let x = points[a][i] - points[b][i];
            sum + x * x
        })
    };
    let (a, b, least) = least_pair(points.len(), square);
    if SAFE_SQUARE.contains(&least) {
        return (a, b, least.sqrt());
    }
    least_pair(points.len(), |a, b| distance(points[a], points[b]))
}

#[inline(always)]
fn least_pair(count: usize, measure: impl Fn(usize, usize) -> f64) -> (usize, usize, f64) {
    let mut least = (1, 0, f64::INFINITY);
    for a in 1..count {
        for b in 0..a {
            let value = measure(a, b);
            if value < least.2 {
                least = (a, b, value);
            }
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::power::scale_by_power;
    use crate::numerics::testing::Random;

    #[test]
    fn shortest_distances_are_the_least_at_every_scale() {
        let mut random = Random(7);
        for exponent in (-1074..=1020).step_by(3) {
            let points: [[f64; 3]; 4] = std::array::from_fn(|_| {
                std::array::from_fn(|_| scale_by_power(random.unit(), exponent))
            });
            let (a, b, length) = shortest_distance(&points.each_ref());
            assert_eq!(length, distance(&points[a], &points[b]), "2^{exponent}");
            let mut all = (0..16).filter(|i| i / 4 > i % 4);
            let is_least = all.all(|i| length <= distance(&points[i / 4], &points[i % 4]));
            assert!(a > b && is_least, "2^{exponent}");
        }
        // One pair's square vanishes, another one's overflows.
        let points = [[0.0, 0.0], [1e200, 0.0], [0.0, 1e-200]];
        assert_eq!(shortest_distance(&points.each_ref()), (2, 0, 1e-200));
    }
}
