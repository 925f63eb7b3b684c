//! The C ABI: what `include/netmesh.h` declares, generated from this module by cbindgen. The
//! documentation of the items here is the C programmer's manual, so it speaks C.
//!
//! This is the only module with `unsafe`. What every function relies on is what the header asks of
//! its callers: a pointer is NULL or points to as much as the manual says, a handle came from a
//! create function and was not freed. Everything else is checked: `memory` holds the raw reads and
//! writes, `handle` the lock and the barrier that every entry goes through, `environment` the
//! floating-point environment that this sets, `error` the thread's last message.

// The header's general rules stand for a `# Safety` section at every function.
#![allow(clippy::missing_safety_doc)]
#![warn(clippy::undocumented_unsafe_blocks, unsafe_op_in_unsafe_fn)]

mod environment;
mod handle;
mod memory;
mod merging;
pub mod shared;
mod structs;
#[cfg(test)]
mod test_support;

// In the header's order, which a blank line each keeps.
mod version;

mod enums;

mod error;

mod create;

mod options;

mod run;
mod sizes;

mod getters;

mod queries;

mod arrays;

mod decode;
mod voronoi;
mod words;

mod topology;

mod alpha_shapes;

mod surfaces;

#[cfg(test)]
mod alpha_shape_tests;
#[cfg(test)]
mod array_tests;
#[cfg(test)]
mod surface_tests;
#[cfg(test)]
mod topology_tests;

mod attributes;

mod boundary;

mod facets;

mod holes;

mod triangulation;

mod diagnosis;

mod measures;

mod histogram;

mod export;

pub use alpha_shapes::{
    nm_export_alpha_shape, nm_mesh_alpha_shape, nm_mesh_connecting_alpha,
    nm_mesh_get_alpha_shape_boundary, nm_mesh_get_alpha_shape_classes, nm_mesh_optimal_alpha,
};
pub use arrays::{
    nm_mesh_get_circumcenters, nm_mesh_get_circumradii, nm_mesh_get_edges,
    nm_mesh_get_facet_simplices, nm_mesh_get_facets, nm_mesh_get_hull, nm_mesh_get_hull_simplices,
    nm_mesh_get_placements, nm_mesh_get_selected, nm_mesh_get_vertex_neighbor_starts,
    nm_mesh_get_vertex_neighbors, nm_mesh_get_vertex_simplex_starts, nm_mesh_get_vertex_simplices,
    nm_mesh_get_volumes,
};
pub use attributes::{
    nm_mesh_get_attributes, nm_mesh_set_attributes, nm_mesh_set_input_attributes,
};
pub use boundary::{
    nm_mesh_get_segment_parents, nm_mesh_get_segments, nm_mesh_get_simplex_regions,
    nm_mesh_set_regions, nm_mesh_set_segments, nm_region,
};
pub use create::{nm_mesh_create, nm_mesh_create_from_file, nm_mesh_free};
pub use diagnosis::{
    nm_intersection, nm_mesh_get_intersections, nm_mesh_get_odd_edges, nm_odd_edge,
};
pub use enums::{
    nm_edge_fault, nm_face_class, nm_feature, nm_filtration, nm_interpolation,
    nm_intersection_kind, nm_placement, nm_status, nm_vertex_kind,
};
pub use error::nm_last_error;
pub use export::{
    nm_export, nm_export_selected, nm_export_write, nm_export_write_selected, nm_write_fn,
};
pub use facets::{
    nm_mesh_get_facet_parents, nm_mesh_get_facet_triangle_simplices, nm_mesh_get_facet_triangles,
    nm_mesh_set_facets, nm_mesh_set_triangles,
};
pub use getters::{
    nm_mesh_counts, nm_mesh_get_domains, nm_mesh_get_input_vertices, nm_mesh_get_neighbors,
    nm_mesh_get_points, nm_mesh_get_precision_limited, nm_mesh_get_simplices,
    nm_mesh_get_vertex_domains, nm_mesh_get_vertex_inputs, nm_mesh_get_vertex_kinds,
    nm_mesh_left_out,
};
pub use handle::nm_mesh;
pub use histogram::nm_mesh_quality_histogram;
pub use holes::{nm_closed_holes, nm_mesh_close_holes};
pub use measures::{nm_mesh_quality, nm_mesh_stats, nm_mesh_validate};
pub use options::nm_options_init;
pub use queries::{
    nm_mesh_extend_values, nm_mesh_index, nm_mesh_interpolate, nm_mesh_locate, nm_mesh_nearest,
    nm_mesh_nearest_input,
};
pub use run::nm_run;
pub use structs::{
    nm_alpha_shape, nm_counts, nm_domain, nm_left_out, nm_options, nm_progress, nm_progress_fn,
    nm_quality, nm_report, nm_selection, nm_stats,
};
pub use surfaces::{
    nm_export_surface, nm_mesh_get_surface_facets, nm_mesh_get_surface_genera,
    nm_mesh_get_surface_insides, nm_mesh_get_surface_left_out, nm_mesh_get_surface_sampling,
    nm_mesh_surface, nm_mesh_validate_surface, nm_surface,
};
pub use topology::{
    nm_export_filtration, nm_mesh_filtration, nm_mesh_filtration_factor, nm_mesh_get_coface_starts,
    nm_mesh_get_cofaces, nm_mesh_get_face_facets, nm_mesh_get_faces, nm_mesh_make_filtration,
};
pub use triangulation::nm_mesh_triangulate_facets;
pub use version::{nm_abi_version, nm_status_name, nm_version};
pub use voronoi::{
    nm_mesh_get_region_shares, nm_mesh_get_region_starts, nm_mesh_get_region_volumes,
    nm_mesh_get_regions, nm_mesh_get_ridge_bounded, nm_mesh_get_ridge_corners,
    nm_mesh_get_ridge_starts,
};
