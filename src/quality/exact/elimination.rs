//! Determinants and linear systems of the edges of simplices, in integers: fraction-free
//! elimination (E. H. Bareiss, "Sylvester's identity and multistep integer-preserving Gaussian
//! elimination", 1968).

use super::{Integer, Number, Refusal};
use crate::memory::{AllocResult, TryGrow, with_capacity};
use crate::mesh::MAX_DIM;
use std::cmp::Ordering;

/// Additional last component of an edge in a lifted determinant.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Lift {
    None,
    /// The square of the edge's length.
    Square,
}

/// Returns the sign of the determinant of the edges from `origin` to `ends`, each with its `lift`.
pub(crate) fn lifted_determinant_sign<const D: usize>(
    origin: &[f64; D],
    ends: &[&[f64; D]],
    lift: Lift,
) -> AllocResult<Ordering> {
    let unit = unit(origin, ends);
    match determinant_sign::<i128, D>(origin, ends, lift, unit) {
        Err(Refusal::TooLarge) => {}
        Err(Refusal::Memory(error)) => return Err(error),
        Ok(sign) => return Ok(sign),
    }
    unbounded(determinant_sign::<Integer, D>(origin, ends, lift, unit))
}

/// A column of right sides.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum RightSide {
    /// The squares of the edges' lengths.
    Square,
    /// Right side with one at each edge.
    Ones,
    /// Right side with one at this edge, zero at the others.
    Unit(usize),
}

/// The rows of a linear system after elimination: `denominator * x` for each side.
pub(crate) struct Solution {
    matrix: Matrix<Integer>,
    dim: usize,
}

impl Solution {
    pub fn numerator(&self, component: usize, side: usize) -> &Integer {
        self.matrix.at(component, self.dim + side)
    }

    pub fn denominator(&self) -> &Integer {
        self.matrix.at(self.dim - 1, self.dim - 1)
    }
}

/// Solves `edge . x = side` over the edges from `origin` to `ends` for each side, in units of
/// `2^exponent`, which is returned; `None` if the edges are dependent.
pub(crate) fn solve<const D: usize>(
    origin: &[f64; D],
    ends: &[&[f64; D]],
    sides: &[RightSide],
) -> AllocResult<Option<(Solution, i32)>> {
    let unit = unit(origin, ends);
    let mut matrix = unbounded(Matrix::<Integer>::edges(origin, ends, unit, sides))?;
    let sign = unbounded(matrix.eliminate(true))?;
    Ok((sign != Ordering::Equal).then_some((Solution { matrix, dim: D }, unit)))
}

/// Takes the result of numbers of any size, which are refused by memory only.
pub(crate) fn unbounded<T>(result: Result<T, Refusal>) -> AllocResult<T> {
    result.map_err(|refusal| match refusal {
        Refusal::Memory(error) => error,
        Refusal::TooLarge => unreachable!("integers have any size"),
    })
}

/// Returns the exponent of the largest power of two that divides all coordinates.
pub(crate) fn unit<const D: usize>(origin: &[f64; D], ends: &[&[f64; D]]) -> i32 {
    let coordinates = ends.iter().copied().chain([origin]).flatten();
    coordinates.filter(|x| **x != 0.0).map(|&x| parts(x).1).min().unwrap_or(0)
}

/// Splits a double into an odd integer and the exponent of a power of two; zero gives zeros.
pub(crate) fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let (biased, fraction) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    let magnitude = if biased == 0 { fraction } else { fraction | 1 << 52 };
    if magnitude == 0 {
        return (0, 0);
    }
    let zeros = magnitude.trailing_zeros();
    let odd = magnitude >> zeros;
    (if x < 0.0 { -odd } else { odd }, biased.max(1) - 1075 + zeros as i32)
}

