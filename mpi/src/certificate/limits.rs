//! Cells whose quality precision may limit: the parts do not tell what the run knows of it.

use super::complex::Complex;
use netmesh::Result;
use netmesh::distributed::memory::filled;

/// The builder compares rounded radii; so does the certificate, with other roundings.
pub const SLACK: f64 = 1e-7;

/// Largest ratio of an edge to the largest coordinate for which there may be no room for a corner.
const LEAST_EDGE: f64 = 1.0 / (1u64 << 40) as f64;

/// And where ratios drown in the rounding of subnormals.
const SUBNORMAL: f64 = f64::from_bits(1 << 30);

/// Returns true if precision limits a simplex of these points.
pub fn simplex<const D: usize>(points: &[&[f64; D]]) -> bool {
    let magnitude = |point: &[f64; D]| point.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let largest = points.iter().map(|point| magnitude(point)).fold(0.0, f64::max);
    let least = (largest * LEAST_EDGE).max(SUBNORMAL);
    points.iter().enumerate().any(|(at, p)| {
        let is_near = |q: &&[f64; D]| magnitude(&std::array::from_fn(|k| p[k] - q[k])) <= least;
        points[at + 1..].iter().any(is_near)
    })
}

/// Returns for each vertex whether precision limits a simplex there.
pub fn vertices<const D: usize>(complex: &Complex<'_>) -> Result<Vec<bool>> {
    let mut is_limited = filled(complex.mesh.vertex_ids.len(), false)?;
    for at in 0..complex.count() {
        if simplex(&complex.points::<D>(at)[..=D]) {
            complex.simplex(at).iter().for_each(|&vertex| is_limited[vertex as usize] = true);
        }
    }
    Ok(is_limited)
}
