//! Determinants in floating point, with a bound of their error.

use crate::numerics::power::{TINY, UNIT};
use crate::numerics::{MAX_SIZE, Sign, laplace};

pub(super) type Matrix = [[f64; MAX_SIZE]; MAX_SIZE];

/// Returns the sign of a determinant whose value and error bound are known; `None` if the bound
/// exceeds the value. Never `Some(Sign::Zero)`.
#[inline]
pub(super) fn certain_sign((determinant, bound): (f64, f64)) -> Option<Sign> {
    // An overflow makes the bound infinite or the determinant NaN: neither comparison holds.
    if determinant > bound {
        Some(Sign::Positive)
    } else if determinant < -bound {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// Returns the determinant of the first `size` rows and columns, and a bound of its error. A
/// product of one entry from each row carries `roundings` already. No entry may be larger than 32
/// in magnitude.
pub(super) fn determinant(rows: &Matrix, size: usize, roundings: usize) -> (f64, f64) {
    let (determinant, permanent) = match size {
        ..=4 => expanded::<16>(rows, size),
        5 => expanded::<32>(rows, size),
        _ => expanded::<512>(rows, size),
    };
    // Each level of the expansion adds at most `size` + 2 roundings to a product.
    let roundings = size * (size + 2) + roundings;
    (determinant, 2.0 * roundings as f64 * UNIT * permanent + TINY)
}

/// Returns the cofactors of the last row, which is not read, and bounds of their errors. A product
/// of one entry from each other row carries `roundings` already. No entry may be larger than 32 in
/// magnitude.
pub(super) fn cofactors<const D: usize>(rows: &Matrix, roundings: usize) -> ([f64; D], [f64; D]) {
    let mut minors = [(1.0f64, 1.0f64); 1 << (MAX_SIZE - 1)];
    let all = (1 << D) - 1;
    laplace::expand(&Rows(rows), all, &mut minors);
    let roundings = (D - 1) * (D + 1) + roundings;
    let minor = |place: usize| minors[all ^ (1 << place)];
    // Along the last row, signs alternate from plus at its end.
    let sign = |place: usize| if (D - 1 - place) % 2 == 0 { 1.0 } else { -1.0 };
    (
        std::array::from_fn(|place| sign(place) * minor(place).0),
        std::array::from_fn(|place| 2.0 * roundings as f64 * UNIT * minor(place).1 + TINY),
    )
}

/// Matrix whose minors come with the permanents of their absolute values.
struct Rows<'a>(&'a Matrix);

impl laplace::Matrix for Rows<'_> {
    type Minor = (f64, f64);
    type Sum = (f64, f64);
    type Sign = f64;
    const ONE: (f64, f64) = (1.0, 1.0);
    const PLUS: f64 = 1.0;
    const ZERO: (f64, f64) = (0.0, 0.0);

    #[inline(always)]
    fn add(&self, sum: &mut (f64, f64), row: usize, column: usize, sign: f64, minor: (f64, f64)) {
        let entry = self.0[row][column];
        sum.0 += sign * entry * minor.0;
        sum.1 += entry.abs() * minor.1;
    }

    #[inline(always)]
    fn minor(&self, sum: (f64, f64)) -> (f64, f64) {
        sum
    }
}

/// Returns the determinant and its permanent, from the minors of all sets of columns, at most
/// `SETS`.
fn expanded<const SETS: usize>(rows: &Matrix, size: usize) -> (f64, f64) {
    let mut minors = [(1.0f64, 1.0f64); SETS];
    laplace::expand(&Rows(rows), 1 << size, &mut minors);
    minors[(1 << size) - 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_determinant_is_within_its_bound() {
        let mut rows = [[0.0; MAX_SIZE]; MAX_SIZE];
        // Vandermonde's, whose value is a product of differences.
        let nodes: [f64; MAX_SIZE] = [0.25, -1.0, 0.5, 1.25, -0.75, 1.5, -1.25, 0.125, 1.0];
        for size in 2..=MAX_SIZE {
            for (row, node) in rows.iter_mut().zip(nodes) {
                (0..size).for_each(|power| row[power] = node.powi(power as i32));
            }
            let pairs = (0..size).flat_map(|i| (0..i).map(move |j| nodes[i] - nodes[j]));
            let exact: f64 = pairs.product();
            let (value, bound) = determinant(&rows, size, 0);
            assert!((value - exact).abs() <= bound && bound < 1e-3 * exact.abs(), "{size}");
            assert_eq!(certain_sign((value, bound)), Some(Sign::of(exact)));
            rows[1] = rows[0];
            assert_eq!(certain_sign(determinant(&rows, size, 0)), None, "equal rows, {size}");
        }
    }

    #[test]
    fn what_overflows_has_no_certain_sign() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1.0] {
            assert_eq!(certain_sign((value, f64::INFINITY)), None);
        }
        assert_eq!(certain_sign((-3.0, 2.0)), Some(Sign::Negative));
        assert_eq!(certain_sign((2.0, 2.0)), None);
    }
}
