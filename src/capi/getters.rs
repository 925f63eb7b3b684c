//! Counts and arrays of a mesh. Every array getter has the same rules; `copy_out` keeps them.

use super::enums::{nm_status, vertex_kind_byte};
use super::handle::{nm_mesh, with_mesh};
use super::memory::{OutStruct, copy_out};
use super::structs::{nm_counts, nm_domain, nm_left_out};
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{LeftOut, Mesh, NONE, Triangulation, VertexKind};

/// Returns the result of the last run, or `State`.
pub(super) fn result(mesh: &Mesh) -> Result<&Triangulation> {
    mesh.triangulation().ok_or_else(|| {
        Error::new(ErrorKind::State, "mesh: it has no result yet; nm_run must succeed first")
    })
}

/// Copies an array of the mesh to the caller's buffer.
///
/// # Safety
/// `mesh` is NULL or a live handle; `buf` and `needed` are as `copy_out` wants them.
pub(super) unsafe fn get_array<T: Copy>(
    mesh: *const nm_mesh,
    buf: *mut T,
    capacity: u64,
    needed: *mut u64,
    array: impl Fn(&Mesh) -> Result<&[T]>,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let values = array(mesh)?.iter().copied();
        // SAFETY: the caller's promise.
        unsafe { copy_out(buf, capacity, needed, values.len(), values) }
    };
    // SAFETY: the caller's promise.
    unsafe { with_mesh(mesh, body) }
}

/// Writes how large the mesh is. O(1).
///
/// counts: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, counts), NM_INVALID_ARGUMENT (counts->struct_size), NM_STATE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_counts(mesh: *const nm_mesh, counts: *mut nm_counts) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("counts", counts)? };
        out.write(&count(mesh));
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

fn count(mesh: &Mesh) -> nm_counts {
    let inputs = mesh.inputs();
    let triangulation = mesh.triangulation();
    nm_counts {
        struct_size: size_of::<nm_counts>() as u32,
        dim: inputs.dim() as u32,
        inputs: inputs.count() as u64,
        duplicates: inputs.duplicates() as u64,
        vertices: triangulation.map_or(inputs.distinct(), Triangulation::vertex_count) as u64,
        simplices: triangulation.map_or(0, Triangulation::simplex_count) as u64,
        domains: triangulation.map_or(0, |t| t.domains.len()) as u64,
        segment_edges: triangulation.map_or(0, |t| t.boundary.subsegments.len()) as u64,
        facet_triangles: triangulation.map_or(0, |t| t.boundary.subfacets.len()) as u64,
    }
}

/// Writes what the file of nm_mesh_create_from_file or nm_mesh_create_from_columns has beside what
/// the mesh has of it: edges, faces and cells of a mesh (NM_FORMAT_GMSH, NM_FORMAT_MEDIT, nOFF, an
/// .ele file), of which the points alone become something, and of NM_FORMAT_PLY what is no face in
/// space. Zero for all other files, and for nm_mesh_create. O(1). Before nm_run and after.
///
/// left_out: the caller sets struct_size.
///
/// Errors: NM_NULL_ARGUMENT (mesh, left_out), NM_INVALID_ARGUMENT (left_out->struct_size), NM_STATE
/// (nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_left_out(
    mesh: *const nm_mesh,
    left_out: *mut nm_left_out,
) -> nm_status {
    let body = |mesh: &Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let out = unsafe { OutStruct::new("left_out", left_out)? };
        let LeftOut { edges, faces, cells } = mesh.left_out();
        let struct_size = size_of::<nm_left_out>() as u32;
        out.write(&nm_left_out { struct_size, reserved: 0, edges, faces, cells });
        Ok(())
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Writes the vertices' coordinates: vertices x dim doubles, coordinate k of vertex v at
/// buf[v * dim + k], in the caller's unit. The distinct inputs come first, in input order, with the
/// caller's bits; before nm_run there are only they.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_points(
    mesh: *const nm_mesh,
    buf: *mut f64,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    let body = |mesh: &Mesh| match mesh.triangulation() {
        Some(t) => {
            let points = t.points.iter().copied();
            // SAFETY: the caller's buffer rules are those of `copy_out`.
            unsafe { copy_out(buf, capacity, needed, t.points.len(), points) }
        }
        None => {
            let inputs = mesh.inputs();
            let count = inputs.distinct() * inputs.dim();
            let points = (0..inputs.distinct()).flat_map(|v| inputs.distinct_point(v)).copied();
            // SAFETY: as above.
            unsafe { copy_out(buf, capacity, needed, count, points) }
        }
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Writes the simplices: simplices x (dim + 1) vertex ids, vertex i of simplex s at
/// buf[s * (dim + 1) + i]. Every simplex is positively oriented: det[v1-v0, ..., vdim-v0] > 0.
///
/// Array getter, see the top of this file. Errors: NM_NULL_ARGUMENT (mesh), NM_CAPACITY,
/// NM_INVALID_ARGUMENT (buf not aligned), NM_STATE (no result yet, nm_run at work, poisoned).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_simplices(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe { get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.simplices)) }
}

/// Writes the adjacency: simplices x (dim + 1) simplex ids; entry i of simplex s, at
/// buf[s * (dim + 1) + i], is the simplex across the facet opposite vertex i, NM_NONE on the hull.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_simplices.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_neighbors(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe { get_array(mesh, buf, capacity, needed, |mesh| Ok(&result(mesh)?.neighbors)) }
}

