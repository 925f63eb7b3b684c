//! The plane of a polygon: three of its vertices, and how far the others are from it.

use super::projection::Projection;
use crate::arrangement::reach::{NEAR, unit_in_last_place};
use crate::numerics::{
    affine_basis, distance, norm, orientation, scale_by_power, scale_of_differences,
    scaled_determinant,
};

/// Plane through three vertices of a polygon that are far from each other.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    base: [u32; 3],
    pub projection: Projection,
}

/// Vertex that is off a plane by more than rounding explains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OffPlane {
    pub vertex: u32,
    pub distance: f64,
}

impl Plane {
    /// Returns a plane of vertices; `None` if they are all on one line.
    pub fn of(points: &[[f64; 3]], vertices: &[u32]) -> Option<Self> {
        let point = |vertex: u32| &points[vertex as usize];
        let farthest = |size: &dyn Fn(u32) -> f64| {
            vertices.iter().copied().reduce(|a, b| if size(b) > size(a) { b } else { a })
        };
        let start = *vertices.first()?;
        let a = farthest(&|vertex| distance(point(start), point(vertex)))?;
        let b = farthest(&|vertex| distance(point(a), point(vertex)))?;
        let c = farthest(&|vertex| from_line([point(a), point(b)], point(vertex)))?;
        let of = |base: [u32; 3]| {
            let projection = Projection::of_triangle(base.map(point))?;
            Some(Self { base, projection })
        };
        of([a, b, c]).or_else(|| {
            let basis = affine_basis::<3>(vertices.len(), |at| *point(vertices[at]));
            match basis[..] {
                [a, b, c, ..] => of([a, b, c].map(|at| vertices[at])),
                _ => None,
            }
        })
    }

    /// Returns the three vertices that the plane goes through.
    pub fn base(&self) -> [u32; 3] {
        self.base
    }

    /// Returns the vertex that is farthest from the plane, in units of what rounding explains;
    /// `None` if rounding explains all.
    ///
    /// A vertex is on the plane if boxes about it and about the three vertices of the plane, which
    /// extend by [`NEAR`] units in the last place of the polygon's largest coordinates, have points
    /// in one plane.
    pub fn farthest(&self, points: &[[f64; 3]], vertices: &[u32]) -> Option<OffPlane> {
        let point = |vertex: u32| &points[vertex as usize];
        let [a, b, c] = self.base.map(point);
        let is_off = |x: &[f64; 3]| !orientation(&[a, b, c, x]).is_zero();
        if !vertices.iter().any(|&vertex| is_off(point(vertex))) {
            return None;
        }
        let units = units_of(vertices.iter().map(|&vertex| point(vertex)));
        let gauge = Gauge::new([a, b, c], units);
        let mut worst = (1.0, None);
        for &vertex in vertices.iter().filter(|&&vertex| is_off(point(vertex))) {
            let (excess, distance) = gauge.measure(point(vertex));
            if excess > worst.0 {
                worst = (excess, Some(OffPlane { vertex, distance }));
            }
        }
        worst.1
    }
}

/// Distances from a plane, and what rounding explains of them.
pub(super) struct Gauge<'a> {
    base: [&'a [f64; 3]; 3],
    /// Normal of the plane: twice the projected areas of the base, divided by 2^`exponent`.
    normal: [f64; 3],
    exponent: i64,
    /// Units of the axes, divided by 2^`unit_exponent`.
    units: [f64; 3],
    unit_exponent: i64,
    raw_units: [f64; 3],
}

