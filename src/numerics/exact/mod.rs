//! Exact signs and circumcentres in integers of a fixed size, without an allocation. Right for
//! every finite input; microseconds where the filters need nanoseconds.
//!
//! ```text
//!   coordinates span at most 62 bits       any finite coordinates, and all circumcentres
//!        |                                      |
//!      wide: rows of one word,                edges: the matrix modulo one prime after the other
//!      determinants of 1 to 11 words            |
//!        |                                    residues (arithmetic modulo a prime)
//!        |                                      |
//!        |                                    integer: sign and value from all residues
//!        v                                      |
//!       sign                                  natural: quotients of the values
//! ```
//!
//! `crossing` has the point where two lines cross, as the quotient of natural numbers.
//!
//! Only what is exact for every finite double may enter, and nothing that allocates.

mod crossing;
mod edges;
mod integer;
mod natural;
mod residues;
mod wide;

use super::power::scale_by_power;
use super::{MAX_SIZE, Sign};
pub(crate) use crossing::{Lines, compare_crossings, compare_to_crossing, crossing};
pub(crate) use edges::{Column, Edges};
use wide::Rows;

/// Returns the sign of det[p1 - p0, ..., pD - p0] for `D + 1` finite points, computed in integers.
///
/// O(2^D D) products of a number of words, where coordinates span no more than 62 bits together;
/// else (at most 2100) modulo each of b/63 primes for b bits, `D` times those, and O(b^2) to put
/// them together.
pub fn orientation_exact<const D: usize>(simplex: &[&[f64; D]]) -> Sign {
    debug_assert_eq!(simplex.len(), D + 1);
    let ends = simplex[1..].iter().copied();
    match Rows::new(simplex[0], ends.clone()) {
        Some(rows) => rows.orientation(),
        None => Edges::new(simplex[0], ends).sign_of_determinant(&components::<D>()),
    }
}

/// Returns the side of the sphere through `D + 1` positively oriented points that `q` is on:
/// positive strictly inside, zero on the sphere, negative strictly outside. The sign is reversed
/// for a negatively oriented simplex; for a flat one it is that of the determinant, which says
/// nothing of a ball.
///
/// Computed in integers at the cost of [`orientation_exact`] for `D + 2` times the bits that the
/// coordinates span.
pub fn in_ball_exact<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Sign {
    debug_assert_eq!(simplex.len(), D + 1);
    let ends = simplex[1..].iter().copied().chain([q]);
    // With rows v_i, |v_i|^2 and w, |w|^2 the determinant is det(v) (|w|^2 - 2 w.c), c the centre.
    let outward = match Rows::new(simplex[0], ends.clone()) {
        Some(rows) => rows.lifted_orientation(),
        None => {
            let mut columns = [Column::Square; MAX_SIZE];
            columns[..D].copy_from_slice(&components::<D>());
            Edges::new(simplex[0], ends).sign_of_determinant(&columns[..=D])
        }
    };
    outward.flip()
}

/// Returns the sign of [`in_ball_exact`] if integers of two words are enough for it, as for points
/// of a grid; these are as fast as anything.
pub fn in_ball_in_few_bits<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Sign> {
    // Edges of coordinates with more bits than that are no better, but where these are far away.
    const UNUSED: u32 = 24;
    let coordinates = simplex.iter().copied().chain([q]).flatten();
    let ones = coordinates.fold(0, |ones, x| ones | x.to_bits());
    if ones.trailing_zeros() < UNUSED {
        return None;
    }
    let ends = simplex[1..].iter().copied().chain([q]);
    let rows = Rows::new(simplex[0], ends)?;
    rows.is_narrow().then(|| rows.lifted_orientation().flip())
}

/// Returns the sign of the scalar product of the vectors from `q` to `a` and to `b`, for any finite
/// points.
pub fn scalar_product_exact<const D: usize>(a: &[f64; D], b: &[f64; D], q: &[f64; D]) -> Sign {
    Edges::new(q, [a, b].into_iter()).sign_of_product()
}

