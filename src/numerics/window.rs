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
