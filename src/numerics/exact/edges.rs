//! The edges of a simplex as integers, and exact determinants of matrices made of them, whatever
//! the sizes of the coordinates. One common power of two scales all of them, which makes them
//! integers and changes no sign.
//!
//! A determinant is computed modulo as many primes as the bound of its magnitude asks for: nothing
//! is rounded, and no memory grows with the numbers.

use super::integer::{Integer, primes_for};
use super::residues::Field;
use crate::numerics::power::{bits_of, decompose, unit_and_span};
use crate::numerics::{MAX_DIM, MAX_SIZE, Sign, laplace};
use std::ops::Neg;

/// Number of 63-bit limbs of the largest coordinate in units of the smallest, 2^2098, plus one.
const MAX_LIMBS: usize = 2098 / 63 + 1;

/// Matrix of residues, each beside its negative; entries beyond the size of the matrix are zero.
struct Residues {
    field: Field,
    rows: [[[u64; 2]; MAX_SIZE]; MAX_SIZE],
}

type Minors = [u64; 1 << MAX_SIZE];

/// Number of primes that is enough for all but coordinates of very different sizes.
const FEW: usize = 32;

/// Number of primes that is enough for all doubles in all dimensions.
const MANY: usize = Field::COUNT;

/// Edges from an origin to at most `D + 1` other points, in units of `2^unit`.
pub(crate) struct Edges<const D: usize> {
    origin: [Coordinate; D],
    ends: [[Coordinate; D]; MAX_SIZE],
    count: usize,
    /// Largest exponent of a power of two that divides all the coordinates.
    pub unit: i32,
    /// Exponent of a power of two that is larger than the magnitude of every component of an edge.
    bits: usize,
    /// Number of limbs of the largest coordinate.
    limbs: usize,
}

/// Column of a matrix with a row for each edge.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Column {
    /// Component of the edges along this axis.
    Component(usize),
    /// Squared lengths of the edges.
    Square,
    /// Number 1 in every row.
    Ones,
}

/// Number `mantissa * 2^(63 limbs + shift)` with `shift` < 63.
#[derive(Clone, Copy)]
struct Coordinate {
    mantissa: i64,
    limbs: u32,
    shift: u32,
}

impl Coordinate {
    const ZERO: Self = Self { mantissa: 0, limbs: 0, shift: 0 };

    /// Returns `value / 2^unit`, which must be an integer.
    fn new(value: f64, unit: i32) -> Self {
        if value == 0.0 {
            return Self::ZERO;
        }
        let (mantissa, exponent) = decompose(value);
        let shift = (exponent - unit) as u32;
        Self { mantissa, limbs: shift / 63, shift: shift % 63 }
    }

    fn residue(self, field: Field, powers: &[u64; MAX_LIMBS]) -> u64 {
        // Less than 2^53 times 2^62.
        let low = field.reduce(u128::from(self.mantissa.unsigned_abs()) << self.shift);
        let value = field.multiply(low, powers[self.limbs as usize]);
        if self.mantissa < 0 { field.subtract(0, value) } else { value }
    }
}

