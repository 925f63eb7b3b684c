//! Surfaces through points: the boundary of the simplices that are inside.

use super::decode::decode_surface;
use super::enums::{nm_status, nm_surface_kind};
use super::getters::result;
use super::handle::{nm_mesh, with_prepared};
use super::measures::encode_report;
use super::memory::{OutStruct, Versioned, copy_out, utf8_path};
use super::structs::nm_report;
use crate::error::{Error, Result};
use crate::io::{SurfaceFormat, write_surface_file};
use crate::mesh::Mesh;
use crate::prepared::Prepared;
use crate::surface::Surface;
use crate::topology::has_inputs_alone;
use std::ffi::c_char;
use std::mem::MaybeUninit;

/// Measures of a surface through points, from nm_mesh_surface.
#[allow(non_camel_case_types)]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct nm_surface {
    /// Set by the caller to sizeof(nm_surface).
    pub struct_size: u32,
    /// 0.
    pub reserved: u32,
    /// The volume that a closed one encloses (an area in 2D), in the unit of the coordinates to the
    /// power dim; 0 for an open one.
    pub volume: f64,
    /// Number of facets: triangles in 3D, edges in 2D.
    pub facets: u64,
    /// Number of vertices that are on it.
    pub vertices: u64,
    /// Number of vertices that are not on it.
    pub left_out: u64,
    /// Number of connected parts, called shells.
    pub shells: u64,
    /// Number of handles of all shells that have two sides: 0 for a sphere, 1 for a torus; 0 in 2D.
    pub handles: u64,
    /// Number of closed curves at which shells end: 1 for a disk, 2 for a tube; in 2D of points, 2
    /// for a curve. 0 for a closed one.
    pub ends: u64,
    /// Number of shells that have one side alone, as a Moebius strip has.
    pub one_sided: u64,
    /// Number of vertices where nm_mesh_get_surface_sampling is above 1: what is there is a guess.
    pub sparse: u64,
}

// SAFETY: repr(C), begins with a u32, no padding (checked below), and the fields take any bits.
unsafe impl Versioned for nm_surface {
    const TYPE: &'static str = "nm_surface";
}

const _: () = assert!(size_of::<nm_surface>() == 2 * 4 + 9 * 8);

fn surface<'a>(
    mesh: &Mesh,
    prepared: &'a Prepared,
    kind: MaybeUninit<nm_surface_kind>,
) -> Result<&'a Surface> {
    let kind = decode_surface(kind)?;
    if !has_inputs_alone(result(mesh)?) {
        return Err(Error::invalid(
            "a surface is of a Delaunay triangulation of the inputs alone, but the mesh has \
             vertices that are no inputs; set options.algorithm to NM_ALGORITHM_DELAUNAY",
        ));
    }
    prepared.surface(mesh, kind)
}

fn closed<'a>(mesh: &Mesh, prepared: &'a Prepared) -> Result<&'a Surface> {
    surface(mesh, prepared, MaybeUninit::new(nm_surface_kind::NM_SURFACE_CLOSED))
}

/// Finds the surface that the inputs were sampled from, and measures it: a surface in 3D, curves in
/// 2D. No normals are asked for. Its facets are faces of the Delaunay triangulation, so it has no
/// intersections, and its vertices are inputs; it is a manifold. Outliers, and inputs that noise
/// moved off it, are left out.
///
/// kind: NM_SURFACE_CLOSED for the boundary of some simplices, which is watertight and oriented
/// outwards; a surface that ends is closed somehow. NM_SURFACE_OPEN for one that may end or have
/// one side alone: it has no facet with a circumradius of more than five distances of points, which
/// is where it ends, and is oriented where it has two sides.
///
/// It has the topology of the surface that was sampled, where that is sampled densely for its
/// curvature and thickness.
///
/// surface: the caller sets struct_size. No facets mean that the inputs tell of no inside.
///
/// Errors: NM_NULL_ARGUMENT (mesh, surface), NM_INVALID_ARGUMENT (kind; a mesh of four dimensions
/// or more; a vertex is no input: the message says what to do; surface->struct_size), NM_LIMIT
/// (more than 2^30 simplices), NM_OUT_OF_MEMORY, NM_STATE (no result yet, nm_run at work,
/// poisoned).
///
/// O(simplices log simplices) for the first call of this group with a kind after a run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_surface(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    surface: *mut nm_surface,
) -> nm_status {
    let body = |mesh: &Mesh, prepared: &Prepared| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("surface", surface)? };
        let surface = self::surface(mesh, prepared, kind)?;
        out.write(&encode(surface, surface.volume(result(mesh)?)?));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_prepared(mesh, body) }
}

