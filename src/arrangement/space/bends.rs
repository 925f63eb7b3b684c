//! The angle by which two triangles bend at their common edge.

use super::projection::Projection;
use super::sides::Sides;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::numerics::{
    cross, orientation, scale_by_power, scale_of_differences, scaled_determinant,
};

/// Sine of the largest angle between two triangles that roundings explain.
pub(super) const ROUNDING: f64 = 1e-12;

/// Two triangles that run through a common edge in opposite directions.
#[derive(Clone, Copy)]
pub(super) struct Hinge<'a> {
    /// Ends of the edge, in the direction of the first triangle.
    pub edge: [&'a [f64; 3]; 2],
    /// Third corner of each triangle.
    pub apexes: [&'a [f64; 3]; 2],
}

impl Hinge<'_> {
    /// Returns true if the triangles lie in one plane, on both sides of the edge, up to an angle
    /// whose sine is `sine`, of less than 90 degrees.
    pub fn is_flat(&self, sine: f64) -> bool {
        let ([a, b], [c, d]) = (self.edge, self.apexes);
        if self.is_surely_bent(sine) {
            return false;
        }
        let Some(projection) = Projection::of_triangle([a, b, c]) else { return false };
        let turns = [c, d].map(|apex| projection.turn([a, b, apex]));
        (turns[0] * turns[1]).is_negative()
            && (orientation(&[a, b, c, d]).is_zero() || self.sine() <= sine)
    }

    /// Returns true only if the sine of the angle is more than `sine`, and mostly if it is.
    fn is_surely_bent(&self, sine: f64) -> bool {
        let ([a, b], [c, d]) = (self.edge, self.apexes);
        let way = |x: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|k| x[k] - a[k]) };
        let [u, v, w] = [b, c, d].map(way);
        let size = |x: &[f64; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        let [lu, lv, lw] = [&u, &v, &w].map(size);
        // Products of six lengths neither overflow nor underflow, and roundings are relative.
        let is_ordinary = |length: f64| (1e-40..1e40).contains(&length);
        if ![lu, lv, lw].into_iter().all(is_ordinary) {
            return false;
        }
        let (m, n) = (cross(&u, &v), cross(&u, &w));
        let volume = (m[0] * w[0] + m[1] * w[1] + m[2] * w[2]).abs();
        // Differences have relative errors of a rounding, which products of three lengths bound.
        let slack = 1e-14;
        let largest = (size(&m) + slack * lu * lv) * (size(&n) + slack * lu * lw);
        let least = (volume - slack * lu * lv * lw) * lu;
        least > 1.0001 * sine * largest
    }

    /// Returns the sine of the angle, with a relative error of some units of roundoff.
    fn sine(&self) -> f64 {
        let ([a, b], [c, d]) = (self.edge, self.apexes);
        let volume = scaled_determinant(&[a, b, c, d]);
        let normals = [c, d].map(|apex| scaled_norm(normal([a, b, apex])));
        let scale = scale_of_differences([a, b]);
        let halvings = i64::from(scale < 1.0);
        let edge = scaled_norm([0, 1, 2].map(|k| (scale * b[k] - scale * a[k], halvings)));
        let exponent = volume.1 + edge.1 - normals[0].1 - normals[1].1;
        scale_by_power(volume.0.abs() * edge.0 / (normals[0].0 * normals[1].0), exponent)
    }
}

/// Returns true if the triangles of a polygon bend by no more than an angle in degrees.
pub(super) fn are_flat(
    points: &[[f64; 3]],
    triangles: &[[u32; 3]],
    degrees: f64,
    poll: Poll<'_>,
) -> Result<bool> {
    if degrees <= 0.0 {
        return Ok(false);
    }
    let (sine, sides) = (sine_of(degrees), Sides::of_triangles(triangles, poll)?);
    let point = |vertex: u32| &points[vertex as usize];
    Ok(sides.groups().filter(|group| group.len() == 2).all(|group| {
        let [(edge, c), (_, d)] = [group[0], group[1]].map(|side| side.within(triangles));
        Hinge { edge: edge.map(point), apexes: [c, d].map(point) }.is_flat(sine)
    }))
}

/// Returns the sine of the angle up to which triangles are in one plane, if the caller allows
/// `degrees`.
pub(super) fn sine_of(degrees: f64) -> f64 {
    degrees.min(90.0).to_radians().sin().max(ROUNDING)
}

/// Returns the normal of a triangle, as long as twice its area, each component as `(m, e)`:
/// m * 2^e.
pub(super) fn normal(corners: [&[f64; 3]; 3]) -> [(f64, i64); 3] {
    Projection::ALL.map(|projection| {
        let [a, b, c] = corners.map(|corner| projection.image(corner));
        scaled_determinant(&[&a, &b, &c])
    })
}

/// Returns the length of a vector as `(m, e)`: m * 2^e.
fn scaled_norm(vector: [(f64, i64); 3]) -> (f64, i64) {
    let (unit, exponent) = normalized(vector);
    (unit.iter().map(|x| x * x).sum::<f64>().sqrt(), exponent)
}

/// Returns the components of a vector divided by 2^e, of which the largest is at least about 1, and
/// e.
pub(super) fn normalized(vector: [(f64, i64); 3]) -> ([f64; 3], i64) {
    let place = |&(m, e): &(f64, i64)| e + i64::from(((m.to_bits() >> 52) & 2047) as i32) - 1023;
    let exponent = vector.iter().filter(|(m, _)| *m != 0.0).map(place).max().unwrap_or(0);
    (vector.map(|(m, e)| scale_by_power(m, e - exponent)), exponent)
}
