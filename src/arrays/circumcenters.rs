//! Circumcentres and circumradii.

use super::Part;
use crate::error::Result;
use crate::memory::{AllocResult, with_capacity};
use crate::mesh::{Triangulation, in_dimension};
use crate::numerics::{Circumball, circumcenter_exact, norm};
use crate::query::dual::Center;
use crate::query::unit::{scaled, sum_of_scaled};
use crate::query::view::View;

/// Largest error, relative to the radius, of a circumcentre in floating point; a less certain one
/// is computed in integers.
const ACCEPTED: f64 = 1e-12;

/// Circumballs of simplices.
#[derive(Clone, Debug, PartialEq)]
pub struct Circumcenters {
    /// Circumcentres, `simplices x dim`, exact up to 1e-12 of the radius and a rounding of the
    /// coordinate. Coordinates beyond the range of doubles are infinite.
    pub centers: Vec<f64>,
    /// Circumradii, exact up to a relative error of 1e-12, or 2^-1074 if subnormal. Radii beyond
    /// the range of doubles are infinite.
    pub radii: Vec<f64>,
}

impl Part<'_> {
    /// Returns the circumcentre and the circumradius of each simplex, in the order of
    /// [`Part::simplices`]. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn circumcenters(&self) -> Result<Circumcenters> {
        let none = || Ok(Circumcenters { centers: Vec::new(), radii: Vec::new() });
        Ok(in_dimension!(self.mesh.dim, D => circumcenters::<D>(self), _ => none())?)
    }
}

fn circumcenters<const D: usize>(part: &Part<'_>) -> AllocResult<Circumcenters> {
    let count = part.simplex_count();
    let mut found =
        Circumcenters { centers: with_capacity(count * D)?, radii: with_capacity(count)? };
    for simplex in part.simplices() {
        let (center, radius) = circumcenter::<D>(part.mesh, simplex);
        found.centers.extend(center);
        found.radii.push(radius);
    }
    Ok(found)
}

fn circumcenter<const D: usize>(mesh: &Triangulation, simplex: u32) -> ([f64; D], f64) {
    let view = View::<D> { mesh };
    let points = view.points_of(view.simplex(simplex));
    let Center { anchor, offset, exponent } = accurate_center(&points[..=D]);
    let coordinate = |i: usize| sum_of_scaled(points[anchor][i], offset[i], exponent);
    (std::array::from_fn(coordinate), scaled(norm(&offset), exponent))
}

/// Returns the circumcentre of a simplex with an error of at most [`ACCEPTED`] radii; NaN for a
/// flat simplex.
pub(super) fn accurate_center<const D: usize>(points: &[&[f64; D]]) -> Center<D> {
    center_within(ACCEPTED, points)
}

/// Returns the circumcentre of a simplex with an error of at most so many radii; NaN for a flat
/// simplex.
pub(crate) fn center_within<const D: usize>(accepted: f64, points: &[&[f64; D]]) -> Center<D> {
    let ball = Circumball::new(points);
    // The error of one that cannot be used is infinite.
    if ball.error < accepted * norm(&ball.center) && ball.error.is_finite() {
        return ball.into();
    }
    match circumcenter_exact(points, 0) {
        Some(exact) => Center { anchor: 0, offset: exact.center, exponent: exact.exponent as i32 },
        None => Center { anchor: 0, offset: [f64::NAN; D], exponent: 0 },
    }
}