/// Writes where each vertex comes from: one byte per vertex, an nm_vertex_kind. Before nm_run all
/// are NM_VERTEX_INPUT.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_kinds(
    mesh: *const nm_mesh,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    let of = |t: &Triangulation, v: usize| vertex_kind_byte(t.kinds[v]);
    let before = vertex_kind_byte(VertexKind::Input);
    // SAFETY: the caller's rules are those of `get_per_vertex`.
    unsafe { get_per_vertex(mesh, buf, capacity, needed, before, of) }
}

/// Writes the index of the innermost domain that contains each vertex (nm_mesh_get_domains): one id
/// per vertex, NM_NONE where there are no domains (before nm_run, NM_ALGORITHM_DELAUNAY).
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_domains(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    let of = |t: &Triangulation, v: usize| t.vertex_domains[v];
    // SAFETY: the caller's rules are those of `get_per_vertex`.
    unsafe { get_per_vertex(mesh, buf, capacity, needed, NONE, of) }
}

/// Writes 1 for each vertex whose cell is outside the promised quality because doubles are too
/// coarse there, 0 for the others: one byte per vertex. Before nm_run all are 0.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_precision_limited(
    mesh: *const nm_mesh,
    buf: *mut u8,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    let of = |t: &Triangulation, v: usize| u8::from(t.precision_limited[v]);
    // SAFETY: the caller's rules are those of `get_per_vertex`.
    unsafe { get_per_vertex(mesh, buf, capacity, needed, 0, of) }
}

/// Writes the vertex of each input: one vertex id per point given, duplicates included. Exact
/// duplicates share the vertex of the first; vertices are numbered by first appearance. The same
/// before and after nm_run. nm_mesh_get_vertex_inputs is the inverse.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_input_vertices(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    // SAFETY: the caller's rules are those of `get_array`.
    unsafe { get_array(mesh, buf, capacity, needed, |mesh| Ok(mesh.inputs().vertices())) }
}

/// Writes the input of each vertex: one number of the caller's points per vertex, of equal points
/// the first; NM_NONE for vertices that are no inputs. Ascending where it is a number.
///
/// With input_vertices from nm_mesh_get_input_vertices, input_vertices[vertex_inputs[v]] is v for
/// each vertex v that is an input, and vertex_inputs[input_vertices[i]] is i for each input i that
/// repeats no earlier one, else the one that it repeats.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_vertex_inputs(
    mesh: *const nm_mesh,
    buf: *mut u32,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let (inputs, distinct) = (mesh.inputs(), mesh.inputs().distinct());
        let count = mesh.triangulation().map_or(distinct, Triangulation::vertex_count);
        let numbers = (0..count).map(|vertex| inputs.first_input(vertex).unwrap_or(NONE));
        // SAFETY: the caller's buffer rules are those of `copy_out`.
        unsafe { copy_out(buf, capacity, needed, count, numbers) }
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Writes the domain hierarchy, a tree of balls: the root first, every parent before its children.
/// None before nm_run and for NM_ALGORITHM_DELAUNAY; one for NM_OUTPUT_WELL_SPACED. capacity and
/// *needed count nm_domain elements.
///
/// Array getter, see the top of this file. Errors: as nm_mesh_get_points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mesh_get_domains(
    mesh: *const nm_mesh,
    buf: *mut nm_domain,
    capacity: u64,
    needed: *mut u64,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let domains = mesh.triangulation().map_or(&[][..], |t| &t.domains);
        let encoded = domains.iter().map(|domain| nm_domain {
            center: domain.center,
            parent: domain.parent,
            radius: domain.radius,
        });
        // SAFETY: the caller's buffer rules are those of `copy_out`.
        unsafe { copy_out(buf, capacity, needed, domains.len(), encoded) }
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh(mesh, body) }
}

