//! The sides of lines and circles that points are on: a filter in doubles first, and exact signs
//! where it cannot tell.

use crate::numerics::{Sign, in_ball_exact, orientation_exact, orientation_filtered};

type Point = [f64; 2];

/// Returns the side of the line from `a` to `b` that `c` is on: positive on the left.
#[inline]
pub(super) fn turn(a: &Point, b: &Point, c: &Point) -> Sign {
    orientation_filtered(&[a, b, c]).unwrap_or_else(|| orientation_exact(&[a, b, c]))
}

/// Signs of the points of a triangulation, and how many the filters did not tell.
pub(super) struct Signs {
    /// True where no coordinate is so large or small that expansions of doubles fail.
    are_moderate: bool,
    pub fallbacks: u64,
}

impl Signs {
    pub fn new(points: &[Point]) -> Self {
        Self { are_moderate: points.iter().flatten().all(|x| is_moderate(*x)), fallbacks: 0 }
    }

    /// Returns the side of the line from `a` to `b` that `c` is on: positive on the left.
    #[inline]
    pub fn turn(&mut self, a: &Point, b: &Point, c: &Point) -> Sign {
        orientation_filtered(&[a, b, c]).unwrap_or_else(|| self.turn_with_care(a, b, c))
    }

    #[cold]
    #[inline(never)]
    fn turn_with_care(&mut self, a: &Point, b: &Point, c: &Point) -> Sign {
        self.fallbacks += 1;
        orientation_exact(&[a, b, c])
    }

    /// Returns true if `q` is strictly inside the circle through three points, counterclockwise.
    #[inline]
    pub fn is_in_circle(&mut self, [a, b, c]: [&Point; 3], q: &Point) -> bool {
        let (determinant, bound) = in_circle(a, b, c, q);
        // False if anything is NaN.
        match determinant.abs() > bound {
            true => determinant > 0.0,
            false => self.is_in_circle_with_care([a, b, c], q),
        }
    }

    #[cold]
    #[inline(never)]
    fn is_in_circle_with_care(&mut self, [a, b, c]: [&Point; 3], q: &Point) -> bool {
        self.fallbacks += 1;
        if self.are_moderate {
            let [a, b, c, q] = [a, b, c, q].map(|&[x, y]| robust::Coord { x, y });
            return robust::incircle(a, b, c, q) > 0.0;
        }
        in_ball_exact(&[a, b, c], q) == Sign::Positive
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
/// by.
#[inline]
fn in_circle(a: &Point, b: &Point, c: &Point, q: &Point) -> (f64, f64) {
    const BOUND: f64 = 10.0 * f64::EPSILON;
    const UNDERFLOW: f64 = 1e-300;
    let [[ax, ay], [bx, by], [cx, cy]] = [a, b, c].map(|p| [p[0] - q[0], p[1] - q[1]]);
    let [a2, b2, c2] = [ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy];
    let (bc, cb) = (bx * cy, cx * by);
    let (ca, ac) = (cx * ay, ax * cy);
    let (ab, ba) = (ax * by, bx * ay);
    let determinant = a2 * (bc - cb) + b2 * (ca - ac) + c2 * (ab - ba);
    let [mbc, mca, mab] = [bc.abs() + cb.abs(), ca.abs() + ac.abs(), ab.abs() + ba.abs()];
    let permanent = a2 * mbc + b2 * mca + c2 * mab;
    let lost = UNDERFLOW * (a2 + b2 + c2 + mbc + mca + mab + UNDERFLOW);
    (determinant, BOUND * permanent + lost)
}
