//! The ring of neighbours of a vertex in the plane, and what doubles tell of the triangles that
//! would fill it if the vertex went. Most vertices are needed for one of those, and need no exact
//! search of the hole that they would leave.

use crate::complex::VertexId;
use crate::delaunay::Delaunay;

/// Vertices with more neighbours have no ring.
const MOST: usize = 16;

/// The neighbours of a vertex counterclockwise, relative to it.
pub(super) struct Ring {
    points: [[f64; 2]; MOST],
    count: usize,
}

impl Ring {
    /// Returns the ring of a vertex; `None` for one of the hull or with many neighbours.
    pub fn around(delaunay: &Delaunay<2>, vertex: VertexId) -> Option<Self> {
        let (complex, x) = (delaunay.complex(), delaunay.point(vertex));
        let mut ring = Self { points: [[0.0; 2]; MOST], count: 0 };
        let first = complex.incident(vertex);
        let mut simplex = first;
        loop {
            let vertices = complex.vertices(simplex);
            let own = vertices.iter().position(|&other| other == vertex)?;
            let next = vertices[(own + 1) % 3];
            if !next.is_valid() || ring.count == MOST {
                return None;
            }
            let point = delaunay.point(next);
            ring.points[ring.count] = [point[0] - x[0], point[1] - x[1]];
            ring.count += 1;
            simplex = complex.neighbors(simplex)[(own + 1) % 3];
            if simplex == first {
                return Some(ring);
            }
        }
    }

    /// Returns true if one of the triangles on the sides of the ring has a radius-edge ratio above
    /// `bound`. Where doubles overflow or vanish the answer is no.
    pub fn has_beyond(&self, bound: f64) -> bool {
        (0..self.count).any(|side| self.squared_ratio_on(side) > bound * bound)
    }

    /// Returns the square of the radius-edge ratio of the triangle on a side: its apex is the
    /// vertex that sees the side at the largest angle.
    fn squared_ratio_on(&self, side: usize) -> f64 {
        let next = (side + 1) % self.count;
        let (a, b) = (self.points[side], self.points[next]);
        let mut least = (0.0, 0.0);
        let mut legs = [0.0; 2];
        for at in (0..self.count).filter(|&at| at != side && at != next) {
            let c = self.points[at];
            let (u, v) = ([a[0] - c[0], a[1] - c[1]], [b[0] - c[0], b[1] - c[1]]);
            let cross = u[0] * v[1] - u[1] * v[0];
            let dot = u[0] * v[0] + u[1] * v[1];
            // By their cotangents.
            if cross > 0.0 && (least.1 == 0.0 || dot * least.1 < least.0 * cross) {
                least = (dot, cross);
                legs = [u, v].map(|leg| leg[0] * leg[0] + leg[1] * leg[1]);
            }
        }
        let base = [b[0] - a[0], b[1] - a[1]];
        let base = base[0] * base[0] + base[1] * base[1];
        let shortest = base.min(legs[0]).min(legs[1]);
        // R = abc / 4A.
        let longer = base * legs[0] * legs[1] / shortest;
        longer / (4.0 * least.1 * least.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::Array;

    /// Returns the ring of the vertex in the middle of a regular polygon of circumradius `scale`.
    fn regular(count: usize, scale: f64) -> Ring {
        let corner = |at: usize| {
            let turn = (at as f64 + 0.3) * std::f64::consts::TAU / count as f64;
            [scale * turn.cos(), scale * turn.sin()]
        };
        let mut points: Vec<[f64; 2]> = (0..count).map(corner).collect();
        points.push([0.0; 2]);
        let ids: Vec<VertexId> = VertexId::below(count + 1).collect();
        let mut delaunay = Delaunay::new(Array::copied(&points).unwrap()).unwrap();
        delaunay.begin(&[ids[0], ids[count / 3], ids[count]]).unwrap();
        let (mut cavity, mut created) = (Default::default(), Vec::new());
        for &id in &ids {
            if !delaunay.complex().contains_vertex(id) {
                let near = delaunay.complex().incident(ids[count]);
                let start = delaunay.locate(near, &points[id.index()]).unwrap();
                delaunay.find_cavity(start, &points[id.index()], &mut cavity).unwrap();
                delaunay.insert(id, &cavity, &mut created).unwrap();
            }
        }
        assert!(Ring::around(&delaunay, ids[0]).is_none());
        Ring::around(&delaunay, ids[count]).unwrap()
    }

    #[test]
    fn the_triangles_of_a_regular_polygon_have_its_radius() {
        for count in [5, 6, 9] {
            let ring = regular(count, 3.0);
            assert_eq!(ring.count, count);
            let ratio = 0.5 / (std::f64::consts::PI / count as f64).sin();
            for side in 0..count {
                let found = ring.squared_ratio_on(side).sqrt();
                assert!((found / ratio - 1.0).abs() < 1e-12, "{count}: {found}, not {ratio}");
            }
            assert!(ring.has_beyond(0.999 * ratio) && !ring.has_beyond(1.001 * ratio));
        }
    }

    #[test]
    fn what_vanishes_is_not_beyond() {
        assert!(!regular(9, 1e-200).has_beyond(0.9));
        assert!(!regular(9, 1e160).has_beyond(0.9));
    }
}
