//! Where the adaptive predicates of `robust` are exact, and their conventions turned into ours.

use robust::{Coord, Coord3D};

/// Whether every coordinate is zero or of magnitude 2^-142 to 2^201: there no partial product of
/// the adaptive predicates in two and three dimensions overflows or loses bits below the smallest
/// double (measured against integers; outside they are silently wrong).
pub(super) fn in_window<'a, const D: usize>(
    points: impl IntoIterator<Item = &'a [f64; D]>,
) -> bool {
    const SMALLEST: f64 = f64::from_bits((1023 - 142) << 52);
    const LARGEST: f64 = f64::from_bits((1023 + 201) << 52);
    points
        .into_iter()
        .all(|point| point.iter().all(|x| *x == 0.0 || (SMALLEST..=LARGEST).contains(&x.abs())))
}

#[inline]
pub(super) fn planar<const D: usize>(point: &[f64; D]) -> Coord<f64> {
    Coord { x: point[0], y: point[1] }
}

#[inline]
pub(super) fn spatial<const D: usize>(point: &[f64; D]) -> Coord3D<f64> {
    Coord3D { x: point[0], y: point[1], z: point[2] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_where_the_adaptive_signs_were_measured() {
        let (smallest, largest) = (2f64.powi(-142), 2f64.powi(201));
        assert!(in_window(&[[0.0, -0.0], [smallest, largest], [-largest, -smallest]]));
        for outside in [smallest.next_down(), largest.next_up(), f64::MAX, f64::from_bits(1)] {
            for point in [[outside, 1.0], [1.0, -outside]] {
                assert!(!in_window(&[[1.0, 1.0], point]));
            }
        }
        assert_eq!((planar(&[1.0, 2.0]).x, planar(&[1.0, 2.0]).y), (1.0, 2.0));
    }
}
