//! The circumball of a simplex with a rigorous error bound: the filter of all conflict tests.

use super::cramer::{self, MAX_CRAMER, square};
use super::f64x2::Real;
use super::precise::precise_circumcenter;
use super::solve::solve;
use crate::numerics::MAX_DIM;
use crate::numerics::exact::circumcenter_exact;
use crate::numerics::lengths::{largest_magnitude, norm};
use crate::numerics::power::{TINY, UNIT, biased_exponent, power_of_two, scale_by_power};
use std::ops::RangeInclusive;

#[cfg(test)]
mod tests;

/// Circumball of a simplex. Its centre is relative to one of the vertices and scaled by a power of
/// two, so that it is as accurate for tiny and huge simplices as for others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circumball<const D: usize> {
    /// Vector (circumcentre - anchor point) / unit. If the exponent is not -1, the largest
    /// magnitude is in [2, 4) unless the exponent had to be clamped. Infinite if the centre cannot
    /// be used.
    pub center: [f64; D],
    /// Index in the simplex of the vertex that `center` is relative to. No two vertices are much
    /// nearer to each other than both are to it: it is an endpoint of the shortest edge in the sum
    /// norm, or the simplex is not [`FLAT`] at it.
    pub anchor: usize,
    /// No component of `center` is further from the exact one than this, less D + 5 units of
    /// roundoff of its length, which pay for [`Self::side`]. Infinite if the centre cannot be used.
    pub error: f64,
    /// Exponent of the unit of `center` and `error`, 2^exponent real ones, from -1000 to 1000. It
    /// is -1 if the circumradius is about 2^-70 to 2^100 ([`PLAIN_EXPONENTS`]): `center` is then
    /// twice the centre in real units.
    pub exponent: i16,
}

/// Largest relative error of a centre's largest component; a less certain centre is recomputed in
/// integers.
const ACCEPTED: f64 = 1e-9;

/// Exponent of the balls that [`Circumball::side`] need not scale.
pub(super) const PLAIN: i16 = -1;

/// Exponents of centres with the unit 2^[`PLAIN`]: their errors, 2^-51 to 2^-29 of them, are normal
/// numbers of single precision.
const PLAIN_EXPONENTS: RangeInclusive<i32> = -70..=100;

/// Largest ratio, for the first vertex to be the anchor, of the volume of a box with the lengths of
/// its edges to the volume that these span. Points near another vertex lose log2 of it in bits.
pub(super) const FLAT: f64 = 128.0;

/// Largest such ratio for an endpoint of the shortest edge to be the anchor, where only the error
/// grows.
const FLATTER: f64 = 1024.0;

/// Returns the share of the centre's length that `error` contains for [`Circumball::side`].
pub(super) const fn side_units(dim: usize) -> f64 {
    (dim + 5) as f64 * UNIT
}

impl<const D: usize> Circumball<D> {
    /// Ball of a flat simplex, or of one with a radius out of range, which decides nothing.
    pub const UNUSABLE: Self =
        Self { center: [f64::INFINITY; D], anchor: 0, error: f64::INFINITY, exponent: PLAIN };

    /// Returns the circumball of `D + 1` finite, affinely independent points. For flat simplices
    /// and those with a radius beyond 2^1030 the error and the radius are infinite and nothing is
    /// decided.
    ///
    /// No allocation and O(D^3) floating-point operations, except for nearly flat simplices and
    /// those at the ends of the exponent range, which cost microseconds.
    #[inline]
    pub fn new(points: &[&[f64; D]]) -> Self {
        Self::of(|i| points[i])
    }

