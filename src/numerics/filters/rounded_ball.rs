//! A circumball as a complex keeps it: in single precision, half as large as [`Circumball`]. Most
//! conflict tests need no more, and what they leave open goes to the points themselves.

use super::circumball::{Circumball, FLAT, PLAIN, is_ordinary, side_of, side_units};
use super::cramer::{self, MAX_CRAMER, square};
use super::f64x2::{F64x2, Real};
use crate::numerics::lengths::norm;
use crate::numerics::power::power_of_two;

/// Circumball of a simplex in single precision, no smaller than it is: 16 bytes in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundedBall<const D: usize> {
    center: [f32; D],
    precision: Precision,
}

/// Factor of a centre before it is rounded to single precision, so that no component comes out
/// nearer to the anchor.
const OUTWARD: f64 = 1.0 + power_of_two(-24) + power_of_two(-29);

/// Largest error of a component that [`OUTWARD`] and rounding make, relative to the centre's
/// length: 2^-24 each, and a little more.
const ROUNDING: f64 = power_of_two(-23) + power_of_two(-27);

impl<const D: usize> RoundedBall<D> {
    /// Stands in the place of a ball where there is none.
    pub const NONE: Self = Self { center: [f32::INFINITY; D], precision: Precision::NONE };

    /// Returns `ball` in single precision. Its radius is no smaller, and at most 2^-22 of itself
    /// larger.
    pub fn new(ball: &Circumball<D>) -> Self {
        let error = ball.error + ROUNDING * norm(&ball.center);
        Self {
            center: ball.center.map(|x| (x * OUTWARD) as f32),
            precision: Precision::new(error, ball.exponent, ball.anchor),
        }
    }

    /// Returns the balls of the points `first(0)` to `first(D)` and `second(0)` to `second(D)`, in
    /// less than twice the time of one; `None` unless both simplices have an ordinary size and
    /// shape.
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
        let error = centers.error + F64x2::of(side_units(D) + ROUNDING) * centers.diameter;
        let outward = centers.twice.map(|x| (x * F64x2::of(OUTWARD)).get());
        let [first, second] = std::array::from_fn(|lane| Self {
            center: outward.map(|x| x[lane] as f32),
            precision: Precision::new(error.get()[lane], PLAIN, 0),
        });
        Some([first, second])
    }

    /// Returns the ball as it is kept; `None` for [`Self::NONE`].
    #[inline(always)]
    pub fn ball(&self) -> Option<Circumball<D>> {
        self.is_ball().then(|| Circumball {
            center: self.center.map(f64::from),
            anchor: self.precision.anchor(),
            error: self.precision.error(),
            exponent: self.precision.exponent(),
        })
    }

    /// Returns false for [`Self::NONE`].
    #[inline(always)]
    pub fn is_ball(&self) -> bool {
        self.precision != Precision::NONE
    }

    /// Returns the side of the ball of the points `vertex(0)` to `vertex(D)` that `q` is on, as
    /// [`Circumball::side`] does; `None` for [`Self::NONE`], too.
    #[inline(always)]
    pub fn side<'a>(&self, vertex: impl Fn(usize) -> &'a [f64; D], q: &[f64; D]) -> Option<bool> {
        if self.precision.is_plain() {
            let origin = vertex(0);
            let w = std::array::from_fn(|i| q[i] - origin[i]);
            let center = self.center.map(f64::from);
            let side = side_of(w, &center, self.precision.plain_error());
            if side.is_some() {
                return side;
            }
        }
        match self.is_ball() {
            true => self.rare_side(vertex(self.precision.anchor()), q),
            false => None,
        }
    }

    #[cold]
    #[inline(never)]
    fn rare_side(&self, anchor_point: &[f64; D], q: &[f64; D]) -> Option<bool> {
        self.ball()?.side(anchor_point, q)
    }

    /// Returns the circumradius in real units, or a little more, 2^-22 of itself at most; `None`
    /// for [`Self::NONE`].
    #[inline(always)]
    pub fn radius(&self) -> Option<f64> {
        match self.precision.is_plain() {
            true => Some(0.5 * square(&self.center.map(f64::from)).sqrt()),
            false => self.rare_radius(),
        }
    }

    #[cold]
    #[inline(never)]
    fn rare_radius(&self) -> Option<f64> {
        self.ball().map(|ball| ball.radius())
    }
}

/// Error bound, anchor and exponent in four bytes: a positive number of single precision with the
/// anchor and with the exponent, less [`PLAIN`], in place of its last bits.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Precision(u32);

impl Precision {
    const EXPONENT_BITS: u32 = 11;
    const EXPONENT: u32 = (1 << Self::EXPONENT_BITS) - 1;
    const ANCHOR_BITS: u32 = 4;
    const ANCHOR: u32 = (1 << Self::ANCHOR_BITS) - 1;
    /// Bits that are not the error's.
    const OTHERS: u32 = (1 << (Self::EXPONENT_BITS + Self::ANCHOR_BITS)) - 1;

    /// Infinite error, and an anchor that no simplex has.
    const NONE: Self = Self(f32::INFINITY.to_bits() | Self::OTHERS);

