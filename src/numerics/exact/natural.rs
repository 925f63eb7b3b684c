//! Natural numbers in a fixed array, with the operations that quotients need.

/// Quotient of two natural numbers in binary.
pub(super) struct Quotient {
    /// First 65 or 66 bits of the quotient, rounded down.
    pub value: u128,
    /// Scale of `value`: the quotient is `value / 2^shift` plus less than one of its units.
    pub shift: i64,
    pub is_exact: bool,
}

/// Natural number. Limbs stand from the lowest; they are zero from `length` on, and the one before
/// is not zero.
#[derive(Clone)]
pub(super) struct Natural<const N: usize> {
    limbs: [u64; N],
    length: usize,
}

/// Returns `top / bottom` in more bits than a double has. There must be room for one bit more than
/// the longer of both has.
pub(super) fn quotient<const N: usize>(mut top: Natural<N>, mut bottom: Natural<N>) -> Quotient {
    let (top_bits, bottom_bits) = (top.bits(), bottom.bits());
    top.shift_left(bottom_bits.saturating_sub(top_bits));
    bottom.shift_left(top_bits.saturating_sub(bottom_bits));
    let mut value = 0;
    for _ in 0..=65 {
        value <<= 1;
        if top.is_at_least(&bottom) {
            top.subtract(&bottom);
            value |= 1;
        }
        top.double();
    }
    let shift = 65 + bottom_bits as i64 - top_bits as i64;
    Quotient { value, shift, is_exact: top.is_zero() }
}

impl<const N: usize> Natural<N> {
    pub const ZERO: Self = Self { limbs: [0; N], length: 0 };

    /// Returns `value * 2^shift`.
    pub fn shifted(value: u64, shift: usize) -> Self {
        let mut number = Self::ZERO;
        number.append(value);
        if value != 0 {
            number.shift_left(shift);
        }
        number
    }

    pub fn is_zero(&self) -> bool {
        self.length == 0
    }

    /// Returns `self * other`, for which there must be room.
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::ZERO;
        for (k, &factor) in other.limbs[..other.length].iter().enumerate() {
            let mut carry = 0;
            let limbs = &mut product.limbs[k..];
            for (sum, &limb) in limbs.iter_mut().zip(&self.limbs[..self.length]) {
                let term = u128::from(limb) * u128::from(factor) + u128::from(carry);
                let term = term + u128::from(*sum);
                *sum = term as u64;
                carry = (term >> 64) as u64;
            }
            if carry != 0 {
                limbs[self.length] = carry;
            }
        }
        let longest = (self.length + other.length).min(N);
        let significant = product.limbs[..longest].iter().rposition(|&limb| limb != 0);
        product.length = significant.map_or(0, |last| last + 1);
        product
    }

    /// Adds `other`; there must be room for the sum.
    pub fn add(&mut self, other: &Self) {
        let mut carry = false;
        self.length = self.length.max(other.length);
        for (limb, other) in self.limbs[..self.length].iter_mut().zip(&other.limbs) {
            let (sum, first) = limb.overflowing_add(*other);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            *limb = sum;
            carry = first || second;
        }
        self.append(u64::from(carry));
    }

    fn bits(&self) -> usize {
        match self.length {
            0 => 0,
            length => 64 * length - self.limbs[length - 1].leading_zeros() as usize,
        }
    }

    /// Multiplies by `factor` and adds `term`.
    pub fn multiply_add(&mut self, factor: u64, term: u64) {
        let mut carry = term;
        for limb in &mut self.limbs[..self.length] {
            let product = u128::from(*limb) * u128::from(factor) + u128::from(carry);
            *limb = product as u64;
            carry = (product >> 64) as u64;
        }
        self.append(carry);
    }

    fn double(&mut self) {
        let mut carry = 0;
        for limb in &mut self.limbs[..self.length] {
            (*limb, carry) = (*limb << 1 | carry, *limb >> 63);
        }
        self.append(carry);
    }

    fn append(&mut self, carry: u64) {
        if carry != 0 {
            self.limbs[self.length] = carry;
            self.length += 1;
        }
    }

    fn shift_left(&mut self, bits: usize) {
        let (whole, part) = (bits / 64, bits % 64);
        self.limbs.copy_within(..self.length, whole);
        self.limbs[..whole].fill(0);
        self.length += whole;
        self.multiply_add(1 << part, 0);
    }

    pub fn is_at_least(&self, other: &Self) -> bool {
        let length = self.length.max(other.length);
        self.limbs[..length].iter().rev().ge(other.limbs[..length].iter().rev())
    }

    /// Subtracts `other`; the difference must not be negative.
    pub fn subtract(&mut self, other: &Self) {
        let mut borrow = false;
        for (limb, other) in self.limbs[..self.length].iter_mut().zip(&other.limbs) {
            let (difference, first) = limb.overflowing_sub(*other);
            let (difference, second) = difference.overflowing_sub(u64::from(borrow));
            *limb = difference;
            borrow = first || second;
        }
        while self.length > 0 && self.limbs[self.length - 1] == 0 {
            self.length -= 1;
        }
    }
}

