//! Formulas for one double, or for two side by side, which a processor computes in the same time. Both
//! come to the same bits: every operation is rounded as IEEE 754 has it.

use std::ops::{Add, Div, Mul, Sub};

/// What formulas are written in.
pub(super) trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn of(value: f64) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// Not so if anything is NaN; of two, whether both are.
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
    fn is_at_most(self, other: Self) -> bool {
        self <= other
    }
}

/// Two doubles.
#[derive(Clone, Copy)]
pub(super) struct Pair(lanes::Lanes);

impl Pair {
    #[inline(always)]
    pub fn new(first: f64, second: f64) -> Self {
        Self(lanes::new(first, second))
    }

    #[inline(always)]
    pub fn get(self) -> [f64; 2] {
        lanes::get(self.0)
    }
}

impl Real for Pair {
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
    fn is_at_most(self, other: Self) -> bool {
        lanes::are_at_most(self.0, other.0)
    }
}

macro_rules! by_lane {
    ($operation:ident, $name:ident) => {
        impl $operation for Pair {
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
        ($name:ident, ($($lanes:ident),+), $intrinsic:ident) => {
            #[inline(always)]
            pub fn $name($($lanes: Lanes),+) -> Lanes {
                // SAFETY: every x86_64 has SSE2, which is all that is asked for.
                unsafe { arch::$intrinsic($($lanes),+) }
            }
        };
    }

    intrinsic!(add, (a, b), _mm_add_pd);
    intrinsic!(sub, (a, b), _mm_sub_pd);
    intrinsic!(mul, (a, b), _mm_mul_pd);
    intrinsic!(div, (a, b), _mm_div_pd);
    intrinsic!(sqrt, (a), _mm_sqrt_pd);

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
    pub fn sqrt(lanes: Lanes) -> Lanes {
        lanes.map(f64::sqrt)
    }

    #[inline(always)]
    pub fn abs(lanes: Lanes) -> Lanes {
        lanes.map(f64::abs)
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