/// Copies one value per vertex: `before` for each distinct input until there is a result.
///
/// # Safety
/// The arguments are as `with_mesh` and `copy_out` demand.
unsafe fn get_per_vertex<T: Copy>(
    mesh: *const nm_mesh,
    buf: *mut T,
    capacity: u64,
    needed: *mut u64,
    before: T,
    of: impl Fn(&Triangulation, usize) -> T,
) -> nm_status {
    let body = |mesh: &Mesh| {
        let triangulation = mesh.triangulation();
        let distinct = mesh.inputs().distinct();
        let count = triangulation.map_or(distinct, Triangulation::vertex_count);
        let values = (0..count).map(|v| triangulation.map_or(before, |t| of(t, v)));
        // SAFETY: the caller's promise.
        unsafe { copy_out(buf, capacity, needed, count, values) }
    };
    // SAFETY: the caller's promise.
    unsafe { with_mesh(mesh, body) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{last_message, square};
    use crate::options::Options;
    use std::ptr::{null, null_mut};

    #[test]
    fn what_a_file_has_beside_its_points_is_told() {
        use crate::capi::create::{nm_mesh_create_from_file, nm_mesh_free};
        use crate::capi::test_support::from_c;
        use crate::io::Format;
        let name = format!("netmesh-{}-left-out.off", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, "nOFF\n2\n3 2 0\n0 0\n1 0\n0 1\n3 0 1 2\n2 0 1\n").unwrap();
        let text = std::ffi::CString::new(path.to_str().unwrap()).unwrap();
        let mut mesh = null_mut();
        let format = from_c(Format::Auto as i32);
        // SAFETY: a C string, and room for a handle.
        let status = unsafe { nm_mesh_create_from_file(text.as_ptr(), format, &mut mesh) };
        std::fs::remove_file(&path).unwrap();
        assert_eq!(status, nm_status::NM_OK, "{}", last_message());
        let struct_size = size_of::<nm_left_out>() as u32;
        let asked = nm_left_out { struct_size, reserved: 9, edges: 9, faces: 9, cells: 9 };
        let get = |mesh: *const nm_mesh| {
            let mut left_out = asked;
            // SAFETY: a live handle or NULL, and a whole struct.
            (unsafe { nm_mesh_left_out(mesh, &mut left_out) }, left_out)
        };
        let expected = nm_left_out { struct_size, reserved: 0, edges: 1, faces: 1, cells: 0 };
        assert_eq!(get(mesh), (nm_status::NM_OK, expected));
        // SAFETY: a live handle; NULL stands for the defaults.
        assert_eq!(unsafe { crate::capi::run::nm_run(mesh, null()) }, nm_status::NM_OK);
        assert_eq!(get(mesh), (nm_status::NM_OK, expected), "after a run, too");
        // SAFETY: fresh.
        unsafe { nm_mesh_free(mesh) };
        let none = nm_left_out { edges: 0, faces: 0, ..expected };
        assert_eq!(get(&square()), (nm_status::NM_OK, none));
        assert_eq!(get(null()), (nm_status::NM_NULL_ARGUMENT, asked));
        // SAFETY: a live handle; NULL is refused.
        let status = unsafe { nm_mesh_left_out(&square(), null_mut()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "left_out is NULL"));
    }

    type Getter<T> = unsafe extern "C" fn(*const nm_mesh, *mut T, u64, *mut u64) -> nm_status;

    /// Returns the values of a getter, which is asked for their number first.
    fn get<T: Copy + Default>(mesh: &nm_mesh, getter: Getter<T>) -> Vec<T> {
        let mut needed = u64::MAX;
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { getter(mesh, null_mut(), 0, &mut needed) };
        assert_eq!(status, nm_status::NM_OK);
        let mut values = vec![T::default(); needed as usize];
        // SAFETY: the buffer has room for `needed`.
        let status = unsafe { getter(mesh, values.as_mut_ptr(), needed, null_mut()) };
        assert_eq!(status, nm_status::NM_OK);
        values
    }

    #[test]
    fn before_a_run_there_are_the_distinct_inputs() {
        let mesh = square();
        assert_eq!(get(&mesh, nm_mesh_get_points), [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
        assert_eq!(get(&mesh, nm_mesh_get_input_vertices), [0, 1, 0, 2, 3]);
        assert_eq!(get(&mesh, nm_mesh_get_vertex_inputs), [0, 1, 3, 4]);
        assert_eq!(get(&mesh, nm_mesh_get_vertex_kinds), [0; 4]);
        assert_eq!(get(&mesh, nm_mesh_get_vertex_domains), [NONE; 4]);
        assert_eq!(get(&mesh, nm_mesh_get_precision_limited), [0; 4]);
        let mut needed = u64::MAX;
        // SAFETY: a live handle; NULL asks for the size.
        let status = unsafe { nm_mesh_get_domains(&mesh, null_mut(), 0, &mut needed) };
        assert_eq!((status, needed), (nm_status::NM_OK, 0));
        let expected = nm_counts {
            struct_size: 64,
            dim: 2,
            inputs: 5,
            duplicates: 1,
            vertices: 4,
            simplices: 0,
            domains: 0,
            segment_edges: 0,
            facet_triangles: 0,
        };
        let mut counts = nm_counts { struct_size: 64, dim: 9, ..expected };
        // SAFETY: a live handle and a whole struct.
        let status = unsafe { nm_mesh_counts(&mesh, &mut counts) };
        assert_eq!((status, counts), (nm_status::NM_OK, expected));
    }

    #[test]
    fn simplices_need_a_run() {
        let mesh = square();
        for getter in [nm_mesh_get_simplices as Getter<u32>, nm_mesh_get_neighbors] {
            let mut needed = 17;
            // SAFETY: a live handle; NULL asks for the size.
            let status = unsafe { getter(&mesh, null_mut(), 0, &mut needed) };
            assert_eq!((status, needed), (nm_status::NM_STATE, 17));
            assert!(last_message().contains("nm_run must succeed first"));
        }
    }

    #[test]
    fn null_arguments_are_named() {
        // SAFETY: NULL is allowed.
        let status = unsafe { nm_mesh_get_points(null(), null_mut(), 0, null_mut()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
        // SAFETY: a live handle; NULL is allowed.
        let status = unsafe { nm_mesh_counts(&square(), null_mut()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "counts is NULL"));
    }
    #[test]
    fn after_a_run_every_getter_has_its_array() {
        // Under Miri each vertex takes a second.
        let n = if cfg!(miri) { 2 } else { 62 };
        let mut points = vec![60.0, 60.0, 60.0, 60.0 + 1e-9];
        points.extend((0..2 * (n as i32 - 2)).map(|i| f64::from(i * i % 121)));
        points.splice(4..4, [60.0, 60.0]);
        let n = n + 1;
        let mut mesh = Mesh::new(2, n, &points, 0).unwrap();
        mesh.run(&Options::default(), None).unwrap();
        let t = mesh.triangulation().unwrap().clone();
        let distinct = mesh.inputs().distinct();
        let mesh = nm_mesh::new(mesh);
        assert_eq!(get(&mesh, nm_mesh_get_points), t.points);
        assert_eq!(get(&mesh, nm_mesh_get_simplices), t.simplices);
        assert_eq!(get(&mesh, nm_mesh_get_neighbors), t.neighbors);
        assert_eq!(get(&mesh, nm_mesh_get_vertex_domains), t.vertex_domains);
        let kinds = get(&mesh, nm_mesh_get_vertex_kinds);
        assert_eq!(kinds, t.kinds.iter().map(|&kind| kind as u8).collect::<Vec<_>>());
        assert!(kinds[..distinct].iter().all(|&kind| kind == 0) && kinds[distinct..].contains(&2));
        let limited = t.precision_limited.iter().map(|&limited| u8::from(limited));
        assert_eq!(get(&mesh, nm_mesh_get_precision_limited), limited.collect::<Vec<_>>());
        let vertices = get(&mesh, nm_mesh_get_input_vertices);
        let inputs = get(&mesh, nm_mesh_get_vertex_inputs);
        assert_eq!((vertices.len(), inputs.len()), (n, t.kinds.len()));
        // Each is the inverse of the other.
        for (vertex, &input) in inputs.iter().enumerate() {
            assert_eq!(input != NONE, vertex < distinct);
            assert!(input == NONE || vertices[input as usize] as usize == vertex);
        }
        for (input, &vertex) in vertices.iter().enumerate() {
            let first = vertices.iter().position(|other| *other == vertex).unwrap();
            assert!(first <= input && inputs[vertex as usize] as usize == first);
        }
        let mut domains = vec![nm_domain { center: 9, parent: 9, radius: 9.0 }; t.domains.len()];
        let capacity = domains.len() as u64;
        // SAFETY: a live handle; the buffer has room for `capacity`.
        let status =
            unsafe { nm_mesh_get_domains(&mesh, domains.as_mut_ptr(), capacity, null_mut()) };
        assert_eq!(status, nm_status::NM_OK);
        assert!(domains.len() > 1 || cfg!(miri), "the close pair has a domain of its own");
        for (is, should) in domains.iter().zip(&t.domains) {
            let is = (is.center, is.parent, is.radius);
            assert_eq!(is, (should.center, should.parent, should.radius));
        }
    }
}
