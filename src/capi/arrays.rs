//! Arrays ready to use, of a selection. Each is made anew in each call; `copy_out` keeps the
//! getters' rules.

use super::enums::{decode_extent, nm_extent, nm_status, placement_byte};
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::memory::{copy_out, read_struct};
use super::structs::nm_selection;
use crate::arrays::{Part, Selection};
use crate::error::Result;
use crate::memory::collected;
use crate::mesh::NONE;
use std::mem::MaybeUninit;

/// Writes where each simplex lies with respect to a region: one byte per simplex, an nm_placement.
/// NM_EXTENT_ALL: all are inside.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT
/// (extent, buf not aligned), NM_CAPACITY, NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at
/// work, poisoned).
///
/// The first call for NM_EXTENT_HULL of a result triangulates the inputs that may be on their hull.
/// Each simplex that its vertices do not place then takes time of the order of the inputs on the
/// hull: little for points in a volume, but as much as all else together and more where most inputs
/// are on the hull, as on a sphere. A byte per simplex is kept until the next nm_run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_placements(
    mesh: *const nm_mesh,
    extent: MaybeUninit<nm_extent>,
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

/// Makes an array of a selection and copies it.
///
/// # Safety
/// `mesh` is NULL or a live handle, `selection` NULL or as long as its `struct_size` says, the
/// buffer as `copy_out` asks for.
pub(super) unsafe fn get<T, S: Copy>(
    mesh: *const nm_mesh,
    selection: *const nm_selection,
    (buf, capacity, needed): (*mut T, u64, *mut u64),
    make: impl FnOnce(&Part<'_>) -> Result<Vec<S>>,
    encode: impl Fn(S) -> T,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            result(mesh)?;
            let part = prepared.part(mesh, &read_selection(selection)?)?;
            let array = make(&part)?;
            copy_out(buf, capacity, needed, array.len(), array.iter().map(|&x| encode(x)))
        })
    }
}

/// # Safety
/// `selection` is NULL or as long as its `struct_size` says.
pub(super) unsafe fn read_selection(selection: *const nm_selection) -> Result<Selection> {
    if selection.is_null() {
        return Ok(Selection::default());
    }
    let defaults = nm_selection {
        struct_size: 0,
        extent: MaybeUninit::new(nm_extent::NM_EXTENT_ALL),
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
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(collected(part.simplices())?),
            |x| x,
        )
    }
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
    unsafe { get(mesh, selection, (buf, capacity, needed), |part| part.edges(), |x| x) }
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
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.facets()?.vertices), |x| x)
    }
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
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.facets()?.simplices), |x| x)
    }
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
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.hull()?.vertices), |x| x)
    }
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
    unsafe {
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.hull()?.simplices), |x| x)
    }
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
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_simplices()?.ids),
            |x| x,
        )
    }
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
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_simplices()?.starts),
            |start| start as u64,
        )
    }
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
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_neighbors()?.ids),
            |x| x,
        )
    }
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
    unsafe {
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.vertex_neighbors()?.starts),
            |start| start as u64,
        )
    }
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
        get(
            mesh,
            selection,
            (buf, capacity, needed),
            |part| Ok(part.circumcenters()?.centers),
            |x| x,
        )
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
        get(mesh, selection, (buf, capacity, needed), |part| Ok(part.circumcenters()?.radii), |x| x)
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
    unsafe { get(mesh, selection, (buf, capacity, needed), |part| part.volumes(), |x| x) }
}
