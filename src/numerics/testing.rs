//! Oracles, point generators and random numbers for unit tests. The oracles share nothing with the
//! code under test: coordinates in units of 2^-1074, homogeneous matrices, Laplace expansion.

use super::random::{SplitMix, mixed};
use super::sign::Sign;
use dashu_int::IBig;
use std::collections::HashMap;

/// Small generator of pseudo-random numbers (SplitMix64), so that failures repeat.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(SplitMix::STEP);
        mixed(self.0)
    }

    /// Returns an integer from `low` to `high`, both possible.
    pub fn integer(&mut self, low: i64, high: i64) -> i64 {
        low + (self.bits() % (high - low + 1) as u64) as i64
    }

    /// Returns a number in [-1, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * f64::EPSILON - 1.0
    }

    /// Returns any finite double, by its bits.
    pub fn raw(&mut self) -> f64 {
        loop {
            let value = f64::from_bits(self.bits());
            if value.is_finite() {
                return value;
            }
        }
    }
}

/// Kinds of points that have broken predicates before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    Uniform,
    Grid,
    OneUlp,
    Subnormal,
    Huge,
    RawBits,
    PowersOfTwo,
    MixedScales,
    Collinear,
    Cospherical,
    NearlyFlat,
    FarCluster,
}

pub const FAMILIES: [Family; 12] = [
    Family::Uniform,
    Family::Grid,
    Family::OneUlp,
    Family::Subnormal,
    Family::Huge,
    Family::RawBits,
    Family::PowersOfTwo,
    Family::MixedScales,
    Family::Collinear,
    Family::Cospherical,
    Family::NearlyFlat,
    Family::FarCluster,
];

/// Returns `count` points of one family.
pub fn points<const D: usize>(family: Family, count: usize, random: &mut Random) -> Vec<[f64; D]> {
    // Lattice families come at some scale, one for all the points: often 1, else anywhere.
    let exponent = if random.bits() & 1 == 0 { 0 } else { random.integer(-1000, 1000) };
    let lattice_scale = 2f64.powi(exponent as i32);
    let (start, direction): ([f64; D], [f64; D]) =
        (each(|| random.integer(-9, 9) as f64), each(|| random.integer(-9, 9) as f64));
    let normal: [f64; D] = each(|| random.unit());
    let squares: [f64; D] = each(|| random.integer(1, 4) as f64);
    let point = |at: usize| -> [f64; D] {
        match family {
            Family::Uniform => each(|| random.unit()),
            Family::Grid => each(|| random.integer(-2, 2) as f64 * lattice_scale),
            Family::OneUlp => each(|| 1.0 + random.integer(-3, 3) as f64 * f64::EPSILON),
            Family::Subnormal => each(|| random.integer(-9, 9) as f64 * f64::from_bits(1)),
            Family::Huge => each(|| random.integer(-4, 4) as f64 / 4.0 * f64::MAX),
            Family::RawBits => each(|| random.raw()),
            Family::PowersOfTwo => each(|| {
                let value = f64::from_bits(1) * 2f64.powi(random.integer(0, 1023) as i32);
                let value = value * 2f64.powi(random.integer(0, 1023) as i32);
                if random.bits() & 1 == 0 { value } else { -value }
            }),
            Family::MixedScales => {
                each(|| random.unit() * 2f64.powi(random.integer(-60, 60) as i32))
            }
            Family::Collinear => {
                let t = random.integer(-9, 9) as f64;
                std::array::from_fn(|i| (start[i] + t * direction[i]) * lattice_scale)
            }
            Family::Cospherical => {
                // Signed permutations of one lattice vector: all on a sphere about the origin.
                let turn = random.integer(0, D as i64 - 1) as usize;
                let signs = random.bits();
                std::array::from_fn(|i| {
                    let sign = if signs >> i & 1 == 0 { 1.0 } else { -1.0 };
                    sign * squares[(i + turn) % D] * lattice_scale
                })
            }
            Family::NearlyFlat => {
                // Rounded onto a tilted hyperplane through the origin.
                let free: [f64; D] = each(|| random.unit());
                let dot: f64 = (0..D - 1).map(|i| free[i] * normal[i]).sum();
                std::array::from_fn(|i| if i == D - 1 { dot } else { free[i] })
            }
            Family::FarCluster => {
                let spread = if at % 3 == 0 { 1.0 } else { 2f64.powi(-35) };
                each(|| 1.0 + random.unit() * spread)
            }
        }
    };
    (0..count).map(point).collect()
}

fn each<const D: usize>(mut coordinate: impl FnMut() -> f64) -> [f64; D] {
    std::array::from_fn(|_| coordinate())
}

pub fn references<const D: usize>(points: &[[f64; D]]) -> Vec<&[f64; D]> {
    points.iter().collect()
}

