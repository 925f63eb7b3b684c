//! Faces and filtrations of a result, from its arrays alone.
//!
//! | | |
//! |---|---|
//! | [`Faces`] | all faces of the simplices, each once, with boundary and coboundary |
//! | [`alpha`] | the alpha value of each face of a Delaunay triangulation |
//! | [`distances`] | the filtration of a mesh by the distance to its inputs |
//! | [`AlphaShape`] | the faces up to an alpha value, and their topology |
//!
//! docs/topology.md has definitions and proofs.

mod alpha;
#[cfg(test)]
mod ball_tests;
mod circumscribed;
mod components;
mod distance;
mod exact;
mod faces;
mod keys;
mod radius;
mod reach;
#[cfg(test)]
mod reach_tests;
mod shape;
#[cfg(test)]
mod shape_tests;
#[cfg(test)]
mod tests;

pub use alpha::{Filtration, Numbers, alpha, has_inputs_alone};
pub use distance::distances;
pub use faces::{Faces, Level};
pub use shape::{AlphaShape, FaceClass, Topology, connecting_alpha, optimal_alpha};
