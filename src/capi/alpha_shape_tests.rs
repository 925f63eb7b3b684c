//! The functions of alpha shapes.

use super::alpha_shapes::*;
use super::enums::nm_status;
use super::handle::nm_mesh;
use super::structs::nm_alpha_shape;
use super::test_support::{last_message, square};
use crate::mesh::Mesh;
use crate::options::{Algorithm, Options};
use std::ffi::CString;
use std::ptr::{null, null_mut};

/// Returns the Delaunay triangulation of the corners of the unit square and a point far from it.
fn delaunay() -> nm_mesh {
    let points = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 9.0, 0.5];
    let mut mesh = Mesh::new(2, 5, &points, 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    nm_mesh::new(mesh)
}

fn cleared() -> nm_alpha_shape {
    // SAFETY: numbers alone.
    let mut shape: nm_alpha_shape = unsafe { std::mem::zeroed() };
    shape.struct_size = size_of::<nm_alpha_shape>() as u32;
    shape
}

#[test]
fn a_shape_has_measures() {
    let mesh = delaunay();
    let mut shape = cleared();
    // SAFETY: a live handle and a struct of its size.
    assert_eq!(unsafe { nm_mesh_alpha_shape(&mesh, 0.5, &mut shape) }, nm_status::NM_OK);
    let expected = nm_alpha_shape {
        struct_size: 136,
        betti_count: 2,
        volume: 1.0,
        euler_characteristic: 2,
        components: 2,
        voids: 0,
        betti: [2, 0, 0],
        face_counts: [5, 5, 2, 0, 0, 0, 0, 0, 0],
    };
    assert_eq!(shape, expected);
    // SAFETY: as above.
    assert_eq!(unsafe { nm_mesh_alpha_shape(&mesh, 0.25, &mut shape) }, nm_status::NM_OK);
    assert_eq!((shape.components, shape.voids, shape.betti), (2, 1, [2, 1, 0]));
    assert_eq!((shape.volume, shape.face_counts[..3].iter().sum::<u64>()), (0.0, 9));
}

#[test]
fn classes_and_boundary_are_written() {
    let mesh = delaunay();
    let mut needed = 0;
    let (mut classes, mut boundary) = ([9u8; 5], [9u32; 8]);
    // SAFETY: a live handle and buffers of the capacity that is said.
    unsafe {
        let get = nm_mesh_get_alpha_shape_classes;
        assert_eq!(get(&mesh, 0.5, 0, null_mut(), 0, &mut needed), nm_status::NM_OK);
        assert_eq!(needed, 5);
        let status = get(&mesh, 0.5, 0, classes.as_mut_ptr(), 4, &mut needed);
        assert_eq!((status, classes), (nm_status::NM_CAPACITY, [9; 5]));
        let status = get(&mesh, 0.5, 0, classes.as_mut_ptr(), 5, null_mut());
        // The far point is alone.
        assert_eq!((status, classes), (nm_status::NM_OK, [2, 2, 2, 2, 1]));
        assert_eq!(get(&mesh, 0.5, 2, classes.as_mut_ptr(), 5, &mut needed), nm_status::NM_OK);
        assert_eq!(classes[..needed as usize].iter().filter(|&&class| class == 3).count(), 2);
        assert_eq!(classes[..needed as usize].iter().filter(|&&class| class == 0).count(), 1);
        let get = nm_mesh_get_alpha_shape_boundary;
        assert_eq!(get(&mesh, 0.5, boundary.as_mut_ptr(), 8, &mut needed), nm_status::NM_OK);
    }
    let mut edges: Vec<[u32; 2]> = boundary.chunks_exact(2).map(|e| [e[0], e[1]]).collect();
    edges.sort_unstable();
    // Counterclockwise.
    assert_eq!((needed, edges), (8, vec![[0, 1], [1, 2], [2, 3], [3, 0]]));
}

