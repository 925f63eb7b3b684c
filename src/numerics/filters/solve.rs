//! Small linear systems with a rigorous bound of the solution's error.

use crate::numerics::lengths::largest_magnitude;
use crate::numerics::power::{TINY, UNIT};

/// Solves `rows * x = right`, where the rows' largest magnitudes are in [1, 2) and `right` is
/// positive and at most 2 D. All stand for exact numbers, from which the entries differ by at most
/// one roundoff and those of `right` by D + 3, relatively, beside underflow. Returns x and a bound
/// of the largest component error against the exact system's solution, which holds if it is at most
/// a thousandth of the largest component; it is larger, infinite or NaN if the system is too close
/// to singular.
#[inline]
pub(super) fn solve<const D: usize>(rows: &[[f64; D]; D], right: &[f64; D]) -> ([f64; D], f64) {
    match D {
        2 => by_two_minors(rows, right),
        3 => by_three_minors(rows, right),
        _ => by_inverse(rows, right),
    }
}

/// Returns the largest component error of numerators over a determinant with the given `inverse`,
/// where a numerator is wrong by at most `numerator_error` and the determinant by
/// `determinant_error`. With a result of at most `size / 1000` the determinant is right to a
/// thousandth, which 1.01 pays for.
#[inline]
fn quotient_error(size: f64, inverse: f64, numerator_error: f64, determinant_error: f64) -> f64 {
    1.01 * (numerator_error + size * determinant_error) * inverse.abs() + 2.0 * UNIT * size
}

/// Solves a system in the plane by Cramer's rule. A product of the determinant carries 4 roundings
/// (2 entries, the product, the difference), one of a numerator 8 (an entry, 5 of the right side,
/// ...): 8 and 16 are allowed.
#[inline]
fn by_two_minors<const D: usize>(a: &[[f64; D]; D], b: &[f64; D]) -> ([f64; D], f64) {
    let (left, right) = (a[0][0] * a[1][1], a[0][1] * a[1][0]);
    let determinant = left - right;
    let (x0, x1) = (b[0] * a[1][1], b[1] * a[0][1]);
    let (y0, y1) = (b[1] * a[0][0], b[0] * a[1][0]);
    let inverse = 1.0 / determinant;
    let mut solution = [0.0; D];
    solution[0] = (x0 - x1) * inverse;
    solution[1] = (y0 - y1) * inverse;
    let size = largest_magnitude(&solution);
    let largest = largest_magnitude(&[x0.abs() + x1.abs(), y0.abs() + y1.abs()]);
    let numerator_error = 16.0 * UNIT * largest + TINY;
    let determinant_error = 8.0 * UNIT * (left.abs() + right.abs()) + TINY;
    (solution, quotient_error(size, inverse, numerator_error, determinant_error))
}

/// Returns the signed 2x2 minors of rows `r` and `s` (their cross product), and the permanents of
/// their absolute values.
#[inline]
fn cross<const D: usize>(r: &[f64; D], s: &[f64; D]) -> ([f64; 3], [f64; 3]) {
    let minor = |i: usize, j: usize| {
        let (left, right) = (r[i] * s[j], r[j] * s[i]);
        (left - right, left.abs() + right.abs())
    };
    let [(x, px), (y, py), (z, pz)] = [minor(1, 2), minor(2, 0), minor(0, 1)];
    ([x, y, z], [px, py, pz])
}

