//! The sign of a real number.

use std::ops::{Mul, Neg};

/// Sign of a determinant, as -1, 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(i8)]
pub enum Sign {
    Negative = -1,
    Zero = 0,
    Positive = 1,
}

impl Sign {
    /// Returns the sign of `value`; zero for both zeros. A NaN has no sign: it counts as zero here,
    /// and callers keep it out.
    #[inline]
    pub fn of(value: f64) -> Self {
        if value > 0.0 {
            Self::Positive
        } else if value < 0.0 {
            Self::Negative
        } else {
            Self::Zero
        }
    }

    /// Returns the sign of an integer.
    #[inline]
    pub(super) fn of_integer(value: i64) -> Self {
        match value {
            ..0 => Self::Negative,
            0 => Self::Zero,
            1.. => Self::Positive,
        }
    }

    /// Returns the sign of the negated number.
    #[inline]
    pub fn flip(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Zero => Self::Zero,
            Self::Positive => Self::Negative,
        }
    }

    #[inline]
    pub fn is_positive(self) -> bool {
        self == Self::Positive
    }

    #[inline]
    pub fn is_negative(self) -> bool {
        self == Self::Negative
    }

    #[inline]
    pub fn is_zero(self) -> bool {
        self == Self::Zero
    }
}

impl From<f64> for Sign {
    #[inline]
    fn from(value: f64) -> Self {
        Self::of(value)
    }
}

impl Neg for Sign {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.flip()
    }
}

/// Sign of a product.
impl Mul for Sign {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        match self {
            Self::Negative => other.flip(),
            Self::Zero => Self::Zero,
            Self::Positive => other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Sign::{self, Negative, Positive, Zero};

    #[test]
    fn signs_are_numbers() {
        assert_eq!([Negative, Zero, Positive].map(|sign| sign as i8), [-1, 0, 1]);
    }

    #[test]
    fn products_follow_the_numbers() {
        for (a, x) in [(Negative, -2.0), (Zero, -0.0), (Positive, 5e-324)] {
            assert_eq!(Sign::of(x), a);
            assert_eq!((-a, a.flip(), Sign::from(x)), (Sign::of(-x), Sign::of(-x), a));
            assert_eq!(
                (a.is_negative(), a.is_zero(), a.is_positive()),
                (x < 0.0, x == 0.0, x > 0.0)
            );
            for (b, y) in [(Negative, -3.0), (Zero, 0.0), (Positive, f64::MAX)] {
                assert_eq!(a * b, Sign::of(Sign::of(x) as i8 as f64 * y));
            }
        }
    }
}
