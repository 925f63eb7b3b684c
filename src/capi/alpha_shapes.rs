//! Alpha shapes: the faces of a Delaunay triangulation up to an alpha value.

use super::enums::{class_byte, nm_status};
use super::error::null_argument;
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::memory::{OutStruct, copy_out, utf8_path};
use super::structs::nm_alpha_shape;
use super::topology::{alpha_values, check_dimension};
use crate::error::Result;
use crate::io::{SurfaceFormat, write_surface_file};
use crate::mesh::Mesh;
use crate::prepared::Prepared;
use crate::topology::{AlphaShape, Faces, Filtration, Topology, connecting_alpha, optimal_alpha};
use std::ffi::c_char;

/// First part of the message for a mesh without alpha values.
const NEED: &str = "an alpha shape is of a Delaunay triangulation of the inputs alone";

fn faces_and_values<'a>(
    mesh: &Mesh,
    prepared: &'a Prepared,
) -> Result<(&'a Faces, &'a Filtration)> {
    let threads = result(mesh)?.parameters.threads;
    let values = alpha_values(mesh, prepared, NEED, threads)?;
    Ok((prepared.faces(mesh, threads)?, values))
}

fn shape<'a>(mesh: &Mesh, prepared: &'a Prepared, alpha: f64) -> Result<AlphaShape<'a>> {
    let (faces, values) = faces_and_values(mesh, prepared)?;
    AlphaShape::new(faces, values, alpha)
}

/// Measures the alpha shape: all faces whose alpha value (NM_FILTRATION_ALPHA) is at most alpha.
///
/// alpha: a squared radius, at least 0; it may be infinite. nm_mesh_connecting_alpha and
/// nm_mesh_optimal_alpha find values.
/// shape: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, shape), NM_INVALID_ARGUMENT (alpha; a vertex is no input: the
/// message says what to do; shape->struct_size), NM_LIMIT (as nm_mesh_get_faces), NM_OUT_OF_MEMORY,
/// NM_STATE (no result yet, nm_run at work, poisoned).
///
/// O(faces log faces). The first call for a result makes the alpha values, as
/// nm_mesh_make_filtration does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_alpha_shape(
    mesh: *const nm_mesh,
    alpha: f64,
    shape: *mut nm_alpha_shape,
) -> nm_status {
    let body = |mesh: &Mesh, prepared: &Prepared| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("shape", shape)? };
        let shape = self::shape(mesh, prepared, alpha)?;
        out.write(&encode(&shape.topology()?, shape.volume(result(mesh)?)?));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_prepared(mesh, body) }
}

fn encode(topology: &Topology, volume: f64) -> nm_alpha_shape {
    let betti = topology.betti.as_deref().unwrap_or(&[]);
    let filled = |from: &[u64], at: usize| from.get(at).copied().unwrap_or(0);
    nm_alpha_shape {
        struct_size: size_of::<nm_alpha_shape>() as u32,
        betti_count: betti.len() as u32,
        volume,
        euler_characteristic: topology.euler_characteristic,
        components: topology.components,
        voids: topology.voids,
        betti: std::array::from_fn(|k| filled(betti, k)),
        face_counts: std::array::from_fn(|k| filled(&topology.face_counts, k)),
    }
}

/// Writes how each face of dimension k lies in the alpha shape, in the order of nm_mesh_get_faces:
/// an nm_face_class each.
///
/// k: 0 to dim.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_alpha_shape; NM_INVALID_ARGUMENT (k),
/// NM_CAPACITY. Made anew in each call: O(faces).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_alpha_shape_classes(
    mesh: *const nm_mesh,
    alpha: f64,
    k: u32,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getters' rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let k = check_dimension(k, 0, result(mesh)?.dim)?;
            let classes = shape(mesh, prepared, alpha)?.classes(k)?;
            let bytes = classes.iter().copied().map(class_byte);
            copy_out(buf, capacity, needed, classes.len(), bytes)
        })
    }
}

