//! Questions to a result, from its arrays alone: which simplex holds a point, which vertex is the
//! nearest, what a function given at the vertices is elsewhere.
//!
//! Signs and the order of distances are exact. An answer depends on neither the order of the points
//! nor the number of threads. Points may come in any order: they are sorted inside.
//!
//! The C functions that belong here, by the names of the functions of [`Index`]:
//!
//! ```c
//! nm_status nm_mesh_locate(const nm_mesh *mesh, uint64_t count, const double *points,
//!                          uint32_t threads, uint32_t *simplices);
//! nm_status nm_mesh_nearest(const nm_mesh *mesh, uint64_t count, const double *points,
//!                           uint32_t threads, uint32_t *vertices, double *distances);
//! nm_status nm_mesh_interpolate(const nm_mesh *mesh, nm_interpolation interpolation,
//!                               uint32_t components, const double *values, uint64_t count,
//!                               const double *points, uint32_t threads, double *out);
//! nm_status nm_mesh_extend_values(const nm_mesh *mesh, uint32_t components,
//!                                 const double *input_values, double *vertex_values);
//! ```

mod barycentric;
mod boxes;
mod cubic;
pub(crate) mod dual;
mod extend;
mod gradients;
mod index;
mod interpolate;
mod locate;
mod marked_ids;
mod natural;
mod point_index;
mod questions;
#[cfg(test)]
mod tests;
mod tetrahedron;
pub(crate) mod threads;
mod triangles;
pub(crate) mod unit;
pub(crate) mod view;
mod weigh;

pub use crate::nearest::Stop;
pub use boxes::SimplexBoxes;
pub use cubic::Cubics;
pub(crate) use extend::check_extension;
pub use extend::extend_values;
pub use gradients::{Convergence, estimate_gradients};
pub(crate) use index::check_arrays;
pub use index::{Among, Index};
pub use interpolate::{Interpolation, Method, Outside, Values};
pub use locate::Place;
pub use point_index::PointIndex;
pub use threads::Work;
pub use triangles::Triangles;
