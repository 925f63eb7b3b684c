//! Directions in space, in doubles: for questions that roundings do not matter to.

use crate::quality::length::Offset;

pub(super) type Vector = [f64; 3];

/// Returns the direction from a point to another, with its largest component in \[1, 2).
pub(super) fn direction(from: &[f64; 3], to: &[f64; 3]) -> Vector {
    Offset::between(to, from).vector
}

/// Returns the scalar product.
pub(super) fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Returns the vector product.
pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns the cosine of the angle between two directions.
pub(super) fn cosine(a: &Vector, b: &Vector) -> f64 {
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

/// Returns the sine of half the angle between two directions: it tells small angles that have one
/// cosine.
pub(super) fn sine_of_half(a: &Vector, b: &Vector) -> f64 {
    let [a, b] = [a, b].map(|own| own.map(|x| x / dot(own, own).sqrt()));
    let difference = [0, 1, 2].map(|axis| a[axis] - b[axis]);
    0.5 * dot(&difference, &difference).sqrt()
}

/// Returns the part of `vector` across `along`.
pub(super) fn across(vector: Vector, along: Vector) -> Vector {
    let share = dot(&vector, &along) / dot(&along, &along);
    [0, 1, 2].map(|axis| vector[axis] - share * along[axis])
}
