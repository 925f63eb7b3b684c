//! The circumball of a simplex with a rigorous error bound: the filter of all conflict tests.

use super::cramer::{self, MAX_CRAMER, square};
use super::f64x2::{F64x2, Real};
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
/// two, so that it is as accurate for tiny and huge simplices as for others. It takes half a cache
/// line in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circumball<const D: usize> {
    /// Vector (circumcentre - anchor point) / unit. If the exponent is not -1, the largest
    /// magnitude is in [2, 4) unless the exponent had to be clamped. Infinite if the centre cannot
    /// be used.
    pub center: [f64; D],
    /// Vertex that `center` is relative to, as its index in the simplex. A caller may put an id of
    /// its own in place of the index ([`Self::anchored`]). No two vertices are much nearer to each
    /// other than both are to the anchor: it is an endpoint of the shortest edge in the sum norm,
    /// or the simplex is not [`FLAT`] at it.
    pub anchor: u32,
    precision: Precision,
}

/// Largest relative error of a centre's largest component; a less certain centre is recomputed in
/// integers.
const ACCEPTED: f64 = 1e-9;

/// Exponent of the balls that [`Circumball::side`] need not scale.
const PLAIN: i16 = -1;

/// Exponents of centres with the unit 2^[`PLAIN`]: their errors, 2^-51 to 2^-29 of them, are normal
/// numbers of single precision.
const PLAIN_EXPONENTS: RangeInclusive<i32> = -70..=100;

/// Largest ratio, for the first vertex to be the anchor, of the volume of a box with the lengths of
/// its edges to the volume that these span. Points near another vertex lose log2 of it in bits.
const FLAT: f64 = 128.0;

/// Largest such ratio for an endpoint of the shortest edge to be the anchor, where only the error
/// grows.
const FLATTER: f64 = 1024.0;

/// Returns the share of the centre's length that `error` contains for [`Circumball::side`].
const fn side_units(dim: usize) -> f64 {
    (dim + 5) as f64 * UNIT
}

impl<const D: usize> Circumball<D> {
    /// Ball of a flat simplex, or of one with a radius out of range, which decides nothing.
    pub const UNUSABLE: Self =
        Self { center: [f64::INFINITY; D], anchor: 0, precision: Precision::NONE };

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

