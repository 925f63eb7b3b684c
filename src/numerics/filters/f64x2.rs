//! Formulas for one double, or for two side by side, which a processor computes in the same time.
//! Both give the same bits, since every operation is rounded as IEEE 754 says.

use std::ops::{Add, Div, Mul, Sub};

/// Number that a formula computes with: one double, or two side by side.
pub(crate) trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn of(value: f64) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// Returns the lesser of two; the second if either is NaN.
    fn min(self, other: Self) -> Self;
    /// Returns the greater of two; the second if either is NaN.
    fn max(self, other: Self) -> Self;
    /// Returns true if the number is at most `other`; false if either is NaN. For two doubles side
    /// by side the comparison must hold for both.
    fn is_at_most(self, other: Self) -> bool;
}

impl Real for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn is_at_most(self, other: Self) -> bool {
        self <= other
    }
}

/// Two doubles side by side.
#[derive(Clone, Copy)]
pub(crate) struct F64x2(lanes::Lanes);

impl F64x2 {
    #[inline(always)]
    pub fn new(first: f64, second: f64) -> Self {
        Self(lanes::new(first, second))
    }

    /// Returns the second and the first.
    #[inline(always)]
    pub fn swapped(self) -> Self {
        Self(lanes::second_and_first(self.0, self.0))
    }

    /// Returns the firsts of two pairs.
    #[inline(always)]
    pub fn firsts(self, other: Self) -> Self {
        Self(lanes::firsts(self.0, other.0))
    }

    /// Returns the seconds of two pairs.
    #[inline(always)]
    pub fn seconds(self, other: Self) -> Self {
        Self(lanes::seconds(self.0, other.0))
    }

    /// Returns the first of this pair and the second of another one.
    #[inline(always)]
    pub fn first_and_second(self, other: Self) -> Self {
        Self(lanes::first_and_second(self.0, other.0))
    }

    #[inline(always)]
    pub fn get(self) -> [f64; 2] {
        lanes::get(self.0)
    }
}

impl Real for F64x2 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::new(value, value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(lanes::sqrt(self.0))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(lanes::abs(self.0))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(lanes::min(self.0, other.0))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(lanes::max(self.0, other.0))
    }

    #[inline(always)]
    fn is_at_most(self, other: Self) -> bool {
        lanes::are_at_most(self.0, other.0)
    }
}

macro_rules! by_lane {
    ($operation:ident, $name:ident) => {
        impl $operation for F64x2 {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(lanes::$name(self.0, other.0))
            }
        }
    };
}

