//! Faces and filtrations. They are made once and kept with the mesh.

use super::decode::decode_filtration;
use super::enums::{nm_filtration, nm_status};
use super::error::null_argument;
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::memory::{copy_out, utf8_path};
use crate::arrays::Lists;
use crate::error::{Error, Result, message};
use crate::io::{FiltrationFormat, write_filtration_file};
use crate::mesh::Mesh;
use crate::prepared::Prepared;
use crate::topology::{Faces, Filtration, Level, has_inputs_alone};
use std::ffi::c_char;
use std::mem::MaybeUninit;

/// Returns the faces, made on the threads of the run.
fn faces<'a>(mesh: &Mesh, prepared: &'a Prepared) -> Result<&'a Faces> {
    prepared.faces(mesh, result(mesh)?.parameters.threads)
}

/// Fails unless the dimension `k` is in a range that ends at `last`.
pub(super) fn check_dimension(k: u32, first: usize, last: usize) -> Result<usize> {
    if (first..=last).contains(&(k as usize)) {
        return Ok(k as usize);
    }
    let message = message!("k is {k}; it must be {first} to {last}");
    Err(Error::invalid(message))
}

/// Copies the ids that `ids` picks of the faces of dimension `k`, at least `first`, to a buffer of
/// a getter.
///
/// # Safety
/// `mesh` is NULL or a live handle, and the buffer is as the getters' rules say.
unsafe fn copy_ids(
    mesh: *const nm_mesh,
    (k, first): (u32, usize),
    ids: fn(&Level) -> &[u32],
    (buf, capacity, needed): (*mut u32, u64, *mut u64),
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let k = check_dimension(k, first, result(mesh)?.dim)?;
            let ids = ids(faces(mesh, prepared)?.of_dimension(k));
            copy_out(buf, capacity, needed, ids.len(), ids.iter().copied())
        })
    }
}

/// Writes the faces of dimension k of all simplices, each once: faces x (k + 1) ids of vertices,
/// not of inputs (nm_mesh_get_vertex_inputs has those), ascending within a face; the faces in
/// lexicographic order. The id of a face is its place there. k: 0 (all vertices, so that ids are
/// those of vertices) to dim (the simplices, in this order another one than that of
/// nm_mesh_get_simplices).
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT (k,
/// buf not aligned), NM_LIMIT (more faces, or facets of faces, of one dimension than 32-bit ids can
/// name), NM_CAPACITY, NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work, poisoned).
///
/// The first call for a result makes the faces of all dimensions, which are kept until the next
/// nm_run: 8 (k + 1) bytes a face of dimension k. O(faces x dim log(faces at a vertex)).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_faces(
    mesh: *const nm_mesh,
    k: u32,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getters' rules.
    unsafe { copy_ids(mesh, (k, 0), |level| &level.vertices, (buf, capacity, needed)) }
}

/// Writes the facets of each face of dimension k, its boundary: faces x (k + 1) ids of faces of
/// dimension k - 1, entry i the face without vertex i, whose sign in the boundary is (-1)^i.
/// k: 1 to dim.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_faces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_face_facets(
    mesh: *const nm_mesh,
    k: u32,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe { copy_ids(mesh, (k, 1), |level| &level.boundary, (buf, capacity, needed)) }
}

/// Returns the cofaces of each face of dimension `k`.
fn cofaces(mesh: &Mesh, prepared: &Prepared, k: u32) -> Result<Lists> {
    let k = check_dimension(k, 0, result(mesh)?.dim - 1)?;
    let faces = faces(mesh, prepared)?;
    faces.of_dimension(k + 1).coboundary(faces.of_dimension(k).count())
}

/// Writes the cofaces of each face of dimension k, its coboundary: the ids of the faces of
/// dimension k + 1 that have it as a facet, ascending, one face after the other. Where the lists
/// begin tells nm_mesh_get_coface_starts. k: 0 to dim - 1.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_faces. Made anew in each call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_cofaces(
    mesh: *const nm_mesh,
    k: u32,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let ids = cofaces(mesh, prepared, k)?.ids;
            copy_out(buf, capacity, needed, ids.len(), ids.iter().copied())
        })
    }
}

/// Writes where the list of each face begins in nm_mesh_get_cofaces, and at the end its length:
/// faces + 1 numbers.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_faces. Made anew in each call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_coface_starts(
    mesh: *const nm_mesh,
    k: u32,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let starts = cofaces(mesh, prepared, k)?.starts;
            copy_out(buf, capacity, needed, starts.len(), starts.iter().map(|&at| at as u64))
        })
    }
}