    /// Returns the circumball of the points `vertex(0)` to `vertex(D)`, as [`Self::new`] does.
    #[inline(always)]
    pub fn of<'a>(vertex: impl Fn(usize) -> &'a [f64; D]) -> Self {
        const { assert!(D >= 2 && D <= MAX_DIM) };
        Self::by_cramer(&vertex, 0, FLAT).unwrap_or_else(|| Self::with_care(&vertex))
    }

    /// Returns the ball of a simplex of ordinary size and shape; `None` for others, and beyond
    /// dimension [`MAX_CRAMER`].
    #[inline(always)]
    fn by_cramer<'a>(
        vertex: &impl Fn(usize) -> &'a [f64; D],
        anchor: usize,
        flatness: f64,
    ) -> Option<Self> {
        if D > MAX_CRAMER {
            return None;
        }
        let center = cramer::circumcenter(&edges(vertex, anchor));
        if !center.is_usable(flatness) || !is_ordinary(center.diameter) {
            return None;
        }
        let error = center.error + side_units(D) * center.diameter;
        Some(Self { center: center.twice, anchor, error, exponent: PLAIN })
    }

    #[cold]
    #[inline(never)]
    fn with_care<'a>(vertex: &impl Fn(usize) -> &'a [f64; D]) -> Self {
        let points: [_; MAX_DIM + 1] = std::array::from_fn(|i| vertex(i.min(D)));
        Self::relative_to_shortest_edge(&points[..D + 1])
    }

    /// Returns the ball relative to an endpoint of the shortest edge.
    #[inline(never)]
    fn relative_to_shortest_edge(points: &[&[f64; D]]) -> Self {
        let anchor = shortest_edge(points);
        Self::by_cramer(&|i| points[i], anchor, FLATTER)
            .or_else(|| Self::in_floats(points, anchor))
            .or_else(|| Self::of_solution(anchor, precise_circumcenter(points, anchor)?))
            .unwrap_or_else(|| Self::in_integers(points, anchor))
    }

    /// Returns the ball computed in floating point; `None` if that is too inaccurate.
    #[inline]
    fn in_floats(points: &[&[f64; D]], anchor: usize) -> Option<Self> {
        let mut rows = edges(&|i| points[i], anchor);
        let exponents = rows.map(|row| biased_exponent(largest_magnitude(&row)));
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
        Self::of_solution(anchor, (solution, error, top - 1023))
    }

    /// Returns the ball with the centre x * 2^top, each component of x being known up to an error;
    /// `None` if that is too inaccurate.
    fn of_solution(anchor: usize, (solution, error, top): ([f64; D], f64, i32)) -> Option<Self> {
        let size = largest_magnitude(&solution);
        let own = biased_exponent(size) - 1023;
        let k = own + top;
        // A NaN or an infinity anywhere fails one of the comparisons.
        let usable = error <= ACCEPTED * size && own.abs() <= 900 && k.abs() < 1000;
        if !usable {
            return None;
        }
        let scale = power_of_two(-own);
        let center = solution.map(|x| x * scale);
        Some(Self::scaled(anchor, center, k, error * scale))
    }

    /// Returns the ball from the exact rational centre.
    #[cold]
    #[inline(never)]
    fn in_integers(points: &[&[f64; D]], anchor: usize) -> Self {
        let Some(exact) = circumcenter_exact(points, anchor) else { return Self::UNUSABLE };
        if exact.exponent > 1030 {
            return Self::UNUSABLE;
        }
        let k = exact.exponent.clamp(-999, 999);
        let center = exact.center.map(|x| scale_by_power(x, exact.exponent - k));
        let error = 2.0 * UNIT * largest_magnitude(&center) + 2.0 * f64::from_bits(1);
        Self::scaled(anchor, center, k as i32, error)
    }

    /// Returns the ball with the centre `half` * 2^k, every component of which is known up to
    /// `error` * 2^k, for |k| < 1000 and no component of `half` beyond 2^32.
    fn scaled(anchor: usize, half: [f64; D], k: i32, error: f64) -> Self {
        let shift = if PLAIN_EXPONENTS.contains(&k) { k } else { 0 };
        let factor = 2.0 * power_of_two(shift);
        let center = half.map(|x| x * factor);
        let error = error * factor + side_units(D) * norm(&center);
        Self { center, anchor, error, exponent: PLAIN + (k - shift) as i16 }
    }

    /// Returns the number of real units per unit of `center`.
    #[inline]
    pub fn unit(&self) -> f64 {
        power_of_two(i32::from(self.exponent))
    }

    /// Returns the circumradius in real units, within 1e-8 relatively if `error` is finite;
    /// infinite if it exceeds `f64::MAX`.
    #[inline]
    pub fn radius(&self) -> f64 {
        match self.exponent {
            PLAIN => 0.5 * square(&self.center).sqrt(),
            _ => scale_by_power(norm(&self.center), i64::from(self.exponent)),
        }
    }

    /// Returns true if `q` is strictly inside the ball and false if strictly outside, as far as
    /// floating-point arithmetic with an error bound can tell; `None` if undecided (ask
    /// [`in_ball`](super::in_ball)). `anchor_point` is the vertex that `anchor` names.
    ///
    /// With w = (q - anchor) / unit / 2 and C the centre, inside is w.(w - C) < 0. All error terms
    /// are multiples of w, so points of a tiny cluster around the anchor are told apart even by a
    /// huge ball.
    #[inline]
    pub fn side(&self, anchor_point: &[f64; D], q: &[f64; D]) -> Option<bool> {
        if self.exponent == PLAIN {
            let w = std::array::from_fn(|i| q[i] - anchor_point[i]);
            let side = side_of(w, &self.center, self.error);
            if side.is_some() {
                return side;
            }
        }
        self.rare_side(anchor_point, q)
    }

    /// Returns the side for balls of an unusual size and for points that are far away.
    #[cold]
    #[inline(never)]
    fn rare_side(&self, anchor_point: &[f64; D], q: &[f64; D]) -> Option<bool> {
        let scale = power_of_two(-1 - i32::from(self.exponent));
        let scaled = std::array::from_fn(|i| (q[i] - anchor_point[i]) * scale);
        side_of(scaled, &self.center, self.error).or_else(|| self.is_far(&scaled).then_some(false))
    }

    /// Returns the approximate power of `q` with respect to the ball, in real units; may be
    /// infinite or NaN.
    #[inline]
    pub fn power(&self, anchor_point: &[f64; D], q: &[f64; D]) -> f64 {
        let double = 2.0 * self.unit();
        (0..D).fold(0.0, |power, i| {
            let w = q[i] - anchor_point[i];
            power + w * (w - self.center[i] * double)
        })
    }

    /// Returns true if a point is so far from the anchor that its square may have overflowed. Then
    /// it is outside: no usable scaled centre exceeds 2^102.
    fn is_far(&self, w: &[f64; D]) -> bool {
        const FAR: f64 = power_of_two(500);
        // Infinite differences of finite points are at least 2^1023: far unless the unit is huge.
        self.error < FAR && self.exponent < 500 && w.iter().any(|x| x.abs() >= FAR)
    }

    /// Returns the distance of the unrounded circumcentre from `x`; NaN or infinite if out of
    /// range.
    #[inline]
    pub fn center_distance(&self, anchor_point: &[f64; D], x: &[f64; D]) -> f64 {
        let unit = self.unit();
        let offset: [f64; D] =
            std::array::from_fn(|i| (anchor_point[i] - x[i]) + self.center[i] * unit);
        norm(&offset)
    }

    /// Returns the circumcentre in real coordinates, rounded; not finite where it overflows or
    /// `error` is infinite, which the caller checks.
    #[inline]
    pub fn center_point(&self, anchor_point: &[f64; D]) -> [f64; D] {
        let unit = self.unit();
        std::array::from_fn(|i| anchor_point[i] + self.center[i] * unit)
    }
}

