//! Arrays ready to use, of a selection. `Prepared` keeps those that were made together from call to
//! call; `copy_out` keeps the getters' rules.

use super::decode::decode_extent;
use super::enums::{nm_status, placement_byte};
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::memory::{copy_out, read_struct};
use super::structs::nm_selection;
use crate::arrays::{Arrays, Group, Selection};
use crate::error::Result;
use crate::mesh::NONE;
use crate::options::Extent;
use std::mem::MaybeUninit;

/// Writes where each simplex lies with respect to a region: one byte per simplex, an nm_placement.
/// NM_EXTENT_ALL and NM_EXTENT_AUTO: all are inside.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT
/// (extent, buf not aligned), NM_CAPACITY, NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at
/// work, poisoned).
///
/// The first call for NM_EXTENT_HULL of a result triangulates the inputs that may be on their
/// hull, and tests the simplices along the hull: little for points in a volume, about as long as
/// nm_run where most inputs are on the hull, as on a sphere. If the inputs lie in a hyperplane, it
/// tests all simplices that are not beyond a side of their box. A byte per simplex is kept until
/// the next nm_run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_placements(
    mesh: *const nm_mesh,
    extent: MaybeUninit<Extent>,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getters' rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let count = result(mesh)?.simplex_count();
            let placements = prepared.placements(mesh, decode_extent("extent", extent)?)?;
            let byte =
                |at: usize| placements.get(at).map_or(0, |&placement| placement_byte(placement));
            copy_out(buf, capacity, needed, count, (0..count).map(byte))
        })
    }
}

/// Copies an array of a selection, the one that `array` picks from a group.
///
/// # Safety
/// `mesh` is NULL or a live handle, `selection` NULL or as long as its `struct_size` says, the
/// buffer as `copy_out` asks for.
pub(super) unsafe fn get<T: Copy>(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    out: (*mut T, u64, *mut u64),
    group: Group,
    array: impl Fn(&mut Arrays) -> &mut Option<Vec<T>>,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe { get_as(mesh, selection, out, group, array, |x| x) }
}

/// Copies the ids of a group, as [`get`] copies an array.
///
/// # Safety
/// The arguments are as [`get`] demands.
pub(super) unsafe fn get_ids(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    out: (*mut u32, u64, *mut u64),
    group: Group,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe { get(mesh, selection, out, group, |of| &mut of.ids) }
}

/// Copies the starts of a group's lists, as [`get`] copies an array.
///
/// # Safety
/// The arguments are as [`get`] demands.
pub(super) unsafe fn get_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    out: (*mut u64, u64, *mut u64),
    group: Group,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe { get_as(mesh, selection, out, group, |of| &mut of.starts, |start| start as u64) }
}

/// Copies an array as [`get`] does, with `encode` of each element.
///
/// # Safety
/// The arguments are as [`get`] demands.
pub(super) unsafe fn get_as<T, S: Copy>(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    (buf, capacity, needed): (*mut T, u64, *mut u64),
    group: Group,
    array: impl Fn(&mut Arrays) -> &mut Option<Vec<S>>,
    encode: impl Fn(S) -> T,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            result(mesh)?;
            let selection = read_selection(selection)?;
            prepared.with_array(mesh, (&selection, group), array, |values| {
                let encoded = values.iter().map(|&value| encode(value));
                copy_out(buf, capacity, needed, values.len(), encoded)?;
                Ok(!buf.is_null())
            })
        })
    }
}

/// Reads a selection; NULL selects everything.
///
/// # Safety
/// `selection` is NULL or as long as its `struct_size` says.
pub(super) unsafe fn read_selection(selection: *const nm_selection) -> Result<Selection> {
    if selection.is_null() {
        return Ok(Selection::default());
    }
    let defaults = nm_selection {
        struct_size: 0,
        extent: MaybeUninit::new(Extent::All),
        across: 0,
        domain: NONE,
    };
    // SAFETY: the caller's promise.
    let given = unsafe { read_struct("selection", selection, defaults)? };
    Ok(Selection {
        extent: decode_extent("selection.extent", given.extent)?,
        across: given.across != 0,
        domain: given.domain,
    })
}

/// Writes the ids of the simplices of a selection, ascending. Arrays with a row for each simplex of
/// a selection have them in this order.
///
/// Array getter of a selection, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh),
/// NM_INVALID_ARGUMENT (a field of the selection; the message names it; buf not aligned),
/// NM_CAPACITY, NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_selected(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::Simplices) }
}

/// Writes the edges: edges x 2 vertex ids, the less first, in lexicographic order.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_edges(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::Edges) }
}

/// Writes the facets: facets x dim vertex ids. They are ordered by their first simplex
/// (nm_mesh_get_facet_simplices) and by the place of the vertex opposite in it, and oriented as on
/// the boundary of that simplex: outwards, as the hull is.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facets(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::Facets) }
}

/// Writes the simplices of each facet: facets x 2 simplex ids, the less first; NM_NONE in place of
/// the second on the hull of the selection.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_facet_simplices(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), Group::Facets, |of| &mut of.simplices) }
}

/// Writes the hull, the facets that only one simplex of the selection has: facets x dim vertex ids,
/// oriented outwards. They go counterclockwise round the mesh in 2D, and counterclockwise for who
/// looks at them from outside in 3D; in any dimension a point inside before them makes a positively
/// oriented simplex.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_hull(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::Hull) }
}

/// Writes the simplex of each facet of nm_mesh_get_hull.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_hull_simplices(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), Group::Hull, |of| &mut of.simplices) }
}

/// Writes the simplices of each vertex, one vertex after the other, each time ascending; where the
/// lists begin tells nm_mesh_get_vertex_simplex_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_simplices(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::VertexSimplices) }
}

/// Writes where the list of each vertex begins in nm_mesh_get_vertex_simplices, and at the end its
/// length: vertices + 1 numbers. Vertices without a simplex of the selection have empty lists.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_simplex_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_starts(mesh, selection, (buf, capacity, needed), Group::VertexSimplices) }
}

/// Writes the vertices that share an edge with each vertex, one vertex after the other, each time
/// ascending; where the lists begin tells nm_mesh_get_vertex_neighbor_starts.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_neighbors(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_ids(mesh, selection, (buf, capacity, needed), Group::VertexNeighbors) }
}

/// Writes where the list of each vertex begins in nm_mesh_get_vertex_neighbors, and at the end its
/// length: vertices + 1 numbers.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_neighbor_starts(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get_starts(mesh, selection, (buf, capacity, needed), Group::VertexNeighbors) }
}

/// Writes the circumcentres: simplices x dim coordinates, exact up to 1e-12 of the circumradius and
/// a rounding. Infinite where a coordinate exceeds the doubles.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_circumcenters(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), Group::Circumcenters, |of| &mut of.centers)
    }
}

/// Writes the circumradius of each simplex, exact up to a relative error of 1e-12, or to 2^-1074 if
/// subnormal. Infinite beyond the doubles.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_circumradii(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe {
        get(mesh, selection, (buf, capacity, needed), Group::Circumcenters, |of| &mut of.radii)
    }
}

/// Writes the volume of each simplex (its area in 2D), exact up to a relative error of 1e-12, or to
/// 2^-1074 if subnormal; 0 below the doubles and infinite beyond.
///
/// Array getter of a selection, see the top of this file. Errors: as nm_mesh_get_selected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_volumes(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's promises are those of `get`.
    unsafe { get(mesh, selection, (buf, capacity, needed), Group::Volumes, |of| &mut of.volumes) }
}