    /// Returns the circumballs of two simplices, in less than twice the time of one; `None` unless
    /// both simplices have an ordinary size and shape.
    #[inline(always)]
    pub fn ordinary_pair<'a>(
        first: impl Fn(usize) -> &'a [f64; D],
        second: impl Fn(usize) -> &'a [f64; D],
    ) -> Option<[Self; 2]> {
        if D > MAX_CRAMER {
            return None;
        }
        let both = |i: usize, k: usize| F64x2::new(first(i)[k], second(i)[k]);
        let origin: [F64x2; D] = std::array::from_fn(|k| both(0, k));
        let edge = |r| std::array::from_fn(|k| both(r + 1, k) - origin[k]);
        let centers = cramer::circumcenter(&std::array::from_fn(edge));
        if !centers.is_usable(FLAT) || !is_ordinary(centers.diameter) {
            return None;
        }
        let error = (centers.error + F64x2::of(side_units(D)) * centers.diameter).get();
        let [first, second] = std::array::from_fn(|lane| Self {
            center: centers.twice.map(|x| x.get()[lane]),
            anchor: 0,
            precision: Precision::plain(error[lane]),
        });
        Some([first, second])
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
        let precision = Precision::plain(center.error + side_units(D) * center.diameter);
        Some(Self { center: center.twice, anchor: anchor as u32, precision })
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
        let precision = Precision::new(error, PLAIN + (k - shift) as i16);
        Self { center, anchor: anchor as u32, precision }
    }

    /// Returns the ball with `anchor` as the id of its anchor.
    #[inline]
    pub const fn anchored(self, anchor: u32) -> Self {
        Self { anchor, ..self }
    }

    /// Returns the error: no component of `center` is further from the exact one than this, less
    /// D + 5 units of roundoff of its length, which pay for [`Self::side`]. Infinite if the centre
    /// cannot be used.
    #[inline]
    pub fn error(&self) -> f64 {
        self.precision.error()
    }

    /// Returns the exponent of the unit of `center` and `error`, 2^exponent real ones, from -1000
    /// to 1000. It is -1 if the circumradius is about 2^-70 to 2^100 ([`PLAIN_EXPONENTS`]):
    /// `center` is then twice the centre in real units.
    #[inline]
    pub fn exponent(&self) -> i16 {
        self.precision.exponent()
    }

    /// Returns the number of real units per unit of `center`.
    #[inline]
    pub fn unit(&self) -> f64 {
        power_of_two(i32::from(self.exponent()))
    }

    /// Returns the circumradius in real units, within 1e-8 relatively if `error` is finite;
    /// infinite if it exceeds `f64::MAX`.
    #[inline]
    pub fn radius(&self) -> f64 {
        match self.precision.is_plain() {
            true => 0.5 * square(&self.center).sqrt(),
            false => scale_by_power(norm(&self.center), i64::from(self.exponent())),
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
        if self.precision.is_plain() {
            let w = std::array::from_fn(|i| q[i] - anchor_point[i]);
            let side = self.side_of(w, self.precision.plain_error());
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
        let scale = power_of_two(-1 - i32::from(self.exponent()));
        let scaled = std::array::from_fn(|i| (q[i] - anchor_point[i]) * scale);
        self.side_of(scaled, self.error()).or_else(|| self.is_far(&scaled).then_some(false))
    }

    /// Returns the side of w, scaled, of a ball with this `error`.
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
    fn side_of(&self, w: [f64; D], error: f64) -> Option<bool> {
        let terms: [f64; D] = std::array::from_fn(|i| w[i] * (w[i] - self.center[i]));
        let power = terms[1..].iter().fold(terms[0], |power, x| power + x);
        let sum = w[1..].iter().fold(w[0].abs(), |sum, x| sum + x.abs());
        // False if anything is NaN.
        let is_decided = power.abs() > error * sum + TINY;
        is_decided.then_some(power < 0.0)
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
        self.error() < FAR && self.exponent() < 500 && w.iter().any(|x| x.abs() >= FAR)
    }

    /// Returns the circumcentre in real coordinates, rounded; not finite where it overflows or
    /// `error` is infinite, which the caller checks.
    #[inline]
    pub fn center_point(&self, anchor_point: &[f64; D]) -> [f64; D] {
        let unit = self.unit();
        std::array::from_fn(|i| anchor_point[i] + self.center[i] * unit)
    }
}

/// Diameters of balls with the unit 2^[`PLAIN`].
const ORDINARY: RangeInclusive<f64> =
    power_of_two(*PLAIN_EXPONENTS.start())..=power_of_two(*PLAIN_EXPONENTS.end());

#[inline(always)]
fn is_ordinary<R: Real>(diameter: R) -> bool {
    R::of(*ORDINARY.start()).is_at_most(diameter) && diameter.is_at_most(R::of(*ORDINARY.end()))
}

/// Error bound and exponent in four bytes: a positive number of single precision with the exponent,
/// less [`PLAIN`], in place of its last bits.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Precision(u32);

impl Precision {
    const EXPONENT_BITS: u32 = 11;
    const EXPONENT: u32 = (1 << Self::EXPONENT_BITS) - 1;

    /// Infinite error.
    const NONE: Self = Self(f32::INFINITY.to_bits());

    /// Packs an error, rounded up by 2^-11 of itself at most (of 2^-126 if it is less), and an
    /// exponent from -1000 to 1000.
    #[inline]
    fn new(error: f64, exponent: i16) -> Self {
        let nearest = (error as f32).to_bits() & !Self::EXPONENT;
        let above = (nearest + Self::EXPONENT + 1).min(Self::NONE.0);
        Self(above | (exponent - PLAIN) as u32 & Self::EXPONENT)
    }

    /// Packs an error below 2^127 with the plain exponent, as [`Self::new`] does.
    #[inline]
    fn plain(error: f64) -> Self {
        debug_assert!(error < power_of_two(127));
        Self(((error as f32).to_bits() | Self::EXPONENT) + 1)
    }

    #[inline]
    fn is_plain(self) -> bool {
        self.0 & Self::EXPONENT == 0
    }

    /// Returns the error of a precision with the plain exponent.
    #[inline]
    fn plain_error(self) -> f64 {
        f64::from(f32::from_bits(self.0))
    }

    #[inline]
    fn error(self) -> f64 {
        f64::from(f32::from_bits(self.0 & !Self::EXPONENT))
    }

    #[inline]
    fn exponent(self) -> i16 {
        let unused = 32 - Self::EXPONENT_BITS;
        PLAIN + ((self.0 << unused) as i32 >> unused) as i16
    }
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
