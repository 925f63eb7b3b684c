//! Integers in a fixed array, built from residues: as digits of mixed radix (Garner, "The Residue
//! Number System", 1959), which tell the sign and the value.

use super::natural::{Natural, Quotient, quotient};
use super::residues::Field;
use crate::numerics::Sign;
use crate::numerics::power::{biased_exponent, scale_by_power};

/// Integer x as the digits of x or, if it is negative, of x + M, where M is the product of the
/// first `count` primes. Digit k counts the product of the k primes before it and is less than
/// prime k.
pub(super) struct Integer<const N: usize> {
    digits: [u64; N],
    count: usize,
}

/// Returns the number of primes whose residues determine an integer of magnitude less than
/// 2^`bits`.
///
/// Each prime is 2^63 (1 - d) with d < 2^-49, so that n of them have a product M > 2^(63 n - 1):
/// with 63 n >= `bits` + 2 that is M > 2 * 2^`bits`, and no two candidates have the same residues.
pub(super) const fn primes_for(bits: usize) -> usize {
    (bits + 2).div_ceil(63)
}

impl<const N: usize> Integer<N> {
    /// Integer of which no residue is known yet.
    pub const NEW: Self = Self { digits: [0; N], count: 0 };

    /// Adds the residue for the next prime, that of `Field::nth(count)`.
    pub fn push(&mut self, residue: u64) {
        let (known, next) = self.digits.split_at_mut(self.count);
        let field = Field::nth(self.count);
        // By Horner's rule, what the digits so far stand for: with a distance below 2^14 each fold
        // leaves less than 2^63 + 2^29, which need not be reduced before the end.
        let mut value = 0u64;
        for (k, digit) in known.iter().enumerate().rev() {
            let product = u128::from(value) * u128::from(field.distance(k));
            value = field.fold(product + u128::from(*digit)) as u64;
        }
        let value = field.reduce(u128::from(value));
        next[0] = field.multiply(field.subtract(residue, value), field.inverse_of_earlier());
        self.count += 1;
    }

    /// Returns the sign. M/2 has the digits (prime - 1)/2 and a half: larger digits stand for x + M
    /// of a negative x.
    pub fn sign(&self) -> Sign {
        let digits = &self.digits[..self.count];
        if digits.iter().all(|digit| *digit == 0) {
            return Sign::Zero;
        }
        let middle = |k: usize| (Field::nth(k).prime() - 1) / 2;
        match (0..self.count).rev().find(|k| digits[*k] != middle(*k)) {
            Some(k) if digits[k] > middle(k) => Sign::Negative,
            _ => Sign::Positive,
        }
    }

    /// Returns `self / denominator` as `(m, e)`, m * 2^e with |m| in [1, 2), within 2 units of
    /// roundoff; (0, 0) for zero. The denominator must not be zero.
    pub fn divided_by(&self, denominator: &Self) -> (f64, i64) {
        let sign = self.sign() * denominator.sign();
        if sign.is_zero() {
            return (0.0, 0);
        }
        // Truncation is far below the rounding to a double.
        let Quotient { value, shift, .. } = quotient(self.magnitude(), denominator.magnitude());
        let value = value as f64;
        let exponent = i64::from(biased_exponent(value)) - 1023;
        let mantissa = f64::from(sign as i8) * scale_by_power(value, -exponent);
        (mantissa, exponent - shift)
    }

    /// Returns the magnitude, of at most 63 N bits: in N limbs there is room for more.
    fn magnitude(&self) -> Natural<N> {
        let negative = self.sign().is_negative();
        let mut value = Natural::ZERO;
        for k in (0..self.count).rev() {
            let (prime, digit) = (Field::nth(k).prime(), self.digits[k]);
            // M - x is one more than M - 1 - x, whose digits are the complements.
            let digit = if negative { prime - 1 - digit } else { digit };
            value.multiply_add(prime, digit + u64::from(negative && k == 0));
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{Random, is_close};
    use dashu_int::IBig;

    fn from_value<const N: usize>(value: &IBig, primes: usize) -> Integer<N> {
        let mut integer = Integer::NEW;
        for k in 0..primes {
            let prime = IBig::from(Field::nth(k).prime());
            let residue = (value % &prime + &prime) % &prime;
            integer.push(u64::try_from(residue).expect("less than the prime"));
        }
        integer
    }

    fn sign_of(value: &IBig) -> Sign {
        match value.cmp(&IBig::ZERO) {
            std::cmp::Ordering::Less => Sign::Negative,
            std::cmp::Ordering::Equal => Sign::Zero,
            std::cmp::Ordering::Greater => Sign::Positive,
        }
    }

    #[test]
    fn the_product_of_primes_is_large_enough() {
        let mut product = IBig::ONE;
        for n in 1..=Field::COUNT {
            product *= Field::nth(n - 1).prime();
            assert!(product > IBig::ONE << (63 * n - 1));
            // The most bits for which n primes are taken.
            let bits = 63 * n - 2;
            assert_eq!((primes_for(bits), primes_for(bits + 1)), (n, n + 1));
        }
    }

    /// Returns values at the ends of the range of `primes` primes, at its middle and in between.
    fn values(primes: usize, random: &mut Random) -> Vec<IBig> {
        let product: IBig = (0..primes).map(|k| IBig::from(Field::nth(k).prime())).product();
        let half = (&product - 1) / 2;
        let lower = &product / Field::nth(primes - 1).prime();
        let drawn = (&half * random.bits()) >> 64;
        let any = &drawn >> random.integer(0, 63 * primes as i64) as usize;
        let values = [IBig::ZERO, IBig::ONE, &half - 1, &lower / 2, &lower / 2 + 1, lower, drawn];
        let values = values.into_iter().chain([half, any]);
        values.flat_map(|value| [-&value, value]).collect()
    }

    #[test]
    fn residues_give_the_value_back() {
        let mut random = Random(5);
        for primes in [1, 2, 3, 7, 31, 100, 333, 334] {
            for value in values(primes, &mut random) {
                let integer = from_value::<{ Field::COUNT }>(&value, primes);
                assert_eq!(integer.sign(), sign_of(&value), "{primes} {value}");
                let magnitude = IBig::from(integer.magnitude().to_oracle());
                assert_eq!(magnitude, if value < IBig::ZERO { -value } else { value }, "{primes}");
            }
        }
    }

    #[test]
    fn quotients_are_near_the_exact_ones() {
        let mut random = Random(6);
        for primes in [1, 2, 3, 17, 31] {
            let values = values(primes, &mut random);
            let integers: Vec<Integer<32>> =
                values.iter().map(|value| from_value(value, primes)).collect();
            for (top, i) in values.iter().zip(&integers) {
                for (bottom, j) in values.iter().zip(&integers).filter(|(v, _)| !v.is_zero()) {
                    let (mantissa, exponent) = i.divided_by(j);
                    if top.is_zero() {
                        assert_eq!((mantissa, exponent), (0.0, 0));
                        continue;
                    }
                    assert!((1.0..2.0).contains(&mantissa.abs()));
                    // `is_close` takes the quotient in units of 2^-1074.
                    let (up, shift) = if exponent < 0 { (-exponent, 0) } else { (0, exponent) };
                    let quotient = (&(top << (1074 + up) as usize), &(bottom << shift as usize));
                    assert!(is_close(mantissa, f64::EPSILON, 0, quotient), "{top} {bottom}");
                }
            }
        }
    }
}
