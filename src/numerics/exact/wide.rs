//! The edges of a simplex as integers of one word, and signs of their determinants in integers of a
//! few words. That is enough unless the coordinates have very different sizes: those are for
//! `edges`.
//!
//! A determinant is computed modulo 2^(64 L). Intermediate results may wrap: the determinant is
//! right in the end if its magnitude is below 2^(64 L - 1), and L is chosen so.

use crate::numerics::power::{bits_of, power_of_two, unit_and_span};
use crate::numerics::{MAX_DIM, MAX_SIZE, Sign, laplace};
use std::marker::PhantomData;

/// Largest number of bits of the coordinates, in their common unit, for which edges fit in a word.
const MAX_SPAN: usize = 62;

/// Edges from an origin to other points, in units of the largest power of two that divides all
/// coordinates.
pub(super) struct Rows {
    rows: [[i64; MAX_DIM]; MAX_SIZE],
    count: usize,
    dim: usize,
    /// Exponent of a power of two that no component of an edge exceeds.
    bits: usize,
}

impl Rows {
    /// Returns the edges; `None` if the coordinates span more than [`MAX_SPAN`] bits, or if all are
    /// zero.
    pub fn new<'a, const D: usize>(
        origin: &'a [f64; D],
        ends: impl Iterator<Item = &'a [f64; D]> + Clone,
    ) -> Option<Self> {
        const { assert!(D <= MAX_DIM) };
        let (unit, span) = unit_and_span(ends.clone().chain([origin]).flatten())?;
        if span > MAX_SPAN {
            return None;
        }
        // In two steps, each of which is a double.
        let steps = [-unit / 2, -unit - (-unit / 2)].map(power_of_two);
        let whole = |x: f64| (x * steps[0] * steps[1]) as i64;
        let origin = origin.map(whole);
        let mut edges = Self { rows: [[0; MAX_DIM]; MAX_SIZE], count: 0, dim: D, bits: 0 };
        let mut ones = 0;
        for end in ends {
            let row = &mut edges.rows[edges.count];
            for ((component, &x), &start) in row.iter_mut().zip(end).zip(&origin) {
                *component = whole(x) - start;
                ones |= (*component ^ (*component >> 63)) as u64;
            }
            edges.count += 1;
        }
        edges.bits = 64 - ones.leading_zeros() as usize;
        Some(edges)
    }

    /// Returns the sign of the determinant of `dim` edges.
    pub fn orientation(&self) -> Sign {
        debug_assert_eq!(self.count, self.dim);
        self.sign(self.dim * self.bits)
    }

    /// Returns true if [`Self::lifted_orientation`] needs no more than two words.
    pub fn is_narrow(&self) -> bool {
        self.words(self.lifted_bits()) <= 2
    }

    /// Returns the sign of the determinant of `dim + 1` edges whose last column is their squared
    /// lengths.
    pub fn lifted_orientation(&self) -> Sign {
        debug_assert_eq!(self.count, self.dim + 1);
        self.sign(self.lifted_bits())
    }

    /// Returns the number of bits of a product of one entry from each column, the last of squares.
    fn lifted_bits(&self) -> usize {
        (self.dim + 2) * self.bits + bits_of(self.dim)
    }

    /// Returns the number of words of a determinant. A product of one entry from each column has
    /// `product` bits; by the Leibniz formula there are n! of them.
    fn words(&self, product: usize) -> usize {
        let bits = product + bits_of((1..=self.count).product());
        (bits + 2).div_ceil(64)
    }

    /// Returns the sign of the determinant, whose products have so many bits.
    fn sign(&self, product: usize) -> Sign {
        match (self.count, self.words(product)) {
            (..=4, ..=1) => self.sign_in::<i64, 16>(),
            (..=4, ..=2) => self.sign_in::<i128, 16>(),
            (..=4, ..=4) => self.sign_in::<Wide<4>, 16>(),
            (..=4, _) => self.sign_in::<Wide<6>, 16>(),
            (5, ..=2) => self.sign_in::<i128, 32>(),
            (5, _) => self.sign_in::<Wide<7>, 32>(),
            (_, ..=2) => self.sign_in::<i128, 512>(),
            _ => self.sign_in::<Wide<11>, 512>(),
        }
    }

    /// Returns the sign of the minor of all rows, computed from the minors of all sets of rows, at
    /// most `SETS`.
    #[inline(never)]
    fn sign_in<T: Ring, const SETS: usize>(&self) -> Sign {
        let mut minors = [T::ZERO; SETS];
        laplace::expand(&Columns::<T>(self, PhantomData), 1 << self.count, &mut minors);
        minors[(1 << self.count) - 1].sign()
    }
}

/// Matrix whose lines are the columns, so that the squared lengths are needed for one set only,
/// that of all rows.
struct Columns<'a, T>(&'a Rows, PhantomData<T>);