/// Solves a system in space by Cramer's rule. A product of the determinant carries 8 roundings, one
/// of a numerator 13: 16 and 24 are allowed.
#[inline]
fn by_three_minors<const D: usize>(a: &[[f64; D]; D], b: &[f64; D]) -> ([f64; D], f64) {
    let (m0, p0) = cross(&a[1], &a[2]);
    let (m1, p1) = cross(&a[2], &a[0]);
    let (m2, p2) = cross(&a[0], &a[1]);
    let determinant = a[0][0] * m0[0] + a[0][1] * m0[1] + a[0][2] * m0[2];
    let permanent = a[0][0].abs() * p0[0] + a[0][1].abs() * p0[1] + a[0][2].abs() * p0[2];
    let inverse = 1.0 / determinant;
    let mut solution = [0.0; D];
    let mut permanents = [0.0; 3];
    for i in 0..3 {
        solution[i] = (b[0] * m0[i] + b[1] * m1[i] + b[2] * m2[i]) * inverse;
        permanents[i] = b[0] * p0[i] + b[1] * p1[i] + b[2] * p2[i];
    }
    let (size, largest) = (largest_magnitude(&solution), largest_magnitude(&permanents));
    let numerator_error = 24.0 * UNIT * largest + TINY;
    let determinant_error = 16.0 * UNIT * permanent + TINY;
    (solution, quotient_error(size, inverse, numerator_error, determinant_error))
}

/// Solves with an approximate inverse B and bounds the error afterwards: with A the exact matrix
/// and |I - BA| <= 1/4 in the row-sum norm, |x - A^-1 b| <= 2 |B| |b - Ax|.
fn by_inverse<const D: usize>(a: &[[f64; D]; D], b: &[f64; D]) -> ([f64; D], f64) {
    // Dot products of D terms and the roundings in the data, twice over.
    let gamma = 2.0 * (D + 4) as f64 * UNIT;
    let Some(inverse) = invert(a) else { return (*b, f64::INFINITY) };
    let solution: [f64; D] = std::array::from_fn(|i| dot(&inverse[i], b));
    let residual: [f64; D] = std::array::from_fn(|i| {
        let magnitudes = absolute_dot(&a[i], &solution) + b[i];
        (dot(&a[i], &solution) - b[i]).abs() + gamma * magnitudes + TINY
    });
    let row_sums: [f64; D] = std::array::from_fn(|i| a[i].iter().map(|x| x.abs()).sum());
    let mut error = 0.0f64;
    for (i, row) in inverse.iter().enumerate() {
        let mut product = [0.0; D];
        for (factor, other) in row.iter().zip(a) {
            product = std::array::from_fn(|j| product[j] + factor * other[j]);
        }
        product[i] -= 1.0;
        let rounding = gamma * (1.0 + absolute_dot(row, &row_sums)) + TINY;
        let defect = product.iter().fold(rounding, |sum, x| sum + x.abs());
        if !(0.0..=0.25).contains(&defect) {
            return (solution, f64::INFINITY); // NaN too: what remains is finite
        }
        error = error.max(2.0 * absolute_dot(row, &residual));
    }
    (solution, error)
}

#[inline]
fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).fold(0.0, |sum, k| sum + a[k] * b[k])
}

#[inline]
fn absolute_dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).fold(0.0, |sum, k| sum + (a[k] * b[k]).abs())
}

