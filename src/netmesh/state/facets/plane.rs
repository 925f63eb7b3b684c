//! The plane of a facet. In the projection that drops the coordinate of the largest component of
//! the normal, a plane is that coordinate as a linear function of the two others, whose slopes are
//! at most one. So a point is put on the plane by one rounding, and stays where it is in the
//! projection; on a plane that is parallel to two axes it is exact.

use crate::numerics::{DoubleDouble, Sign, orientation};

/// A point is on a plane if it is no farther from it than this, in units in the last place.
const NEAR: f64 = 4.0;

/// Plane through a facet's vertices, with the projection in which its triangles are told apart.
#[derive(Clone, Copy, Debug)]
pub(in crate::netmesh) struct Plane {
    origin: [f64; 3],
    /// Axes of the projection, ordered so that triangles of the facet are counterclockwise there.
    axes: [usize; 2],
    dropped: usize,
    /// Change of the dropped coordinate along the axes of the projection.
    slopes: [DoubleDouble; 2],
}

/// Returns the power of two that is no larger than `x`, but in a range whose inverses are normal.
pub(in crate::netmesh) fn power_below(x: f64) -> f64 {
    const RANGE: std::ops::RangeInclusive<u64> = 4..=2042;
    let exponent = (x.to_bits() >> 52 & 0x7ff).clamp(*RANGE.start(), *RANGE.end());
    f64::from_bits(exponent << 52)
}

impl Plane {
    /// Returns the plane with the sum of the normals of `triangles`, through the lowest of their
    /// vertices by x, y and z. That is a corner of the facet, and no input beside it that the
    /// triangles go through.
    pub fn of(triangles: &[[[f64; 3]; 3]]) -> Self {
        let lower = |x: [f64; 3], y: [f64; 3]| if y < x { y } else { x };
        let origin = triangles.iter().flatten().copied().fold(triangles[0][0], lower);
        let normal = normal_of(triangles, &origin);
        let size = |k: usize| normal[k].high.abs();
        let dropped = (1..3).fold(0, |best, k| if size(k) > size(best) { k } else { best });
        let mut axes = [(dropped + 1) % 3, (dropped + 2) % 3];
        if normal[dropped].high < 0.0 {
            axes.swap(0, 1);
        }
        Self { origin, axes, dropped, slopes: slopes(&normal, dropped, axes) }
    }

    /// Returns the plane of one of the triangles that this is the plane of, in the same projection.
    pub fn of_part(&self, triangle: &[[f64; 3]; 3]) -> Self {
        let origin = triangle[0];
        let normal = normal_of(&[*triangle], &origin);
        Self { origin, slopes: slopes(&normal, self.dropped, self.axes), ..*self }
    }

    /// Returns where a point is in the projection.
    pub fn image(&self, x: &[f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| x[axis])
    }

    /// Returns the point of the plane that is at `x` in the projection, rounded.
    pub fn at(&self, x: &[f64; 3]) -> [f64; 3] {
        let ways = self.axes.map(|axis| DoubleDouble::difference(x[axis], self.origin[axis]));
        let power = power_below(ways.iter().fold(0.0, |most: f64, way| most.max(way.high.abs())));
        let scaled = |way: DoubleDouble| way.scaled(1.0 / power);
        let rise = self.slopes[0] * scaled(ways[0]) + self.slopes[1] * scaled(ways[1]);
        let rise = rise.scaled(power);
        let mut on = *x;
        let height = DoubleDouble { high: self.origin[self.dropped], low: 0.0 } + rise;
        on[self.dropped] = height.high;
        on
    }

    /// Returns a normal, about which triangles of the facet are counterclockwise. Its largest
    /// component is 1 or -1.
    pub fn normal(&self) -> [f64; 3] {
        let [u, v] = self.axes;
        let sign = if (u + 1) % 3 == v { 1.0 } else { -1.0 };
        let mut normal = [0.0; 3];
        normal[self.dropped] = sign;
        for (axis, slope) in self.axes.into_iter().zip(self.slopes) {
            normal[axis] = -sign * slope.high;
        }
        normal
    }

    /// Returns the point of the plane that is nearest to `x`, rounded.
    pub fn foot(&self, x: &[f64; 3]) -> [f64; 3] {
        let height = self.height(x);
        let slopes = self.slopes.map(|slope| slope.high);
        // The normal is (-slopes, 1).
        let part = height / (1.0 + slopes[0] * slopes[0] + slopes[1] * slopes[1]);
        let mut foot = *x;
        for (axis, slope) in self.axes.into_iter().zip(slopes) {
            foot[axis] += part * slope;
        }
        self.at(&foot)
    }

    /// Returns the height of `x` above the plane, along the axis that the projection drops.
    pub fn height(&self, x: &[f64; 3]) -> f64 {
        x[self.dropped] - self.at(x)[self.dropped]
    }

    /// Returns true if `x` is on the plane within roundings.
    pub fn is_near(&self, x: &[f64; 3]) -> bool {
        let largest = x.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        self.height(x).abs() <= NEAR * (largest.next_up() - largest)
    }

