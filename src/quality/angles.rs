//! Angles of simplices: the dihedral angles at the ridges, which in 2D are the angles.

use super::corner::normals;
use super::view::View;
use crate::memory::AllocResult;
use crate::mesh::MAX_DIM;

/// Returns the squared tangent of half the smallest dihedral angle of the simplex `points`, which
/// grows with the angle. It is 0 for a flat simplex; [`angle`] is the inverse.
pub(crate) fn smallest_squared_tangent<const D: usize>(points: &[&[f64; D]]) -> AllocResult<f64> {
    let mut smallest = f64::INFINITY;
    for_each_squared_tangent(points, |tangent| smallest = smallest.min(tangent))?;
    Ok(smallest)
}

/// Visits the angle of each pair of facets of the simplex `points`, as the square of the tangent of
/// its half; all are 0 if the simplex is flat.
pub(crate) fn for_each_squared_tangent<const D: usize>(
    points: &[&[f64; D]],
    mut visit: impl FnMut(f64),
) -> AllocResult<()> {
    let units = normals(points)?.map(|normals| normals.map(unit));
    let count = View::<D>::VERTICES;
    for i in 0..count {
        for j in i + 1..count {
            let tangent =
                |units: &[[f64; D]; MAX_DIM + 1]| squared_tangent_inside(&units[i], &units[j]);
            visit(units.as_ref().map_or(0.0, tangent));
        }
    }
    Ok(())
}

/// Returns the angle in radians whose half has a tangent with this square.
pub(crate) fn angle(squared_tangent: f64) -> f64 {
    2.0 * squared_tangent.sqrt().atan()
}

fn unit<const D: usize>(vector: [f64; D]) -> [f64; D] {
    let norm = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    vector.map(|x| x / norm)
}

/// Returns the squared tangent of half the angle between two facets with these inward unit normals.
/// The angle is pi minus that of the normals, and the tangent is accurate at both ends.
fn squared_tangent_inside<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let square = |sign: f64| a.iter().zip(b).map(|(x, y)| (x + sign * y).powi(2)).sum::<f64>();
    square(1.0) / square(-1.0)
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