    /// Packs an error, rounded up by 2^-7 of itself at most (by 2^-133 if it is less than 2^-126),
    /// an exponent from -1000 to 1000, and an anchor.
    #[inline(always)]
    fn new(error: f64, exponent: i16, anchor: usize) -> Self {
        let above = ((error as f32).to_bits() | Self::OTHERS) + 1;
        let error = above.min(f32::INFINITY.to_bits());
        let exponent = (exponent - PLAIN) as u32 & Self::EXPONENT;
        Self(error | (anchor as u32) << Self::EXPONENT_BITS | exponent)
    }

    /// Returns true if the exponent is the plain one, and the anchor the first vertex.
    #[inline(always)]
    fn is_plain(self) -> bool {
        self.0 & Self::OTHERS == 0
    }

    /// Returns the error of a precision that is plain.
    #[inline(always)]
    fn plain_error(self) -> f64 {
        f64::from(f32::from_bits(self.0))
    }

    #[inline(always)]
    fn error(self) -> f64 {
        f64::from(f32::from_bits(self.0 & !Self::OTHERS))
    }

    #[inline(always)]
    fn anchor(self) -> usize {
        (self.0 >> Self::EXPONENT_BITS & Self::ANCHOR) as usize
    }

    #[inline(always)]
    fn exponent(self) -> i16 {
        let unused = 32 - Self::EXPONENT_BITS;
        PLAIN + ((self.0 << unused) as i32 >> unused) as i16
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, points, references};

    /// A rounded ball holds all that the ball holds, and hardly more; its error says so too.
    #[test]
    fn balls_are_rounded_outward() {
        fn check<const D: usize>() {
            let mut random = Random(D as u64);
            let mut usable = 0;
            for family in FAMILIES {
                for trial in 0..400 {
                    let simplex = points::<D>(family, D + 1, &mut random);
                    let ball = Circumball::new(&references(&simplex));
                    let rounded = RoundedBall::new(&ball).ball().expect("it is one");
                    assert_eq!(rounded.anchor, ball.anchor, "{family:?} {trial}");
                    assert_eq!(rounded.exponent, ball.exponent, "{family:?} {trial}");
                    if ball.error == f64::INFINITY {
                        assert_eq!(rounded.radius(), f64::INFINITY, "{family:?} {trial}");
                        continue;
                    }
                    usable += 1;
                    let least = norm(&ball.center) * power_of_two(-60);
                    for (component, exact) in rounded.center.iter().zip(ball.center) {
                        let distance = (component - exact).abs();
                        assert!(distance <= rounded.error - ball.error, "{family:?} {trial}");
                        assert!(component.abs() >= exact.abs() - least, "{family:?} {trial}");
                    }
                    let radius = RoundedBall::new(&ball).radius().expect("it is one");
                    assert_eq!(radius, rounded.radius(), "{family:?} {trial}");
                    let exact = ball.radius();
                    let most = exact * (1.0 + power_of_two(-22));
                    assert!((exact..=most).contains(&radius), "{family:?} {radius:e} {exact:e}");
                }
            }
            assert!(usable > 2000, "{usable}");
        }
        check::<2>();
        check::<3>();
        check::<8>();
    }

    #[test]
    fn errors_anchors_and_exponents_are_packed() {
        let mut random = Random(12);
        for trial in 0..2000 {
            let error = random.unit().abs() * 2f64.powi(random.integer(-140, 140) as i32);
            let exponent = if trial % 2 == 0 { PLAIN } else { random.integer(-1000, 1000) as i16 };
            let anchor = random.integer(-8, 8).max(0) as usize;
            let precision = Precision::new(error, exponent, anchor);
            assert_eq!((precision.exponent(), precision.anchor()), (exponent, anchor));
            let most = if error < 2f64.powi(127) {
                error * (1.0 + 2f64.powi(-7)) + 2f64.powi(-133)
            } else {
                f64::INFINITY
            };
            assert!((error..=most).contains(&precision.error()), "{error:e} {precision:?}");
            assert_eq!(precision.is_plain(), exponent == PLAIN && anchor == 0);
            assert!(!precision.is_plain() || precision.plain_error() == precision.error());
        }
        for exponent in [-1000, PLAIN, 1000] {
            for error in [f64::INFINITY, f64::MAX, f64::from(f32::MAX)] {
                let precision = Precision::new(error, exponent, 8);
                assert_eq!(precision.error(), f64::INFINITY);
                assert_ne!(precision, Precision::NONE);
            }
            assert!(Precision::new(0.0, exponent, 0).error() < 2f64.powi(-133));
        }
        assert_eq!([size_of::<RoundedBall<2>>(), size_of::<RoundedBall<3>>()], [12, 16]);
        let none = RoundedBall::<3>::NONE;
        assert!(!none.is_ball() && none.ball().is_none() && none.radius().is_none());
        let vertex = |_| -> &[f64; 3] { unreachable!("there is none") };
        assert_eq!(none.side(vertex, &[0.0; 3]), None);
    }
}
