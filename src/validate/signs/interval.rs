//! Signs of determinants by Gaussian elimination in intervals: they are certain if no pivot may be
//! zero.

use crate::mesh::MAX_DIM;
use crate::quality::exact::Lift;
use crate::quality::length::{exponent_of, scale};
use std::cmp::Ordering;

/// A real number between two doubles. Each operation widens what rounding to nearest gives by one
/// double on either side, which covers rounding, underflow and overflow.
#[derive(Clone, Copy)]
struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    const ZERO: Self = Self { low: 0.0, high: 0.0 };

    fn around(low: f64, high: f64) -> Self {
        Self { low: low.next_down(), high: high.next_up() }
    }

    fn plus(self, other: Self) -> Self {
        Self::around(self.low + other.low, self.high + other.high)
    }

    fn minus(self, other: Self) -> Self {
        Self::around(self.low - other.high, self.high - other.low)
    }

    fn times(self, other: Self) -> Self {
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        if products.iter().any(|product| product.is_nan()) {
            return Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
        }
        let low = products.iter().copied().fold(f64::INFINITY, f64::min);
        Self::around(low, products.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    }

    /// Divides by an interval that does not hold zero.
    fn over(self, divisor: Self) -> Self {
        self.times(Self::around(1.0 / divisor.high, 1.0 / divisor.low))
    }

    /// Returns `2^exponent` times this interval.
    fn scaled(self, exponent: i32) -> Self {
        Self::around(scale(self.low, exponent), scale(self.high, exponent))
    }

    /// Returns the sign; `None` if the number may be zero.
    fn sign(self) -> Option<Ordering> {
        if self.low > 0.0 {
            Some(Ordering::Greater)
        } else if self.high < 0.0 {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// Returns the least magnitude that the number may have.
    fn least(self) -> f64 {
        self.low.max(-self.high).max(0.0)
    }
}

const SIZE: usize = MAX_DIM + 1;

/// Returns the sign of the determinant of the edges from `origin` to `ends`, each with its `lift`;
/// `None` if the intervals do not tell.
pub(super) fn determinant_sign<const D: usize>(
    origin: &[f64; D],
    ends: &[&[f64; D]],
    lift: Lift,
) -> Option<Ordering> {
    let mut rows = [[Interval::ZERO; SIZE]; SIZE];
    let mut exponents = [0; SIZE];
    for (i, end) in ends.iter().enumerate() {
        let edge: [f64; D] = std::array::from_fn(|k| end[k] - origin[k]);
        let longest = edge.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        // Neither a difference that overflows nor an edge of no length.
        exponents[i] = exponent_of(longest)?;
        for (entry, x) in rows[i].iter_mut().zip(edge) {
            *entry = Interval::around(x, x).scaled(-exponents[i]);
        }
    }
    if lift == Lift::Square {
        // A row in units of its edge has the square in units of that edge too; the column in the
        // longest.
        let longest = exponents[..ends.len()].iter().copied().max()?;
        for (row, exponent) in rows.iter_mut().zip(&exponents[..ends.len()]) {
            let square = row[..D].iter().fold(Interval::ZERO, |sum, &x| sum.plus(x.times(x)));
            row[D] = square.scaled(exponent - longest);
        }
    }
    eliminate(&mut rows, ends.len())
}

/// Returns the sign of the determinant of the first `size` rows and columns: that of the product of
/// the pivots.
fn eliminate(rows: &mut [[Interval; SIZE]; SIZE], size: usize) -> Option<Ordering> {
    let mut sign = Ordering::Greater;
    for k in 0..size {
        let least = |&i: &usize| rows[i][k].least();
        let pivot = (k..size).max_by(|a, b| least(a).total_cmp(&least(b)))?;
        if pivot != k {
            rows.swap(pivot, k);
            sign = sign.reverse();
        }
        let above = rows[k];
        if above[k].sign()? == Ordering::Less {
            sign = sign.reverse();
        }
        for row in &mut rows[k + 1..size] {
            let factor = row[k].over(above[k]);
            for j in k + 1..size {
                row[j] = row[j].minus(factor.times(above[j]));
            }
        }
    }
    Some(sign)
}
