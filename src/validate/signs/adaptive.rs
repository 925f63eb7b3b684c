//! Signs in two dimensions and orientations in three from adaptive floating-point expansions (J. R.
//! Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
//! 1997), which the package `robust` has.
//!
//! Its in-sphere test is not used: the last stage of it takes 181 KB of stack, which threads of
//! small stacks do not have.

use robust::{Coord, Coord3D, incircle, orient2d, orient3d};
use std::cmp::Ordering;

/// Coordinates from this magnitude on, and zero, are within the window. The units of such a
/// coordinate's last place are at least 2^-194, so that every product of five factors is a multiple
/// of 2^-970: no expansion loses bits below 2^-1074, and an error bound of 2^-52 of such a product
/// is still normal.
const SMALLEST: f64 = f64::from_bits((1023 - 142) << 52);

/// The largest magnitude within the window. An in-sphere determinant, the longest of all, would be a
/// sum of 72 products of five differences below 2^202: less than 2^1017, and 2^7 times that is still
/// finite.
const LARGEST: f64 = f64::from_bits((1023 + 201) << 52);

/// A source of signs in two and three dimensions; `None` where it has none.
pub(in super::super) trait Adaptive {
    fn orientation<const D: usize>(&mut self, simplex: &[&[f64; D]]) -> Option<Ordering>;
    fn in_ball<const D: usize>(&mut self, simplex: &[&[f64; D]], q: &[f64; D]) -> Option<Ordering>;
}

/// The package `robust`, within the window where it is exact.
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
        if D != 2 || !simplex.iter().copied().chain([q]).all(is_in_window) {
            return None;
        }
        let [a, b, c] = std::array::from_fn(|i| planar(simplex[i]));
        Some(sign(incircle(a, b, c, planar(q))))
    }
}

/// Whether no step of the expansions over- or underflows for a point.
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
