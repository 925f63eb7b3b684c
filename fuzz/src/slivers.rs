//! Least dihedral angles on points that are degenerate as a rule: vertices are removed and inserted
//! elsewhere among cospherical and flat ones, and the certificate must hold all the same.

use super::bytes::Bytes;
use super::families;
use super::mesh::check_points;
use super::settings::Settings;
use netmesh::{Algorithm, Options};

/// Largest number of points.
const MAX_POINTS: u8 = 40;
const MAX_VERTICES: u64 = 3000;

/// Checks slivers. The bytes pick the angle, the options, a family of points, and the points.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let min_dihedral = 1.0 + f64::from(bytes.below(22) as u32);
    let Settings { options, valid } = Settings::new(&mut bytes, 3);
    let options = Options {
        algorithm: Algorithm::Netmesh,
        distance_ratio: 0.0,
        max_vertices: MAX_VERTICES,
        min_dihedral: min_dihedral.min(22.0),
        ..options
    };
    let count = 5 + bytes.below(MAX_POINTS - 4);
    let points = match bytes.once_in(3) {
        true => grid(&mut bytes, count),
        false => families::points(&mut bytes, 3, count),
    };
    check_points(3, &points, &Settings { options, valid });
}

/// Returns a grid, some of whose points are moved a little.
fn grid(bytes: &mut Bytes<'_>, count: usize) -> Vec<f64> {
    let side = 2 + bytes.below(3);
    let exponent = -(bytes.below(52) as i32);
    let point = |i: usize| [i % side, i / side % side, i / side / side];
    let mut moved = |x: usize| match bytes.once_in(2) {
        true => 1.0 + x as f64 + f64::from(bytes.byte() as i8) * 2f64.powi(exponent - 8),
        false => 1.0 + x as f64,
    };
    (0..count).flat_map(point).map(&mut moved).collect()
}