/// Point relative to a vertex: `center * 2^exponent` in real units. The largest magnitude among the
/// components of `center` is in [1, 2), or all are zero; each is within 2 units of roundoff (2^-53)
/// of the exact rational, relatively, or within 2^-1074 if smaller than 2^-1022.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledCenter<const D: usize> {
    pub center: [f64; D],
    pub exponent: i64,
}

/// Returns the circumcentre of `D + 1` finite points relative to `points[anchor]`, from the exact
/// rational solution; `None` if the points are affinely dependent.
pub fn circumcenter_exact<const D: usize>(
    points: &[&[f64; D]],
    anchor: usize,
) -> Option<ScaledCenter<D>> {
    debug_assert_eq!(points.len(), D + 1);
    let others = points[..anchor].iter().chain(&points[anchor + 1..]);
    let edges = Edges::new(points[anchor], others.copied());
    // 2 v.c = |v|^2: the solution of v.x = |v|^2 is twice the centre.
    let parts = edges.solve(Column::Square)?;
    let nonzero = parts.iter().filter(|part| part.0 != 0.0);
    let top = nonzero.map(|part| part.1).max()?; // there is one: the centre is not the anchor
    let center = parts.map(|(mantissa, e)| scale_by_power(mantissa, e - top));
    Some(ScaledCenter { center, exponent: top + i64::from(edges.unit) - 1 })
}

fn components<const D: usize>() -> [Column; D] {
    std::array::from_fn(Column::Component)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::*;

    fn agrees_with_the_oracle<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 2, &mut random);
                let (simplex, q) = (references(&points[..=D]), &points[D + 1]);
                let (orientation, side) =
                    (orientation_oracle(&simplex), in_ball_oracle(&simplex, q));
                assert_eq!(orientation_exact(&simplex), orientation, "{family:?} {points:?}");
                assert_eq!(in_ball_exact(&simplex, q), side, "{family:?} {points:?}");
                assert_eq!(
                    crate::numerics::orientation(&simplex),
                    orientation,
                    "{family:?} {points:?}"
                );
                assert_eq!(crate::numerics::in_ball(&simplex, q), side, "{family:?} {points:?}");
            }
        }
    }

    #[test]
    fn signs_agree_with_laplace_expansion() {
        agrees_with_the_oracle::<2>(600);
        agrees_with_the_oracle::<3>(300);
        agrees_with_the_oracle::<4>(100);
        agrees_with_the_oracle::<5>(30);
        agrees_with_the_oracle::<6>(15);
        agrees_with_the_oracle::<7>(4);
        agrees_with_the_oracle::<8>(2);
    }

    fn centres_solve_the_system<const D: usize>(trials: usize) {
        for family in FAMILIES {
            let mut random = Random(family as u64 * 100 + 50 + D as u64);
            for _ in 0..trials {
                let points = points::<D>(family, D + 1, &mut random);
                let simplex = references(&points);
                let anchor = random.integer(0, D as i64) as usize;
                let (numerators, denominator) = circumcenter_oracle(&simplex, anchor);
                let Some(centre) = circumcenter_exact(&simplex, anchor) else {
                    assert!(denominator.is_zero(), "{family:?} {points:?}");
                    continue;
                };
                let largest = centre.center.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                assert!((1.0..2.0).contains(&largest), "{family:?} {points:?}");
                for (value, numerator) in centre.center.iter().zip(&numerators) {
                    let bound = value.abs() * f64::EPSILON + f64::from_bits(1);
                    let quotient = (numerator, &denominator);
                    assert!(is_close(*value, bound, centre.exponent, quotient), "{points:?}");
                }
            }
        }
    }

    #[test]
    fn centres_agree_with_cramers_rule() {
        centres_solve_the_system::<2>(200);
        centres_solve_the_system::<3>(100);
        centres_solve_the_system::<4>(40);
        centres_solve_the_system::<5>(16);
        centres_solve_the_system::<6>(8);
        centres_solve_the_system::<7>(3);
        centres_solve_the_system::<8>(2);
    }
}
