//! The volume of a simplex, whatever its size and shape.

use super::exact::Edges;
use super::filters::{are_flat_at_sight, determinant_filtered, precise_determinant};
use super::power::{UNIT, biased_exponent, scale_by_power};

/// Largest relative error of a determinant in floating point that is accepted; the division by a
/// factorial and two scalings come on top.
const ACCEPTED: f64 = 9e-13;

/// Returns det[p1 - p0, ..., pD - p0] / D! for `D + 1` finite points: the volume, positive if the
/// simplex is positively oriented. Relative error at most 1e-12, or 2^-1074 absolutely where the
/// result is subnormal; infinite beyond `f64::MAX`.
///
/// Usually O(2^D D) floating-point operations; a flat simplex costs some twenty times as much, one
/// that is flat within roundings as many operations in integers.
pub fn volume<const D: usize>(simplex: &[&[f64; D]]) -> f64 {
    let (mantissa, exponent) = determinant_filtered(simplex, ACCEPTED)
        .or_else(|| precise_determinant(simplex, ACCEPTED))
        .unwrap_or_else(|| in_integers(simplex));
    let factorial: u32 = (1..=D as u32).product();
    scale_by_power(mantissa / f64::from(factorial), exponent)
}

/// Returns det[p1 - p0, ..., pD - p0] for `D + 1` finite points as `(m, e)`, m * 2^e with |m| in
/// [1, 2), or m = 0, within 2 units of roundoff; zero only if it is.
///
/// Some thousand operations at most, unless the points are flat within roundings and comparisons do
/// not tell that they are flat.
pub(crate) fn scaled_determinant<const D: usize>(simplex: &[&[f64; D]]) -> (f64, i64) {
    if are_flat_at_sight(simplex) {
        return (0.0, 0);
    }
    match precise_determinant(simplex, 2.0 * UNIT) {
        Some((mantissa, exponent)) => {
            let shift = i64::from(biased_exponent(mantissa)) - 1023;
            (scale_by_power(mantissa, -shift), exponent + shift)
        }
        None => in_integers(simplex),
    }
}

fn in_integers<const D: usize>(simplex: &[&[f64; D]]) -> (f64, i64) {
    Edges::new(simplex[0], simplex[1..].iter().copied()).determinant_of_components()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;
    use dashu_int::IBig;

    fn volumes_agree<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 30 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 1, &mut random);
                let edge = |p: &[f64; D]| -> Vec<IBig> {
                    p.iter().zip(&points[0]).map(|(x, o)| integer(*x) - integer(*o)).collect()
                };
                let rows: Vec<Vec<IBig>> = points[1..].iter().map(edge).collect();
                // In units of 2^-1074 after division by so many more of them.
                let exact = determinant_oracle(&rows);
                let factorial = IBig::from((1..=D).product::<usize>());
                let denominator = factorial << (1074 * (D - 1));
                let (mantissa, exponent) = scaled_determinant(&references(&points));
                let bound = mantissa.abs() * 2.0 * UNIT;
                assert!(mantissa == 0.0 || (1.0..2.0).contains(&mantissa.abs()), "{points:?}");
                // In units of 2^-1074 of one.
                let shift = 1074 - 1074 * D as i64 - exponent;
                let [up, down] = [shift, -shift].map(|shift| shift.max(0) as usize);
                let quotient = (&(exact.clone() << up), &(IBig::ONE << down));
                assert!(is_close(mantissa, bound, 0, quotient), "{family:?} {points:?}");
                let value = volume(&references(&points));
                if value.is_infinite() {
                    let largest = integer(f64::MAX) * &denominator;
                    assert!(exact >= largest || -exact >= largest, "{points:?}");
                    continue;
                }
                let bound = 1e-12 * value.abs() + f64::from_bits(1);
                assert!(is_close(value, bound, 0, (&exact, &denominator)), "{family:?} {points:?}");
            }
        }
    }

    #[test]
    fn volumes_are_determinants_in_integers() {
        volumes_agree::<2>(200);
        volumes_agree::<3>(100);
        volumes_agree::<4>(30);
        volumes_agree::<5>(10);
        volumes_agree::<8>(1);
    }
}