fn determinant_sign<N: Number, const D: usize>(
    origin: &[f64; D],
    ends: &[&[f64; D]],
    lift: Lift,
    unit: i32,
) -> Result<Ordering, Refusal> {
    let square = [RightSide::Square];
    let sides = if lift == Lift::Square { &square[..] } else { &[] };
    Matrix::<N>::edges(origin, ends, unit, sides)?.eliminate(false)
}

fn product<N: Number>(edge: &[N], other: &[N]) -> Result<N, Refusal> {
    let mut sum = N::shifted(0, 0)?;
    for (component, factor) in edge.iter().zip(other) {
        sum = sum.plus(&component.times(factor)?)?;
    }
    Ok(sum)
}

/// Rows of equal width.
pub(crate) struct Matrix<N> {
    entries: Vec<N>,
    height: usize,
    width: usize,
}

impl<N: Number> Matrix<N> {
    /// Returns the products of the edges from `origin` to `ends` with each other, and in a last
    /// column with themselves, in units of `2^(2 unit)`.
    pub fn products<const D: usize>(
        origin: &[f64; D],
        ends: &[&[f64; D]],
        unit: i32,
    ) -> Result<Self, Refusal> {
        let edges = Self::edges(origin, ends, unit, &[])?;
        let (height, width) = (ends.len(), ends.len() + 1);
        let edge = |i: usize| &edges.entries[i * D..][..D];
        let mut entries = with_capacity(height * width)?;
        for i in 0..height {
            for j in (0..height).chain([i]) {
                entries.push(product(edge(i), edge(j))?);
            }
        }
        Ok(Self { entries, height, width })
    }

    /// Returns a matrix with a row for each of `ends`: its edge in units of `2^unit`, then its
    /// `sides`.
    fn edges<const D: usize>(
        origin: &[f64; D],
        ends: &[&[f64; D]],
        unit: i32,
        sides: &[RightSide],
    ) -> Result<Self, Refusal> {
        let whole = |x: f64| {
            let (odd, exponent) = parts(x);
            N::shifted(odd, if odd == 0 { 0 } else { (exponent - unit) as u32 })
        };
        let mut start = with_capacity(MAX_DIM)?;
        for &x in origin {
            start.push(whole(x)?);
        }
        let width = D + sides.len();
        let mut entries: Vec<N> = with_capacity(ends.len() * width)?;
        for (row, end) in ends.iter().enumerate() {
            for (&x, start) in end.iter().zip(&start) {
                entries.push(whole(x)?.minus(start)?);
            }
            for side in sides {
                let entry = match *side {
                    RightSide::Square => {
                        let edge = &entries[row * width..][..D];
                        product(edge, edge)?
                    }
                    RightSide::Ones => N::shifted(1, 0)?,
                    RightSide::Unit(at) => N::shifted(i64::from(at == row), 0)?,
                };
                entries.try_push(entry)?;
            }
        }
        Ok(Self { entries, height: ends.len(), width })
    }

    pub fn at(&self, row: usize, column: usize) -> &N {
        &self.entries[row * self.width + column]
    }

    /// Eliminates below the diagonal, or if `fully` above it too; returns the determinant's sign.
    /// Each entry is a minor at every step, so that the division by the pivot before leaves no
    /// remainder.
    pub fn eliminate(&mut self, fully: bool) -> Result<Ordering, Refusal> {
        let mut swapped = false;
        for k in 0..self.height {
            let is_pivot = |&row: &usize| self.at(row, k).sign() != Ordering::Equal;
            let Some(pivot) = (k..self.height).find(is_pivot) else {
                return Ok(Ordering::Equal);
            };
            if pivot != k {
                (0..self.width)
                    .for_each(|j| self.entries.swap(k * self.width + j, pivot * self.width + j));
                swapped = !swapped;
            }
            for i in (0..self.height).filter(|&i| i > k || fully && i < k) {
                for j in k + 1..self.width {
                    self.entries[i * self.width + j] = self.reduced(i, j, k)?;
                }
            }
            // An entry on the diagonal becomes the pivot, as all of them are in the end; the pivot
            // before, which divides, comes last.
            for i in 0..if fully { k } else { 0 } {
                self.entries[i * self.width + i] = self.reduced(i, i, k)?;
            }
        }
        let sign = self.at(self.height - 1, self.height - 1).sign();
        Ok(if swapped { sign.reverse() } else { sign })
    }

