//! Lengths that neither overflow nor underflow on the way, whatever the scale of the coordinates.
//!
//! Squares of ordinary lengths are compared as they are. Others are scaled by a power of two first,
//! or compared as lengths. A measure may enter if it holds its relative error from 2^-1074 to
//! `f64::MAX`.

mod norm;
mod shortest;
mod triangle;

pub(super) use norm::largest_magnitude;
pub use norm::{distance, norm, scale_of_differences, scale_of_products};
pub use shortest::shortest_distance;
pub use triangle::{
    cross, distance_to_edge, distance_to_line, distance_to_triangle, dot, foot_on_line,
};
