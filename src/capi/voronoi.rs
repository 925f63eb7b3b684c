//! Voronoi cells of a selection as arrays.

use super::arrays::{get, get_as, get_ids, get_starts};
use super::enums::nm_status;
use super::handle::nm_mesh;
use super::structs::nm_selection;
use crate::arrays::Group;

/// Writes the Voronoi cells: the simplices whose circumcentres are the corners of each vertex's
/// cell, one vertex after the other. In 2D counterclockwise, from one end to the other where the
/// cell is unbounded; else ascending. Where the lists begin tells nm_mesh_get_region_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_regions(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::Regions) }
}

/// Writes where the list of each vertex begins in nm_mesh_get_regions, and at the end its length:
/// vertices + 1 numbers.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_region_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_starts(mesh, selection, (buf, capacity, needed), Group::Regions) }
}

/// Writes the volume of each vertex's Voronoi cell, infinite where the cell is unbounded: the
/// vertex is on the hull of the selection, or in no simplex of it. Computed in doubles from
/// circumcentres.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_region_volumes(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), Group::Cells, |of| &mut of.volumes) }
}

/// Writes what each vertex's Voronoi cell adds to the volume of the mesh: its volume if it is
/// bounded; else what the simplices at the vertex have of it, which may be negative next to obtuse
/// simplices. The shares of all vertices add up to the volume of the simplices.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_region_shares(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), Group::Cells, |of| &mut of.shares) }
}

/// Writes the ridges, the facets of Voronoi cells: one for each edge, in the order of
/// nm_mesh_get_edges, between the cells of its ends. A ridge is the list of simplices whose
/// circumcentres are its corners, in 3D in their order round it, from one end to the other where it
/// is unbounded; else ascending. Where the lists begin tells nm_mesh_get_ridge_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_ridge_corners(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::Ridges) }
}

/// Writes where the list of each ridge begins in nm_mesh_get_ridge_corners, and at the end its
/// length: edges + 1 numbers.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_ridge_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_starts(mesh, selection, (buf, capacity, needed), Group::Ridges) }
}

/// Writes 1 for each ridge that is bounded, 0 for those whose edge is on the hull of the selection:
/// one byte per edge.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_ridge_bounded(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get_as(
            mesh,
            selection,
            (buf, capacity, needed),
            Group::Ridges,
            |of| &mut of.is_bounded,
            u8::from,
        )
    }
}
