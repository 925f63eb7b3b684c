//! The orientation of a simplex, exactly.

use super::at_sight::are_flat_at_sight;
use super::determinant::{certain_sign, determinant};
use crate::numerics::exact::orientation_exact;
use crate::numerics::lengths::largest_magnitude;
use crate::numerics::power::{TINY, UNIT, biased_exponent, power_of_two};
use crate::numerics::{MAX_SIZE, Sign};

/// Returns the sign of det[p1 - p0, ..., pD - p0] for `D + 1` points: positive if they turn
/// counterclockwise (D = 2), zero if they lie in one hyperplane.
///
/// Exact for all finite coordinates. Usually O(2^D D) floating-point operations; points that are
/// nearly in one hyperplane cost as many in integers, unless comparisons tell that they are.
#[inline]
pub fn orientation<const D: usize>(simplex: &[&[f64; D]]) -> Sign {
    orientation_filtered(simplex).unwrap_or_else(|| match are_flat_at_sight(simplex) {
        true => Sign::Zero,
        false => orientation_exact(simplex),
    })
}

/// Returns the sign of [`orientation`] if floating-point arithmetic with an error bound can tell
/// it; never `Some(Sign::Zero)`.
#[inline]
pub fn orientation_filtered<const D: usize>(simplex: &[&[f64; D]]) -> Option<Sign> {
    const { assert!(D >= 2 && D <= 8) };
    debug_assert_eq!(simplex.len(), D + 1);
    let rows: [[f64; D]; D] = std::array::from_fn(|i| {
        let (p, origin) = (simplex[i + 1], simplex[0]);
        std::array::from_fn(|j| p[j] - origin[j])
    });
    certain_sign(match D {
        2 => planar_determinant(&rows),
        3 => spatial_determinant(&rows),
        _ => normal_determinant(&normalise(rows)?),
    })
}

/// Returns det[p1 - p0, ..., pD - p0] as m * 2^e, if floating-point arithmetic can tell it with a
/// relative error of at most `accepted`.
pub fn determinant_filtered<const D: usize>(
    simplex: &[&[f64; D]],
    accepted: f64,
) -> Option<(f64, i64)> {
    let rows: [[f64; D]; D] = std::array::from_fn(|i| {
        let (p, origin) = (simplex[i + 1], simplex[0]);
        std::array::from_fn(|j| p[j] - origin[j])
    });
    let exponent = |row: &[f64; D]| i64::from(biased_exponent(largest_magnitude(row))) - 1023;
    let (determinant, bound) = normal_determinant(&normalise(rows)?);
    // False if anything is NaN.
    let is_accepted = bound <= accepted * determinant.abs();
    is_accepted.then(|| (determinant, rows.iter().map(exponent).sum()))
}

/// Returns the determinant of two rows of rounded differences and a bound of its error. Each
/// product carries three roundings and their difference one: 4u of the permanent, doubled here;
/// products that underflow lose at most 2^-1075 each.
#[inline]
fn planar_determinant<const D: usize>(r: &[[f64; D]; D]) -> (f64, f64) {
    let (left, right) = (r[0][0] * r[1][1], r[0][1] * r[1][0]);
    (left - right, 8.0 * UNIT * (left.abs() + right.abs()) + TINY)
}

/// Returns the determinant of three rows of rounded differences and a bound of its error: at most
/// eight roundings lie on the way of each product of the permanent, 16u are allowed. A product of
/// two that underflows loses 2^-1075, times the third factor.
#[inline]
fn spatial_determinant<const D: usize>(r: &[[f64; D]; D]) -> (f64, f64) {
    const UNDERFLOW: f64 = 1e-300;
    let minor = |a: usize, b: usize| {
        let (left, right) = (r[a][0] * r[b][1], r[a][1] * r[b][0]);
        (left - right, left.abs() + right.abs())
    };
    let [(m0, p0), (m1, p1), (m2, p2)] = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let [z0, z1, z2] = [r[0][2], r[1][2], r[2][2]];
    let permanent = p0 * z0.abs() + p1 * z1.abs() + p2 * z2.abs();
    let third = z0.abs() + z1.abs() + z2.abs();
    (z0 * m0 + z1 * m1 + z2 * m2, 16.0 * UNIT * permanent + UNDERFLOW * third + TINY)
}

