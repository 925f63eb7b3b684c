//! Projections of space along an axis, which are exact: they drop a coordinate.

use crate::numerics::{Sign, cross, dot, norm, orientation, scale_of_differences};

/// Projection along an axis. Triangles that turn counterclockwise in it have a normal with a
/// positive component on this axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Projection {
    axis: usize,
}

impl Projection {
    /// Projections along all axes.
    pub const ALL: [Self; 3] = [Self { axis: 0 }, Self { axis: 1 }, Self { axis: 2 }];

    /// Returns the projection of a triangle in which it is largest, but for roundings; `None` if it
    /// has no area.
    pub fn of_triangle(corners: [&[f64; 3]; 3]) -> Option<Self> {
        let normal = normal(corners);
        let mut all = Self::ALL;
        // Of equal components the one on the last axis is the first.
        all.sort_unstable_by(|a, b| {
            let by_size = normal[b.axis].abs().total_cmp(&normal[a.axis].abs());
            by_size.then(b.axis.cmp(&a.axis))
        });
        all.into_iter().find(|projection| !projection.turn(corners).is_zero())
    }

    /// Returns the projections along all axes, sorted by the area of the largest of some loops in
    /// them, but for roundings: the one with the largest area first.
    pub fn by_area<'a>(
        points: &[[f64; 3]],
        loops: impl Iterator<Item = &'a [u32]> + Clone,
        vertex: impl Fn(u32) -> u32,
    ) -> [Self; 3] {
        let point = |&input: &u32| &points[vertex(input) as usize];
        let of_all = || loops.clone().flatten().map(point);
        let origin = of_all().next().unwrap_or(&[0.0; 3]);
        let scale = scale_of_differences(of_all());
        let way = |x: &[f64; 3]| -> [f64; 3] {
            std::array::from_fn(|k| scale * x[k] - scale * origin[k])
        };
        let longest = of_all().flat_map(&way).fold(0.0f64, |longest, x| longest.max(x.abs()));
        let mut largest = [0.0; 3];
        for own in loops.clone() {
            let mut area = [0.0; 3];
            for (from, to) in own.iter().zip(own.iter().cycle().skip(1)) {
                let [u, v] = [from, to].map(|end| way(point(end)).map(|x| x / longest));
                let part = cross(&u, &v);
                area = std::array::from_fn(|k| area[k] + part[k]);
            }
            if norm(&area) > norm(&largest) {
                largest = area;
            }
        }
        let mut all = Self::ALL;
        all.sort_unstable_by(|a, b| {
            let by_size = largest[b.axis].abs().total_cmp(&largest[a.axis].abs());
            by_size.then(a.axis.cmp(&b.axis))
        });
        all
    }

    /// Returns the image of a point.
    #[inline]
    pub fn image(self, x: &[f64; 3]) -> [f64; 2] {
        [x[(self.axis + 1) % 3], x[(self.axis + 2) % 3]]
    }

    /// Returns the sign of the area of a projected triangle, exactly: positive if it turns
    /// counterclockwise.
    pub fn turn(self, corners: [&[f64; 3]; 3]) -> Sign {
        let images = corners.map(|corner| self.image(corner));
        let [a, b, c] = images.each_ref();
        orientation(&[a, b, c])
    }
}

/// Returns a normal of a triangle, of any length, but for roundings; zeros where doubles cannot
/// tell it.
pub(super) fn normal([a, b, c]: [&[f64; 3]; 3]) -> [f64; 3] {
    let scale = scale_of_differences([a, b, c]);
    let [u, v] = [b, c].map(|end| {
        let way: [f64; 3] = std::array::from_fn(|k| scale * end[k] - scale * a[k]);
        let longest = way.iter().fold(0.0f64, |longest, step| longest.max(step.abs()));
        way.map(|step| if longest > 0.0 { step / longest } else { 0.0 })
    });
    cross(&u, &v)
}

/// Returns the tangent of half of the angle between two normals, but for roundings; 0 if they have
/// one direction, no number if one of them has none.
pub(super) fn tangent_of_half([u, v]: [&[f64; 3]; 2]) -> f64 {
    let (sine, cosine) = (norm(&cross(u, v)), dot(u, v));
    sine / (norm(&[sine, cosine]) + cosine)
}
