//! Exact signs of determinants of points with f64 coordinates, circumcentres with rigorous error
//! bounds, and lengths that neither overflow nor underflow. Knows no mesh.
//!
//! Everything is generic in the dimension `D`, 2 to 8 (checked at compile time), and expects finite
//! coordinates; the whole finite range counts, subnormals and 1e308 included. A simplex is a slice
//! of `D + 1` points.
//!
//! ```text
//!   orientation, in_ball, Circumball::side, affine_basis
//!        |
//!        v
//!   filters   f64 with a bound of the error: decides nearly all signs in nanoseconds;
//!        |    then two f64 for one number: decides all but true ties and near ones
//!        |  undecided
//!        v
//!   exact     integers of a fixed size: decides the rest, without an allocation
//!
//!   lengths   distances at every scale, for callers and for filters
//! ```
//!
//! Beside the groups: `segment`, exact tests and nearest points of a segment, made of filters and
//! exact integers.
//!
//! Shared by several groups are `sign`, `power` (scaling without rounding) and `laplace` (the
//! expansion of a determinant over any ring); `random` has pseudo-random numbers and hashes. A
//! group uses another one only through its front page, and `exact` uses no other group.

mod affine;
mod double_double;
mod exact;
mod filters;
mod laplace;
mod lengths;
mod power;
mod random;
mod segment;
mod sign;
mod volume;

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod timing;

pub use affine::{AffineBasis, affine_basis};
pub(crate) use double_double::DoubleDouble;
pub(crate) use exact::{Column, Edges};
pub(crate) use exact::{Lines, compare_crossings, compare_to_crossing, crossing};
pub use exact::{ScaledCenter, circumcenter_exact, in_ball_exact, orientation_exact};
pub use filters::{Circumball, RoundedBall, in_ball, in_ball_with_care};
pub(crate) use filters::{F64x2, Hyperplane, Real};
pub use filters::{orientation, orientation_filtered};
pub use lengths::{
    cross, distance, distance_to_edge, distance_to_line, distance_to_triangle, dot, foot_on_line,
    norm, scale_of_differences, scale_of_products, shortest_distance,
};
pub(crate) use power::scale_by_power;
pub use random::{SplitMix, mixed, random_numbers};
pub use segment::{in_diametral_ball, offset_from_line, point_at_level, point_between};
pub use sign::Sign;
pub(crate) use volume::scaled_determinant;
pub use volume::volume;

/// Largest dimension that the module supports.
const MAX_DIM: usize = 8;

/// Largest number of rows or columns of a matrix.
const MAX_SIZE: usize = MAX_DIM + 1;

/// Returns point `at` of a flat array.
#[inline]
pub(crate) fn coordinates<const D: usize>(points: &[f64], at: usize) -> &[f64; D] {
    points[at * D..][..D].try_into().expect("D coordinates")
}