#[cfg(test)]
impl<const N: usize> Natural<N> {
    pub fn to_oracle(&self) -> dashu_int::UBig {
        dashu_int::UBig::from_le_bytes(&self.limbs.map(u64::to_le_bytes).concat())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;
    use dashu_int::UBig;
    use dashu_int::ops::BitTest;

    const LIMBS: usize = 12;

    fn natural(value: &UBig) -> Natural<LIMBS> {
        let mut bytes = [0; 8 * LIMBS];
        let significant = value.to_le_bytes();
        bytes[..significant.len()].copy_from_slice(&significant);
        let limb = |k: usize| bytes[8 * k..8 * k + 8].try_into().expect("eight bytes");
        let limbs = std::array::from_fn(|k| u64::from_le_bytes(limb(k)));
        Natural { limbs, length: value.bit_len().div_ceil(64) }
    }

    /// Returns a number of up to `bits` bits with long runs of ones and zeros, so that carries run
    /// far.
    fn runs(bits: i64, random: &mut Random) -> UBig {
        let one = UBig::from(1u8);
        let mut value = UBig::from(random.bits());
        for _ in 0..3 {
            let (from, to) = (random.integer(0, bits - 1), random.integer(0, bits - 1));
            let run = (&one << from.max(to) as usize) - (&one << from.min(to) as usize);
            value = if random.bits() & 1 == 0 { value + run } else { value ^ run };
        }
        value % (one << bits as usize)
    }

    fn assert_is(value: &Natural<LIMBS>, expected: &UBig) {
        assert_eq!(value.to_oracle(), *expected);
        assert_eq!(value.length, expected.bit_len().div_ceil(64));
    }

    #[test]
    fn operations_agree_with_the_oracle() {
        let mut random = Random(11);
        for trial in 0..20_000 {
            let bits = random.integer(64, 64 * (LIMBS as i64 - 2));
            let (a, b) = (runs(bits, &mut random), runs(bits, &mut random));
            let (small, large) = if a < b { (&a, &b) } else { (&b, &a) };
            let (factor, term) = (random.bits() >> (trial % 64), random.bits() >> (trial % 61));
            let mut value = natural(&a);
            assert_eq!(value.bits(), a.bit_len());
            assert_eq!(value.is_at_least(&natural(&b)), a >= b);
            assert!(value.is_at_least(&natural(&a)));
            value.multiply_add(factor.max(1), term);
            assert_is(&value, &(&a * factor.max(1) + term));
            let mut value = natural(&a);
            value.double();
            assert_is(&value, &(&a << 1));
            let shift = random.integer(0, 64 * LIMBS as i64 - 64 - bits) as usize;
            let mut value = natural(&a);
            value.shift_left(shift);
            assert_is(&value, &(&a << shift));
            let mut value = natural(large);
            value.subtract(&natural(small));
            assert_is(&value, &(large - small));
            value.subtract(&natural(&(large - small)));
            assert_is(&value, &UBig::ZERO);
            let mut value = natural(&a);
            value.add(&natural(&b));
            assert_is(&value, &(&a + &b));
            let [a, b] = [&a, &b].map(|x| x >> (x.bit_len() / 2 + 1));
            assert_is(&natural(&a).times(&natural(&b)), &(&a * &b));
            assert_is(
                &Natural::shifted(factor, shift % 500),
                &(UBig::from(factor) << (shift % 500)),
            );
        }
    }

    #[test]
    fn quotients_agree_with_the_oracle() {
        let mut random = Random(12);
        for _ in 0..5000 {
            let lengths = [0; 2].map(|_| random.integer(1, 64 * (LIMBS as i64 - 1)));
            let [top, bottom] = lengths.map(|bits| runs(bits, &mut random) + 1u8);
            // An exact division, and those that just fail to be one.
            let whole = &bottom * UBig::from(random.bits() % 3 + 1);
            for top in [&top, &bottom, &whole, &(&whole + 1u8), &(&whole - 1u8)] {
                if top.is_zero() || top.bit_len().max(bottom.bit_len()) > 64 * (LIMBS - 1) {
                    continue;
                }
                let Quotient { value, shift, is_exact } = quotient(natural(top), natural(&bottom));
                assert_eq!(shift, 65 + bottom.bit_len() as i64 - top.bit_len() as i64);
                let (up, down) = (shift.max(0) as usize, (-shift).max(0) as usize);
                assert_eq!(UBig::from(value), (top << up) / (&bottom << down));
                assert_eq!(is_exact, ((top << up) % (&bottom << down)).is_zero());
                assert!((65..=66).contains(&(128 - value.leading_zeros())));
            }
        }
    }
}