impl<'a> Gauge<'a> {
    /// Makes the gauge of a plane through three points, with units in the last place by axis.
    pub fn new(base: [&'a [f64; 3]; 3], units: [f64; 3]) -> Self {
        let areas = Projection::ALL.map(|projection| area(projection, base));
        let exponents = areas.iter().filter(|(m, _)| *m != 0.0).map(|&(_, exponent)| exponent);
        let exponent = exponents.max().unwrap_or(0);
        let unit = units.iter().fold(0.0f64, |largest, &unit| largest.max(unit));
        let unit_exponent = i64::from(((unit.to_bits() >> 52) as i32).max(1) - 1023);
        Self {
            base,
            normal: areas.map(|(m, e)| scale_by_power(m, e - exponent)),
            exponent,
            units: units.map(|unit| scale_by_power(unit, -unit_exponent)),
            unit_exponent,
            raw_units: units,
        }
    }

    /// Returns false only if no point of a box is near the plane. Where numbers overflow,
    /// comparisons with NaN leave it true.
    pub fn may_meet(&self, [low, high]: [&[f64; 3]; 2]) -> bool {
        const ROUNDINGS: f64 = 1e-12;
        let (mut value, mut reach) = (0.0, 0.0);
        for k in 0..3 {
            let middle = (0.5 * low[k] + 0.5 * high[k]) - self.base[0][k];
            let half = 0.5 * high[k] - 0.5 * low[k];
            value += self.normal[k] * middle;
            let margin = ROUNDINGS * middle.abs() + 64.0 * self.raw_units[k];
            reach += self.normal[k].abs() * (half + margin);
        }
        let is_apart = value.abs() > reach;
        !is_apart
    }

    /// Returns a number that grows with the height of a point above the plane, but for roundings.
    pub fn height(&self, x: &[f64; 3]) -> f64 {
        let base = self.base[0];
        let scale = scale_of_differences([base, x]);
        let sum: f64 = (0..3).map(|k| self.normal[k] * (scale * x[k] - scale * base[k])).sum();
        sum / scale
    }

    /// Returns the distance of a point from the plane, first in what rounding explains at most, and
    /// then as a length.
    pub fn measure(&self, x: &[f64; 3]) -> (f64, f64) {
        let [a, b, c] = self.base;
        let (volume, exponent) = scaled_determinant(&[a, b, c, x]);
        let volume = |shift: i64| scale_by_power(volume.abs(), exponent - self.exponent - shift);
        let explained: f64 = (0..3).map(|k| NEAR * self.normal[k].abs() * self.units[k]).sum();
        let excess = volume(self.unit_exponent) / (explained * (1.0 + self.weights(x)));
        (excess, volume(0) / norm(&self.normal))
    }

    /// Returns the sum of the magnitudes of a point's barycentric coordinates in the base,
    /// projected along the longest component of the normal.
    fn weights(&self, x: &[f64; 3]) -> f64 {
        let longest = |a: usize, b: usize| self.normal[b].abs() > self.normal[a].abs();
        let axis = (1..3).fold(0, |axis, k| if longest(axis, k) { k } else { axis });
        let projection = Projection::ALL[axis];
        let [a, b, c] = self.base;
        let whole = self.normal[axis].abs();
        [[x, b, c], [a, x, c], [a, b, x]]
            .map(|corners| {
                let (m, e) = area(projection, corners);
                scale_by_power(m.abs(), e - self.exponent) / whole
            })
            .iter()
            .sum()
    }
}

/// Returns for each axis the unit in the last place of the largest coordinate of points.
pub(super) fn units_of<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> [f64; 3] {
    let larger =
        |largest: [f64; 3], x: &[f64; 3]| std::array::from_fn(|k| largest[k].max(x[k].abs()));
    points.fold([0.0; 3], larger).map(unit_in_last_place)
}

/// Returns twice the area of a projected triangle as `(m, e)`: m * 2^e.
fn area(projection: Projection, corners: [&[f64; 3]; 3]) -> (f64, i64) {
    let [a, b, c] = corners.map(|corner| projection.image(corner));
    scaled_determinant(&[&a, &b, &c])
}

/// Returns a number that grows with the distance of a point from a line, but for roundings.
pub(super) fn from_line([a, b]: [&[f64; 3]; 2], x: &[f64; 3]) -> f64 {
    let scale = scale_of_differences([a, b, x]);
    let way: [f64; 3] = std::array::from_fn(|k| scale * b[k] - scale * a[k]);
    let longest = way.iter().fold(0.0f64, |longest, step| longest.max(step.abs()));
    let u = way.map(|step| step / longest);
    let v: [f64; 3] = std::array::from_fn(|k| (scale * x[k] - scale * a[k]) / longest);
    let cross = |k: usize| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    norm(&[cross(0), cross(1), cross(2)])
}
