//! Numbers of neighbours of the vertices of a mesh.

use netmesh::Triangulation;

/// Vertices from which on one in ten thousand is more than a few.
const MANY: usize = 10_000;

#[derive(Clone, Copy, Debug)]
pub struct Degrees {
    pub mean: f64,
    /// The 99.99th percentile; NaN for fewer than [`MANY`] vertices.
    pub high: f64,
    pub max: f64,
}

impl Degrees {
    pub fn of(mesh: &Triangulation) -> Self {
        let mut degrees = degrees(mesh);
        degrees.sort_unstable();
        let sum: f64 = degrees.iter().map(|&degree| f64::from(degree)).sum();
        let at = |fraction: f64| {
            let place = (degrees.len() as f64 * fraction).ceil() as usize;
            degrees.get(place.max(1) - 1).map_or(f64::NAN, |&degree| f64::from(degree))
        };
        Self {
            mean: sum / degrees.len() as f64,
            high: if degrees.len() < MANY { f64::NAN } else { at(0.9999) },
            max: at(1.0),
        }
    }
}

/// Vertex -> the number of other vertices that it shares a simplex with. O(simplices).
fn degrees(mesh: &Triangulation) -> Vec<u32> {
    let vertices = mesh.vertex_count();
    let mut ends = vec![0usize; vertices + 1];
    for &vertex in &mesh.simplices {
        ends[vertex as usize + 1] += 1;
    }
    for vertex in 0..vertices {
        ends[vertex + 1] += ends[vertex];
    }
    let begins = ends.clone();
    let mut incident = vec![0u32; mesh.simplices.len()];
    for (at, &vertex) in mesh.simplices.iter().enumerate() {
        incident[ends[vertex as usize]] = (at / (mesh.dim + 1)) as u32;
        ends[vertex as usize] += 1;
    }
    let mut seen_from = vec![u32::MAX; vertices];
    let mut degree = |vertex: usize| {
        // A vertex is no neighbour of itself.
        seen_from[vertex] = vertex as u32;
        let star = &incident[begins[vertex]..begins[vertex + 1]];
        let shared = star.iter().flat_map(|&simplex| {
            let begin = simplex as usize * (mesh.dim + 1);
            &mesh.simplices[begin..begin + mesh.dim + 1]
        });
        let mut count = 0;
        for &other in shared {
            count += u32::from(seen_from[other as usize] != vertex as u32);
            seen_from[other as usize] = vertex as u32;
        }
        count
    };
    (0..vertices).map(&mut degree).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{inputs, runner};
    use netmesh::{Options, quality};
    use std::time::Duration;

    /// Twice the edges over the vertices, by Euler's formula, and the largest as the library has
    /// it.
    #[test]
    fn degrees_are_those_of_the_edges() {
        let points = inputs::uniform(2, 300, 1);
        let outcome = runner::mesh(&points, &Options::default(), Duration::from_secs(60));
        let mesh = outcome.mesh().unwrap();
        let degrees = Degrees::of(mesh);
        let edges = mesh.vertex_count() + mesh.simplex_count() - 1;
        assert_eq!(degrees.mean, 2.0 * edges as f64 / mesh.vertex_count() as f64);
        assert_eq!(degrees.max, f64::from(quality::measure(mesh).unwrap().max_degree));
        assert!(degrees.high.is_nan(), "too few vertices");
    }
}
