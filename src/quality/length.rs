//! Lengths and offsets with their own exponent: nothing here over- or underflows, whatever finite
//! doubles come in. Shared by the measures and the certificate, and by nothing that builds.

use std::ops::Range;

/// Returns `2^exponent` for an exponent of a normal double.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// Returns `value * 2^exponent`, exact unless the result leaves the normal range.
#[inline]
pub(crate) fn scale(value: f64, exponent: i32) -> f64 {
    match exponent {
        -1000..=1000 => value * power_of_two(exponent),
        _ => scale_far(value, exponent),
    }
}

fn scale_far(value: f64, exponent: i32) -> f64 {
    let mut value = value;
    let mut exponent = exponent.clamp(-4200, 4200);
    while exponent > 1000 {
        value *= power_of_two(1000);
        exponent -= 1000;
    }
    while exponent < -1000 {
        value *= power_of_two(-1000);
        exponent += 1000;
    }
    value * power_of_two(exponent)
}

/// Returns the exponent `e` with `2^e <= |value| < 2^(e+1)`; `None` for zero and for numbers that
/// are not finite.
pub(crate) fn exponent_of(value: f64) -> Option<i32> {
    if value == 0.0 || !value.is_finite() {
        return None;
    }
    let biased = |x: f64| ((x.to_bits() >> 52) & 0x7ff) as i32;
    Some(match biased(value) {
        0 => biased(value * power_of_two(64)) - 64 - 1023,
        normal => normal - 1023,
    })
}

/// A length `mantissa * 2^exponent` with the mantissa in \[1, 2): the bits of a double, with an
/// exponent of 12 bits and no sign, so that lengths compare as integers do. Lengths below 2^-1500,
/// which no distance of two points is, are zero, and those from 2^2594 on infinite, as their ratio
/// to any such distance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Length(u64);

/// The exponent of a length's least biased exponent, less one.
const LENGTH_BIAS: i32 = 1501;
/// The biased exponent of an infinite length.
const BEYOND: i32 = 0xfff;
/// The bits of a double's mantissa.
const FRACTION: u64 = (1 << 52) - 1;
/// The bits of the length of one, less those of the double.
const SHIFT: u64 = ((LENGTH_BIAS - 1023) as u64) << 52;

impl Length {
    pub const ZERO: Self = Self(0);
    pub const INFINITE: Self = Self((BEYOND as u64) << 52);
    /// Squares of lengths whose components may be squared without harm.
    pub(super) const SQUARES: Range<f64> = 1e-250..1e250;

    /// Makes the length `value * 2^exponent` for `value >= 0`. A value that is not a number counts
    /// as infinite.
    pub fn scaled(value: f64, exponent: i32) -> Self {
        if value == 0.0 {
            return Self::ZERO;
        }
        let Some(own) = exponent_of(value) else {
            return Self::INFINITE;
        };
        match own.saturating_add(exponent).saturating_add(LENGTH_BIAS) {
            ..=0 => Self::ZERO,
            BEYOND.. => Self::INFINITE,
            biased => Self((biased as u64) << 52 | scale(value, -own).to_bits() & FRACTION),
        }
    }

    /// Makes the length `value`, which is not negative.
    #[inline]
    pub fn new(value: f64) -> Self {
        match (f64::MIN_POSITIVE..f64::INFINITY).contains(&value) {
            true => Self(value.to_bits() + SHIFT),
            false => Self::scaled(value, 0),
        }
    }

    /// Returns the mantissa of a length that is neither zero nor infinite.
    fn mantissa(self) -> f64 {
        f64::from_bits(self.0 & FRACTION | 1023 << 52)
    }

    /// Returns the exponent of a length that is neither zero nor infinite.
    fn exponent(self) -> i32 {
        (self.0 >> 52) as i32 - LENGTH_BIAS
    }

    /// Returns the distance of two points.
    pub fn between<const D: usize>(p: &[f64; D], q: &[f64; D]) -> Self {
        let squared: f64 = p.iter().zip(q).map(|(a, b)| (a - b) * (a - b)).sum();
        if Self::SQUARES.contains(&squared) {
            return Self::new(squared.sqrt());
        }
        Offset::between(p, q).length()
    }

    pub fn times(self, factor: f64) -> Self {
        if self == Self::ZERO || self == Self::INFINITE {
            return self;
        }
        Self::scaled(self.mantissa() * factor, self.exponent())
    }

    pub fn plus(self, other: Self) -> Self {
        let (small, large) = if self < other { (self, other) } else { (other, self) };
        if small == Self::ZERO || large == Self::INFINITE {
            return large;
        }
        let aligned = scale(small.mantissa(), small.exponent() - large.exponent());
        Self::scaled(large.mantissa() + aligned, large.exponent())
    }