impl<const D: usize> Edges<D> {
    pub fn new<'a>(origin: &'a [f64; D], ends: impl Iterator<Item = &'a [f64; D]> + Clone) -> Self {
        const { assert!(D <= MAX_DIM) };
        let (unit, span) = unit_and_span(ends.clone().chain([origin]).flatten()).unwrap_or((0, 0));
        let scaled = |p: &[f64; D]| p.map(|x| Coordinate::new(x, unit));
        let mut edges = Self {
            origin: scaled(origin),
            ends: [[Coordinate::ZERO; D]; MAX_SIZE],
            count: 0,
            unit,
            // A difference is less than twice the larger of two.
            bits: span + 1,
            limbs: span / 63,
        };
        for p in ends {
            edges.ends[edges.count] = scaled(p);
            edges.count += 1;
        }
        edges
    }

    /// Returns the sign of the determinant of these columns, of which there are as many as edges.
    pub fn sign_of_determinant(&self, columns: &[Column]) -> Sign {
        let primes = primes_for(self.bits_of_determinants(columns));
        if primes <= FEW {
            self.sign_in::<FEW>(columns, primes)
        } else {
            self.sign_in::<MANY>(columns, primes)
        }
    }

    fn sign_in<const N: usize>(&self, columns: &[Column], primes: usize) -> Sign {
        let mut value = Integer::<N>::NEW;
        self.minors(columns, primes, |minors| value.push(minors[(1 << columns.len()) - 1]));
        value.sign()
    }

    /// Returns the sign of the scalar product of the first two edges.
    pub fn sign_of_product(&self) -> Sign {
        debug_assert_eq!(self.count, 2);
        let primes = primes_for(2 * self.bits + bits_of(D));
        let mut value = Integer::<MANY>::NEW;
        for field in (0..primes).map(Field::nth) {
            let [a, b] = [0, 1].map(|edge| self.residues(field, edge));
            value.push(field.sum_of_products(a.into_iter().zip(b)));
        }
        value.sign()
    }

    /// Returns the determinant m * 2^e of the components of `D` edges as `(m, e)` with |m| in [1,
    /// 2), or m = 0, within 2 units of roundoff.
    pub fn determinant_of_components(&self) -> (f64, i64) {
        debug_assert_eq!(self.count, D);
        let columns: [Column; D] = std::array::from_fn(Column::Component);
        let primes = primes_for(self.bits_of_determinants(&columns));
        let (mantissa, exponent) = if primes <= FEW {
            self.determinant_in::<FEW>(&columns, primes)
        } else {
            self.determinant_in::<MANY>(&columns, primes)
        };
        (mantissa, exponent + D as i64 * i64::from(self.unit))
    }

    fn determinant_in<const N: usize>(&self, columns: &[Column], primes: usize) -> (f64, i64) {
        let (mut value, mut one) = (Integer::<N>::NEW, Integer::<N>::NEW);
        self.minors(columns, primes, |minors| {
            value.push(minors[(1 << columns.len()) - 1]);
            one.push(1);
        });
        value.divided_by(&one)
    }

    /// Returns the solution x of `D` equations, edge . x = right, each component m * 2^e as `(m,
    /// e)` with |m| in [1, 2), or m = 0, within 2 units of roundoff; `None` if the edges are
    /// dependent.
    pub fn solve(&self, right: Column) -> Option<[(f64, i64); D]> {
        debug_assert_eq!(self.count, D);
        let mut columns = [right; MAX_SIZE];
        (0..D).for_each(|k| columns[k] = Column::Component(k));
        let columns = &columns[..=D];
        let primes = primes_for(self.bits_of_determinants(columns));
        if primes <= FEW {
            self.solve_in::<FEW>(columns, primes)
        } else {
            self.solve_in::<MANY>(columns, primes)
        }
    }

    /// Solves equations by Cramer's rule, with at most `N` primes: a numerator is the minor of all
    /// columns but one.
    fn solve_in<const N: usize>(
        &self,
        columns: &[Column],
        primes: usize,
    ) -> Option<[(f64, i64); D]> {
        let all = (1 << columns.len()) - 1;
        let mut determinant = Integer::<N>::NEW;
        let mut numerators: [Integer<N>; D] = [const { Integer::NEW }; D];
        self.minors(columns, primes, |minors| {
            determinant.push(minors[all ^ 1 << D]);
            numerators.iter_mut().enumerate().for_each(|(k, x)| x.push(minors[all ^ 1 << k]));
        });
        if determinant.sign().is_zero() {
            return None;
        }
        Some(std::array::from_fn(|k| {
            let (mantissa, exponent) = numerators[k].divided_by(&determinant);
            // The right side has to pass the columns after k to be in its place.
            (if (D - 1 - k) % 2 == 0 { mantissa } else { -mantissa }, exponent)
        }))
    }

    /// Calls `take` with the residues of the minors for each of the first `primes` fields.
    fn minors(&self, columns: &[Column], primes: usize, mut take: impl FnMut(&Minors)) {
        // There are no minors of more columns than rows: the set of all columns may be one.
        let end = (1 << columns.len()) - usize::from(columns.len() > self.count);
        let mut minors = [0; 1 << MAX_SIZE];
        for field in (0..primes).map(Field::nth) {
            let matrix = self.matrix(field, columns);
            laplace::expand(&matrix, end, &mut minors);
            take(&minors);
        }
    }

    /// Returns an exponent of 2 that bounds all minors of as many of the columns as there are
    /// edges: by the Leibniz formula such a minor is the sum of n! products of one entry from each
    /// of n columns. At most 21012, for the sphere in eight dimensions through points at both ends
    /// of the doubles.
    fn bits_of_determinants(&self, columns: &[Column]) -> usize {
        let entries = columns.iter().map(|column| match column {
            Column::Component(_) => self.bits,
            Column::Square => 2 * self.bits + bits_of(D),
            Column::Ones => 0,
        });
        let smallest = if columns.len() > self.count { entries.clone().min() } else { None };
        entries.sum::<usize>() - smallest.unwrap_or(0) + bits_of((1..=self.count).product())
    }

    /// Returns the residues of the powers of the unit of a limb.
    fn powers(&self, field: Field) -> [u64; MAX_LIMBS] {
        let mut powers = [1; MAX_LIMBS];
        for k in 1..=self.limbs {
            powers[k] = field.multiply(powers[k - 1], field.limb_unit());
        }
        powers
    }

    /// Returns the residues of the components of one edge.
    fn residues(&self, field: Field, edge: usize) -> [u64; D] {
        let powers = self.powers(field);
        std::array::from_fn(|k| {
            let [end, origin] =
                [self.ends[edge][k], self.origin[k]].map(|x| x.residue(field, &powers));
            field.subtract(end, origin)
        })
    }

    fn matrix(&self, field: Field, columns: &[Column]) -> Residues {
        let powers = self.powers(field);
        let residues = |p: &[Coordinate; D]| p.map(|x| x.residue(field, &powers));
        let origin = residues(&self.origin);
        let mut rows = [[[0; 2]; MAX_SIZE]; MAX_SIZE];
        for (i, end) in self.ends[..self.count].iter().enumerate() {
            let end = residues(end);
            let edge: [u64; D] = std::array::from_fn(|k| field.subtract(end[k], origin[k]));
            for (entry, column) in rows[i].iter_mut().zip(columns) {
                let residue = match *column {
                    Column::Component(k) => edge[k],
                    Column::Square => field.sum_of_products(edge.into_iter().zip(edge)),
                    Column::Ones => 1,
                };
                *entry = [residue, field.subtract(0, residue)];
            }
        }
        Residues { field, rows }
    }
}