/// Returns the alpha values. `need` begins the message where there are none.
pub(super) fn alpha_values<'a>(
    mesh: &Mesh,
    prepared: &'a Prepared,
    need: &str,
    threads: u32,
) -> Result<&'a Filtration> {
    if has_inputs_alone(result(mesh)?) {
        return prepared.alpha(mesh, threads);
    }
    let message = message!(
        "{need}, but the mesh has vertices that are no inputs; set options.algorithm to \
         NM_ALGORITHM_DELAUNAY"
    );
    Err(Error::invalid(message))
}

/// Returns the filtration that is asked for.
fn filtration<'a>(
    mesh: &Mesh,
    prepared: &'a Prepared,
    filtration: MaybeUninit<nm_filtration>,
    threads: u32,
) -> Result<&'a Filtration> {
    let is_of_mesh = decode_filtration(filtration)?;
    if is_of_mesh {
        return prepared.distances(mesh, threads);
    }
    alpha_values(mesh, prepared, "filtration is NM_FILTRATION_ALPHA", threads)
}

/// Makes a filtration on some threads, unless it is there. nm_mesh_filtration makes it itself, on
/// those of the run.
///
/// threads: threads to use, 0 = all cores; no value depends on it.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT (filtration; NM_FILTRATION_ALPHA where a
/// vertex is no input), NM_LIMIT (as nm_mesh_get_faces), NM_OUT_OF_MEMORY, NM_STATE (no result yet,
/// nm_run at work, poisoned).
///
/// Kept until the next nm_run: 8 bytes a face, and what nm_mesh_get_faces keeps.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_make_filtration(
    mesh: *const nm_mesh,
    filtration: MaybeUninit<nm_filtration>,
    threads: u32,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            result(mesh)?;
            self::filtration(mesh, prepared, filtration, threads).map(|_| ())
        })
    }
}

/// Writes the values of the faces of dimension k in a filtration, in the order of
/// nm_mesh_get_faces. No face has less than one of its facets. docs/topology.md has the
/// definitions.
///
/// k: 0 to dim.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT
/// (filtration; NM_FILTRATION_ALPHA where a vertex is no input: the message says what to do; k; buf
/// not aligned), NM_LIMIT (as nm_mesh_get_faces), NM_CAPACITY, NM_OUT_OF_MEMORY, NM_STATE (no
/// result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_filtration(
    mesh: *const nm_mesh,
    filtration: MaybeUninit<nm_filtration>,
    k: u32,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getters' rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let result = result(mesh)?;
            let k = check_dimension(k, 0, result.dim)?;
            let threads = result.parameters.threads;
            let values = &self::filtration(mesh, prepared, filtration, threads)?.values[k];
            copy_out(buf, capacity, needed, values.len(), values.iter().copied())
        })
    }
}

/// Writes how near the diagrams of a filtration are to those of the balls round the inputs: a
/// feature of either, from birth to death, both lengths, with death / birth > factor * factor has
/// its own in the other, and births and deaths differ by no more than this factor. 1 for
/// NM_FILTRATION_ALPHA, whose values are squares of such lengths.
///
/// factor: receives a number of at least 1, infinite where nothing can be said. It is small for
/// NM_OUTPUT_WELL_SPACED and large where cages are.
///
/// Errors: as nm_mesh_make_filtration; NM_NULL_ARGUMENT (factor).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_filtration_factor(
    mesh: *const nm_mesh,
    filtration: MaybeUninit<nm_filtration>,
    factor: *mut f64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or a place for a double.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let threads = result(mesh)?.parameters.threads;
            if factor.is_null() {
                return Err(null_argument("factor"));
            }
            let found = self::filtration(mesh, prepared, filtration, threads)?.factor;
            factor.write_unaligned(found);
            Ok(())
        })
    }
}

/// Writes all faces and their values in a filtration to a file, which appears complete or not at
/// all, for programs that compute persistent homology (docs/topology.md). NM_FILTRATION_ALPHA has
/// the caller's points for vertices, of equal ones the first (nm_mesh_get_vertex_inputs);
/// NM_FILTRATION_MESH, which has others, the vertices of the mesh.
///
/// path_utf8: UTF-8 on every system; it ends with .filtration (text, as GUDHI's simplex trees write
/// and read it) or .dipha (DIPHA's binary boundary matrix).
///
/// Errors: as nm_mesh_make_filtration; NM_NULL_ARGUMENT (path_utf8), NM_INVALID_ARGUMENT (path_utf8
/// empty, not UTF-8, or with another extension), NM_IO (the message has the system's reason).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_filtration(
    mesh: *const nm_mesh,
    filtration: MaybeUninit<nm_filtration>,
    path_utf8: *const c_char,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or a C string.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let threads = result(mesh)?.parameters.threads;
            let path = utf8_path(path_utf8)?;
            let format = FiltrationFormat::from_path(path)?;
            let found = self::filtration(mesh, prepared, filtration, threads)?;
            write_filtration_file(mesh.inputs(), faces(mesh, prepared)?, found, format, path)
        })
    }
}
