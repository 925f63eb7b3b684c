//! Integers of any size and determinants in them, for those that measure a result or ask it:
//! nothing that builds comes in here. Fraction-free elimination (Bareiss) in 128 bits where they
//! suffice, else in as many words as it takes. Memory may be refused.

mod elimination;
mod integer;

pub(crate) use elimination::{
    Lift, Matrix, RightSide, Solution, lifted_determinant_sign, parts, solve, unbounded, unit,
};
pub(crate) use integer::{Integer, ratio};

use crate::memory::AllocError;

/// Why a number was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    /// The result does not fit 128 bits.
    TooLarge,
    Memory(AllocError),
}

impl From<AllocError> for Refusal {
    fn from(error: AllocError) -> Self {
        Self::Memory(error)
    }
}

/// The integers that an elimination may run in.
pub(crate) trait Number: Sized {
    /// Returns `mantissa * 2^shift`.
    fn shifted(mantissa: i64, shift: u32) -> Result<Self, Refusal>;
    fn plus(&self, other: &Self) -> Result<Self, Refusal>;
    fn minus(&self, other: &Self) -> Result<Self, Refusal>;
    fn times(&self, other: &Self) -> Result<Self, Refusal>;
    /// Returns the quotient by a divisor of this number.
    fn over(&self, divisor: &Self) -> Result<Self, Refusal>;
    fn sign(&self) -> std::cmp::Ordering;
}

impl Number for i128 {
    fn shifted(mantissa: i64, shift: u32) -> Result<Self, Refusal> {
        let power = 1i128.checked_shl(shift).filter(|&power| power > 0);
        let shifted = power.and_then(|power| i128::from(mantissa).checked_mul(power));
        shifted.ok_or(Refusal::TooLarge)
    }

    fn plus(&self, other: &Self) -> Result<Self, Refusal> {
        self.checked_add(*other).ok_or(Refusal::TooLarge)
    }

    fn minus(&self, other: &Self) -> Result<Self, Refusal> {
        self.checked_sub(*other).ok_or(Refusal::TooLarge)
    }

    fn times(&self, other: &Self) -> Result<Self, Refusal> {
        self.checked_mul(*other).ok_or(Refusal::TooLarge)
    }

    fn over(&self, divisor: &Self) -> Result<Self, Refusal> {
        // Most often the numbers fit in a word, whose division is many times faster.
        if let (Ok(value), Ok(divisor)) = (i64::try_from(*self), i64::try_from(*divisor)) {
            return value.checked_div(divisor).map(Self::from).ok_or(Refusal::TooLarge);
        }
        self.checked_div(*divisor).ok_or(Refusal::TooLarge)
    }

    fn sign(&self) -> std::cmp::Ordering {
        self.cmp(&0)
    }
}
