//! Points in a tree of boxes, which finds points beyond a plane.

use super::plane::Plane;
use crate::memory::{AllocResult, collected, filled};
use crate::numerics::coordinates;
use std::ops::Range;

/// Largest number of points in a leaf.
const LEAF: usize = 8;

pub(super) struct Cloud<const D: usize> {
    points: Vec<[f64; D]>,
    /// Least and largest coordinates of the points below each node. Node 0 is the root, nodes 2 i +
    /// 1 and 2 i + 2 have the halves of the points of node i.
    boxes: Vec<[[f64; D]; 2]>,
}

impl<const D: usize> Cloud<D> {
    /// Builds the tree of points given by `points x D` coordinates. O(points log points).
    pub fn new(points: &[f64]) -> AllocResult<Self> {
        let count = points.len() / D;
        let mut nodes = 1usize;
        while count > LEAF * nodes.div_ceil(2) {
            nodes = 2 * nodes + 1;
        }
        let mut cloud = Self {
            points: collected((0..count).map(|at| *coordinates(points, at)))?,
            boxes: filled(nodes, [[0.0; D]; 2])?,
        };
        cloud.divide(0, 0..count);
        Ok(cloud)
    }

    /// Computes the boxes of a node and of the nodes below it.
    fn divide(&mut self, node: usize, range: Range<usize>) {
        let Some(own) = self.boxes.get_mut(node) else { return };
        let points = &mut self.points[range.clone()];
        let (low, high) = bounds(points.as_flattened());
        *own = [low, high];
        // Halves, so that no difference overflows.
        let width = |axis: usize| 0.5 * high[axis] - 0.5 * low[axis];
        let widest = (1..D).fold(0, |a, b| if width(b) > width(a) { b } else { a });
        let half = points.len() / 2;
        if half > 0 {
            points.select_nth_unstable_by(half, |p, q| p[widest].total_cmp(&q[widest]));
        }
        let middle = range.start + half;
        self.divide(2 * node + 1, range.start..middle);
        self.divide(2 * node + 2, middle..range.end);
    }

    pub fn point(&self, at: usize) -> &[f64; D] {
        &self.points[at]
    }

    /// Returns the first point strictly on the positive side of a plane, or `None`.
    pub fn first_beyond(&self, plane: &Plane<D>) -> Option<usize> {
        self.first_in(0, 0..self.points.len(), plane)
    }

    fn first_in(&self, node: usize, range: Range<usize>, plane: &Plane<D>) -> Option<usize> {
        let Some([low, high]) = self.boxes.get(node) else {
            return { range }.find(|&at| plane.has_beyond(&self.points[at]));
        };
        if plane.most_in(low, high) < 0.0 {
            return None;
        }
        let middle = range.start + range.len() / 2;
        let second = || self.first_in(2 * node + 2, middle..range.end, plane);
        self.first_in(2 * node + 1, range.start..middle, plane).or_else(second)
    }

    /// Returns a point strictly on the positive side of a plane, or `None` if there is none. The
    /// point is far from the plane, since boxes that reach farther are searched first.
    pub fn far_beyond(&self, plane: &Plane<D>) -> Option<usize> {
        let mut farthest = Farthest { plane, height: 0.0, at: None };
        self.seek_far(0, 0..self.points.len(), &mut farthest);
        farthest.at
    }

    fn seek_far(&self, node: usize, range: Range<usize>, farthest: &mut Farthest<'_, D>) {
        if self.boxes.get(node).is_none() {
            { range }.for_each(|at| farthest.consider(at, &self.points[at]));
            return;
        }
        let middle = range.start + range.len() / 2;
        let halves = [(2 * node + 1, range.start..middle), (2 * node + 2, middle..range.end)];
        let most = |node: usize| {
            let own = self.boxes.get(node).map(|[low, high]| farthest.plane.most_in(low, high));
            own.unwrap_or(f64::INFINITY)
        };
        let mut halves = halves.map(|(node, range)| (most(node), node, range));
        // False if one is no number.
        if halves[1].0 > halves[0].0 {
            halves.swap(0, 1);
        }
        for (most, node, range) in halves {
            let is_before = most < 0.0;
            if farthest.at.is_none() && !is_before {
                self.seek_far(node, range, farthest);
            }
        }
    }
}

/// Farthest point beyond a plane among the points of one leaf.
struct Farthest<'a, const D: usize> {
    plane: &'a Plane<D>,
    /// Lower bound of the point's distance from the plane, in the units of [`Plane::least_at`].
    height: f64,
    at: Option<usize>,
}

impl<const D: usize> Farthest<'_, D> {
    fn consider(&mut self, at: usize, point: &[f64; D]) {
        let height = self.plane.least_at(point);
        if height > self.height {
            (self.height, self.at) = (height, Some(at));
        } else if self.at.is_none() && self.plane.has_beyond(point) {
            self.at = Some(at);
        }
    }
}

/// Returns the least and the largest coordinates of points.
pub(super) fn bounds<const D: usize>(points: &[f64]) -> ([f64; D], [f64; D]) {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for at in 0..points.len() / D {
        for (axis, &x) in coordinates::<D>(points, at).iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::{FAMILIES, Random, points};

    #[test]
    fn a_point_beyond_a_plane_is_found_if_there_is_one() {
        fn check<const D: usize>() {
            let mut seen = [0; 2];
            for (family, count) in FAMILIES.into_iter().flat_map(|f| [1, 9, 60].map(|n| (f, n))) {
                let mut random = Random(family as u64 * 7 + D as u64);
                let points = points::<D>(family, count + D + 1, &mut random);
                let (simplex, others) = points.split_at(D + 1);
                let cloud = Cloud::<D>::new(others.as_flattened()).unwrap();
                assert!((0..count).all(|at| others.contains(cloud.point(at))));
                let references: Vec<&[f64; D]> = simplex.iter().collect();
                for i in 0..=D {
                    let plane = Plane::of_facet(&references, i);
                    for plane in [plane, plane.turned()] {
                        let exists = others.iter().any(|point| plane.has_beyond(point));
                        for found in [cloud.first_beyond(&plane), cloud.far_beyond(&plane)] {
                            assert_eq!(found.is_some(), exists, "{family:?}");
                            assert!(found.is_none_or(|at| plane.has_beyond(cloud.point(at))));
                        }
                        seen[usize::from(exists)] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|&count| count > 10), "{seen:?}");
        }
        check::<2>();
        check::<3>();
        check::<5>();
    }
}
