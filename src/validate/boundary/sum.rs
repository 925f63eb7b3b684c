//! An exact sum of products of doubles, as an integer of fixed size: no addition rounds, and none
//! needs memory.

use crate::quality::exact::parts;
use std::cmp::Ordering;

/// The unit is the product of three smallest doubles.
const UNIT: i32 = -3222;
/// Number of words of a sum: 2^6294 is a product of three largest doubles in units, and 2^128 of
/// them can be added up.
const LIMBS: usize = 102;

/// Integer in two's complement, from the lowest word.
#[derive(Clone)]
pub(super) struct Sum {
    limbs: [u64; LIMBS],
}

impl Sum {
    pub fn zero() -> Self {
        Self { limbs: [0; LIMBS] }
    }

    pub fn is_zero(&self) -> bool {
        self.limbs.iter().all(|&limb| limb == 0)
    }

    pub fn sign(&self) -> Ordering {
        match self.limbs[LIMBS - 1] >> 63 {
            1 => Ordering::Less,
            _ if self.is_zero() => Ordering::Equal,
            _ => Ordering::Greater,
        }
    }

    /// Returns the sum as `mantissa * 2^exponent` with a relative error of at most 2^-52.
    pub fn rounded(&self) -> (f64, i32) {
        let mut magnitude = Self::zero();
        let is_negative = self.sign() == Ordering::Less;
        magnitude.add_words(&self.limbs, 0, is_negative);
        let Some(top) = magnitude.limbs.iter().rposition(|&limb| limb != 0) else {
            return (0.0, 0);
        };
        let zeros = magnitude.limbs[top].leading_zeros();
        let below = if top == 0 { 0 } else { magnitude.limbs[top - 1] };
        let wide = u128::from(magnitude.limbs[top]) << 64 | u128::from(below);
        let bits = ((wide << zeros) >> 64) as u64;
        let exponent = 64 * top as i32 - zeros as i32 + UNIT;
        (if is_negative { -(bits as f64) } else { bits as f64 }, exponent)
    }

    /// Adds twice the area, or six times the volume, between the origin and a facet of the
    /// dimension: the determinant of its points.
    pub fn add_facet<const D: usize>(&mut self, points: [&[f64; D]; D]) {
        if D == 2 {
            self.add_product(&[points[0][0], points[1][1]]);
            self.add_product(&[-points[0][1], points[1][0]]);
            return;
        }
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let [a, b, c] = [0, 1, 2].map(|at| points[at]);
            self.add_product(&[a[i], b[j], c[k]]);
            self.add_product(&[-a[i], b[k], c[j]]);
        }
    }

    /// Adds another sum, or takes it away.
    pub fn add(&mut self, other: &Self, is_negative: bool) {
        self.add_words(&other.limbs, 0, is_negative);
    }

    /// Adds the product of at most three finite factors.
    pub fn add_product(&mut self, factors: &[f64]) {
        let (mut magnitude, mut exponent, mut is_negative) = ([1u64, 0, 0], -UNIT, false);
        for &factor in factors {
            let (odd, own) = parts(factor);
            if odd == 0 {
                return;
            }
            let mut carry = 0;
            for word in &mut magnitude {
                carry += u128::from(*word) * u128::from(odd.unsigned_abs());
                *word = carry as u64;
                carry >>= 64;
            }
            exponent += own;
            is_negative ^= odd < 0;
        }
        let (start, bits) = (exponent as usize / 64, exponent as usize % 64);
        let mut words = [0; 4];
        for (at, &word) in magnitude.iter().enumerate() {
            let shifted = u128::from(word) << bits;
            words[at] |= shifted as u64;
            words[at + 1] = (shifted >> 64) as u64;
        }
        self.add_words(&words, start, is_negative);
    }

    fn add_words(&mut self, words: &[u64], start: usize, is_negative: bool) {
        let mut carry = false;
        for (at, limb) in self.limbs[start..].iter_mut().enumerate() {
            let word = words.get(at).copied().unwrap_or(0);
            if at >= words.len() && !carry {
                return;
            }
            (*limb, carry) = match is_negative {
                true => subtracted(*limb, word, carry),
                false => added(*limb, word, carry),
            };
        }
    }
}

/// Returns `limb + word + carry`, and what is carried.
fn added(limb: u64, word: u64, carry: bool) -> (u64, bool) {
    let (sum, first) = limb.overflowing_add(word);
    let (sum, second) = sum.overflowing_add(u64::from(carry));
    (sum, first || second)
}

/// Returns `limb - word - borrow`, and what is borrowed.
fn subtracted(limb: u64, word: u64, borrow: bool) -> (u64, bool) {
    let (rest, first) = limb.overflowing_sub(word);
    let (rest, second) = rest.overflowing_sub(u64::from(borrow));
    (rest, first || second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_int::IBig;

    fn value(sum: &Sum) -> IBig {
        let raw = sum.limbs.iter().rev().fold(IBig::ZERO, |value, &limb| (value << 64) + limb);
        if sum.limbs[LIMBS - 1] >> 63 == 1 { raw - (IBig::ONE << (64 * LIMBS)) } else { raw }
    }

    /// Holds that a sum's rounding is within its bound.
    fn check_rounding(sum: &Sum) {
        let (mantissa, exponent) = sum.rounded();
        let (odd, own) = crate::numerics::testing::decomposed(mantissa);
        let exact = value(sum);
        let shift = own + exponent - UNIT;
        let rounded = match shift < 0 {
            true => IBig::from(odd) >> -shift as usize,
            false => IBig::from(odd) << shift as usize,
        };
        let error = (&rounded - &exact) << 52;
        assert!(error.clone() * error <= &exact * &exact + IBig::ONE, "{mantissa} {exponent}");
        assert_eq!(sum.sign(), exact.cmp(&IBig::ZERO));
    }

    #[test]
    fn sums_of_products_are_those_of_integers() {
        let mut random = crate::numerics::testing::Random(3);
        let (mut sum, mut expected) = (Sum::zero(), IBig::ZERO);
        let whole = |x: f64| {
            let (mantissa, exponent) = crate::numerics::testing::decomposed(x);
            (IBig::from(mantissa), exponent)
        };
        let mut terms = vec![[f64::MAX; 3], [-5e-324, 5e-324, 5e-324], [f64::MAX, -f64::MAX, 1.0]];
        for _ in 0..2000 {
            let mut draw = || {
                let exponent = random.integer(-1000, 1000) as i32;
                (random.unit() - 0.5) * 2f64.powi(exponent)
            };
            terms.push([draw(), draw(), draw()]);
        }
        for factors in &terms {
            sum.add_product(factors);
            let whole = factors.map(whole);
            let exponent = whole.iter().map(|(_, exponent)| exponent).sum::<i32>() - UNIT;
            let product = whole.into_iter().fold(IBig::ONE, |product, (odd, _)| product * odd);
            expected += product << exponent as usize;
            assert_eq!(value(&sum), expected);
            check_rounding(&sum);
        }
        for &[a, b, c] in &terms {
            assert!(!sum.is_zero());
            sum.add_product(&[-a, b, c]);
        }
        assert!(sum.is_zero());
        sum.add_product(&[3.0, -0.5]);
        assert_eq!(sum.rounded(), (-1.5 * 2f64.powi(63), -63));
    }
}
