//! Signed integers of any size, whose memory may be refused.

use super::{Number, Refusal};
use crate::memory::{AllocResult, TryGrow, with_capacity};
use std::cmp::Ordering;

/// Sign and magnitude.
#[derive(Debug)]
pub(crate) struct Integer {
    negative: bool,
    /// Words of the magnitude, from the lowest; the highest is not zero, and zero has none.
    limbs: Vec<u64>,
}

impl Integer {
    fn new(negative: bool, mut limbs: Vec<u64>) -> Self {
        while limbs.last() == Some(&0) {
            limbs.pop();
        }
        Self { negative, limbs }
    }

    fn sum(&self, other: &Self, negated: bool) -> AllocResult<Self> {
        let other_negative = other.negative != negated;
        if self.negative == other_negative {
            return Ok(Self::new(self.negative, added(&self.limbs, &other.limbs)?));
        }
        Ok(match compare(&self.limbs, &other.limbs) {
            Ordering::Less => Self::new(other_negative, subtracted(&other.limbs, &self.limbs)?),
            _ => Self::new(self.negative, subtracted(&self.limbs, &other.limbs)?),
        })
    }

    /// Returns the highest 64 bits of the magnitude, and the exponent of the power of two that is
    /// their unit.
    fn top(&self) -> (u64, i64) {
        let Some((&high, rest)) = self.limbs.split_last() else {
            return (0, 0);
        };
        let zeros = high.leading_zeros();
        let below = rest.last().copied().unwrap_or(0);
        let bits = if zeros == 0 { high } else { high << zeros | below >> (64 - zeros) };
        (bits, 64 * rest.len() as i64 - i64::from(zeros))
    }
}

impl Number for Integer {
    fn shifted(mantissa: i64, shift: u32) -> Result<Self, Refusal> {
        let (words, bits) = (shift as usize / 64, shift % 64);
        let wide = u128::from(mantissa.unsigned_abs()) << bits;
        let mut limbs = with_capacity(words + 2)?;
        limbs.resize(words, 0);
        limbs.extend([wide as u64, (wide >> 64) as u64]);
        Ok(Self::new(mantissa < 0, limbs))
    }

    fn plus(&self, other: &Self) -> Result<Self, Refusal> {
        Ok(self.sum(other, false)?)
    }

    fn minus(&self, other: &Self) -> Result<Self, Refusal> {
        Ok(self.sum(other, true)?)
    }

    fn times(&self, other: &Self) -> Result<Self, Refusal> {
        let mut limbs: Vec<u64> = with_capacity(self.limbs.len() + other.limbs.len())?;
        limbs.resize(self.limbs.len() + other.limbs.len(), 0);
        for (i, &factor) in self.limbs.iter().enumerate() {
            let mut carry = 0u128;
            for (limb, &digit) in limbs[i..].iter_mut().zip(&other.limbs) {
                carry += u128::from(factor) * u128::from(digit) + u128::from(*limb);
                *limb = carry as u64;
                carry >>= 64;
            }
            limbs[i + other.limbs.len()] = carry as u64;
        }
        Ok(Self::new(self.negative != other.negative, limbs))
    }

    /// Divides without remainder from the lowest word, by the inverse of an odd number modulo a
    /// power of two (Hensel, Jebelean). For that the powers of two in the divisor go first.
    fn over(&self, divisor: &Self) -> Result<Self, Refusal> {
        if self.limbs.is_empty() {
            return Ok(Self::new(false, Vec::new()));
        }
        let shift = trailing_zeros(&divisor.limbs);
        let (odd, mut rest) = (halved(&divisor.limbs, shift)?, halved(&self.limbs, shift)?);
        let inverse = inverse_of_odd(odd[0]);
        let length = (rest.len() + 1).saturating_sub(odd.len());
        let mut limbs = with_capacity(length)?;
        for i in 0..length {
            let digit = rest[i].wrapping_mul(inverse);
            let mut borrow = 0u128;
            let end = rest.len().min(i + odd.len() + 1);
            let digits = odd.iter().chain([&0]);
            for (limb, &other) in rest[i..end].iter_mut().zip(digits) {
                borrow += u128::from(digit) * u128::from(other);
                let (low, under) = limb.overflowing_sub(borrow as u64);
                *limb = low;
                borrow = (borrow >> 64) + u128::from(under);
            }
            // What is borrowed beyond comes back with the next digits: the division has no
            // remainder.
            for limb in &mut rest[end..] {
                let (low, under) = limb.overflowing_sub(borrow as u64);
                *limb = low;
                borrow = u128::from(under);
            }
            limbs.push(digit);
        }
        Ok(Self::new(self.negative != divisor.negative, limbs))
    }