    /// Returns the entry (i, j) after step k of the elimination.
    fn reduced(&self, i: usize, j: usize, k: usize) -> Result<N, Refusal> {
        let kept = self.at(k, k).times(self.at(i, j))?;
        // The pivot's row has a zero left of the pivot, which is not stored there.
        let value = match j < k {
            true => kept,
            false => kept.minus(&self.at(i, k).times(self.at(k, j))?)?,
        };
        if k == 0 { Ok(value) } else { value.over(self.at(k - 1, k - 1)) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::ratio;
    use super::*;
    use crate::numerics::testing::*;
    use dashu_int::IBig;

    /// Compares solutions for all sides at once with Cramer's rule on another library's integers.
    fn solutions_agree<const D: usize>(trials: usize) {
        let mut independent = 0;
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 70 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 1, &mut random);
                let mut sides = vec![RightSide::Square, RightSide::Ones];
                sides.extend((0..D).map(RightSide::Unit));
                let ends = references(&points[1..]);
                let solution = solve(&points[0], &ends, &sides).unwrap();
                let edge = |i: usize, k: usize| integer(ends[i][k]) - integer(points[0][k]);
                let rows: Vec<Vec<IBig>> =
                    (0..D).map(|i| (0..D).map(|k| edge(i, k)).collect()).collect();
                let determinant = determinant_oracle(&rows);
                let Some((solution, unit)) = solution else {
                    assert!(determinant.is_zero(), "{points:?}");
                    continue;
                };
                independent += 1;
                for (at, side) in sides.iter().enumerate() {
                    let right = |i: usize| match *side {
                        RightSide::Square => rows[i].iter().fold(IBig::ZERO, |sum, x| sum + x * x),
                        RightSide::Ones => IBig::ONE,
                        RightSide::Unit(row) => IBig::from(u8::from(row == i)),
                    };
                    // Edges are in units of 2^-1074 here: so are squares over edges, and 1 over
                    // edges in the inverse.
                    let power = if *side == RightSide::Square { unit + 1074 } else { -unit - 1074 };
                    for k in 0..D {
                        let mut replaced = rows.clone();
                        (0..D).for_each(|i| replaced[i][k] = right(i));
                        let (value, own) = ratio(solution.numerator(k, at), solution.denominator());
                        let shift = own + i64::from(power);
                        let (up, down) = ((-shift).max(0) as usize, shift.max(0) as usize);
                        let (above, below) =
                            (determinant_oracle(&replaced) << (1074 + up), &determinant << down);
                        let bound = value.abs() * 4.0 * f64::EPSILON;
                        assert!(is_close(value, bound, 0, (&above, &below)), "{points:?} {at} {k}");
                    }
                }
            }
        }
        assert!(independent > trials * FAMILIES.len() / 2);
    }

    #[test]
    fn solutions_agree_with_cramers_rule() {
        solutions_agree::<2>(60);
        solutions_agree::<3>(30);
        solutions_agree::<4>(10);
        solutions_agree::<6>(2);
        solutions_agree::<8>(1);
    }

    #[test]
    fn small_numbers_and_large_ones_have_the_same_signs() {
        let mut random = Random(9);
        for _ in 0..200 {
            let points = points::<4>(Family::Grid, 6, &mut random);
            let ends = references(&points[1..]);
            let unit = unit(&points[0], &ends);
            let small = determinant_sign::<i128, 4>(&points[0], &ends, Lift::Square, unit);
            let large = determinant_sign::<Integer, 4>(&points[0], &ends, Lift::Square, unit);
            assert_eq!(small, large, "{points:?}");
            assert!(small.is_ok());
        }
    }
}
