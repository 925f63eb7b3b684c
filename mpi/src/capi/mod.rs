//! The C ABI: what `include/netmesh_mpi.h` declares, made from this module by cbindgen, but for
//! `nm_mpi_run`, which only C can declare. The documentation of the items is the C programmer's
//! manual.
//!
//! Every function relies on what the header asks of its callers, and on nothing else, as in the
//! core's ABI.

// The header's general rules stand for a `# Safety` section at every function.
#![allow(clippy::missing_safety_doc)]
#![warn(clippy::undocumented_unsafe_blocks, unsafe_op_in_unsafe_fn)]

mod structs;

// In the header's order, which a blank line each keeps.
mod run;

mod getters;

mod validate;

mod export;

pub use export::{nm_mpi_export, nm_mpi_format};
pub use getters::{
    nm_mpi_get_counts, nm_mpi_get_domains, nm_mpi_get_ghost_ids, nm_mpi_get_ghost_owners,
    nm_mpi_get_ghosts, nm_mpi_get_interface, nm_mpi_get_neighbors, nm_mpi_get_points,
    nm_mpi_get_simplices, nm_mpi_get_vertex_domains, nm_mpi_get_vertex_ids,
    nm_mpi_get_vertex_kinds, nm_mpi_get_vertex_owners,
};
pub use run::{netmesh_mpi_run, nm_mpi_last_error, nm_mpi_mesh, nm_mpi_mesh_free};
pub use structs::{nm_mpi_counts, nm_mpi_domain, nm_mpi_facet, nm_mpi_report};
pub use validate::nm_mpi_validate;
