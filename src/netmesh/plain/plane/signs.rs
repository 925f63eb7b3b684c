//! The sides of lines and circles that points are on: a filter in doubles first, and exact signs
//! where it cannot tell.

use super::super::bits::bits;
use crate::numerics::{Sign, in_ball_with_care, orientation, orientation_exact};

type Point = [f64; 2];

/// More than products that underflow can lose.
const UNDERFLOW: f64 = 1e-300;

/// More than all of some products lose that underflow last.
const TINY: f64 = 1e-320;

/// Returns three corners counterclockwise, or with the last two exchanged if they are not.
pub(super) fn counterclockwise([a, b, c]: [u32; 3], points: &[Point]) -> [u32; 3] {
    match orientation(&[&points[a as usize], &points[b as usize], &points[c as usize]]) {
        Sign::Negative => [a, c, b],
        _ => [a, b, c],
    }
}

/// Signs of the points of a triangulation, and how many the filters did not tell.
pub(super) struct Signs {
    /// True where no coordinate is so large or small that expansions of doubles fail.
    are_moderate: bool,
    /// True where doubles are exact, since coordinates have so few bits.
    are_lines_exact: bool,
    are_circles_exact: bool,
    pub fallbacks: u64,
}

impl Signs {
    pub fn new(points: &[Point]) -> Self {
        let bits = bits(points.as_flattened());
        Self {
            are_moderate: points.iter().flatten().all(|x| is_moderate(*x)),
            // Differences have one bit more, and sums of 2 and of 12 products one and four.
            are_lines_exact: 2 * (bits + 1) < f64::MANTISSA_DIGITS,
            are_circles_exact: 4 * (bits + 1) + 4 <= f64::MANTISSA_DIGITS,
            fallbacks: 0,
        }
    }

    /// Returns the side of the line from `a` to `b` that `c` is on: positive on the left.
    #[inline]
    pub fn turn(&mut self, a: &Point, b: &Point, c: &Point) -> Sign {
        let (left, right) = ((b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0]));
        let determinant = left - right;
        // Each product carries three roundings and their difference one: 4 u of the permanent,
        // doubled here. What underflows is less than the last term. False if anything is NaN.
        let bound = 4.0 * f64::EPSILON * (left.abs() + right.abs()) + UNDERFLOW;
        match determinant.abs() > bound {
            true if determinant > 0.0 => Sign::Positive,
            true => Sign::Negative,
            false if self.are_lines_exact => Sign::of(determinant),
            false => self.turn_with_care(a, b, c),
        }
    }

    #[cold]
    #[inline(never)]
    fn turn_with_care(&mut self, a: &Point, b: &Point, c: &Point) -> Sign {
        self.fallbacks += 1;
        orientation_exact(&[a, b, c])
    }

    /// Returns the side of the circle through three points, counterclockwise, that `q` is on:
    /// positive inside.
    #[inline]
    pub fn in_circle(&mut self, [a, b, c]: [&Point; 3], q: &Point) -> Sign {
        let (determinant, bound) = in_circle(a, b, c, q);
        // False if anything is NaN.
        match determinant.abs() > bound {
            true if determinant > 0.0 => Sign::Positive,
            true => Sign::Negative,
            false if self.are_circles_exact => Sign::of(determinant),
            false => self.in_circle_with_care([a, b, c], q),
        }
    }

    #[cold]
    #[inline(never)]
    fn in_circle_with_care(&mut self, [a, b, c]: [&Point; 3], q: &Point) -> Sign {
        self.fallbacks += 1;
        if self.are_moderate {
            let [a, b, c, q] = [a, b, c, q].map(|&[x, y]| robust::Coord { x, y });
            return Sign::of(robust::incircle(a, b, c, q));
        }
        in_ball_with_care(&[a, b, c], q)
    }
}

/// Returns true for numbers of which `robust` tells signs rightly: 0 and those of a magnitude from
/// 2^-142 to 2^201.
fn is_moderate(x: f64) -> bool {
    const LEAST: f64 = 1.0 / (1u128 << 71) as f64 / (1u128 << 71) as f64;
    const LARGEST: f64 = (1u128 << 100) as f64 * (1u128 << 101) as f64;
    x == 0.0 || (LEAST..=LARGEST).contains(&x.abs())
}

