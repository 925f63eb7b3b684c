//! The circumball of a simplex with a rigorous error bound: the filter of all conflict tests.

use super::exact::circumcenter_exact;
use super::length::norm;
use super::power::{TINY, UNIT, biased_exponent, power_of_two, scale_by_power};
use super::solve::solve;

/// The circumball of a simplex, its centre relative to one of the vertices and scaled by a power
/// of two, so that tiny and huge simplices are told apart from their neighbours alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circumball<const D: usize> {
    /// Index in the simplex of the vertex that `center` is relative to: an endpoint of the
    /// shortest edge in the sum norm (which is the Euclidean one within a factor sqrt(D)).
    pub anchor: u8,
    /// 2^-k, k in -1000..=1000: of scaled units, per real unit.
    pub scale: f64,
    /// (circumcentre - anchor point) * scale. The largest magnitude is in [1, 2) unless k had to be
    /// clamped.
    pub center: [f64; D],
    /// No component of `center` is further from the exact one than this, and it is at least 16
    /// units of roundoff of the largest component; infinite if the centre cannot be used.
    pub error: f64,
    /// The circumradius in real units, within 1e-8 relatively if `error` is finite; infinite if it
    /// exceeds `f64::MAX`.
    pub radius: f64,
}

/// A centre whose largest component is not known better than this, relatively, is recomputed in
/// integers.
const ACCEPTED: f64 = 1e-9;

/// The floor of `error` in terms of the largest component: pays for the roundings of
/// [`Circumball::side`].
const FLOOR: f64 = 16.0 * UNIT;

impl<const D: usize> Circumball<D> {
    /// The circumball of `D + 1` finite, affinely independent points. For flat simplices and those
    /// with a radius beyond 2^1030 the error and the radius are infinite and nothing is decided.
    ///
    /// No allocation and O(D^3) floating-point operations, except for nearly flat simplices and
    /// those at the ends of the exponent range, which cost microseconds.
    #[inline]
    pub fn new(points: &[&[f64; D]]) -> Self {
        const { assert!(D >= 2 && D <= 8) };
        let points = &points[..D + 1];
        let anchor = shortest_edge(points);
        match Self::in_floats(points, anchor) {
            Some(ball) => ball,
            None => Self::in_integers(points, anchor),
        }
    }

    /// The ball by floating-point arithmetic; `None` if that is too inaccurate.
    #[inline]
    fn in_floats(points: &[&[f64; D]], anchor: usize) -> Option<Self> {
        let mut rows = [[0.0; D]; D];
        let mut exponents = [0; D];
        for (r, row) in rows.iter_mut().enumerate() {
            let (p, origin) = (points[r + usize::from(r >= anchor)], points[anchor]);
            *row = std::array::from_fn(|i| p[i] - origin[i]);
            exponents[r] = biased_exponent(row.iter().fold(0.0, |m: f64, x| m.max(x.abs())));
        }
        let top = exponents.iter().fold(0, |m, e| m.max(*e));
        let bottom = exponents.iter().fold(2047, |m, e| m.min(*e));
        if bottom < 1 || top > 2045 || top - bottom > 900 {
            return None;
        }
        // 2 v.c = |v|^2 with v = row * 2^e and c = x * 2^top.
        let mut right = [0.0; D];
        for (r, row) in rows.iter_mut().enumerate() {
            let scale = power_of_two(1023 - exponents[r]);
            row.iter_mut().for_each(|x| *x *= scale);
            let square = row.iter().fold(0.0, |sum, x| sum + *x * *x);
            right[r] = square * power_of_two(exponents[r] - top - 1);
        }
        let (solution, error) = solve(&rows, &right);
        let size = solution.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let own = biased_exponent(size) - 1023;
        let k = own + top - 1023;
        // A NaN or an infinity anywhere fails one of the comparisons.
        let usable = error <= ACCEPTED * size && own.abs() <= 900 && k.abs() <= 1000;
        if !usable {
            return None;
        }
        let scale = power_of_two(-own);
        let center = solution.map(|x| x * scale);
        let square = center.iter().fold(0.0, |sum, x| sum + *x * *x);
        Some(Self {
            anchor: anchor as u8,
            scale: power_of_two(-k),
            center,
            error: (error.max(FLOOR * size)) * scale,
            radius: square.sqrt() * power_of_two(k),
        })
    }

    /// The ball from the exact rational centre.
    #[cold]
    #[inline(never)]
    fn in_integers(points: &[&[f64; D]], anchor: usize) -> Self {
        let unusable = Self {
            anchor: anchor as u8,
            scale: 1.0,
            center: [f64::NAN; D],
            error: f64::INFINITY,
            radius: f64::INFINITY,
        };
        let Some(exact) = circumcenter_exact(points, anchor) else { return unusable };
        if exact.exponent > 1030 {
            return unusable;
        }
        let k = exact.exponent.clamp(-1000, 1000);
        let center = exact.center.map(|x| scale_by_power(x, exact.exponent - k));
        let size = center.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        Self {
            anchor: anchor as u8,
            scale: power_of_two(-k as i32),
            center,
            error: FLOOR * size,
            radius: scale_by_power(norm(&exact.center), exact.exponent),
        }
    }

    /// Whether `q` is strictly inside the ball, as far as floating-point arithmetic with an error
    /// bound can tell: `Some(true)` strictly inside, `Some(false)` strictly outside, `None`
    /// undecided (ask [`in_ball`](super::in_ball)). `anchor_point` is the vertex that `anchor`
    /// names.
    ///
    /// With w = (q - anchor) * scale, inside is |w|^2 - 2 w.c < 0. All error terms are multiples of
    /// w, so points of a tiny cluster around the anchor are told apart even by a huge ball.
    #[inline]
    pub fn side(&self, anchor_point: &[f64; D], q: &[f64; D]) -> Option<bool> {
        let (mut square, mut product, mut sum) = (0.0, 0.0, 0.0);
        for i in 0..D {
            let w = (q[i] - anchor_point[i]) * self.scale;
            square += w * w;
            product += w * self.center[i];
            sum += w.abs();
        }
        let power = square - 2.0 * product;
        // Roundings: at most (D + 3)u |w|^2 and 2(D + 2)u |w|_1 |c|_max <= 1.25 error |w|_1, beside
        // the centre's own 2 error |w|_1; the constant pays for underflow. With overflow or an
        // unusable centre the bound is infinite or NaN and nothing is decided.
        let bound = 4.0 * self.error * sum + 16.0 * UNIT * square + TINY;
        if power > bound {
            Some(false)
        } else if power < -bound {
            Some(true)
        } else {
            None
        }
    }

    /// The circumcentre in real coordinates, rounded; not finite where it overflows or `error` is
    /// infinite, which the caller checks.
    #[inline]
    pub fn center_point(&self, anchor_point: &[f64; D]) -> [f64; D] {
        let real = 1.0 / self.scale;
        std::array::from_fn(|i| anchor_point[i] + self.center[i] * real)
    }
}

/// The first endpoint of the shortest edge in the sum norm.
#[inline]
fn shortest_edge<const D: usize>(points: &[&[f64; D]]) -> usize {
    let mut shortest = f64::INFINITY;
    let mut endpoint = 0;
    for i in 0..D {
        for j in i + 1..=D {
            let length = (0..D).fold(0.0, |sum, k| sum + (points[i][k] - points[j][k]).abs());
            if length < shortest {
                (shortest, endpoint) = (length, i);
            }
        }
    }
    endpoint
}
