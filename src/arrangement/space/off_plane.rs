//! Filter for the planes of triangles: doubles tell of most points that they are off a plane by
//! more than rounding explains, and [`Gauge::measure`](super::plane::Gauge::measure), which is
//! exact and takes a hundred times as long, tells of the others.

use crate::arrangement::reach::NEAR;
use crate::numerics::{cross, dot};
use std::array::from_fn;

/// Roundings of differences, products of three and their sums, relative to the sum of magnitudes.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Largest difference of coordinates, and smallest volume, for which products neither overflow nor
/// lose bits below the smallest doubles.
const LARGEST: f64 = 1e45;
const SMALLEST: f64 = 1e-240;

/// Vector, with the largest magnitude that each component may have but for its signs: errors are
/// [`ROUNDING`] of that.
struct Product {
    value: [f64; 3],
    magnitude: [f64; 3],
}

impl Product {
    /// Returns the cross product of two vectors.
    fn of(p: &[f64; 3], q: &[f64; 3]) -> Self {
        let magnitude = |k: usize| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            (p[i] * q[j]).abs() + (p[j] * q[i]).abs()
        };
        Self { value: cross(p, q), magnitude: from_fn(magnitude) }
    }

    fn most(&self, k: usize) -> f64 {
        self.value[k].abs() + ROUNDING * self.magnitude[k]
    }

    fn least(&self, k: usize) -> f64 {
        self.value[k].abs() - ROUNDING * self.magnitude[k]
    }
}

/// Returns true only if a point is off the plane of a triangle by more than roundings of the axes'
/// `units` explain; false for some others that are.
pub(super) fn is_clearly_off([a, b, c]: [&[f64; 3]; 3], units: &[f64; 3], x: &[f64; 3]) -> bool {
    let [u, v, w] = [b, c, x].map(|to| -> [f64; 3] { from_fn(|k| to[k] - a[k]) });
    let normal = Product::of(&u, &v);
    let volume = dot(&normal.value, &w).abs();
    let magnitude: f64 = (0..3).map(|k| normal.magnitude[k] * w[k].abs()).sum();
    let explained: f64 = (0..3).map(|k| NEAR * normal.most(k) * units[k]).sum();
    let Some(weights) = most_weights(&normal, &Product::of(&u, &w), &Product::of(&w, &v)) else {
        return false;
    };
    let is_in_range = [u, v, w].iter().flatten().all(|x| x.abs() <= LARGEST);
    is_in_range
        && volume > SMALLEST
        && volume - ROUNDING * magnitude > (1.0 + ROUNDING) * explained * (1.0 + weights)
}

/// Returns what the magnitudes of a point's barycentric coordinates sum up to at most, in the
/// projection along the longest component of the normal; `None` if that is not known well. `third`
/// and `second` are products with the weights of the third and the second corner.
fn most_weights(normal: &Product, third: &Product, second: &Product) -> Option<f64> {
    let largest = |own: &[f64; 3]| own.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let (longest, error) = (largest(&normal.value), ROUNDING * largest(&normal.magnitude));
    if error > 0.25 * longest {
        return None;
    }
    // The component that is longest exactly is one of those that may be.
    let candidates = (0..3).filter(|&k| normal.value[k].abs() >= longest - 2.0 * error);
    let weights = candidates.map(|k| {
        let first = (normal.value[k] - third.value[k] - second.value[k]).abs();
        let magnitude = normal.magnitude[k] + third.magnitude[k] + second.magnitude[k];
        let sum = first + ROUNDING * magnitude + third.most(k) + second.most(k);
        sum / normal.least(k)
    });
    Some(weights.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::super::plane::{Gauge, units_of};
    use super::*;
    use crate::numerics::SplitMix;

    /// Returns three corners, some of needles, and a point that is off their plane by `height`
    /// units in the last place, up to 64 times as far away as the corners are from each other.
    fn case(random: &mut SplitMix, height: f64) -> ([[f64; 3]; 3], [f64; 3]) {
        let center: [f64; 3] = from_fn(|_| 4.0 * random.unit());
        let width = (-20.0 - 20.0 * random.unit()).exp2();
        let mut near = || -> [f64; 3] { from_fn(|k| center[k] + random.unit()) };
        let [a, b, c] = [near(), near(), near()];
        let c = from_fn(|k| a[k] + 0.3 * (b[k] - a[k]) + width * (c[k] - a[k]));
        let [s, t] = [0, 1].map(|_| 64.0 * random.unit());
        let unit = units_of([&a, &b, &c].into_iter());
        let x = from_fn(|k| {
            a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]) + height * unit[k] * random.unit()
        });
        ([a, b, c], x)
    }

    #[test]
    fn what_is_clearly_off_a_plane_is_off_it() {
        let mut random = SplitMix(7);
        let (mut clear, mut off) = (0, 0);
        for at in 0..20_000 {
            let height = 2f64.powi(at % 60 - 4);
            let (corners, x) = case(&mut random, height);
            for scale in [1.0, 1e-70, 1e-200, 1e100, 1e300] {
                let scaled = |x: [f64; 3]| x.map(|x| scale * x);
                let (corners, x) = (corners.map(scaled), scaled(x));
                let corners = corners.each_ref();
                let units = units_of(corners.into_iter().chain([&x]));
                let is_off = Gauge::new(corners, units).measure(&x).0 > 1.0;
                let is_clear = is_clearly_off(corners, &units, &x);
                assert!(is_off || !is_clear, "{corners:?} {x:?}");
                if scale == 1.0 {
                    (clear, off) = (clear + i32::from(is_clear), off + i32::from(is_off));
                }
            }
        }
        assert!(off > 10_000 && clear > off / 2, "{clear} of {off}");
    }
}
