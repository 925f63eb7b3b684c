//! The side of a circumsphere that a point is on, exactly.

use super::at_sight::are_cospherical_at_sight;
use super::determinant::{certain_sign, determinant};
use super::precise::precise_in_ball;
use crate::numerics::exact::{in_ball_exact, in_ball_in_few_bits};
use crate::numerics::power::{biased_exponent, power_of_two};
use crate::numerics::{MAX_SIZE, Sign};

/// Returns the side of the sphere through the `D + 1` points of a positively oriented simplex that
/// `q` is on: positive strictly inside, zero on the sphere, negative strictly outside. The sign is
/// reversed for a negatively oriented simplex; for a flat one it says nothing of a ball.
///
/// Exact for all finite coordinates. Usually O(2^D D) floating-point operations; a point that is
/// nearly on the sphere costs as many in integers. Callers that have a simplex's
/// [`Circumball`](super::Circumball) ask it first, and then [`in_ball_with_care`].
pub fn in_ball<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Sign {
    in_ball_filtered(simplex, q).unwrap_or_else(|| in_ball_with_care(simplex, q))
}

/// Returns the result of [`in_ball`] for a point that is nearly on the sphere: in integers of a
/// word or two where these are enough, else by comparisons where these tell that it is on it, else
/// in some 106 bits, and where that is not enough in integers.
#[cold]
#[inline(never)]
pub fn in_ball_with_care<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Sign {
    in_ball_in_few_bits(simplex, q)
        .or_else(|| are_cospherical_at_sight(simplex, q).then_some(Sign::Zero))
        .or_else(|| precise_in_ball(simplex, q))
        .unwrap_or_else(|| in_ball_exact(simplex, q))
}

/// Returns the sign of [`in_ball`] if floating-point arithmetic with an error bound can tell it;
/// never `Some(Sign::Zero)`.
pub fn in_ball_filtered<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Sign> {
    const { assert!(D >= 2 && D <= 8) };
    debug_assert_eq!(simplex.len(), D + 1);
    let (origin, ends) = (simplex[0], simplex[1..].iter().copied().chain([q]));
    let mut rows = [[0.0; MAX_SIZE]; MAX_SIZE];
    let mut largest = 0.0f64;
    for (row, end) in rows.iter_mut().zip(ends) {
        for axis in 0..D {
            row[axis] = end[axis] - origin[axis];
            largest = largest.max(row[axis].abs());
        }
    }
    // One scale for all, so that the largest is in [1, 2), changes no sign.
    let exponent = biased_exponent(largest);
    if !(1..=2045).contains(&exponent) {
        return None;
    }
    let scale = power_of_two(1023 - exponent);
    for row in &mut rows[..=D] {
        let (edge, others) = row.split_at_mut(D);
        edge.iter_mut().for_each(|x| *x *= scale);
        others[0] = edge.iter().map(|x| x * x).sum();
    }
    // A difference carries one rounding, a squared length two of each difference and D more. With
    // rows v_i,
    // |v_i|^2 and w, |w|^2 the determinant is det(v) (|w|^2 - 2 w.c), c the centre.
    certain_sign(determinant(&rows, D + 1, 2 * D + 2)).map(Sign::flip)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;

    fn the_filter_is_right<const D: usize>(trials: usize) {
        let (mut certain, mut uniform) = (0, 0);
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 30 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 2, &mut random);
                let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
                let side = in_ball_oracle(&simplex, q);
                if let Some(sign) = in_ball_filtered(&simplex, q) {
                    assert_eq!(sign, side, "{family:?} {points:?}");
                    certain += 1;
                    uniform += usize::from(family == Family::Uniform);
                }
                assert_eq!(in_ball(&simplex, q), side, "{family:?} {points:?}");
            }
        }
        assert_eq!(uniform, trials, "the filter decides what is not degenerate");
        assert!(certain < trials * FAMILIES.len(), "and not what is");
    }

    #[test]
    fn the_filter_agrees_with_integers() {
        the_filter_is_right::<2>(400);
        the_filter_is_right::<3>(200);
        the_filter_is_right::<4>(60);
        the_filter_is_right::<5>(20);
        the_filter_is_right::<6>(8);
        the_filter_is_right::<7>(3);
        the_filter_is_right::<8>(2);
    }

    /// Points a unit of roundoff beside the sphere are undecided: the bound claims no more than the
    /// arithmetic knows.
    #[test]
    fn points_next_to_the_sphere_are_told_apart_in_integers() {
        let simplex = [&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0], &[-1.0, 0.0, 0.0]];
        let flipped = [simplex[1], simplex[0], simplex[2], simplex[3]];
        for (x, sign) in [(1.0, 0), (1.0f64.next_up(), -1), (1.0f64.next_down(), 1)] {
            let q = [0.0, 0.0, -x];
            assert_eq!(in_ball_filtered(&simplex, &q), None);
            let signs = [&simplex, &flipped].map(|vertices| in_ball(vertices, &q) as i8);
            assert_eq!(signs.map(i8::abs), [sign * sign; 2]);
            assert_eq!(signs[0], -signs[1]);
            assert_eq!(in_ball_oracle(&simplex, &q) as i8, signs[0]);
        }
    }
}