    /// Returns the sign of the area of a triangle in the projection: positive for those of the
    /// facet.
    pub fn turn(&self, triangle: [&[f64; 3]; 3]) -> Sign {
        let flat = triangle.map(|x| self.image(x));
        orientation(&[&flat[0], &flat[1], &flat[2]])
    }
}

/// Returns the sum of the normals of triangles, divided by a power of two, which depends on how far
/// they reach from `origin`.
fn normal_of(triangles: &[[[f64; 3]; 3]], origin: &[f64; 3]) -> [DoubleDouble; 3] {
    let reach = triangles.iter().flatten().flat_map(|x| (0..3).map(|k| (x[k] - origin[k]).abs()));
    let power = power_below(reach.fold(0.0, f64::max));
    let mut normal = [DoubleDouble::ZERO; 3];
    for [a, b, c] in triangles {
        let way = |to: &[f64; 3]| -> [DoubleDouble; 3] {
            std::array::from_fn(|k| DoubleDouble::difference(to[k] / power, a[k] / power))
        };
        let (u, v) = (way(b), way(c));
        normal = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            normal[k] + (u[i] * v[j] - u[j] * v[i])
        });
    }
    normal
}

/// Returns the changes of the dropped coordinate along the axes of a projection.
fn slopes(normal: &[DoubleDouble; 3], dropped: usize, axes: [usize; 2]) -> [DoubleDouble; 2] {
    axes.map(|axis| match normal[dropped].high == 0.0 {
        true => DoubleDouble::ZERO,
        false => -(normal[axis] / normal[dropped]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::cross;

    const FACES: [[usize; 3]; 4] = [[0, 1, 2], [1, 2, 0], [2, 1, 0], [0, 2, 1]];

    #[test]
    fn triangles_are_counterclockwise_about_the_normal() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.25, -2.0], [0.5, -3.0, 0.125]];
        for turn in 0..3 {
            for order in [[0, 1, 2], [0, 2, 1]] {
                let turned = |x: [f64; 3]| [0, 1, 2].map(|k: usize| x[(k + turn) % 3]);
                let [a, b, c] = order.map(|at: usize| turned(points[at]));
                let exact = cross(&b, &c);
                let largest = exact.iter().fold(0.0f64, |most, x| most.max(x.abs()));
                let normal = Plane::of(&[[a, b, c]]).normal();
                for (x, y) in normal.iter().zip(exact) {
                    assert!((x - y / largest).abs() < 1e-15, "{normal:?} {exact:?}");
                }
            }
        }
    }

    #[test]
    fn points_of_axis_parallel_planes_are_exact() {
        for (axis, height) in [(0, 0.1), (1, -3e-300), (2, 1e300)] {
            let at = |u: f64, v: f64| {
                let mut x = [height; 3];
                (x[(axis + 1) % 3], x[(axis + 2) % 3]) = (u, v);
                x
            };
            let triangle = [at(0.0, 0.0), at(1.0, 0.1), at(0.3, 1.0)];
            let plane = Plane::of(&[triangle]);
            assert_eq!(plane.at(&at(0.7, 0.3)), at(0.7, 0.3));
            let [a, b, c] = &triangle;
            assert!(plane.turn([a, b, c]).is_positive() && !plane.turn([a, c, b]).is_positive());
        }
    }

    #[test]
    fn points_of_tilted_planes_are_rounded_once() {
        for face in FACES {
            let place = |x: f64, y: f64| {
                let z = 0.25 * x + 0.5 * y + 1.0;
                let mut all = [0.0; 3];
                (all[face[0]], all[face[1]], all[face[2]]) = (x, y, z);
                all
            };
            let triangles = [[place(0.0, 0.0), place(1.0, 0.0), place(0.0, 3.0)]];
            let plane = Plane::of(&triangles);
            for (x, y) in [(0.25, 0.75), (0.1, 0.7), (1e-9, 0.3)] {
                assert_eq!(plane.at(&place(x, y)), place(x, y), "{face:?} {x} {y}");
            }
        }
    }

    #[test]
    fn feet_are_at_a_right_angle() {
        for face in FACES {
            // The plane z = x / 2 - y / 4, and points of it moved along its normal.
            let place = |x: f64, y: f64, height: f64| {
                let mut all = [0.0; 3];
                let moved = [x - 0.5 * height, y + 0.25 * height, 0.5 * x - 0.25 * y + height];
                face.into_iter().zip(moved).for_each(|(axis, x)| all[axis] = x);
                all
            };
            let plane =
                Plane::of(&[[place(0.0, 0.0, 0.0), place(1.0, 0.0, 0.0), place(0.0, 3.0, 0.0)]]);
            for (x, y, height) in [(0.25, 0.75, 1.0), (-1.5, 4.0, -2.0), (1.0, 2.0, 0.0)] {
                assert_eq!(plane.foot(&place(x, y, height)), place(x, y, 0.0), "{face:?} {height}");
            }
        }
    }
}