impl<T: Ring> laplace::Matrix for Columns<'_, T> {
    type Minor = T;
    type Sum = T;
    type Sign = i64;
    const ONE: T = T::ONE;
    const PLUS: i64 = 1;
    const ZERO: T = T::ZERO;

    #[inline(always)]
    fn add(&self, sum: &mut T, column: usize, row: usize, sign: i64, minor: T) {
        let row = &self.0.rows[row];
        if column < self.0.dim {
            sum.add_product(minor, sign * row[column]);
        } else {
            // A squared length need not fit in a word: two factors, one after the other.
            for &entry in &row[..self.0.dim] {
                let mut product = T::ZERO;
                product.add_product(minor, entry);
                sum.add_product(product, sign * entry);
            }
        }
    }

    #[inline(always)]
    fn minor(&self, sum: T) -> T {
        sum
    }
}

/// Integers modulo a power of two.
trait Ring: Copy {
    const ZERO: Self;
    const ONE: Self;

    fn add_product(&mut self, other: Self, factor: i64);

    /// Returns the sign of the representative that is nearest to zero.
    fn sign(self) -> Sign;
}

impl Ring for i64 {
    const ZERO: Self = 0;
    const ONE: Self = 1;

    #[inline]
    fn add_product(&mut self, other: Self, factor: i64) {
        *self = self.wrapping_add(other.wrapping_mul(factor));
    }

    fn sign(self) -> Sign {
        Sign::of_integer(self.signum())
    }
}

impl Ring for i128 {
    const ZERO: Self = 0;
    const ONE: Self = 1;

    #[inline]
    fn add_product(&mut self, other: Self, factor: i64) {
        *self = self.wrapping_add(other.wrapping_mul(i128::from(factor)));
    }

    fn sign(self) -> Sign {
        Sign::of_integer(self.signum() as i64)
    }
}

/// Integer of `L` words, the lowest first.
#[derive(Clone, Copy)]
struct Wide<const L: usize>([u64; L]);

impl<const L: usize> Ring for Wide<L> {
    const ZERO: Self = Self([0; L]);
    const ONE: Self = {
        let mut words = [0; L];
        words[0] = 1;
        Self(words)
    };

    /// Adds `other * factor`, without a branch on the sign of `factor`, which a processor cannot
    /// predict.
    #[inline]
    fn add_product(&mut self, other: Self, factor: i64) {
        // To subtract the product is to add its complement and one.
        let flip = (factor >> 63) as u64;
        let (mut high, mut carry) = (0, u128::from(flip & 1));
        for (word, &digit) in self.0.iter_mut().zip(&other.0) {
            let product = u128::from(digit) * u128::from(factor.unsigned_abs()) + high;
            high = product >> 64;
            let sum = u128::from(*word) + u128::from(product as u64 ^ flip) + carry;
            *word = sum as u64;
            carry = sum >> 64;
        }
    }