/// Returns an approximate inverse by Gauss-Jordan elimination with row pivoting; `None` if a pivot
/// is zero.
fn invert<const D: usize>(matrix: &[[f64; D]; D]) -> Option<[[f64; D]; D]> {
    let mut a = *matrix;
    let mut inverse: [[f64; D]; D] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    for k in 0..D {
        let mut at = k;
        for i in k + 1..D {
            if a[i][k].abs() > a[at][k].abs() {
                at = i;
            }
        }
        a.swap(k, at);
        inverse.swap(k, at);
        if a[k][k] == 0.0 {
            return None;
        }
        let pivot = 1.0 / a[k][k];
        let (row, inverse_row) = (a[k].map(|x| x * pivot), inverse[k].map(|x| x * pivot));
        for i in 0..D {
            let factor = a[i][k];
            for j in 0..D {
                a[i][j] -= factor * row[j];
                inverse[i][j] -= factor * inverse_row[j];
            }
        }
        (a[k], inverse[k]) = (row, inverse_row);
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::power::scale_by_power;
    use crate::numerics::testing::{Random, determinant_oracle, integer, is_close};

    /// Returns rows with a largest magnitude in [1, 2), nearly dependent by 2^-`depth`, and right
    /// sides of at most 2 D.
    fn system<const D: usize>(depth: i64, random: &mut Random) -> ([[f64; D]; D], [f64; D]) {
        let mut row = || -> [f64; D] { std::array::from_fn(|_| random.unit()) };
        let first = row();
        let mut rows: [[f64; D]; D] = std::array::from_fn(|_| {
            let other = row();
            std::array::from_fn(|k| first[k] + other[k] * scale_by_power(1.0, -depth))
        });
        for row in &mut rows {
            let exponent = crate::numerics::power::biased_exponent(largest_magnitude(row)) - 1023;
            *row = row.map(|x| scale_by_power(x, i64::from(-exponent)));
        }
        (rows, std::array::from_fn(|_| (random.unit() + 1.0) * D as f64))
    }

    /// Checks that the exact solution is within the bound of the computed one; returns how many
    /// were bounded.
    fn bounds_hold<const D: usize>(trials: usize, depth: i64) -> usize {
        let mut random = Random(D as u64 * 100 + depth as u64);
        let bounded = |_: &usize| {
            let (rows, right) = system::<D>(depth, &mut random);
            let (solution, error) = solve(&rows, &right);
            let is_bounded = error <= 1e-3 * largest_magnitude(&solution);
            if is_bounded {
                let exact = rows.map(|row| row.map(integer).to_vec());
                let denominator = determinant_oracle(&exact);
                for k in 0..D {
                    let mut replaced = exact.clone();
                    replaced.iter_mut().zip(right).for_each(|(row, b)| row[k] = integer(b));
                    // `is_close` takes the quotient in units of 2^-1074.
                    let quotient = (&(determinant_oracle(&replaced) << 1074), &denominator);
                    assert!(is_close(solution[k], error, 0, quotient), "{rows:?} {right:?}");
                }
            }
            is_bounded
        };
        (0..trials).filter(bounded).count()
    }

    #[test]
    fn solutions_are_within_their_bounds() {
        fn check<const D: usize>(trials: usize) {
            for depth in [0, 10, 20, 30, 40, 45] {
                bounds_hold::<D>(trials, depth);
            }
            // A bound is worth something: it is rarely missing where nothing is wrong.
            assert!(bounds_hold::<D>(100, 0) > 95);
        }
        check::<2>(200);
        check::<3>(200);
        check::<4>(100);
        check::<6>(20);
        check::<8>(5);
    }

    /// The bound of x = right for the unit matrix, in units of roundoff, is what the proofs allow.
    #[test]
    fn bounds_are_those_of_the_counted_roundings() {
        fn units<const D: usize>(size: f64) -> f64 {
            let rows =
                std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
            let (solution, error) = solve::<D>(&rows, &[size; D]);
            assert_eq!(solution, [size; D]);
            error / (UNIT * size)
        }
        for size in [1.0, 1.5] {
            // 1.01 times what numerators and determinants are wrong by, and the last rounding
            // twice.
            assert!((units::<2>(size) - (1.01 * (16.0 + 8.0) + 2.0)).abs() < 1e-3);
            assert!((units::<3>(size) - (1.01 * (24.0 + 16.0) + 2.0)).abs() < 1e-3);
            // Twice gamma times |row| |x| + b.
            assert!((units::<4>(size) - 2.0 * 2.0 * 8.0 * 2.0).abs() < 1e-3);
            assert!((units::<8>(size) - 2.0 * 2.0 * 12.0 * 2.0).abs() < 1e-3);
        }
    }

    /// Roundings that the residual may hide are added to it.
    #[test]
    fn residuals_do_not_offset_their_roundings() {
        let mut random = Random(9);
        for _ in 0..100 {
            let (a, b) = (1.0 + random.unit().abs(), 1.0 + random.unit().abs());
            let rows =
                std::array::from_fn(|i| std::array::from_fn(|j| if i == j { a } else { 0.0 }));
            let (solution, error) = solve::<4>(&rows, &[b; 4]);
            let gamma = 2.0 * 8.0 * UNIT;
            let residual = (a * solution[0] - b).abs() + gamma * (a * solution[0] + b);
            assert!((error * a / (2.0 * residual) - 1.0).abs() < 1e-9);
        }
    }

    /// The inverse is exact here, and differences in the data, which cancel nowhere, could make the
    /// matrix singular.
    #[test]
    fn rows_that_cancel_are_not_small() {
        let near = -1.0 + 2f64.powi(-48);
        let rows = [
            [1.0, -1.0, 0.0, 0.0],
            [1.0, near, 0.0, 0.0],
            [0.0, 0.0, 1.0, -1.0],
            [0.0, 0.0, 1.0, near],
        ];
        assert_eq!(solve(&rows, &[1.0; 4]).1, f64::INFINITY);
    }

    /// All terms of determinants and numerators count, whatever their signs: these cancel.
    #[test]
    fn bounds_grow_with_the_permanents() {
        for signs in 0..32 {
            let sign = |bit: i32| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 };
            let mut rows = [[sign(0), sign(1)], [sign(2) * 0.5, sign(3) * 0.75]];
            if signs >= 16 {
                rows.iter_mut().for_each(|row| row.swap(0, 1));
            }
            let (solution, error) = solve(&rows, &[1.0, 1.0]);
            let determinant = (rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]).abs();
            let size = largest_magnitude(&solution);
            // Permanents: 0.75 + 0.5 of the matrix, 0.75 + 1 and 0.5 + 1 of the numerators.
            let expected = 1.01 * (16.0 * 1.75 + size * 8.0 * 1.25) / determinant + 2.0 * size;
            assert!((error / (UNIT * expected) - 1.0).abs() < 1e-9, "{rows:?}");
        }
        for signs in 0..512 {
            let sign = |bit: usize| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 };
            let magnitudes = [[1.0, 0.5, 0.25], [0.5, 1.25, 0.75], [0.25, 0.5, 1.5]];
            let rows: [[f64; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| magnitudes[i][j] * sign(3 * i + j))
            });
            let right = [1.0, 2.0, 3.0];
            let (solution, error) = solve(&rows, &right);
            let size = largest_magnitude(&solution);
            let replaced = |k: usize| {
                let mut replaced = magnitudes;
                replaced.iter_mut().zip(right).for_each(|(row, b)| row[k] = b);
                permanent(&replaced)
            };
            let largest = replaced(0).max(replaced(1)).max(replaced(2));
            let determinant = determinant(&rows);
            if determinant == 0.0 {
                continue;
            }
            let sums = 24.0 * largest + size * 16.0 * permanent(&magnitudes);
            let expected = 1.01 * sums / determinant.abs() + 2.0 * size;
            assert!((error / (UNIT * expected) - 1.0).abs() < 1e-9, "{rows:?}");
        }
    }

    fn determinant(m: &[[f64; 3]; 3]) -> f64 {
        let turn = |s: usize| m[0][s] * m[1][(s + 1) % 3] * m[2][(s + 2) % 3];
        let back = |s: usize| m[0][s] * m[1][(s + 2) % 3] * m[2][(s + 1) % 3];
        (0..3).map(|s| turn(s) - back(s)).sum()
    }

    fn permanent(m: &[[f64; 3]; 3]) -> f64 {
        let turn = |s: usize| m[0][s] * m[1][(s + 1) % 3] * m[2][(s + 2) % 3];
        let back = |s: usize| m[0][s] * m[1][(s + 2) % 3] * m[2][(s + 1) % 3];
        (0..3).map(|s| turn(s) + back(s)).sum()
    }

    #[test]
    fn singular_systems_have_no_bound() {
        fn bound<const D: usize>() -> f64 {
            solve(&[[1.0; D]; D], &[1.0; D]).1
        }
        for error in [bound::<2>(), bound::<3>(), bound::<4>(), bound::<8>()] {
            assert!(error.is_nan() || error == f64::INFINITY);
        }
    }
}
