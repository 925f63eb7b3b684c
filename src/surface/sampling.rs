//! Density of the points for the surface: the distances between them beside the local feature
//! size, which is the distance to the medial axis (N. Amenta and M. Bern, "Surface reconstruction
//! by Voronoi filtering", 1999). Poles are near the medial axis.

use super::balls::Balls;
use super::open::radius;
use super::poles::Poles;
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::NONE;

/// Returns for each vertex the largest circumradius of its facets over the distance to the nearest
/// pole of their vertices; NaN for a vertex without facets. O(simplices).
pub fn ratios<const D: usize>(
    balls: &Balls<'_, D>,
    poles: &[Poles],
    facets: &[u32],
) -> AllocResult<Vec<f64>> {
    let none = (f64::NAN, f64::INFINITY);
    let mut sizes = filled(poles.len(), none)?;
    for facet in facets.chunks_exact(D) {
        let radius = radius(balls.view, balls.unit, facet);
        for &vertex in facet {
            let (largest, nearest) = &mut sizes[vertex as usize];
            *largest = largest.max(radius);
            let poles = facet.iter().map(|&vertex| poles[vertex as usize]);
            let poles = poles.flat_map(|Poles { first, second, .. }| [first, second]);
            for pole in poles.filter(|&pole| pole != NONE) {
                *nearest = nearest.min(balls.distance(pole, vertex));
            }
        }
    }
    collected(sizes.into_iter().map(|(largest, nearest)| largest / nearest))
}