fn encode(surface: &Surface, volume: f64) -> nm_surface {
    let shells = || surface.shells.iter();
    nm_surface {
        struct_size: size_of::<nm_surface>() as u32,
        reserved: 0,
        volume,
        facets: shells().map(|shell| shell.facets).sum(),
        vertices: shells().map(|shell| shell.vertices).sum(),
        left_out: surface.left_out.len() as u64,
        shells: surface.shells.len() as u64,
        handles: shells().filter(|shell| !shell.is_one_sided).map(|shell| shell.genus).sum(),
        ends: shells().map(|shell| shell.ends).sum(),
        one_sided: shells().filter(|shell| shell.is_one_sided).count() as u64,
        sparse: surface.sparse() as u64,
    }
}

/// Writes the facets of the surface: facets x dim inputs, numbers of the caller's points, of equal
/// ones the first; those of closed shells are oriented outwards as by nm_mesh_get_hull.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_surface; NM_CAPACITY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_surface_facets(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and a buffer by the getters' rules.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let facets = &surface(mesh, prepared, kind)?.facets;
            let inputs = facets.iter().map(|&vertex| first_input(mesh, vertex));
            copy_out(buf, capacity, needed, facets.len(), inputs)
        })
    }
}

/// Writes the inputs that are not on the surface, of equal ones the first, ascending.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_surface; NM_CAPACITY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_surface_left_out(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let left_out = &surface(mesh, prepared, kind)?.left_out;
            let inputs = left_out.iter().map(|&vertex| first_input(mesh, vertex));
            copy_out(buf, capacity, needed, left_out.len(), inputs)
        })
    }
}

/// Returns the first input that is a vertex; first inputs ascend with their vertices.
fn first_input(mesh: &Mesh, vertex: u32) -> u32 {
    mesh.inputs().first_input(vertex as usize).expect("a vertex that is an input")
}

/// Writes the number of handles of each shell of the surface, in the order of their first vertices:
/// 0 for a sphere, 1 for a torus; 0 in 2D; of a shell with one side its crosscaps, 1 for a Moebius
/// strip.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_surface; NM_CAPACITY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_surface_genera(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    buf: *mut u64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let shells = &surface(mesh, prepared, kind)?.shells;
            let genera = shells.iter().map(|shell| shell.genus);
            copy_out(buf, capacity, needed, shells.len(), genera)
        })
    }
}

/// Writes for each vertex how sparse the inputs are there for the surface: the largest circumradius
/// of its facets (in 2D half the longest of its edges) over the distance to the nearest pole of
/// their vertices, which stands for the local feature size. 0.3 and less is dense; above 1 the
/// surface is a guess. At sharp edges, and with noise, it is large. NaN for a vertex that is left
/// out. The vertices are those of nm_mesh_get_points.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_surface; NM_CAPACITY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_surface_sampling(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let sampling = &surface(mesh, prepared, kind)?.sampling;
            copy_out(buf, capacity, needed, sampling.len(), sampling.iter().copied())
        })
    }
}

/// Writes for each simplex 1 if the closed surface has it inside, else 0.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_surface; NM_CAPACITY.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_surface_insides(
    mesh: *const nm_mesh,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: as above.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let insides = &closed(mesh, prepared)?.is_inside;
            copy_out(buf, capacity, needed, insides.len(), insides.iter().map(|&is| u8::from(is)))
        })
    }
}

/// Checks the triangulation as nm_mesh_validate does at level 3, and the surface: it is a manifold,
/// closed unless it is NM_SURFACE_OPEN, and oriented unless a shell has one side; its facets are
/// faces of the triangulation, and each vertex is on it or left out.
///
/// report: the caller sets struct_size.
///
/// Errors: as nm_mesh_surface; NM_NULL_ARGUMENT (report). A violation is no error.
/// O(simplices log simplices).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_validate_surface(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    report: *mut nm_report,
) -> nm_status {
    let body = |mesh: &Mesh, prepared: &Prepared| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("report", report)? };
        let found = surface(mesh, prepared, kind)?.validate(mesh.inputs(), result(mesh)?)?;
        out.write(&encode_report(&found));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_prepared(mesh, body) }
}

/// Writes the surface to a file, which appears complete or not at all, with the vertices that it
/// has: triangles in 3D, edges in 2D.
///
/// path_utf8: UTF-8 on every system; it ends with .ply, .off, .stl (in 3D, with single precision)
/// or .obj.
///
/// Errors: as nm_mesh_surface; NM_NULL_ARGUMENT (path_utf8), NM_INVALID_ARGUMENT (path_utf8 empty,
/// not UTF-8, or with another extension; STL in 2D, or where single precision makes two corners of
/// a triangle one), NM_IO (the message has the system's reason).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_export_surface(
    mesh: *const nm_mesh,
    kind: MaybeUninit<nm_surface_kind>,
    path_utf8: *const c_char,
) -> nm_status {
    // SAFETY: the caller gave NULL or a live handle, and NULL or a C string.
    unsafe {
        with_prepared(mesh, |mesh, prepared| {
            let triangulation = result(mesh)?;
            let path = utf8_path(path_utf8)?;
            let format = SurfaceFormat::from_path(path)?;
            let facets = &surface(mesh, prepared, kind)?.facets;
            write_surface_file(mesh.inputs(), triangulation, facets, format, path)
        })
    }
}
