//! Signs in two dimensions and orientations in three from adaptive floating-point expansions (J. R.
//! Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
//! 1997), which the package `robust` has.
//!
//! Its in-sphere test is not used: the last stage of it takes 181 KB of stack, which threads of
//! small stacks do not have. A determinant in doubles with a bound of its error takes its place,
//! and leaves what that does not tell to others.

use robust::{Coord, Coord3D, incircle, orient2d, orient3d};
use std::cmp::Ordering;

/// Coordinates from this magnitude on, and zero, are within the window. The units of such a
/// coordinate's last place are at least 2^-194, so that every product of five factors is a multiple
/// of 2^-970: no expansion loses bits below 2^-1074, and an error bound of 2^-52 of such a product
/// is still normal.
const SMALLEST: f64 = f64::from_bits((1023 - 142) << 52);

/// The largest magnitude within the window. An in-sphere determinant, the longest of all, would be
/// a sum of 72 products of five differences below 2^202: less than 2^1017, and 2^7 times that is
/// still finite.
const LARGEST: f64 = f64::from_bits((1023 + 201) << 52);

/// A source of signs in two and three dimensions; `None` where it has none.
pub(in super::super) trait Adaptive {
    fn orientation<const D: usize>(&mut self, simplex: &[&[f64; D]]) -> Option<Ordering>;
    fn in_ball<const D: usize>(&mut self, simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Ordering>;
}

/// The package `robust`, within the window where it is exact, and the determinant in doubles.
#[derive(Debug, Default)]
pub(in super::super) struct Robust;

impl Adaptive for Robust {
    fn orientation<const D: usize>(&mut self, simplex: &[&[f64; D]]) -> Option<Ordering> {
        if D > 3 || !simplex.iter().all(|point| is_in_window(point)) {
            return None;
        }
        Some(sign(match D {
            2 => orient2d(planar(simplex[0]), planar(simplex[1]), planar(simplex[2])),
            _ => {
                let [a, b, c, d] = std::array::from_fn(|i| spatial(simplex[i]));
                // Positive for a fourth point below the first three, seen from where they turn
                // left.
                -orient3d(a, b, c, d)
            }
        }))
    }

    fn in_ball<const D: usize>(&mut self, simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Ordering> {
        if D > 3 || !simplex.iter().copied().chain([q]).all(is_in_window) {
            return None;
        }
        if D == 2 {
            let [a, b, c] = std::array::from_fn(|i| planar(simplex[i]));
            return Some(sign(incircle(a, b, c, planar(q))));
        }
        let edge = |point: &[f64; D]| [0, 1, 2].map(|axis| point[axis] - simplex[0][axis]);
        // Positive outside of the sphere of a simplex which `orient3d` calls positive.
        lifted_sign([1, 2, 3].map(|i| edge(simplex[i])), edge(q)).map(Ordering::reverse)
    }
}

/// A sum of products, and the sum of their magnitudes.
#[derive(Clone, Copy)]
struct Sum {
    value: f64,
    magnitude: f64,
}

impl Sum {
    const ZERO: Self = Self { value: 0.0, magnitude: 0.0 };

    fn plus(self, factor: f64, of: Self) -> Self {
        Self {
            value: self.value + factor * of.value,
            magnitude: self.magnitude + factor.abs() * of.magnitude,
        }
    }
}

/// Returns the sign of the determinant of four edges with their squared lengths; `None` if rounding
/// may have changed it. Coordinates must be in the window: then nothing over- or underflows.
fn lifted_sign(first: [[f64; 3]; 3], last: [f64; 3]) -> Option<Ordering> {
    // Each of 72 terms has at most 17 roundings: five differences, four products of them, two of
    // which are squares, and eight sums. That is below 9 EPSILON of the terms' magnitudes.
    const ERROR: f64 = 16.0 * f64::EPSILON;
    let edges = [first[0], first[1], first[2], last];
    let across = |i: usize, j: usize| {
        let products = [edges[i][0] * edges[j][1], edges[j][0] * edges[i][1]];
        Sum { value: products[0] - products[1], magnitude: products[0].abs() + products[1].abs() }
    };
    let volume = |i: usize, j: usize, k: usize| {
        let height = |at: usize| edges[at][2];
        let sum = Sum::ZERO.plus(height(i), across(j, k)).plus(-height(j), across(i, k));
        sum.plus(height(k), across(i, j))
    };
    let square = |at: usize| edges[at].iter().map(|x| x * x).sum::<f64>();
    let sum = Sum::ZERO.plus(-square(0), volume(1, 2, 3)).plus(square(1), volume(0, 2, 3));
    let sum = sum.plus(-square(2), volume(0, 1, 3)).plus(square(3), volume(0, 1, 2));
    (sum.value.abs() > ERROR * sum.magnitude).then(|| sign(sum.value))
}

/// Returns true if no step of the expansions over- or underflows for a point.
fn is_in_window<const D: usize>(point: &[f64; D]) -> bool {
    point.iter().all(|x| *x == 0.0 || (SMALLEST..=LARGEST).contains(&x.abs()))
}

fn sign(value: f64) -> Ordering {
    value.partial_cmp(&0.0).expect("finite within the window")
}

fn planar<const D: usize>(point: &[f64; D]) -> Coord<f64> {
    Coord { x: point[0], y: point[1] }
}

fn spatial<const D: usize>(point: &[f64; D]) -> Coord3D<f64> {
    Coord3D { x: point[0], y: point[1], z: point[2] }
}