/// Scales rows by powers of two until their largest magnitudes are in [1, 2), which changes no
/// sign; returns `None` if a row is zero, subnormal or too large for that.
#[inline]
pub(super) fn normalise<const D: usize>(mut rows: [[f64; D]; D]) -> Option<[[f64; D]; D]> {
    for row in &mut rows {
        let exponent = biased_exponent(largest_magnitude(row));
        if !(1..=2045).contains(&exponent) {
            return None;
        }
        let scale = power_of_two(1023 - exponent);
        row.iter_mut().for_each(|x| *x *= scale);
    }
    Some(rows)
}

/// Returns the determinant of normalised rows and a bound of its error.
fn normal_determinant<const D: usize>(rows: &[[f64; D]; D]) -> (f64, f64) {
    let mut matrix = [[0.0; MAX_SIZE]; MAX_SIZE];
    for (entries, row) in matrix.iter_mut().zip(rows) {
        entries[..D].copy_from_slice(row);
    }
    // Each difference carries a rounding.
    determinant(&matrix, D, D)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::in_ball;
    use crate::numerics::testing::*;
    use proptest::prelude::*;

    #[test]
    fn the_standard_simplex_is_positive_and_holds_its_centroid() {
        fn check<const D: usize>() {
            let mut vertices = vec![[0.0; D]];
            for i in 0..D {
                vertices.push(std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
            }
            let simplex = references(&vertices);
            assert_eq!(orientation_filtered(&simplex), Some(Sign::Positive));
            assert_eq!(in_ball(&simplex, &[1.0 / (D as f64 + 1.0); D]), Sign::Positive);
            assert_eq!(in_ball(&simplex, &[1.0; D]), Sign::Zero);
            assert_eq!(in_ball(&simplex, &[-1.0; D]), Sign::Negative);
        }
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
        check::<7>();
        check::<8>();
    }

    /// Checks points that have a coordinate in common, and those that differ in it by an ulp.
    #[test]
    fn points_in_a_plane_along_an_axis_are_on_it() {
        let mut random = Random(5);
        for family in FAMILIES {
            for axis in 0..3 {
                let mut simplex = points::<3>(family, 4, &mut random);
                let level = simplex[0][axis];
                simplex.iter_mut().for_each(|p| p[axis] = level);
                assert!(are_flat_at_sight(&references(&simplex)));
                assert_eq!(orientation(&references(&simplex)), Sign::Zero, "{family:?}");
                simplex[3][axis] = level.next_up();
                let expected = orientation_oracle(&references(&simplex));
                assert_eq!(orientation(&references(&simplex)), expected, "{family:?}");
            }
        }
    }

    /// Checks the filter against integers: it is never wrong, and never undecided on generic
    /// points.
    fn filter_is_sound<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 7 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 1, &mut random);
                let filtered = orientation_filtered(&references(&points));
                assert!(filtered.is_some() || family != Family::Uniform);
                if let Some(sign) = filtered {
                    assert_eq!(sign, orientation_exact(&references(&points)), "{points:?}");
                }
            }
        }
    }

    #[test]
    fn filters_agree_with_integers() {
        filter_is_sound::<2>(5000);
        filter_is_sound::<3>(5000);
        filter_is_sound::<4>(2000);
        filter_is_sound::<5>(1000);
        filter_is_sound::<8>(300);
    }

    /// Determinants of a few units of roundoff, with a permanent of 2, are undecided below the
    /// bound of roundings and decided above.
    #[test]
    fn filters_allow_for_the_counted_roundings() {
        fn check<const D: usize>(allowance: f64) {
            let filtered = |units: f64| {
                let mut vertices = vec![[0.0; D]];
                for i in 0..D {
                    vertices.push(std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
                }
                vertices[1][1] = 1.0;
                vertices[2][0] = 1.0;
                vertices[2][1] = 1.0 + (units / 2.0).round() * f64::EPSILON;
                orientation_filtered(&references(&vertices))
            };
            assert_eq!(filtered(1.8 * allowance), None);
            assert_eq!(filtered(2.2 * allowance), Some(Sign::Positive));
        }
        check::<2>(8.0);
        check::<3>(16.0);
        check::<4>(2.0 * 4.0 * 7.0);
        check::<5>(2.0 * 5.0 * 8.0);
        check::<8>(2.0 * 8.0 * 11.0);
    }

    #[test]
    fn underflowing_minors_are_not_trusted() {
        // In units of 2^-1074 the minors are 0.51 and -0.75 and round to 1 and -1; times the third
        // coordinates they would make a clearly positive sum of what is negative.
        let tiny = 2f64.powi(-537);
        let vertices =
            [[0.0; 3], [0.0, -0.75 * tiny, 1e300], [0.0, -0.51 * tiny, 0.9e300], [tiny, 0.0, 0.0]];
        agree_in_every_order(&vertices);
        // The minors are right, but times the third coordinates they are 0.51, 0.51 and -1.3 in
        // units of 2^-1074 and round to 1, 1 and -1.
        let (a, z) = (2f64.powi(-267), 2f64.powi(-540));
        agree_in_every_order(&[[0.0; 3], [a, 0.0, z], [-a, -1.3 * a, z], [0.0, -0.51 * a, z]]);
    }

    /// Checks a tetrahedron in every order of the vertices after the first, with all signs of
    /// coordinates.
    fn agree_in_every_order(vertices: &[[f64; 3]; 4]) {
        for order in [[1, 2, 3], [2, 3, 1], [3, 1, 2], [1, 3, 2], [3, 2, 1], [2, 1, 3]] {
            for signs in 0..8 {
                let sign = |axis: usize| if signs >> axis & 1 == 1 { -1.0 } else { 1.0 };
                let turned = [0, order[0], order[1], order[2]].map(|i: usize| -> [f64; 3] {
                    std::array::from_fn(|k| vertices[i][k] * sign(k))
                });
                let simplex = references(&turned);
                assert_eq!(orientation(&simplex), orientation_oracle(&simplex));
            }
        }
    }

    /// Draws any finite double, or one of a few that collide often.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite()),
            (-3i32..=3).prop_map(f64::from),
            (-3i32..=3).prop_map(|k| 1.0 + f64::from(k) * f64::EPSILON),
        ]
    }

    fn signs<const D: usize>(points: &[[f64; D]]) -> (Sign, Sign) {
        let simplex = references(&points[..=D]);
        (orientation(&simplex), in_ball(&simplex, &points[D + 1]))
    }

    /// Checks symmetries. Swapping two vertices flips both signs; negation multiplies them by
    /// (-1)^D; so does the mirror of one axis by -1; the determinant of the lifted points flips
    /// when the query point changes places with a vertex.
    fn symmetries_hold<const D: usize>(values: &[f64], i: usize, j: usize) {
        let points: Vec<[f64; D]> =
            values.chunks_exact(D).take(D + 2).map(|c| c.try_into().expect("D long")).collect();
        let (orientation, side) = signs(&points);
        let (i, j) = (i % (D + 1), j % (D + 1));
        if i != j {
            let mut swapped = points.clone();
            swapped.swap(i, j);
            assert_eq!(signs(&swapped), (-orientation, -side));
        }
        let mut exchanged = points.clone();
        exchanged.swap(i, D + 1);
        assert_eq!(signs(&exchanged).1, -side);
        let negated: Vec<[f64; D]> = points.iter().map(|p| p.map(|x| -x)).collect();
        let parity = if D % 2 == 0 { Sign::Positive } else { Sign::Negative };
        assert_eq!(signs(&negated), (orientation * parity, side * parity));
        let mut mirrored = points;
        mirrored.iter_mut().for_each(|p| p[i.min(D - 1)] *= -1.0);
        assert_eq!(signs(&mirrored), (-orientation, -side));
    }

    proptest! {
        #[test]
        fn signs_follow_permutation_and_negation(
            values in proptest::collection::vec(coordinate(), 48),
            i in 0usize..7,
            j in 0usize..7,
        ) {
            symmetries_hold::<2>(&values, i, j);
            symmetries_hold::<3>(&values, i, j);
            symmetries_hold::<4>(&values, i, j);
            symmetries_hold::<5>(&values, i, j);
            symmetries_hold::<6>(&values, i, j);
        }
    }
}