    /// Returns `self / other` as a double: 0 or infinity where it does not fit.
    pub fn ratio(self, other: Self) -> f64 {
        if self == Self::ZERO || other == Self::INFINITE {
            return 0.0;
        }
        if self == Self::INFINITE || other == Self::ZERO {
            return f64::INFINITY;
        }
        scale(self.mantissa() / other.mantissa(), self.exponent() - other.exponent())
    }

    /// Returns the length as a word that [`Self::from_word`] reads, on any machine.
    pub fn to_word(self) -> u64 {
        self.0
    }

    /// Reads a length from a word that [`Self::to_word`] made.
    pub fn from_word(word: u64) -> Self {
        Self(word.min(Self::INFINITE.0))
    }

    /// Returns the nearest double, for messages: 0 or infinity where the length does not fit.
    pub fn to_f64(self) -> f64 {
        self.ratio(Self::new(1.0))
    }
}

/// A vector `vector * 2^exponent` whose largest component has magnitude in \[1, 2), or zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offset<const D: usize> {
    pub vector: [f64; D],
    pub exponent: i32,
}

impl<const D: usize> Offset<D> {
    pub const ZERO: Self = Self { vector: [0.0; D], exponent: i32::MIN / 2 };

    /// Returns `p - q`, each component rounded once.
    pub fn between(p: &[f64; D], q: &[f64; D]) -> Self {
        let difference: [f64; D] = std::array::from_fn(|k| p[k] - q[k]);
        if difference.iter().all(|x| x.is_finite()) {
            return Self::normalized(difference, 0);
        }
        // The vector is longer than any double: what halving loses of tiny components is nothing.
        Self::normalized(std::array::from_fn(|k| p[k] / 2.0 - q[k] / 2.0), 1)
    }

    /// Makes the offset `vector * 2^exponent`, normalised.
    pub fn normalized(vector: [f64; D], exponent: i32) -> Self {
        let largest = vector.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        match exponent_of(largest) {
            Some(own) => Self { vector: vector.map(|x| scale(x, -own)), exponent: exponent + own },
            None => Self::ZERO,
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        let exponent = self.exponent.max(other.exponent);
        let aligned = |offset: &Self, k: usize| scale(offset.vector[k], offset.exponent - exponent);
        let sum = std::array::from_fn(|k| aligned(self, k) + aligned(other, k));
        Self::normalized(sum, exponent)
    }

    /// Returns the squared length in units of `2^(2 exponent)`: a number in \[1, 4 D), or zero.
    pub fn squared_mantissa(&self) -> f64 {
        self.vector.iter().map(|x| x * x).sum()
    }

    pub fn length(&self) -> Length {
        Length::scaled(self.squared_mantissa().sqrt(), self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TINY: f64 = 5e-324;

    #[test]
    fn lengths_survive_both_ends_of_the_doubles() {
        let huge = Length::between(&[f64::MAX, 0.0], &[-f64::MAX, 0.0]);
        assert_eq!(huge.ratio(Length::new(f64::MAX)), 2.0);
        let tiny = Length::between(&[TINY, 0.0], &[0.0, TINY]);
        assert!((tiny.ratio(Length::new(TINY)) - 2f64.sqrt()).abs() < 1e-15);
        assert_eq!(huge.ratio(tiny), f64::INFINITY);
        assert_eq!(tiny.ratio(huge), 0.0);
    }

    #[test]
    fn lengths_are_ordered_and_added() {
        let (one, three) = (Length::new(1.0), Length::new(3.0));
        assert!(one < three && Length::ZERO < one && three < Length::INFINITE);
        assert_eq!(one.plus(three).to_f64(), 4.0);
        assert_eq!(Length::ZERO.plus(three), three);
        assert_eq!(three.times(0.25).to_f64(), 0.75);
        assert_eq!(one.max(three), three);
        assert_eq!(one.min(Length::INFINITE), one);
    }

    #[test]
    fn scaling_and_exponents_agree() {
        for value in [1.0, 1.5, -3.0, TINY, 2.5e-310, f64::MAX, f64::MIN_POSITIVE] {
            let exponent = exponent_of(value).unwrap();
            let mantissa = scale(value, -exponent);
            assert!((1.0..2.0).contains(&mantissa.abs()), "{value}: {mantissa}");
            assert_eq!(scale(mantissa, exponent), value);
        }
        assert_eq!(exponent_of(0.0), None);
    }

    #[test]
    fn offsets_of_unlike_scales_add() {
        let far = Offset::between(&[1e300, 0.0], &[0.0, 0.0]);
        let near = Offset::between(&[0.0, 1e-300], &[0.0, 0.0]);
        assert_eq!(far.plus(&near).length().to_f64(), 1e300);
        assert_eq!(Offset::ZERO.plus(&near).length(), near.length());
    }
}
