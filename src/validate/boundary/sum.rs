//! An exact sum of products of doubles, as an integer of fixed size: no addition rounds, and none
//! needs memory.

use crate::quality::exact::parts;

/// The unit is the product of two smallest doubles.
const UNIT: i32 = -2148;
/// Number of words of a sum: 2^4096 is a product of two largest doubles in units, and 2^128 of them
/// can be added up.
const LIMBS: usize = 68;

/// Integer in two's complement, from the lowest word.
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

    /// Adds the doubled area between the edge from `a` to `b` and the origin.
    pub fn add_edge(&mut self, a: &[f64; 2], b: &[f64; 2]) {
        self.add_product(a[0], b[1]);
        self.add_product(-a[1], b[0]);
    }

    fn add_product(&mut self, a: f64, b: f64) {
        let ((a, a_exponent), (b, b_exponent)) = (parts(a), parts(b));
        if a == 0 || b == 0 {
            return;
        }
        let product = u128::from(a.unsigned_abs()) * u128::from(b.unsigned_abs());
        let shift = (a_exponent + b_exponent - UNIT) as usize;
        let (word, bits) = (shift / 64, shift % 64);
        let (low, high) = (product << bits, if bits == 0 { 0 } else { product >> (128 - bits) });
        let words = [low as u64, (low >> 64) as u64, high as u64];
        self.add_words(words, word, (a < 0) != (b < 0));
    }

    fn add_words(&mut self, words: [u64; 3], start: usize, is_negative: bool) {
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

    #[test]
    fn sums_of_products_are_those_of_integers() {
        let mut random = crate::numerics::testing::Random(3);
        let (mut sum, mut expected) = (Sum::zero(), IBig::ZERO);
        let whole = |x: f64| {
            let (mantissa, exponent) = crate::numerics::testing::decomposed(x);
            (IBig::from(mantissa), exponent)
        };
        let mut terms = vec![(f64::MAX, f64::MAX), (-5e-324, 5e-324), (f64::MAX, -f64::MAX)];
        for _ in 0..2000 {
            let mut draw = || {
                let exponent = random.integer(-1000, 1000) as i32;
                (random.unit() - 0.5) * 2f64.powi(exponent)
            };
            terms.push((draw(), draw()));
        }
        for &(a, b) in &terms {
            sum.add_product(a, b);
            let ((a, a_exponent), (b, b_exponent)) = (whole(a), whole(b));
            expected += (a * b) << (a_exponent + b_exponent - UNIT) as usize;
            assert_eq!(value(&sum), expected);
        }
        for &(a, b) in &terms {
            assert!(!sum.is_zero());
            sum.add_product(-a, b);
        }
        assert!(sum.is_zero());
    }
}