/// Writes the boundary of the simplices of an alpha shape (of the regularized shape): facets x dim
/// inputs, numbers of the caller's points, of equal ones the first; oriented outwards as by
/// nm_mesh_get_hull. They are the facets of class
/// NM_FACE_CLASS_REGULAR. In 3D it is a closed surface; two of its sheets may touch in a vertex or
/// an edge.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_alpha_shape; NM_CAPACITY. Made anew
/// in each call: O(simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_alpha_shape_boundary(
    mesh: *const nm_mesh,
    alpha: f64,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let shape = shape(mesh, prepared, alpha)?;
            let facets = shape.boundary(mesh.inputs(), result(mesh)?)?;
            copy_out(buf, capacity, needed, facets.len(), facets.iter().copied())
        })
    }
}

/// Finds the least alpha whose shape is connected; it holds all inputs, as each alpha shape does: a
/// quarter of the square of the longest edge of their minimum spanning tree.
///
/// alpha: receives a squared radius.
///
/// Errors: NM_NULL_ARGUMENT (mesh, alpha), else as nm_mesh_alpha_shape. O(edges log edges).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_connecting_alpha(
    mesh: *const nm_mesh,
    alpha: *mut f64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or a place for a double.
    unsafe { find_alpha(mesh, alpha, connecting_alpha) }
}

/// Finds the least alpha for which each input is a vertex of a simplex of the shape, and its
/// simplices, connected across facets, are at most so many pieces: CGAL's optimal alpha, by which
/// points of a surface or of a solid become one.
///
/// components: at least 1.
/// alpha: receives a squared radius.
///
/// Errors: NM_NULL_ARGUMENT (mesh, alpha), NM_INVALID_ARGUMENT (components), else as
/// nm_mesh_alpha_shape. O(simplices log simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_optimal_alpha(
    mesh: *const nm_mesh,
    components: u64,
    alpha: *mut f64,
) -> nm_status {
    // SAFETY: as above.
    unsafe { find_alpha(mesh, alpha, |faces, values| optimal_alpha(faces, values, components)) }
}

/// Writes an alpha that `find` finds.
///
/// # Safety
/// `mesh` is NULL or a live handle, `alpha` NULL or a place for a double.
unsafe fn find_alpha(
    mesh: *const nm_mesh,
    alpha: *mut f64,
    find: impl FnOnce(&Faces, &Filtration) -> Result<f64>,
) -> nm_status {
    // SAFETY: the caller's promise.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            result(mesh)?;
            if alpha.is_null() {
                return Err(null_argument("alpha"));
            }
            let (faces, values) = faces_and_values(mesh, prepared)?;
            alpha.write_unaligned(find(faces, values)?);
            Ok(())
        })
    }
}

/// Writes the boundary of nm_mesh_get_alpha_shape_boundary to a file, which appears complete or not
/// at all, with the vertices that it has: triangles in 3D, edges in 2D.
///
/// path_utf8: UTF-8 on every system; it ends with .ply, .off, .stl (in 3D, with single
/// precision) or .obj.
///
/// Errors: as nm_mesh_alpha_shape; NM_NULL_ARGUMENT (path_utf8), NM_INVALID_ARGUMENT (path_utf8
/// empty, not UTF-8, or with another extension; a mesh of four dimensions or more), NM_IO (the
/// message has the system's reason).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_alpha_shape(
    mesh: *const nm_mesh,
    alpha: f64,
    path_utf8: *const c_char,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or a C string.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let triangulation = result(mesh)?;
            let path = utf8_path(path_utf8)?;
            let format = SurfaceFormat::from_path(path)?;
            let hull = shape(mesh, prepared, alpha)?.solid(triangulation)?.hull()?;
            write_surface_file(mesh.inputs(), triangulation, &hull.vertices, format, path)
        })
    }
}