    fn sign(&self) -> Ordering {
        match (self.limbs.is_empty(), self.negative) {
            (true, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            (_, false) => Ordering::Greater,
        }
    }
}

/// Returns `numerator / denominator` as a double and the exponent of a power of two that it is to
/// be multiplied by, with a relative error below 2^-50.
pub(crate) fn ratio(numerator: &Integer, denominator: &Integer) -> (f64, i64) {
    let ((a, a_unit), (b, b_unit)) = (numerator.top(), denominator.top());
    let magnitude = a as f64 / b as f64;
    let negative = numerator.negative != denominator.negative;
    (if negative { -magnitude } else { magnitude }, a_unit - b_unit)
}

fn compare(a: &[u64], b: &[u64]) -> Ordering {
    a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
}

fn added(a: &[u64], b: &[u64]) -> AllocResult<Vec<u64>> {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let mut limbs: Vec<u64> = with_capacity(long.len() + 1)?;
    let mut carry = false;
    for (i, &limb) in long.iter().enumerate() {
        let (sum, over) = limb.overflowing_add(short.get(i).copied().unwrap_or(0));
        let (sum, again) = sum.overflowing_add(u64::from(carry));
        limbs.push(sum);
        carry = over || again;
    }
    limbs.push(u64::from(carry));
    Ok(limbs)
}

/// Returns `a - b` for `a >= b`.
fn subtracted(a: &[u64], b: &[u64]) -> AllocResult<Vec<u64>> {
    let mut limbs = with_capacity(a.len())?;
    let mut borrow = false;
    for (i, &limb) in a.iter().enumerate() {
        let (rest, under) = limb.overflowing_sub(b.get(i).copied().unwrap_or(0));
        let (rest, again) = rest.overflowing_sub(u64::from(borrow));
        limbs.push(rest);
        borrow = under || again;
    }
    Ok(limbs)
}

fn trailing_zeros(limbs: &[u64]) -> usize {
    let words = limbs.iter().position(|&limb| limb != 0).expect("no divisor is zero");
    64 * words + limbs[words].trailing_zeros() as usize
}

/// Returns `limbs / 2^shift`, rounded down.
fn halved(limbs: &[u64], shift: usize) -> AllocResult<Vec<u64>> {
    let (words, bits) = (shift / 64, shift % 64);
    let kept = &limbs[words.min(limbs.len())..];
    let mut halved = Vec::new();
    halved.try_extend(kept)?;
    if bits > 0 {
        for (i, limb) in halved.iter_mut().enumerate() {
            let above = kept.get(i + 1).copied().unwrap_or(0);
            *limb = *limb >> bits | above << (64 - bits);
        }
    }
    while halved.last() == Some(&0) {
        halved.pop();
    }
    Ok(halved)
}

/// Returns the inverse of an odd number modulo 2^64, by Newton's iteration: each step doubles the
/// bits that are right, three at first.
fn inverse_of_odd(odd: u64) -> u64 {
    let mut inverse = odd;
    for _ in 0..5 {
        inverse = inverse.wrapping_mul(2u64.wrapping_sub(odd.wrapping_mul(inverse)));
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu_int::IBig;

    fn value(integer: &Integer) -> IBig {
        let magnitude = integer
            .limbs
            .iter()
            .rev()
            .fold(IBig::ZERO, |sum, &limb| (sum << 64) + IBig::from(limb));
        if integer.negative { -magnitude } else { magnitude }
    }

    /// Draws numbers of up to five words, with words of zeros and of ones among them.
    fn draw(random: &mut impl FnMut() -> u64) -> Integer {
        let word = |bits: u64, any: u64| [0, u64::MAX, 1 << (any % 64), any][bits as usize % 4];
        let length = random() % 6;
        let limbs = (0..length).map(|_| word(random(), random())).collect();
        let integer = Integer::new(random() % 2 == 0, limbs);
        Integer { negative: integer.negative && !integer.limbs.is_empty(), ..integer }
    }

    #[test]
    fn arithmetic_agrees_with_another_library() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            state.rotate_left(32)
        };
        for _ in 0..20_000 {
            let (a, b) = (draw(&mut random), draw(&mut random));
            assert_eq!(value(&a.plus(&b).unwrap()), value(&a) + value(&b));
            assert_eq!(value(&a.minus(&b).unwrap()), value(&a) - value(&b));
            let product = a.times(&b).unwrap();
            assert_eq!(value(&product), value(&a) * value(&b));
            assert_eq!(product.sign(), value(&product).cmp(&IBig::ZERO));
            if b.sign() != Ordering::Equal {
                assert_eq!(value(&product.over(&b).unwrap()), value(&a), "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn shifts_and_ratios() {
        for shift in [0, 1, 63, 64, 65, 2000] {
            let (a, b) =
                (Integer::shifted(-3 << 40, shift).unwrap(), Integer::shifted(1, 9).unwrap());
            assert_eq!(value(&a), IBig::from(-3i64 << 40) << shift as usize);
            let (mantissa, exponent) = ratio(&a, &b);
            let expected = -1.5f64.log2();
            let found = -(mantissa.abs().log2() + exponent as f64 - f64::from(shift) - 41.0 + 9.0);
            assert!(mantissa < 0.0 && (found - expected).abs() < 1e-9, "{mantissa} {exponent}");
        }
    }
}
