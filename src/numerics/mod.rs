//! Exact signs of determinants of points with f64 coordinates, circumcentres with rigorous error
//! bounds, and lengths that neither overflow nor underflow. Knows no mesh.
//!
//! Everything is generic in the dimension `D`, 2 to 8 (checked at compile time), and expects finite
//! coordinates; the whole finite range counts, subnormals and 1e308 included. A simplex is a slice
//! of `D + 1` points. Signs are exact: a filter in f64 decides nearly all of them, integers of
//! a fixed size decide the rest, without an allocation.

mod affine;
mod circumball;
mod cramer;
mod determinant;
mod edges;
mod exact;
mod in_ball;
mod integer;
mod length;
mod natural;
mod orientation;
mod pair;
mod power;
mod residues;
mod sign;
mod solve;
mod wide;

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod timing;

pub use affine::{AffineBasis, affine_basis};
pub use circumball::Circumball;
pub(crate) use edges::{Column, Edges};
pub use exact::{ScaledCenter, circumcenter_exact, in_ball_exact, orientation_exact};
pub use in_ball::in_ball;
pub use length::{distance, norm, shortest_distance};
pub use orientation::{orientation, orientation_filtered};
pub use sign::Sign;

/// As many dimensions as all in here know.
const MAX_DIM: usize = 8;

/// The most rows or columns of a matrix.
const MAX_SIZE: usize = MAX_DIM + 1;
