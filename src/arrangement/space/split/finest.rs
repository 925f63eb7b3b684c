//! Places of corners, with each coordinate from the piece that has it with the smaller roundings.
//!
//! A place that is computed on one piece has the roundings of its coordinates. The other piece may
//! have far smaller ones, or be in a plane of an axis, and has no room for them then.

use super::super::bends::{normal, normalized};
use super::super::meet::{Face, corner, vertices_of_face};
use crate::nearest::{Bounds, bounds_of};
use crate::numerics::{cross, dot, scale_by_power, scale_of_products, scaled_determinant};
use std::array::from_fn;

/// Factor by which coordinates must be smaller for a place to be computed from them: near to each
/// other, places are where they are computed first.
const FINER: f64 = 8.0;

/// Largest distance along an axis of a place from the point that it stands for, in the coarsest
/// unit in the last place: roundings explain more only where planes are at small angles.
const FARTHEST: f64 = 256.0;

/// Returns the corner of what two pieces share, but for roundings. It is in the interior of an edge
/// of one, and of an edge or the triangle of the other.
pub(super) fn corner_of(points: &[[f64; 3]], vertices: [&[u32]; 2], faces: [Face; 2]) -> [f64; 3] {
    let first = corner(points, vertices, faces);
    let [one, other] = [0, 1].map(|which| vertices_of_face(vertices[which], faces[which]));
    match faces.map(Face::count_ones) {
        [2, 3] => finest(points, [one, other], first, || in_triangle(points, vertices, faces)),
        [3, 2] => finest(points, [other, one], first, || in_triangle(points, vertices, faces)),
        _ => finest(points, [one, other], first, || {
            corner(points, [vertices[1], vertices[0]], [faces[1], faces[0]])
        }),
    }
}

/// Returns the place of a corner, given as it is computed on the first of two faces and on the
/// second: the first one, with the coordinates of the second where those are finer.
pub(super) fn finest(
    points: &[[f64; 3]],
    faces: [impl IntoIterator<Item = u32>; 2],
    mut first: [f64; 3],
    second: impl FnOnce() -> [f64; 3],
) -> [f64; 3] {
    let bounds = faces.map(|face| bounds_of(face.into_iter().map(|at| &points[at as usize])));
    let is_second = [0, 1, 2].map(|k| is_finer(&bounds, k));
    if is_second.contains(&true) {
        let second = second();
        (0..3).filter(|&k| is_second[k]).for_each(|k| first[k] = second[k]);
    }
    first
}

/// Returns true if the second of two faces has finer coordinates along an axis: far smaller ones,
/// or only one.
fn is_finer([one, other]: &[Bounds; 2], k: usize) -> bool {
    let largest = |[low, high]: &Bounds| low[k].abs().max(high[k].abs());
    let is_flat = |[low, high]: &Bounds| low[k] == high[k];
    !is_flat(one) && (is_flat(other) || FINER * largest(other) < largest(one))
}

/// Returns the corner where an edge of one of two pieces crosses the triangle that is the other, as
/// a point of the triangle: with roundings of its coordinates, and exact where these are all the
/// same.
fn in_triangle(points: &[[f64; 3]], both: [&[u32]; 2], faces: [Face; 2]) -> [f64; 3] {
    let edge = usize::from(faces[0].count_ones() != 2);
    let ends = vertices_of_face(both[edge], faces[edge]).map(|vertex| &points[vertex as usize]);
    let corners = both[1 - edge].iter().map(|&vertex| &points[vertex as usize]);
    let [low, high] = bounds_of(corners.clone());
    let volume = |left_out: usize| {
        let others = corners.clone().enumerate().filter(|(at, _)| *at != left_out);
        let mut all = ends.clone().chain(others.map(|(_, x)| x));
        let simplex: [&[f64; 3]; 4] = from_fn(|_| all.next().unwrap_or(&low));
        scaled_determinant(&simplex)
    };
    let weights = normalized([0, 1, 2].map(volume)).0.map(f64::abs);
    let sum: f64 = weights.iter().sum();
    from_fn(|k| {
        let scale = scale_of_products([low[k], high[k]]);
        let parts = corners.clone().zip(weights);
        let x: f64 = parts.map(|(x, weight)| scale * x[k] * (weight / sum)).sum();
        (x / scale).clamp(low[k], high[k])
    })
}

