//! A quick test for points that are surely well inside a hull, as most of many inputs are. Such
//! points need not be sorted when the hull is made, nor compared with its edges.

use std::ops::Range;

/// Directions in which the outermost points are sought, counterclockwise.
const WAYS: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [1.0, 1.0],
    [0.0, 1.0],
    [-1.0, 1.0],
    [-1.0, 0.0],
    [-1.0, -1.0],
    [0.0, -1.0],
    [1.0, -1.0],
];

/// Distance, relative to the largest coordinate, below which two outermost points count as one: the
/// sides of a short edge say little.
const APART: f64 = 1.0 / 256.0;

/// Largest coordinates for which products neither overflow nor vanish.
const SAFE: Range<f64> = 1e-100..1e100;

/// Twice the least area of the triangle of an edge and a point inside, relative to the square of
/// the largest coordinate; roundings are millions of times smaller.
const MARGIN: f64 = 1.0 / (1 << 28) as f64;

/// Polygon of outermost points (S. Akl and G. Toussaint, "A fast convex hull algorithm", 1978).
pub(super) struct Inner {
    /// Edges of the polygon: a corner, and the vector from it to the next corner.
    edges: [([f64; 2], [f64; 2]); 8],
    count: usize,
    least: f64,
}

impl Inner {
    /// Builds the polygon from all points that a hull is made of, or from the corners of a convex
    /// curve.
    pub fn of<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Self {
        let mut outermost = [(f64::NEG_INFINITY, [0.0; 2]); 8];
        let mut largest: f64 = 0.0;
        for x in points {
            largest = largest.max(x[0].abs()).max(x[1].abs());
            for (far, way) in outermost.iter_mut().zip(WAYS) {
                let own = way[0] * x[0] + way[1] * x[1];
                if own > far.0 {
                    *far = (own, *x);
                }
            }
        }
        let mut inner = Self { edges: Default::default(), count: 0, least: 0.0 };
        if SAFE.contains(&largest) {
            inner.least = MARGIN * largest * largest;
            inner.join(&outermost.map(|far| far.1), APART * largest);
        }
        inner
    }

    /// Adds the edges between consecutive `corners` that are more than `apart` from each other.
    fn join(&mut self, corners: &[[f64; 2]; 8], apart: f64) {
        let way = |a: &[f64; 2], b: &[f64; 2]| [b[0] - a[0], b[1] - a[1]];
        let are_apart =
            |a: &[f64; 2], b: &[f64; 2]| way(a, b).into_iter().any(|step| step.abs() > apart);
        let mut last = corners[0];
        for corner in &corners[1..] {
            if are_apart(&last, corner) && are_apart(corner, &corners[0]) {
                self.edges[self.count] = (last, way(&last, corner));
                self.count += 1;
                last = *corner;
            }
        }
        self.edges[self.count] = (last, way(&last, &corners[0]));
        self.count += 1;
    }

    /// Returns true only if a disc about `x`, larger than any rounding, is inside the hull: `x` is
    /// left of all edges of a closed polygon, which goes round it. May return false for a point
    /// inside.
    pub fn holds(&self, x: &[f64; 2]) -> bool {
        let is_left = |&(from, way): &([f64; 2], [f64; 2])| {
            way[0] * (x[1] - from[1]) - way[1] * (x[0] - from[0]) > self.least
        };
        self.count > 2 && self.edges[..self.count].iter().all(is_left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::orientation;

    /// Returns the `side` squared points of a lattice in the unit square, each moved by `place`.
    fn lattice(side: u32, place: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[f64; 2]> {
        let at = |i: u32| f64::from(i) / f64::from(side - 1);
        (0..side * side).map(|i| place([at(i % side), at(i / side)])).collect()
    }

    fn held(points: &[[f64; 2]]) -> usize {
        let inner = Inner::of(points.iter());
        points.iter().filter(|x| inner.holds(x)).count()
    }

    /// All points of a lattice except its boundary are inside, however the square is turned. Turned
    /// by half a right angle, it has its outermost points at its corners only, else also near
    /// these.
    #[test]
    fn most_of_a_lattice_is_within() {
        let turned = |cosine: f64, sine: f64| {
            move |[x, y]: [f64; 2]| [cosine * x - sine * y, sine * x + cosine * y]
        };
        assert_eq!(held(&lattice(41, |x| x)), 39 * 39);
        for (cosine, sine) in [(0.8, 0.6), (-0.6, 0.8), (0.28, -0.96)] {
            assert_eq!(held(&lattice(41, turned(cosine, sine))), 39 * 39, "{cosine}");
        }
        assert_eq!(held(&lattice(41, |x| x.map(|x| 1e90 * x - 1e89))), 39 * 39);
        assert_eq!(held(&lattice(41, |x| x.map(|x| 1e-90 * x - 1e-91))), 39 * 39);
    }

    #[test]
    fn where_products_overflow_or_vanish_nothing_is() {
        for scale in [f64::MAX, 1e101, 1e-101, 5e-324, 0.0] {
            assert_eq!(held(&lattice(9, |x| x.map(|x| scale * x))), 0, "{scale}");
        }
        // A square of roundings far from the origin.
        assert_eq!(held(&lattice(9, |[x, y]| [1e9 + 1e-6 * x, y])), 0);
        assert_eq!(held(&[]), 0);
        assert_eq!(held(&[[1.0, 2.0]]), 0);
        assert_eq!(held(&lattice(9, |[x, _]| [x, 2.0 * x])), 0);
    }

    /// Points that are held are left of all edges by far more than the roundings that `frame`
    /// allows for.
    #[test]
    fn nothing_next_to_an_edge_is_within() {
        let corners = [[-0.8, 0.6], [-0.6, -0.8], [0.8, -0.6], [0.6, 0.8]];
        let mut inside = 0;
        for at in 1..99 {
            let part = f64::from(at) / 99.0;
            for exponent in 8..60 {
                let off = 2f64.powi(-exponent);
                // Inwards from the third edge, which ends at the last corner.
                let [a, b] = [corners[2], corners[3]];
                let way = [b[0] - a[0], b[1] - a[1]];
                let x = [0, 1].map(|axis| {
                    a[axis] + part * way[axis] + off * if axis == 0 { -way[1] } else { way[0] }
                });
                let is_held = Inner::of(corners.iter()).holds(&x);
                assert!(!is_held || off > 1e-10, "{part} {off}");
                assert!(!is_held || orientation(&[&a, &b, &x]).is_positive());
                inside += usize::from(is_held);
            }
        }
        assert!(inside > 98 * 10, "{inside}");
    }
}