/// Returns `value` in units of 2^-1074.
pub fn integer(value: f64) -> IBig {
    let bits = value.to_bits();
    let field = (bits >> 52 & 0x7ff) as usize;
    let fraction = bits & ((1 << 52) - 1);
    let magnitude = match field {
        0 => IBig::from(fraction),
        _ => IBig::from(fraction | 1 << 52) << (field - 1),
    };
    if value.is_sign_negative() { -magnitude } else { magnitude }
}

/// Returns the determinant by Laplace expansion along the rows, with a table of minors by columns.
pub fn determinant_oracle(matrix: &[Vec<IBig>]) -> IBig {
    fn minor(m: &[Vec<IBig>], columns: u32, known: &mut HashMap<u32, IBig>) -> IBig {
        if columns == 0 {
            return IBig::ONE;
        }
        if let Some(value) = known.get(&columns) {
            return value.clone();
        }
        let row = &m[m.len() - columns.count_ones() as usize];
        let mut sum = IBig::ZERO;
        let mut positive = true;
        for (j, entry) in row.iter().enumerate().filter(|(j, _)| columns >> j & 1 == 1) {
            let term = entry * minor(m, columns & !(1 << j), known);
            sum = if positive { sum + term } else { sum - term };
            positive = !positive;
        }
        known.insert(columns, sum.clone());
        sum
    }
    minor(matrix, (1 << matrix.len()) - 1, &mut HashMap::new())
}

fn sign(value: IBig) -> Sign {
    match value.cmp(&IBig::ZERO) {
        std::cmp::Ordering::Less => Sign::Negative,
        std::cmp::Ordering::Equal => Sign::Zero,
        std::cmp::Ordering::Greater => Sign::Positive,
    }
}

/// Returns the orientation by the homogeneous matrix with rows (1, p).
pub fn orientation_oracle<const D: usize>(simplex: &[&[f64; D]]) -> Sign {
    let row = |p: &&[f64; D]| {
        std::iter::once(IBig::ONE).chain(p.iter().map(|x| integer(*x))).collect::<Vec<_>>()
    };
    sign(determinant_oracle(&simplex.iter().map(row).collect::<Vec<_>>()))
}

/// Returns the side of the sphere by the lifted homogeneous matrix with rows (1, p, |p|^2).
pub fn in_ball_oracle<const D: usize>(simplex: &[&[f64; D]], q: &[f64; D]) -> Sign {
    let row = |p: &&[f64; D]| {
        let p = p.map(integer);
        let square = p.iter().map(|x| x * x).fold(IBig::ZERO, |sum, x| sum + x);
        std::iter::once(IBig::ONE).chain(p).chain([square]).collect::<Vec<_>>()
    };
    // A point of the ball is below the lifted hyperplane.
    sign(determinant_oracle(&simplex.iter().chain([&q]).map(row).collect::<Vec<_>>())).flip()
}

/// Returns the circumcentre relative to `points[anchor]` by Cramer's rule: numerators and the
/// common denominator, in units of 2^-1074.
pub fn circumcenter_oracle<const D: usize>(
    points: &[&[f64; D]],
    anchor: usize,
) -> ([IBig; D], IBig) {
    let others = points.iter().enumerate().filter(|(i, _)| *i != anchor).map(|(_, p)| p);
    let edge = |p: &&[f64; D]| -> Vec<IBig> {
        p.iter().zip(points[anchor]).map(|(x, o)| integer(*x) - integer(*o)).collect()
    };
    let rows: Vec<Vec<IBig>> = others.map(edge).collect();
    let squares: Vec<IBig> =
        rows.iter().map(|row| row.iter().fold(IBig::ZERO, |sum, x| sum + x * x)).collect();
    let numerators = std::array::from_fn(|i| {
        let mut replaced = rows.clone();
        replaced.iter_mut().zip(&squares).for_each(|(row, square)| row[i] = square.clone());
        determinant_oracle(&replaced)
    });
    (numerators, determinant_oracle(&rows) * 2)
}

/// Returns true if |value * 2^exponent - numerator / denominator| is at most `bound * 2^exponent`,
/// with the quotient in units of 2^-1074.
pub fn is_close(value: f64, bound: f64, exponent: i64, quotient: (&IBig, &IBig)) -> bool {
    // value and bound are integers times 2^-1074: bring all to units of 2^(-4296).
    const UNITS: i64 = 4296;
    let scaled = |x: f64| integer(x) << (UNITS - 1074 + exponent) as usize;
    let (numerator, denominator) = quotient;
    let difference = scaled(value) * denominator - (numerator << (UNITS - 1074) as usize);
    magnitude(difference) <= scaled(bound) * magnitude(denominator.clone())
}

fn magnitude(value: IBig) -> IBig {
    if value < IBig::ZERO { -value } else { value }
}

/// Returns `value` as a whole mantissa and the exponent of its unit; zero as (0, 0).
pub fn decomposed(value: f64) -> (i64, i32) {
    match super::power::decompose(value) {
        (0, _) => (0, 0),
        parts => parts,
    }
}