impl laplace::Matrix for Residues {
    type Minor = u64;
    type Sum = u128;
    type Sign = Side;
    const ONE: u64 = 1;
    const PLUS: Side = Side(0);
    const ZERO: u128 = 0;

    #[inline(always)]
    fn add(&self, sum: &mut u128, row: usize, column: usize, side: Side, minor: u64) {
        let entry = self.rows[row][column][side.0 & 1];
        *sum += self.field.folded_product(entry, minor);
    }

    #[inline(always)]
    fn minor(&self, sum: u128) -> u64 {
        self.field.reduce(sum)
    }
}

/// Choice between a residue, 0, and its negative, 1.
#[derive(Clone, Copy)]
struct Side(usize);

impl Neg for Side {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0 ^ 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;
    use crate::numerics::{circumcenter_exact, in_ball_exact, orientation_exact};

    /// Returns points with coordinates from both ends of the doubles, for which integers are as
    /// long as they get.
    fn at_the_ends<const D: usize>(random: &mut Random) -> Vec<[f64; D]> {
        let most = [f64::MAX, -f64::MAX, f64::MAX, -f64::MAX, f64::from_bits(1), 0.0];
        let mut coordinate = || most[random.integer(0, 5) as usize];
        let mut points: Vec<[f64; D]> =
            (0..D + 2).map(|_| std::array::from_fn(|_| coordinate())).collect();
        points[0] = [-f64::MAX; D];
        points[1][0] = f64::from_bits(1);
        points
    }

