//! netmesh: conforming quality Delaunay meshes of points in any fixed dimension, of linear size in
//! O(n log n) time whatever the spread (NETMESH, "Beating the Spread: Time-Optimal Point Meshing").
//!
//! This crate, as all Rust code, assumes the default floating-point environment: rounding to
//! nearest, subnormal numbers, no traps. A program that has another one, for instance because a
//! shared object in it sets flush-to-zero, must restore the default before it calls. The C ABI and
//! the Python package do so themselves.

#![deny(unsafe_code)]

pub(crate) mod arrangement;
pub mod arrays;
pub mod distributed;
pub mod error;
pub mod io;
pub(crate) mod memory;
pub mod mesh;
pub(crate) mod nearest;
pub(crate) mod netmesh;
pub mod numerics;
pub mod options;
pub mod parameters;
pub mod prepared;
pub mod quality;
pub mod query;
mod run;
mod sizes;
pub mod surface;
pub(crate) mod threads;
pub mod topology;
pub mod validate;

#[allow(unsafe_code)]
pub mod capi;
pub(crate) mod complex;
pub(crate) mod delaunay;

pub use error::{Error, ErrorKind, Result};
pub use mesh::{
    Arrangement, Attribute, Diagnosis, Domain, EdgeFault, FacetTriangulation, Facets, Feature,
    HoleFilling, Inputs, Intersection, IntersectionKind, LeftOut, Mesh, NONE, Region, Segments,
    Stats, Subsegment, Triangulation, VertexKind,
};
pub use nearest::{merge_points, representatives};
pub use options::{
    Algorithm, Criterion, Crossings, Extent, GivesWay, Interior, Labels, NetOrdering, Options,
    Output, Phase, Progress, ProgressFn,
};
pub use parameters::Parameters;