by_lane!(Add, add);
by_lane!(Sub, sub);
by_lane!(Mul, mul);
by_lane!(Div, div);

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod lanes {
    use std::arch::x86_64 as arch;
    pub use std::arch::x86_64::__m128d as Lanes;

    macro_rules! intrinsic {
        ($name:ident, ($($lanes:ident),+), $($intrinsic:tt)+) => {
            #[inline(always)]
            pub fn $name($($lanes: Lanes),+) -> Lanes {
                // SAFETY: every x86_64 has SSE2, which is all that is asked for.
                unsafe { arch::$($intrinsic)+($($lanes),+) }
            }
        };
    }

    intrinsic!(add, (a, b), _mm_add_pd);
    intrinsic!(sub, (a, b), _mm_sub_pd);
    intrinsic!(mul, (a, b), _mm_mul_pd);
    intrinsic!(div, (a, b), _mm_div_pd);
    intrinsic!(min, (a, b), _mm_min_pd);
    intrinsic!(max, (a, b), _mm_max_pd);
    intrinsic!(sqrt, (a), _mm_sqrt_pd);
    intrinsic!(firsts, (a, b), _mm_unpacklo_pd);
    intrinsic!(seconds, (a, b), _mm_unpackhi_pd);
    intrinsic!(first_and_second, (a, b), _mm_shuffle_pd::<2>);
    intrinsic!(second_and_first, (a, b), _mm_shuffle_pd::<1>);

    #[inline(always)]
    pub fn new(first: f64, second: f64) -> Lanes {
        // SAFETY: as above.
        unsafe { arch::_mm_set_pd(second, first) }
    }

    #[inline(always)]
    pub fn get(lanes: Lanes) -> [f64; 2] {
        // SAFETY: as above.
        unsafe {
            [arch::_mm_cvtsd_f64(lanes), arch::_mm_cvtsd_f64(arch::_mm_unpackhi_pd(lanes, lanes))]
        }
    }

    #[inline(always)]
    pub fn abs(lanes: Lanes) -> Lanes {
        // SAFETY: as above.
        unsafe { arch::_mm_andnot_pd(arch::_mm_set1_pd(-0.0), lanes) }
    }

    #[inline(always)]
    pub fn are_at_most(a: Lanes, b: Lanes) -> bool {
        // SAFETY: as above.
        unsafe { arch::_mm_movemask_pd(arch::_mm_cmple_pd(a, b)) == 3 }
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod lanes {
    pub type Lanes = [f64; 2];

    #[inline(always)]
    pub fn new(first: f64, second: f64) -> Lanes {
        [first, second]
    }

    #[inline(always)]
    pub fn get(lanes: Lanes) -> [f64; 2] {
        lanes
    }

    #[inline(always)]
    pub fn firsts(a: Lanes, b: Lanes) -> Lanes {
        [a[0], b[0]]
    }

    #[inline(always)]
    pub fn seconds(a: Lanes, b: Lanes) -> Lanes {
        [a[1], b[1]]
    }

    #[inline(always)]
    pub fn first_and_second(a: Lanes, b: Lanes) -> Lanes {
        [a[0], b[1]]
    }

    #[inline(always)]
    pub fn second_and_first(a: Lanes, b: Lanes) -> Lanes {
        [a[1], b[0]]
    }

    #[inline(always)]
    pub fn sqrt(lanes: Lanes) -> Lanes {
        lanes.map(f64::sqrt)
    }

    #[inline(always)]
    pub fn abs(lanes: Lanes) -> Lanes {
        lanes.map(f64::abs)
    }

    #[inline(always)]
    pub fn min(a: Lanes, b: Lanes) -> Lanes {
        std::array::from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }

    #[inline(always)]
    pub fn max(a: Lanes, b: Lanes) -> Lanes {
        std::array::from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }

    #[inline(always)]
    pub fn are_at_most(a: Lanes, b: Lanes) -> bool {
        a[0] <= b[0] && a[1] <= b[1]
    }

    #[inline(always)]
    pub fn add(a: Lanes, b: Lanes) -> Lanes {
        [a[0] + b[0], a[1] + b[1]]
    }

    #[inline(always)]
    pub fn sub(a: Lanes, b: Lanes) -> Lanes {
        [a[0] - b[0], a[1] - b[1]]
    }

    #[inline(always)]
    pub fn mul(a: Lanes, b: Lanes) -> Lanes {
        [a[0] * b[0], a[1] * b[1]]
    }

    #[inline(always)]
    pub fn div(a: Lanes, b: Lanes) -> Lanes {
        [a[0] / b[0], a[1] / b[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    /// Computes a formula that has every operation.
    fn formula<R: Real>([a, b, c, d]: [R; 4]) -> [R; 6] {
        let root = (b * b + d * d).sqrt() / R::of(3.0);
        [a * b - c / d, (a + c).abs().sqrt(), root, (c - a).abs(), a.min(b), c.max(d)]
    }

    #[test]
    fn both_come_to_the_bits_of_one() {
        let mut random = Random(1);
        let specials = [0.0, -0.0, f64::INFINITY, f64::NAN, f64::MAX, f64::from_bits(1)];
        // Miri takes a hundred times as long.
        for trial in 0..if cfg!(miri) { 100 } else { 10_000 } {
            let mut value = || match random.integer(0, 15) as usize {
                special @ 0..6 if trial % 2 == 0 => specials[special],
                _ => random.raw(),
            };
            let (first, second): ([f64; 4], [f64; 4]) =
                ([(); 4].map(|()| value()), [(); 4].map(|()| value()));
            let both = formula(std::array::from_fn(|i| F64x2::new(first[i], second[i])));
            for (lane, values) in [first, second].into_iter().enumerate() {
                for (both, one) in both.into_iter().zip(formula(values)) {
                    let both = both.get()[lane];
                    // Which NaN comes out is not laid down.
                    assert!(both.to_bits() == one.to_bits() || both.is_nan() && one.is_nan());
                }
            }
        }
    }

    #[test]
    fn pairs_are_taken_apart() {
        let (a, b) = (F64x2::new(1.0, 2.0), F64x2::new(3.0, 4.0));
        assert_eq!(a.swapped().get(), [2.0, 1.0]);
        assert_eq!(a.firsts(b).get(), [1.0, 3.0]);
        assert_eq!(a.seconds(b).get(), [2.0, 4.0]);
        assert_eq!(a.first_and_second(b).get(), [1.0, 4.0]);
    }

    #[test]
    fn both_are_at_most_as_large() {
        let values = [1.0, 2.0, f64::NEG_INFINITY, f64::NAN];
        for [a, b, c, d] in (0..256).map(|i| [0, 2, 4, 6].map(|shift| values[i >> shift & 3])) {
            let are_at_most = F64x2::new(a, b).is_at_most(F64x2::new(c, d));
            assert_eq!(are_at_most, a <= c && b <= d, "{a} {b} {c} {d}");
        }
    }
}
