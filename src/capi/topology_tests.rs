//! The getters of faces and filtrations.

use super::enums::{nm_filtration, nm_status};
use super::handle::nm_mesh;
use super::test_support::{from_c, last_message, square};
use super::topology::*;
use crate::mesh::Mesh;
use crate::options::{Algorithm, Options};
use std::ffi::CString;
use std::ptr::{null, null_mut};

/// Returns a right triangle and a point beyond its hypotenuse.
fn delaunay() -> nm_mesh {
    let points = [0.0, 0.0, 4.0, 0.0, 0.0, 3.0, 5.0, 4.0];
    let mut mesh = Mesh::new(2, 4, &points, 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    nm_mesh::new(mesh)
}

/// Returns all of an array: its size first.
fn all<T: Copy + Default>(get: impl Fn(*mut T, u64, *mut u64) -> nm_status) -> Vec<T> {
    let mut needed = u64::MAX;
    assert_eq!(get(null_mut(), 0, &mut needed), nm_status::NM_OK, "{}", last_message());
    let mut values = vec![T::default(); needed as usize];
    assert_eq!(get(values.as_mut_ptr(), needed, null_mut()), nm_status::NM_OK);
    if needed > 0 {
        assert_eq!(get(values.as_mut_ptr(), needed - 1, null_mut()), nm_status::NM_CAPACITY);
    }
    values
}

type Getter<T> = unsafe extern "C" fn(*const nm_mesh, u32, *mut T, u64, *mut u64) -> nm_status;

fn of_dimension<T: Copy + Default>(mesh: &nm_mesh, k: u32, getter: Getter<T>) -> Vec<T> {
    // SAFETY: a live handle and buffers as long as is said.
    all(|buf, capacity, needed| unsafe { getter(mesh, k, buf, capacity, needed) })
}

fn values(mesh: &nm_mesh, filtration: i32, k: u32) -> Vec<f64> {
    // SAFETY: as above.
    all(|buf, capacity, needed| unsafe {
        nm_mesh_filtration(mesh, from_c(filtration), k, buf, capacity, needed)
    })
}

#[test]
fn faces_boundaries_and_values_of_two_triangles() {
    let mesh = delaunay();
    assert_eq!(of_dimension(&mesh, 0, nm_mesh_get_faces), [0, 1, 2, 3]);
    assert_eq!(of_dimension(&mesh, 1, nm_mesh_get_faces), [0, 1, 0, 2, 1, 2, 1, 3, 2, 3]);
    assert_eq!(of_dimension(&mesh, 2, nm_mesh_get_faces), [0, 1, 2, 1, 2, 3]);
    assert_eq!(of_dimension(&mesh, 2, nm_mesh_get_face_facets), [2, 1, 0, 4, 3, 2]);
    assert_eq!(of_dimension(&mesh, 1, nm_mesh_get_face_facets), [1, 0, 2, 0, 2, 1, 3, 1, 3, 2]);
    assert_eq!(of_dimension(&mesh, 1, nm_mesh_get_coface_starts), [0, 1, 2, 4, 5, 6]);
    assert_eq!(of_dimension(&mesh, 1, nm_mesh_get_cofaces), [0, 0, 0, 1, 1, 1]);
    assert_eq!(of_dimension(&mesh, 0, nm_mesh_get_coface_starts), [0, 2, 5, 8, 10]);
    assert_eq!(values(&mesh, 0, 0), [0.0; 4]);
    // Half a hypotenuse; the other triangle is acute.
    assert_eq!(values(&mesh, 0, 1), [4.0, 2.25, 6.25, 4.25, 6.5]);
    assert_eq!(values(&mesh, 0, 2)[0], 6.25);
    let roots: Vec<f64> = values(&mesh, 0, 2).iter().map(|x| x.sqrt()).collect();
    assert_eq!(values(&mesh, 1, 2), roots);
}

#[test]
fn a_mesh_has_a_factor() {
    let mut mesh = square();
    // SAFETY: a live handle, and NULL or a place for a double.
    unsafe {
        assert_eq!(nm_mesh_make_filtration(&mesh, from_c(1), 0), nm_status::NM_STATE);
        assert_eq!(super::run::nm_run(&mut mesh, null()), nm_status::NM_OK);
        let make = |filtration| nm_mesh_make_filtration(&mesh, from_c(filtration), 0);
        assert_eq!(make(1), nm_status::NM_OK);
        let mut factor = f64::NAN;
        let factor_of = |filtration, out| nm_mesh_filtration_factor(&mesh, from_c(filtration), out);
        assert_eq!(factor_of(1, &mut factor), nm_status::NM_OK);
        assert!((1.0..10.0).contains(&factor), "{factor}");
        assert_eq!(factor_of(1, null_mut()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(values(&mesh, 1, 0)[..4], [0.0; 4]);
        assert!(values(&mesh, 1, 0)[4..].iter().all(|&value| value > 0.0));
        for status in [make(0), factor_of(0, &mut factor)] {
            assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
            assert!(last_message().contains("NM_ALGORITHM_DELAUNAY"), "{}", last_message());
        }
    }
    // SAFETY: as above.
    let factor_of_delaunay = unsafe {
        let mut factor = f64::NAN;
        nm_mesh_filtration_factor(&delaunay(), from_c(0), &mut factor);
        factor
    };
    assert_eq!(factor_of_delaunay, 1.0);
}

#[test]
fn a_filtration_goes_to_a_file() {
    let path = std::env::temp_dir().join(format!("netmesh-{}.filtration", std::process::id()));
    let name = CString::new(path.to_str().unwrap()).unwrap();
    let mesh = delaunay();
    // SAFETY: a live handle and C strings, or NULL.
    unsafe {
        let export = |filtration, name| nm_export_filtration(&mesh, from_c(filtration), name);
        assert_eq!(export(0, name.as_ptr()), nm_status::NM_OK, "{}", last_message());
        let lines = std::fs::read_to_string(&path).unwrap();
        assert_eq!(lines.lines().nth(4), Some("1 2 0 2.25"));
        std::fs::remove_file(&path).unwrap();
        assert_eq!(export(0, null()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(export(0, c"a.vtu".as_ptr()), nm_status::NM_INVALID_ARGUMENT);
        assert!(last_message().contains(".filtration or .dipha"), "{}", last_message());
        assert_eq!(export(7, name.as_ptr()), nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(export(1, c"/no/such/directory/a.dipha".as_ptr()), nm_status::NM_IO);
    }
}

#[test]
fn what_is_wrong_is_named() {
    let mesh = delaunay();
    let buf = null_mut();
    let mut needed = 7;
    // SAFETY: NULL or a live handle; no buffer.
    unsafe {
        let invalid = nm_status::NM_INVALID_ARGUMENT;
        assert_eq!(nm_mesh_get_faces(&mesh, 3, null_mut(), 0, &mut needed), invalid);
        assert_eq!(last_message(), "k is 3; it must be 0 to 2");
        assert_eq!(nm_mesh_get_face_facets(&mesh, 0, null_mut(), 0, &mut needed), invalid);
        assert_eq!(last_message(), "k is 0; it must be 1 to 2");
        assert_eq!(nm_mesh_get_cofaces(&mesh, 2, null_mut(), 0, &mut needed), invalid);
        assert_eq!(last_message(), "k is 2; it must be 0 to 1");
        let alpha = from_c::<nm_filtration>(0);
        assert_eq!(nm_mesh_filtration(&mesh, alpha, u32::MAX, buf, 0, &mut needed), invalid);
        assert_eq!(nm_mesh_filtration(&mesh, from_c(2), 0, buf, 0, &mut needed), invalid);
        assert_eq!(last_message(), "filtration is 2; it must be one of nm_filtration, 0 to 1");
        assert_eq!(needed, 7);
        let status = nm_mesh_get_faces(null(), 0, null_mut(), 0, &mut needed);
        assert_eq!(status, nm_status::NM_NULL_ARGUMENT);
        let fresh = square();
        for k in [0, 9] {
            let status = nm_mesh_get_faces(&fresh, k, null_mut(), 0, &mut needed);
            assert_eq!(status, nm_status::NM_STATE);
        }
    }
}