/// Returns the side of w, scaled, of a ball with this `center` and `error`.
///
/// Proof of the bound. Let p = w.(w - C) for the exact w and C, u the roundoff. Beside what the
/// error of C makes of it, error |w|_1, the computed p is wrong by at most
/// (D + 2)u |w||w - C| + u |w|^2: each product carries the roundings of w, of w - C, its own
/// and D - 1 sums, and w is rounded in w - C too. If p <= 0, w is in the ball and both |w| and
/// |w - C| are at most
/// |C|: that is within (D + 3)u |C||w|_1, and two more units pay for the roundings in the
/// bound; so a computed p beyond the bound is not so. If p > 0 and the computed one is less
/// than -bound, its error exceeds p + (D + 5)u |C||w|. Now |w|^2 + |w - C|^2 = |C|^2 + 2p, so
/// for p <= |C|^2 both are at most |C| + p/|C| <= 2|C| and the error at most (D + 3)u |w|
/// (|C| + p/|C|) <= (D + 3)u |C||w| + 2(D + 3)u p; for p > |C|^2 it is at most (D + 3)u 3p:
/// less in both cases. TINY pays for underflow. With overflow p or the bound is infinite: an
/// infinite p with a finite bound is right, as p is less than the square of a length that
/// overflows only far away.
#[inline(always)]
pub(super) fn side_of<const D: usize>(w: [f64; D], center: &[f64; D], error: f64) -> Option<bool> {
    let terms: [f64; D] = std::array::from_fn(|i| w[i] * (w[i] - center[i]));
    let power = terms[1..].iter().fold(terms[0], |power, x| power + x);
    let sum = w[1..].iter().fold(w[0].abs(), |sum, x| sum + x.abs());
    // False if anything is NaN.
    let is_decided = power.abs() > error * sum + TINY;
    is_decided.then_some(power < 0.0)
}

/// Diameters of balls with the unit 2^[`PLAIN`].
const ORDINARY: RangeInclusive<f64> =
    power_of_two(*PLAIN_EXPONENTS.start())..=power_of_two(*PLAIN_EXPONENTS.end());

#[inline(always)]
pub(super) fn is_ordinary<R: Real>(diameter: R) -> bool {
    R::of(*ORDINARY.start()).is_at_most(diameter) && diameter.is_at_most(R::of(*ORDINARY.end()))
}

/// Returns the edges from the anchor to the other vertices.
#[inline(always)]
fn edges<'a, const D: usize>(
    vertex: &impl Fn(usize) -> &'a [f64; D],
    anchor: usize,
) -> [[f64; D]; D] {
    let origin = vertex(anchor);
    std::array::from_fn(|r| {
        let end = vertex(r + usize::from(r >= anchor));
        std::array::from_fn(|i| end[i] - origin[i])
    })
}

/// Returns the first endpoint of the shortest edge in the sum norm, the lowest among lengths within
/// 8 ulps. The bits of positive doubles sort as they do: the index occupies the lowest three, and
/// the minimum needs no branch.
#[inline]
fn shortest_edge<const D: usize>(points: &[&[f64; D]]) -> usize {
    let mut shortest = u64::MAX;
    for i in 0..D {
        for j in i + 1..=D {
            let length = (0..D).fold(0.0, |sum, k| sum + (points[i][k] - points[j][k]).abs());
            shortest = shortest.min(length.to_bits() & !7 | i as u64);
        }
    }
    (shortest & 7) as usize
}
