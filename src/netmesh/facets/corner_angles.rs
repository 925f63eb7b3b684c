//! Angles between facets at a vertex that they share. A facet need not be convex: that two vertices
//! on it are seen from there at a small angle does not tell that the facets meet at one.

use crate::complex::VertexId;
use crate::netmesh::state::State;
use crate::numerics::{cross, dot, norm};

/// Corner of a triangle: directions of length 1 along two edges, from their common end.
#[derive(Clone, Copy)]
pub(super) struct Corner([[f64; 3]; 2]);

impl Corner {
    fn new(ways: [[f64; 3]; 2]) -> Self {
        Self(ways.map(|way| {
            let length = norm(&way);
            way.map(|x| x / length)
        }))
    }
}

impl State<3> {
    /// Returns the corner of a subfacet at one of its vertices.
    pub(super) fn corner_at(&self, vertex: VertexId, subfacet: u32) -> Corner {
        let vertices = self.facets.get(subfacet).vertices;
        let at = vertices.iter().position(|&own| own == vertex).unwrap_or(0);
        let x = self.delaunay.point(vertex);
        Corner::new([1, 2].map(|step| {
            let end = self.delaunay.point(vertices[(at + step) % 3]);
            std::array::from_fn(|k| end[k] - x[k])
        }))
    }
}

/// Returns the cosine of the smallest angle between two corners at one point, which share nothing
/// else but an edge at most.
pub(super) fn cosine_between(first: &Corner, second: &Corner) -> f64 {
    let to = |corner: &Corner, ways: &Corner| {
        ways.0.iter().map(|way| cosine_to(way, corner)).fold(-1.0, f64::max)
    };
    to(first, second).max(to(second, first))
}

/// Returns the cosine of the smallest angle between a direction and those of a corner.
fn cosine_to(way: &[f64; 3], corner: &Corner) -> f64 {
    let Corner([a, b]) = corner;
    let normal = cross(a, b);
    let square = dot(&normal, &normal);
    let height = dot(way, &normal) / square;
    let shadow: [f64; 3] = std::array::from_fn(|k| way[k] - height * normal[k]);
    let is_left_of = |from: &[f64; 3], to: &[f64; 3]| dot(&cross(from, to), &normal) >= 0.0;
    let at_ends = dot(way, a).max(dot(way, b));
    match square > 0.0 && is_left_of(a, &shadow) && is_left_of(&shadow, b) {
        // The shadow is the longer the smaller the angle to it is.
        true => at_ends.max(dot(&shadow, &shadow).sqrt()),
        false => at_ends,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Ways = [[f64; 3]; 2];

    fn angle(first: Ways, second: Ways) -> f64 {
        let [first, second] = [first, second].map(Corner::new);
        let cosine = cosine_between(&first, &second);
        assert!((cosine - cosine_between(&second, &first)).abs() < 1e-15);
        cosine.acos().to_degrees()
    }

    const FLAT: Ways = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn angles_are_between_edges_or_to_the_inside() {
        // In the plane of the corner, beyond its second edge.
        assert!((angle(FLAT, [[-1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]]) - 45.0).abs() < 1e-12);
        // Above it, over its middle.
        let height = 30f64.to_radians().tan() * 2f64.sqrt();
        assert!((angle(FLAT, [[1.0, 1.0, height], [0.0, 0.0, 1.0]]) - 30.0).abs() < 1e-12);
        // Beyond the corner itself.
        let expected = (-1.0 / 11f64.sqrt()).acos().to_degrees();
        assert!((angle(FLAT, [[-1.0, -1.0, 0.1], [-1.0, -1.0, 3.0]]) - expected).abs() < 1e-12);
        assert!(angle(FLAT, [[-1.0, 0.0, 1.0], [0.0, -1.0, 1.0]]) > 89.9);
    }

    #[test]
    fn corners_with_a_common_edge_meet_at_none() {
        assert!(angle(FLAT, [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]) < 1e-6);
    }

    #[test]
    fn lengths_do_not_count() {
        let scaled = |by: f64, [a, b]: Ways| [a.map(|x| by * x), b.map(|x| 3.0 * by * x)];
        let other = [[1.0, 1.0, 0.5], [0.2, 0.3, 1.0]];
        let expected = angle(FLAT, other);
        for by in [1e-300, 1e300] {
            assert!((angle(scaled(by, FLAT), other) - expected).abs() < 1e-12, "{by}");
        }
    }
}