/// Returns the point that the planes of three triangles share, near a place that is off it by
/// roundings of what this was computed from; the place itself if the point is farther off than
/// that, as where planes are at small angles. From wherever it is computed, it is the same one.
///
/// One step of Newton's method leaves no more than its own roundings, since the heights of the
/// place above the planes are exact.
pub(super) fn on_planes(
    points: &[[f64; 3]],
    triangles: [[u32; 3]; 3],
    place: [f64; 3],
    units: &[f64; 3],
) -> [f64; 3] {
    let planes = triangles.map(|own| Plane::of(own.map(|vertex| &points[vertex as usize])));
    let normals = planes.each_ref().map(|plane| plane.normal);
    let unit = units.iter().fold(0.0f64, |most, unit| most.max(*unit));
    let scale = scale_of_products([unit; 2]);
    let heights = planes.each_ref().map(|plane| plane.height(&place, scale));
    let determinant = |rows: [[f64; 3]; 3]| dot(&rows[0], &cross(&rows[1], &rows[2]));
    let whole = determinant(normals);
    // Cramer's rule.
    let step: [f64; 3] = from_fn(|k| {
        let mut replaced = normals;
        replaced.iter_mut().zip(heights).for_each(|(row, height)| row[k] = -height);
        determinant(replaced) / whole
    });
    match step.iter().all(|step| step.abs() <= FARTHEST * (scale * unit)) {
        true => from_fn(|k| place[k] + step[k] / scale),
        false => place,
    }
}

/// Plane of a triangle.
struct Plane<'a> {
    corners: [&'a [f64; 3]; 3],
    /// Normal, divided by 2^`exponent`, with roundings of its components.
    normal: [f64; 3],
    exponent: i64,
}

impl<'a> Plane<'a> {
    fn of(corners: [&'a [f64; 3]; 3]) -> Self {
        let (normal, exponent) = normalized(normal(corners));
        Self { corners, normal, exponent }
    }

    /// Returns the product of the normal and the way from the plane to a point, times a scale, with
    /// a rounding or two of its own.
    fn height(&self, x: &[f64; 3], scale: f64) -> f64 {
        let [a, b, c] = self.corners;
        let (m, exponent) = scaled_determinant(&[a, b, c, x]);
        scale_by_power(scale * m, exponent - self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLES: [[u32; 3]; 3] = [[0, 1, 2], [3, 4, 5], [6, 7, 8]];

    #[test]
    fn the_point_of_three_planes_is_the_same_from_any_place_near_it() {
        // With 2^20 added to x: z = 0, x = 0.25 + 0.5 y and x = 0.75 - 0.5 y.
        let far = |x: f64, y: f64, z: f64| [x + 1048576.0, y, z];
        let points = [
            far(0.0, 0.0, 0.0),
            far(1.0, 0.0, 0.0),
            far(0.0, 1.0, 0.0),
            far(0.25, 0.0, -1.0),
            far(0.25, 0.0, 1.0),
            far(0.75, 1.0, 0.25),
            far(0.75, 0.0, -1.0),
            far(0.75, 0.0, 1.0),
            far(0.25, 1.0, 0.5),
        ];
        let units = [f64::EPSILON * 1048576.0, 1e-16, 1e-16];
        for k in 0..40 {
            let off = |sign: f64| sign * f64::from(k) * units[0];
            let place = far(0.5 + off(1.0), 0.5 + off(-0.7), off(0.3));
            assert_eq!(on_planes(&points, TRIANGLES, place, &units), far(0.5, 0.5, 0.0));
        }
    }

    #[test]
    fn a_place_far_from_the_point_of_planes_at_small_angles_stays() {
        // z = 0 and z = 1e-13 (x - 0.5), which share a line beside the place up to roundings, and
        // x = 0.5 + 1e-3 y, which crosses that line a hundred times farther away.
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.5, 0.0, 0.0],
            [0.5, 1.0, 0.0],
            [1.5, 0.0, 1e-13],
            [0.5, 0.0, 0.0],
            [0.5, 0.0, 1.0],
            [0.501, 1.0, 0.0],
        ];
        let place = [0.5001, 0.1, 0.0];
        assert_eq!(on_planes(&points, TRIANGLES, place, &[1e-16; 3]), place);
    }
}
