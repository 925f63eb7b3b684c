//! The functions of surfaces through points.

use super::enums::nm_status;
use super::handle::nm_mesh;
use super::measures::nm_mesh_validate;
use super::run::nm_run;
use super::structs::nm_report;
use super::surfaces::*;
use super::test_support::{last_message, square};
use crate::mesh::Mesh;
use crate::options::{Algorithm, Options};
use std::ffi::CString;
use std::ptr::{null, null_mut};

/// Returns the Delaunay triangulation of the corners of the unit square, the first of them twice,
/// and a point far from it.
fn delaunay() -> nm_mesh {
    let points = [0.0, 0.0, 9.0, 0.5, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0];
    let mut mesh = Mesh::new(2, 6, &points, 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    nm_mesh::new(mesh)
}

fn cleared<T>(size: impl Fn(&mut T) -> &mut u32) -> T {
    // SAFETY: only structs of numbers are asked for.
    let mut value: T = unsafe { std::mem::zeroed() };
    *size(&mut value) = size_of::<T>() as u32;
    value
}

#[test]
fn a_surface_has_measures() {
    let mesh = delaunay();
    let mut surface = cleared(|surface: &mut nm_surface| &mut surface.struct_size);
    // SAFETY: a live handle and a struct of its size.
    assert_eq!(unsafe { nm_mesh_surface(&mesh, &mut surface) }, nm_status::NM_OK);
    let expected = nm_surface {
        struct_size: 56,
        reserved: 0,
        volume: 1.0,
        facets: 4,
        vertices: 4,
        left_out: 1,
        shells: 1,
        handles: 0,
    };
    assert_eq!(surface, expected);
}

#[test]
fn arrays_speak_of_inputs() {
    let mesh = delaunay();
    let mut needed = 0;
    let (mut facets, mut left_out, mut genera, mut insides) =
        ([0u32; 8], [0u32; 1], [9u64], [7; 9]);
    // SAFETY: a live handle and buffers of the capacity that is said.
    unsafe {
        let get = nm_mesh_get_surface_facets;
        assert_eq!(get(&mesh, facets.as_mut_ptr(), 7, &mut needed), nm_status::NM_CAPACITY);
        assert_eq!(needed, 8);
        assert_eq!(get(&mesh, facets.as_mut_ptr(), 8, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_left_out;
        assert_eq!(get(&mesh, left_out.as_mut_ptr(), 1, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_genera;
        assert_eq!(get(&mesh, genera.as_mut_ptr(), 1, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_insides;
        assert_eq!(get(&mesh, insides.as_mut_ptr(), 9, &mut needed), nm_status::NM_OK);
    }
    let mut edges: Vec<&[u32]> = facets.chunks(2).collect();
    edges.sort_unstable();
    assert_eq!(edges, [[0, 2], [2, 4], [4, 5], [5, 0]]);
    assert_eq!((left_out, genera), ([1], [0]));
    assert_eq!(insides[..needed as usize].iter().map(|&is| usize::from(is)).sum::<usize>(), 2);
}

#[test]
fn a_surface_is_certified_and_written() {
    let mesh = delaunay();
    let mut report = cleared(|report: &mut nm_report| &mut report.struct_size);
    // SAFETY: a live handle, a whole struct, C strings.
    unsafe {
        assert_eq!(nm_mesh_validate_surface(&mesh, &mut report), nm_status::NM_OK);
        assert_eq!((report.level, report.violations), (3, 0));
        let of_surface = report.checked;
        assert_eq!(nm_mesh_validate(&mesh, 3, &mut report), nm_status::NM_OK);
        assert!(of_surface > report.checked);
        let path = std::env::temp_dir().join(format!("netmesh_surface_{}.off", std::process::id()));
        let name = CString::new(path.to_str().unwrap()).unwrap();
        assert_eq!(nm_export_surface(&mesh, name.as_ptr()), nm_status::NM_OK);
        assert!(std::fs::read_to_string(&path).unwrap().starts_with("OFF\n4 4 0\n"));
        std::fs::remove_file(path).unwrap();
        let status = nm_export_surface(&mesh, c"surface.stl".as_ptr());
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(last_message(), "STL has triangles in space, and the mesh is 2D");
    }
}

#[test]
fn what_has_no_surface_is_refused() {
    let mut surface = cleared(|surface: &mut nm_surface| &mut surface.struct_size);
    let mesh = delaunay();
    // SAFETY: NULL, or a live handle.
    unsafe {
        assert_eq!(nm_mesh_surface(&mesh, null_mut()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(last_message(), "surface is NULL");
        assert_eq!(nm_mesh_surface(null(), &mut surface), nm_status::NM_NULL_ARGUMENT);
        let unfinished = square();
        assert_eq!(nm_mesh_surface(&unfinished, &mut surface), nm_status::NM_STATE);
    }
    let mut refined = square();
    // SAFETY: a live handle.
    let status = unsafe {
        assert_eq!(nm_run(&mut refined, null()), nm_status::NM_OK);
        nm_mesh_surface(&refined, &mut surface)
    };
    assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
    assert!(last_message().contains("NM_ALGORITHM_DELAUNAY"), "{}", last_message());
}