    fn signs_agree_at_the_ends<const D: usize>(trials: usize) {
        let mut random = Random(D as u64);
        for _ in 0..trials {
            let points = at_the_ends::<D>(&mut random);
            let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
            assert_eq!(orientation_exact(&simplex), orientation_oracle(&simplex), "{points:?}");
            assert_eq!(in_ball_exact(&simplex, q), in_ball_oracle(&simplex, q), "{points:?}");
        }
    }

    #[test]
    fn the_longest_numbers_fit() {
        signs_agree_at_the_ends::<2>(60);
        signs_agree_at_the_ends::<3>(40);
        signs_agree_at_the_ends::<4>(20);
        signs_agree_at_the_ends::<5>(8);
        signs_agree_at_the_ends::<6>(4);
        signs_agree_at_the_ends::<7>(3);
        signs_agree_at_the_ends::<8>(3);
        let points = at_the_ends::<8>(&mut Random(0));
        let edges = Edges::new(&points[0], points[1..].iter());
        let mut columns = [Column::Square; MAX_SIZE];
        (0..8).for_each(|k| columns[k] = Column::Component(k));
        assert_eq!(edges.bits_of_determinants(&columns), 21012);
        assert_eq!(primes_for(21012), Field::COUNT);
    }

    #[test]
    fn minors_are_those_of_the_first_rows() {
        let field = Field::nth(0);
        let mut rows = [[[0; 2]; MAX_SIZE]; MAX_SIZE];
        for (row, residues) in rows.iter_mut().zip([[1, 2, 3], [4, 5, 7]]) {
            for (entry, residue) in row.iter_mut().zip(residues) {
                *entry = [residue, field.prime() - residue];
            }
        }
        let mut minors = [0; 1 << MAX_SIZE];
        laplace::expand(&Residues { field, rows }, 7, &mut minors);
        let negative = |x: u64| field.prime() - x;
        // By sets of columns: none, {0}, {1}, {0, 1}, {2}, {0, 2}, {1, 2}.
        assert_eq!(minors[..7], [1, 1, 2, negative(3), 3, negative(5), negative(1)]);
    }

    #[test]
    fn points_at_the_origin_are_flat() {
        let (simplex, q) = ([&[0.0, -0.0]; 3], [0.0; 2]);
        assert_eq!(
            (orientation_exact(&simplex), in_ball_exact(&simplex, &q)),
            (Sign::Zero, Sign::Zero)
        );
        assert!(circumcenter_exact(&simplex, 1).is_none());
    }

    /// Exact signs need little stack: threads of some systems have 128 KiB.
    #[test]
    fn a_small_stack_is_enough() {
        let points = at_the_ends::<8>(&mut Random(1));
        let near = points.iter().map(|point| point.map(|x| x.signum() * 2f64.powi(61) + 1024.0));
        let near: Vec<_> = near.collect();
        let work = move || {
            for points in [&near, &points] {
                let (simplex, q) = (references(&points[..9]), &points[9]);
                assert_eq!(in_ball_exact(&simplex, q), in_ball_oracle(&simplex, q));
            }
            let simplex = references(&points[..9]);
            assert!(circumcenter_exact(&simplex, 0).is_some());
        };
        let thread = std::thread::Builder::new().stack_size(64 << 10).spawn(work);
        thread.expect("a thread").join().expect("no overflow, which would end the process");
    }
}
