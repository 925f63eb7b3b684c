//! The triangles of a facet that is bent: the caller's, or where crossings are split the parts of
//! them. Vertices are put on these and not on the plane of the facet, off which they may be by far
//! more than two facets are from each other: the sheets of such would cross.

use crate::memory::{AllocResult, collected};
use crate::nearest::{Bounds, BoxTree, bounds_of};
use crate::netmesh::state::facets::plane::{Plane, power_below};
use std::cell::Cell;

/// Number of units in the last place by which a point may be beside a triangle and yet count as in
/// it: sheets end at chains, which are as far from the edges of triangles at most.
const BESIDE: f64 = 64.0;

/// Distance from its plane, in units in the last place of the facet's largest coordinate, up to
/// which a facet goes through inputs that are beside it, and is flat all the same.
const FLAT: f64 = 128.0;

/// Triangles of a bent facet, with the planes of each.
pub(in crate::netmesh) struct Bent {
    /// Triangle -> its corners in the projection of the facet, and its plane.
    triangles: Vec<([[f64; 2]; 3], Plane)>,
    boxes: BoxTree<'static>,
    /// Inverse of a power of two about as large as the facet.
    scale: f64,
}

impl Bent {
    /// Returns the triangles of a facet if some of their corners are off its plane by more than
    /// roundings explain; `None` for one that is flat. O(n log n).
    pub fn of(plane: &Plane, triangles: &[[[f64; 3]; 3]]) -> AllocResult<Option<Self>> {
        let corners = || triangles.iter().flatten();
        let largest = corners().flatten().fold(0.0f64, |largest, x| largest.max(x.abs()));
        let most = FLAT * (largest.next_up() - largest);
        if corners().all(|corner| plane.height(corner).abs() <= most) {
            return Ok(None);
        }
        let of_triangle = |own: &[[f64; 3]; 3]| (own.map(|x| plane.image(&x)), plane.of_part(own));
        let triangles = collected(triangles.iter().map(of_triangle))?;
        let bounds = |(corners, _): &([[f64; 2]; 3], Plane)| {
            bounds_of(corners.map(|[u, v]| [u, v, 0.0]).iter())
        };
        let boxes: Vec<Bounds> = collected(triangles.iter().map(bounds))?;
        let [low, high] = bounds_of(boxes.iter().flatten());
        let scale = 1.0 / power_below((high[0] - low[0]).max(high[1] - low[1]));
        Ok(Some(Self { boxes: BoxTree::new(boxes)?, triangles, scale }))
    }

    /// Returns the plane of the triangle that has a point in the projection, the largest of several
    /// such; `None` beside all. Expected O(log n).
    pub fn plane_at(&self, x: [f64; 2]) -> Option<&Plane> {
        let margin = x.map(|x| BESIDE * (x.abs().next_up() - x.abs()));
        let bound = |[low, high]: &Bounds| {
            let is_at = |k: usize| low[k] - margin[k] <= x[k] && x[k] <= high[k] + margin[k];
            if is_at(0) && is_at(1) { f64::NEG_INFINITY } else { f64::INFINITY }
        };
        let largest = Cell::new((0.0, None));
        let value = |triangle: u32| {
            let (corners, plane) = &self.triangles[triangle as usize];
            let Some(area) = self.area_around(corners, x, margin) else { return f64::INFINITY };
            if largest.get().1.is_none() || area > largest.get().0 {
                largest.set((area, Some(plane)));
            }
            -area
        };
        self.boxes.least(&bound, &value);
        largest.get().1
    }

    /// Returns twice the area of a counterclockwise triangle, scaled, if that has `x` or is beside
    /// it by a margin at most; `None` for others.
    fn area_around(&self, [a, b, c]: &[[f64; 2]; 3], x: [f64; 2], margin: [f64; 2]) -> Option<f64> {
        let way = |from: &[f64; 2], to: &[f64; 2]| {
            [self.scale * (to[0] - from[0]), self.scale * (to[1] - from[1])]
        };
        let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
        let is_within = |[from, to]: [&[f64; 2]; 2]| {
            let edge = way(from, to);
            let beside = edge[0].abs() * margin[1] + edge[1].abs() * margin[0];
            cross(edge, way(from, &x)) >= -self.scale * beside
        };
        let is_in = [[a, b], [b, c], [c, a]].into_iter().all(is_within);
        is_in.then(|| cross(way(a, b), way(a, c)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a roof over the square from (0, 0) to (2, 2), whose ridge is at x = 1, 0.25 high.
    fn roof() -> [[[f64; 3]; 3]; 4] {
        let at = |x: f64, y: f64| [x, y, 0.25 * (1.0 - (x - 1.0).abs())];
        let (a, b, c, d, e, f) =
            (at(0.0, 0.0), at(1.0, 0.0), at(2.0, 0.0), at(0.0, 2.0), at(1.0, 2.0), at(2.0, 2.0));
        [[a, b, e], [a, e, d], [b, c, f], [b, f, e]]
    }

    #[test]
    fn points_are_put_on_the_triangle_that_they_are_over() {
        for turn in 0..3 {
            let turned = |mut x: [f64; 3]| {
                x.rotate_right(turn);
                x
            };
            let triangles = roof().map(|own| own.map(turned));
            let plane = Plane::of(&triangles);
            let bent = Bent::of(&plane, &triangles).unwrap().expect("the roof is bent");
            for (x, y) in [(0.25, 0.5), (0.75, 1.75), (1.0, 1.0), (1.5, 0.125), (1.25, 1.75)] {
                let expected = turned([x, y, 0.25 * (1.0 - f64::abs(x - 1.0))]);
                let own = bent.plane_at(plane.image(&expected)).unwrap();
                assert_eq!(own.at(&turned([x, y, 7.0])), expected);
            }
            assert!(bent.plane_at(plane.image(&turned([2.5, 1.0, 0.0]))).is_none());
            // Chains may be beside the edges of triangles by roundings.
            assert!(bent.plane_at(plane.image(&turned([2.0 + 1e-15, 1.0, 0.0]))).is_some());
        }
    }

    #[test]
    fn flat_facets_have_their_plane_alone() {
        let triangles = roof().map(|own| own.map(|[x, y, _]| [x, y, 0.25 * x + 0.5 * y]));
        assert!(Bent::of(&Plane::of(&triangles), &triangles).unwrap().is_none());
    }
}