/// Returns the in-circle determinant of rounded differences from `q`, and a bound of its error.
/// Each product of the permanent carries at most ten roundings (Shewchuk 1997 has 10 + 96 u of it);
/// 20 u are allowed. A product of two that underflows loses 2^-1075, times what it is multiplied
/// by; the last products lose less than `TINY` in all.
#[inline]
fn in_circle(a: &Point, b: &Point, c: &Point, q: &Point) -> (f64, f64) {
    const BOUND: f64 = 10.0 * f64::EPSILON;
    // Arrays that are mapped would be calls, here where most of the time goes.
    let (ax, ay) = (a[0] - q[0], a[1] - q[1]);
    let (bx, by) = (b[0] - q[0], b[1] - q[1]);
    let (cx, cy) = (c[0] - q[0], c[1] - q[1]);
    let (a2, b2, c2) = (ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy);
    let (bc, cb) = (bx * cy, cx * by);
    let (ca, ac) = (cx * ay, ax * cy);
    let (ab, ba) = (ax * by, bx * ay);
    let determinant = a2 * (bc - cb) + b2 * (ca - ac) + c2 * (ab - ba);
    let (mbc, mca, mab) = (bc.abs() + cb.abs(), ca.abs() + ac.abs(), ab.abs() + ba.abs());
    let permanent = a2 * mbc + b2 * mca + c2 * mab;
    let lost = UNDERFLOW * (a2 + b2 + c2 + mbc + mca + mab) + TINY;
    (determinant, BOUND * permanent + lost)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, in_ball_oracle, orientation_oracle, points};

    /// Integers of as many bits as doubles are trusted with, and of one more.
    #[test]
    fn signs_of_integers_are_exact_up_to_their_bits() {
        let kinds = [
            ((1 << 11) - 1, [true, true]),
            (1 << 11, [true, false]),
            ((1 << 25) - 1, [true, false]),
            (1 << 25, [false, false]),
        ];
        for (most, are_exact) in kinds {
            let mut random = Random(most as u64);
            for _ in 0..4000 {
                let mut far =
                    || (most - random.integer(0, 3)) as f64 * random.integer(-1, 1) as f64;
                let given = [0; 4].map(|_| [far(), far()]);
                let [a, b, c, q] = given;
                let mut signs = Signs::new(&[a, b, c, q, [most as f64, 1.0]]);
                assert_eq!([signs.are_lines_exact, signs.are_circles_exact], are_exact);
                let turn = orientation_oracle(&[&a, &b, &c]);
                assert_eq!(signs.turn(&a, &b, &c), turn, "{given:?}");
                if turn == Sign::Positive {
                    let side = in_ball_oracle(&[&a, &b, &c], &q);
                    assert_eq!(signs.in_circle([&a, &b, &c], &q), side, "{given:?}");
                }
            }
        }
    }

    #[test]
    fn signs_are_those_of_integers_at_every_scale() {
        for family in FAMILIES {
            for trial in 0..3000 {
                let mut random = Random(70_000 * family as u64 + trial);
                let given = points::<2>(family, 4, &mut random);
                let scale = 2f64.powi(random.integer(-1040, 900) as i32);
                let [a, b, c, q] = [0, 1, 2, 3].map(|at| given[at].map(|x| x * scale));
                if ![a, b, c, q].as_flattened().iter().all(|x| x.is_finite()) {
                    continue;
                }
                let mut signs = Signs::new(&[a, b, c, q]);
                let turn = orientation_oracle(&[&a, &b, &c]);
                assert_eq!(signs.turn(&a, &b, &c), turn, "{family:?} {a:?} {b:?} {c:?}");
                if turn == Sign::Positive {
                    let side = in_ball_oracle(&[&a, &b, &c], &q);
                    assert_eq!(signs.in_circle([&a, &b, &c], &q), side, "{family:?} {trial}");
                }
            }
        }
    }
}