/// Every point but the last one twice.
#[test]
fn the_boundary_is_of_the_callers_points() {
    let points = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 9.0, 0.5];
    let mut mesh = Mesh::new(2, 8, &points, 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    let (mesh, mut needed, mut boundary) = (nm_mesh::new(mesh), 0, [9u32; 8]);
    let get = nm_mesh_get_alpha_shape_boundary;
    // SAFETY: a live handle and a buffer of the capacity that is said.
    let status = unsafe { get(&mesh, 0.5, boundary.as_mut_ptr(), 8, &mut needed) };
    assert_eq!((status, needed), (nm_status::NM_OK, 8));
    let mut edges: Vec<[u32; 2]> = boundary.chunks_exact(2).map(|e| [e[0], e[1]]).collect();
    edges.sort_unstable();
    assert_eq!(edges, [[0, 2], [2, 5], [5, 6], [6, 0]]);
}

#[test]
fn values_are_found() {
    let mesh = delaunay();
    let mut alpha = f64::NAN;
    // SAFETY: a live handle, and NULL or a place for a double.
    unsafe {
        assert_eq!(nm_mesh_connecting_alpha(&mesh, &mut alpha), nm_status::NM_OK);
        assert_eq!(alpha, (64.0 + 0.25) / 4.0);
        assert_eq!(nm_mesh_optimal_alpha(&mesh, 1, &mut alpha), nm_status::NM_OK);
        // The circle through three points, two of them a unit apart.
        let center: f64 = (64.0 - 0.25) / 16.0;
        assert_eq!(alpha, center * center + 0.25);
        assert_eq!(nm_mesh_optimal_alpha(&mesh, 1, null_mut()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(nm_mesh_connecting_alpha(null(), &mut alpha), nm_status::NM_NULL_ARGUMENT);
        let status = nm_mesh_optimal_alpha(&mesh, 0, &mut alpha);
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(last_message(), "components is 0; it must be at least 1");
    }
}

#[test]
fn a_boundary_goes_to_a_file() {
    let path = std::env::temp_dir().join(format!("netmesh-shape-{}.off", std::process::id()));
    let name = CString::new(path.to_str().unwrap()).unwrap();
    let mesh = delaunay();
    // SAFETY: a live handle and C strings, or NULL.
    unsafe {
        let export = |name| nm_export_alpha_shape(&mesh, 0.5, name);
        assert_eq!(export(name.as_ptr()), nm_status::NM_OK, "{}", last_message());
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.starts_with("OFF\n4 4 0\n0 0 0\n1 0 0\n"), "{text}");
        std::fs::remove_file(&path).unwrap();
        assert_eq!(export(null()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(export(c"a.vtu".as_ptr()), nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(export(c"/no/such/directory/a.ply".as_ptr()), nm_status::NM_IO);
    }
}

#[test]
fn what_is_wrong_is_named() {
    let (mesh, mut shape) = (delaunay(), cleared());
    let before = shape;
    // SAFETY: NULL or a live handle, NULL or a struct of its size.
    unsafe {
        let invalid = nm_status::NM_INVALID_ARGUMENT;
        assert_eq!(nm_mesh_alpha_shape(&mesh, -1.0, &mut shape), invalid);
        assert_eq!(last_message(), "alpha is -1; it must be at least 0, a squared radius");
        assert_eq!(nm_mesh_alpha_shape(&mesh, f64::NAN, &mut shape), invalid);
        assert_eq!(nm_mesh_alpha_shape(&mesh, 1.0, null_mut()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(nm_mesh_alpha_shape(null(), 1.0, &mut shape), nm_status::NM_NULL_ARGUMENT);
        let get = nm_mesh_get_alpha_shape_classes;
        assert_eq!(get(&mesh, 1.0, 3, null_mut(), 0, null_mut()), invalid);
        assert_eq!(last_message(), "k is 3; it must be 0 to 2");
        let mut other = square();
        assert_eq!(nm_mesh_alpha_shape(&other, 1.0, &mut shape), nm_status::NM_STATE);
        assert_eq!(super::run::nm_run(&mut other, null()), nm_status::NM_OK);
        assert_eq!(nm_mesh_alpha_shape(&other, 1.0, &mut shape), invalid);
        assert!(last_message().contains("NM_ALGORITHM_DELAUNAY"), "{}", last_message());
    }
    assert_eq!(shape, before);
}
