//! Sums of two doubles, the second at most half a unit in the last place of the first: some 106
//! bits (T. J. Dekker, "A floating-point technique for extending the available precision", 1971).
//! Exponents are small enough that nothing overflows or underflows.

use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DoubleDouble {
    pub high: f64,
    pub low: f64,
}

impl DoubleDouble {
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// Returns `a - b`, exactly.
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        let high = a - b;
        let part = high - a;
        Self { high, low: (a - (high - part)) - (b + part) }
    }

    /// Returns `a * b`, exactly.
    #[inline]
    fn product(a: f64, b: f64) -> Self {
        let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
        let high = a * b;
        let rest = a_high * b_high - high + a_high * b_low + a_low * b_high;
        Self { high, low: rest + a_low * b_low }
    }

    /// Normalises the parts, for `high` no smaller than `low`.
    #[inline]
    fn of_parts(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }

    /// Multiplies by a power of two: exact.
    #[inline]
    pub fn scaled(self, power: f64) -> Self {
        Self { high: self.high * power, low: self.low * power }
    }
}

/// Halves of 26 bits each.
#[inline]
fn split(x: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0;
    let shifted = SPLITTER * x;
    let high = shifted - (shifted - x);
    (high, x - high)
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

/// Error at most 4 u^2 (|a| + |b|), with u = 2^-53.
impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let sum = Self::difference(self.high, -other.high);
        Self::of_parts(sum.high, sum.low + (self.low + other.low))
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// Error at most 8 u^2 |a b|.
impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::of_parts(product.high, product.low + cross)
    }
}

/// Error at most 8 u^2 |a b|.
impl Mul<f64> for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        let product = Self::product(self.high, other);
        Self::of_parts(product.high, product.low + self.low * other)
    }
}

/// Error at most 16 u^2 |a / b|.
impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        Self::of_parts(first, rest.high / other.high)
    }
}