    fn sign(self) -> Sign {
        let is_zero = self.0.iter().all(|&word| word == 0);
        let top = self.0[L - 1] as i64;
        Sign::of_integer(if is_zero { 0 } else { top >> 63 | 1 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;
    use dashu_int::IBig;

    fn rows_of<const D: usize>(points: &[[f64; D]]) -> Option<Rows> {
        Rows::new(&points[0], points[1..].iter())
    }

    /// Checks signs with all words that a determinant may need, and the span from which on there
    /// are no rows.
    fn signs_agree_at_the_limit<const D: usize>(trials: usize) {
        let largest = 2f64.powi(62).next_down();
        let unit = f64::from_bits(1);
        let mut random = Random(D as u64);
        for trial in 0..trials {
            let values = [largest, -largest, largest, -largest, largest, 1.0, -1.0, 0.0];
            let mut coordinate = || values[random.integer(0, 7 - 3 * (trial as i64 % 2)) as usize];
            let mut points: Vec<[f64; D]> =
                (0..D + 2).map(|_| std::array::from_fn(|_| coordinate())).collect();
            (points[0], points[1][0]) = ([-largest; D], 1.0);
            let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
            let orientation = rows_of(&points[..=D]).expect("a span of 62").orientation();
            assert_eq!(orientation, orientation_oracle(&simplex), "{points:?}");
            let rows = rows_of(&points).expect("a span of 62");
            assert_eq!(rows.lifted_orientation().flip(), in_ball_oracle(&simplex, q), "{points:?}");
            let small: Vec<_> = points.iter().map(|point| point.map(|x| x * unit)).collect();
            assert_eq!(
                rows_of(&small).expect("subnormals").lifted_orientation(),
                rows.lifted_orientation()
            );
            points[1][0] = 0.5;
            assert!(rows_of(&points).is_none());
        }
    }

    #[test]
    fn signs_agree_where_edges_just_fit() {
        signs_agree_at_the_limit::<2>(200);
        signs_agree_at_the_limit::<3>(100);
        signs_agree_at_the_limit::<4>(60);
        signs_agree_at_the_limit::<5>(20);
        signs_agree_at_the_limit::<6>(10);
        signs_agree_at_the_limit::<7>(4);
        signs_agree_at_the_limit::<8>(3);
    }

    /// Checks signs from one bit a coordinate to as many as there may be, so that each number of
    /// words occurs.
    fn signs_agree_for_all_sizes<const D: usize>(step: usize) {
        let mut random = Random(30 + D as u64);
        for bits in (1..=53).step_by(step) {
            let most = (1i64 << bits) - 1;
            let mut points: Vec<[f64; D]> = (0..D + 2)
                .map(|_| std::array::from_fn(|_| random.integer(-most, most) as f64))
                .collect();
            if bits % 2 == 0 {
                // As far from the first as a vertex, and so on its sphere or near it.
                points[D + 1] = std::array::from_fn(|axis| {
                    points[0][axis] + points[1][(axis + 1) % D] - points[0][(axis + 1) % D]
                });
            }
            let simplex = references(&points[..=D]);
            let side = in_ball_oracle(&simplex, &points[D + 1]);
            let rows = rows_of(&points).expect("a small span");
            assert_eq!(rows.lifted_orientation().flip(), side, "{points:?}");
            let rows = rows_of(&points[..=D]).expect("a small span");
            assert_eq!(rows.orientation(), orientation_oracle(&simplex), "{points:?}");
        }
    }

    #[test]
    fn signs_agree_for_all_numbers_of_words() {
        signs_agree_for_all_sizes::<2>(1);
        signs_agree_for_all_sizes::<3>(1);
        signs_agree_for_all_sizes::<4>(1);
        signs_agree_for_all_sizes::<5>(2);
        signs_agree_for_all_sizes::<6>(3);
        signs_agree_for_all_sizes::<7>(7);
        signs_agree_for_all_sizes::<8>(17);
    }

    /// Checks that the largest determinants fit, which Hadamard's matrices have.
    fn the_largest_fit<const D: usize>() {
        for bits in 1..=53 {
            let most = ((1i64 << bits) - 1) as f64;
            let sign =
                |i: usize, j: usize| if (i & j).count_ones() % 2 == 0 { most } else { -most };
            let edges: Vec<[f64; D]> =
                (0..D).map(|i| std::array::from_fn(|j| sign(i, j))).collect();
            let rows = Rows::new(&[0.0; D], edges.iter()).expect("a small span");
            let vertices: Vec<_> = [[0.0; D]].iter().chain(&edges).copied().collect();
            assert_eq!(rows.orientation(), orientation_oracle(&references(&vertices)), "{bits}");
        }
    }

    #[test]
    fn the_largest_determinants_fit() {
        the_largest_fit::<2>();
        the_largest_fit::<4>();
        the_largest_fit::<8>();
    }

    /// Bits count the lengths of edges, wherever the edges lie.
    #[test]
    fn bits_are_those_of_edges() {
        let far = 2f64.powi(52) - 8.0;
        let rows = rows_of(&[[far, far], [far + 1.0, far], [far, far - 1.0]]).expect("a span");
        assert_eq!((rows.bits, rows.count, rows.orientation()), (1, 2, Sign::Negative));
        let scaled = rows_of(&[[0.0, 0.75], [3.75, 0.0], [-0.0, 0.75]]).expect("quarters");
        assert_eq!((scaled.bits, &scaled.rows[0][..2]), (4, &[15, -3][..]));
        assert!(rows_of(&[[0.0; 3]; 4]).is_none(), "no unit");
    }

    /// Checks products of many factors in words against exact ones, modulo the power of two at
    /// which the words wrap.
    fn products_wrap<T: Ring>(bits: usize, value_of: impl Fn(T) -> IBig) {
        let mut random = Random(bits as u64);
        let modulus = IBig::ONE << bits;
        for _ in 0..300 {
            let (mut held, mut value) = (T::ONE, IBig::ONE);
            for _ in 0..bits / 32 {
                let factor = match random.integer(0, 4) {
                    0 => random.integer(-1, 1),
                    1 => i64::MAX,
                    2 => -i64::MAX,
                    _ => random.bits() as i64 | 1,
                };
                let mut product = T::ZERO;
                product.add_product(held, factor);
                held.add_product(product, 1 - factor / 2);
                value = &value + &value * factor * (1 - factor / 2);
                value = (value % &modulus + &modulus) % &modulus;
                assert_eq!(value_of(held), value);
                let sign = match value == IBig::ZERO {
                    true => Sign::Zero,
                    false if value.clone() << 1 >= modulus => Sign::Negative,
                    false => Sign::Positive,
                };
                assert_eq!(held.sign(), sign);
            }
        }
    }

    fn value<const L: usize>(wide: Wide<L>) -> IBig {
        wide.0.iter().rev().fold(IBig::ZERO, |value, &word| (value << 64) + word)
    }

    #[test]
    fn words_hold_what_they_can() {
        products_wrap(64, |x: i64| IBig::from(x as u64));
        products_wrap(128, |x: i128| IBig::from(x as u128));
        products_wrap(256, value::<4>);
        products_wrap(704, value::<11>);
    }
}
