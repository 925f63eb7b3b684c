//! Tests in floating point of many points against one hyperplane.

use super::determinant::cofactors;
use super::orientation::normalise;
use crate::numerics::MAX_SIZE;
use crate::numerics::power::{TINY, power_of_two};

/// Factor by which normals are scaled. Their components are at most 7! 2^7 before; times a
/// difference, the sum of eight such products does not overflow unless the difference does.
const UNIT: f64 = power_of_two(-30);

/// Hyperplane through `D` points: its normal, computed once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hyperplane<const D: usize> {
    origin: [f64; D],
    normal: [f64; D],
    /// Largest errors of the components of the normal, including what a product with one adds.
    error: [f64; D],
}

impl<const D: usize> Hyperplane<D> {
    /// Returns the hyperplane of `D` points. Points x are on its positive side if the orientation
    /// of the `D` points followed by x is positive. `None` if two of the points are too close or
    /// too far apart.
    pub fn new(points: &[[f64; D]; D]) -> Option<Self> {
        let origin = points[0];
        let mut rows = [[1.0; D]; D];
        for (row, point) in rows.iter_mut().zip(&points[1..]) {
            *row = std::array::from_fn(|k| point[k] - origin[k]);
        }
        let mut matrix = [[0.0; MAX_SIZE]; MAX_SIZE];
        for (entries, row) in matrix.iter_mut().zip(&normalise(rows)?[..D - 1]) {
            entries[..D].copy_from_slice(row);
        }
        // Each difference carries a rounding, and so do the D + 2 operations on a component
        // afterwards: the difference it is multiplied by, the product and D sums.
        let (normal, error) = cofactors(&matrix, (D - 1) + D + 2);
        let (normal, error) = (normal.map(|x| x * UNIT), error.map(|x| x * UNIT + TINY));
        Some(Self { origin, normal, error })
    }

    /// Returns the hyperplane with its sides exchanged.
    pub fn turned(self) -> Self {
        Self { normal: self.normal.map(|x| -x), ..self }
    }

    /// Returns a lower bound of a point's distance from the hyperplane, in some unit: if it is
    /// positive, the point is certainly on the positive side. An overflow makes it useless, but not
    /// wrong.
    #[inline]
    pub fn least_at(&self, point: &[f64; D]) -> f64 {
        let (mut sum, mut error) = (0.0, TINY);
        let components = self.normal.iter().zip(&self.error);
        for ((x, origin), (normal, bound)) in point.iter().zip(&self.origin).zip(components) {
            let x = x - origin;
            sum += normal * x;
            error += bound * x.abs();
        }
        sum - 1.01 * error
    }

    /// Returns an upper bound of the distance from the hyperplane of all points of a box, in the
    /// unit of [`Self::least_at`]: if it is negative, the whole box is certainly on the negative
    /// side. An overflow makes it useless, but not wrong.
    #[inline]
    pub fn most_in(&self, low: &[f64; D], high: &[f64; D]) -> f64 {
        let (mut sum, mut error) = (0.0, TINY);
        for k in 0..D {
            let (a, b) = (low[k] - self.origin[k], high[k] - self.origin[k]);
            sum += (self.normal[k] * a).max(self.normal[k] * b);
            error += self.error[k] * a.abs().max(b.abs());
        }
        sum + 1.01 * error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::Sign;
    use crate::numerics::orientation_exact;
    use crate::numerics::testing::{FAMILIES, Family, Random, points, references};

    /// Checks bounds against integers: they are never wrong, and never undecided on generic points.
    fn bounds_are_sound<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 7 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 2, &mut random);
                let plane = Hyperplane::new(points[..D].try_into().unwrap());
                let generic = matches!(family, Family::Uniform);
                assert!(plane.is_some() || !generic);
                let Some(plane) = plane else { continue };
                let side = |q: usize| {
                    let mut simplex = references(&points[..D]);
                    simplex.push(&points[q]);
                    orientation_exact(&simplex)
                };
                for (plane, turned) in [(plane, false), (plane.turned(), true)] {
                    let sides = [side(D), side(D + 1)].map(|s| if turned { -s } else { s });
                    for (q, sign) in [D, D + 1].into_iter().zip(sides) {
                        let (least, most) =
                            (plane.least_at(&points[q]), plane.most_in(&points[q], &points[q]));
                        if least > 0.0 || most < 0.0 {
                            let found = if least > 0.0 { Sign::Positive } else { Sign::Negative };
                            assert_eq!(sign, found, "{points:?}");
                        }
                        assert!(least > 0.0 || most < 0.0 || !generic, "{points:?}");
                    }
                    let (p, q) = (&points[D], &points[D + 1]);
                    let low = std::array::from_fn(|k| p[k].min(q[k]));
                    let high = std::array::from_fn(|k| p[k].max(q[k]));
                    let most = plane.most_in(&low, &high);
                    if most < 0.0 {
                        assert_eq!(sides, [Sign::Negative; 2], "{points:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn sides_agree_with_integers() {
        bounds_are_sound::<2>(3000);
        bounds_are_sound::<3>(3000);
        bounds_are_sound::<4>(1000);
        bounds_are_sound::<5>(500);
        bounds_are_sound::<8>(100);
    }
}
