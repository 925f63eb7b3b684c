//! Angles of simplices: the dihedral angles at the ridges, which in 2D are the angles.

use super::simplex::{Normals, Simplex};
use crate::memory::AllocResult;
use crate::mesh::MAX_DIM;

/// Screen before the smallest angle of a simplex: it holds back most simplices whose angles are all
/// larger than a limit, without a root or a quotient, and none with a smaller one.
#[derive(Clone, Copy)]
pub(super) struct Screen {
    /// The least squared cosine of an angle that passes, if that is not obtuse.
    squared_cosine: f64,
}

impl Screen {
    /// Lets every simplex pass.
    pub(super) const OPEN: Self = Self { squared_cosine: -1.0 };
    /// Lets none pass.
    pub(super) const CLOSED: Self = Self { squared_cosine: f64::INFINITY };

    /// Makes a screen for angles whose half has a tangent with a smaller square.
    ///
    /// A squared cosine that is [`Screen::MARGIN`] smaller is of an angle whose square is larger by
    /// at least as much: far more than what roundings do to tangents and products of normals.
    pub fn of(squared_tangent: f64) -> Self {
        match (1.0 - squared_tangent) / (1.0 + squared_tangent) {
            cosine if cosine > 0.0 => Self { squared_cosine: cosine * cosine - Self::MARGIN },
            _ => Self::OPEN,
        }
    }

    const MARGIN: f64 = 1e-9;

    /// Returns the wider of two screens, which lets pass what either does.
    pub fn wider(self, other: Self) -> Self {
        Self { squared_cosine: self.squared_cosine.min(other.squared_cosine) }
    }

    pub fn is_closed(self) -> bool {
        self.squared_cosine == f64::INFINITY
    }

    /// Returns true if two of the facets with these inward normals may be at a smaller angle. No
    /// product of four components of normals may over- or underflow.
    #[inline]
    pub fn passes<const D: usize>(self, normals: &[[f64; D]; D], last: &[f64; D]) -> bool {
        if self.squared_cosine < 0.0 {
            return true;
        }
        let squares = normals.map(|normal| product(&normal, &normal));
        let of_last = product(last, last);
        let mut passes = false;
        for i in 0..D {
            let across = |other: &[f64; D], square: f64| {
                let product = product(&normals[i], other);
                product < 0.0 && product * product > self.squared_cosine * (squares[i] * square)
            };
            passes |= across(last, of_last);
            for j in i + 1..D {
                passes |= across(&normals[j], squares[j]);
            }
        }
        passes
    }
}

#[inline]
fn product<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for axis in 0..D {
        sum += a[axis] * b[axis];
    }
    sum
}

/// Returns the squared tangent of half the smallest dihedral angle of the simplex `points`, which
/// grows with the angle. It is 0 for a flat simplex; [`angle`] is the inverse.
pub(crate) fn smallest_squared_tangent<const D: usize>(points: &[&[f64; D]]) -> AllocResult<f64> {
    Simplex::new(points).smallest_squared_tangent()
}

/// Returns the same of a simplex with these normals of facets, or of a flat one without.
#[inline]
pub(super) fn smallest_squared_tangent_of<const D: usize>(normals: Option<Normals<D>>) -> f64 {
    let mut smallest = f64::INFINITY;
    visit_squared_tangents(normals, |tangent| smallest = smallest.min(tangent));
    smallest
}

/// Visits the angle of each pair of facets of the simplex `points`, as the square of the tangent of
/// its half; all are 0 if the simplex is flat.
pub(crate) fn for_each_squared_tangent<const D: usize>(
    points: &[&[f64; D]],
    visit: impl FnMut(f64),
) -> AllocResult<()> {
    visit_squared_tangents(Simplex::new(points).normals()?, visit);
    Ok(())
}

#[inline]
fn visit_squared_tangents<const D: usize>(normals: Option<Normals<D>>, mut visit: impl FnMut(f64)) {
    let mut units = normals.unwrap_or([[0.0; D]; MAX_DIM + 1]);
    units[..=D].iter_mut().for_each(|normal| *normal = unit(*normal));
    for i in 0..=D {
        for j in i + 1..=D {
            let is_flat = normals.is_none();
            visit(if is_flat { 0.0 } else { squared_tangent_inside(&units[i], &units[j]) });
        }
    }
}

/// Returns the angle in radians whose half has a tangent with this square.
pub(crate) fn angle(squared_tangent: f64) -> f64 {
    2.0 * squared_tangent.sqrt().atan()
}

/// Returns the squared tangent of half an angle in radians.
pub(super) fn squared_tangent(angle: f64) -> f64 {
    let tangent = (0.5 * angle).tan();
    tangent * tangent
}

fn unit<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let factor = 1.0 / vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    vector.map(|x| x * factor)
}

/// Returns the squared tangent of half the angle between two facets with these inward unit normals.
/// The angle is pi minus that of the normals, and the tangent is accurate at both ends.
fn squared_tangent_inside<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let (mut of_sum, mut of_difference) = (0.0, 0.0);
    for axis in 0..D {
        let (sum, difference) = (a[axis] + b[axis], a[axis] - b[axis]);
        of_sum += sum * sum;
        of_difference += difference * difference;
    }
    of_sum / of_difference
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees<const D: usize>(points: &[[f64; D]]) -> f64 {
        angle(smallest_squared_tangent(&points.iter().collect::<Vec<_>>()).unwrap()).to_degrees()
    }

    #[test]
    fn known_angles() {
        assert!((degrees(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]) - 45.0).abs() < 1e-12);
        assert!(
            (degrees(&[[0.0, 0.0], [2e300, 0.0], [1e300, 3f64.sqrt() * 1e300]]) - 60.0).abs()
                < 1e-9
        );
        let regular = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        assert!((degrees(&regular) - (1.0f64 / 3.0).acos().to_degrees()).abs() < 1e-12);
        let corner = [
            [0.0; 4],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        assert!((degrees(&corner) - 60.0).abs() < 1e-12);
    }

    #[test]
    fn thin_and_flat_simplices() {
        let thin = degrees(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1e-12]]).to_radians();
        assert!((thin / 2e-12 - 1.0).abs() < 1e-3, "{thin}");
        assert_eq!(degrees(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), 0.0);
    }
}
