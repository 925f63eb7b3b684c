//! The functions of surfaces through points.

use super::enums::{nm_status, nm_surface_kind};
use super::handle::nm_mesh;
use super::measures::nm_mesh_validate;
use super::run::nm_run;
use super::structs::nm_report;
use super::surfaces::*;
use super::test_support::{from_c, last_message, square};
use crate::mesh::Mesh;
use crate::options::{Algorithm, Options};
use std::ffi::CString;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

/// Returns the Delaunay triangulation of 16 points along the sides of a square of 4 units, of a
/// point far from it, and of its first corner once more: inputs 0, 1, and the others in rows.
fn delaunay() -> nm_mesh {
    let lattice = (0..25).map(|i| [i / 5, i % 5]);
    let is_on_side = |p: &[i32; 2]| p.iter().any(|&x| x == 0 || x == 4);
    let sides = lattice.filter(is_on_side).flat_map(|p| p.map(f64::from));
    let points: Vec<f64> = [0.0, 0.0, 40.0, 2.0].into_iter().chain(sides).collect();
    let mut mesh = Mesh::new(2, 18, &points, 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    nm_mesh::new(mesh)
}

fn closed() -> MaybeUninit<nm_surface_kind> {
    MaybeUninit::new(nm_surface_kind::NM_SURFACE_CLOSED)
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
    assert_eq!(unsafe { nm_mesh_surface(&mesh, closed(), &mut surface) }, nm_status::NM_OK);
    let expected = nm_surface {
        struct_size: 80,
        reserved: 0,
        volume: 16.0,
        facets: 16,
        vertices: 16,
        left_out: 1,
        shells: 1,
        handles: 0,
        ends: 0,
        one_sided: 0,
        sparse: 0,
    };
    assert_eq!(surface, expected);
    let open = MaybeUninit::new(nm_surface_kind::NM_SURFACE_OPEN);
    // SAFETY: a live handle and a struct of its size.
    assert_eq!(unsafe { nm_mesh_surface(&mesh, open, &mut surface) }, nm_status::NM_OK);
    assert_eq!(surface, nm_surface { volume: 0.0, ..expected });
}

#[test]
fn arrays_speak_of_inputs() {
    let mesh = delaunay();
    let mut needed = 0;
    let (mut facets, mut left_out) = ([0u32; 32], [0u32; 1]);
    let (mut genera, mut insides, mut sampling) = ([9u64], [7; 18], [0.0; 17]);
    // SAFETY: a live handle and buffers of the capacity that is said.
    unsafe {
        let get = nm_mesh_get_surface_facets;
        assert_eq!(
            get(&mesh, closed(), facets.as_mut_ptr(), 31, &mut needed),
            nm_status::NM_CAPACITY
        );
        assert_eq!(needed, 32);
        assert_eq!(get(&mesh, closed(), facets.as_mut_ptr(), 32, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_left_out;
        assert_eq!(get(&mesh, closed(), left_out.as_mut_ptr(), 1, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_genera;
        assert_eq!(get(&mesh, closed(), genera.as_mut_ptr(), 1, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_sampling;
        assert_eq!(get(&mesh, closed(), sampling.as_mut_ptr(), 17, null_mut()), nm_status::NM_OK);
        let get = nm_mesh_get_surface_insides;
        assert_eq!(get(&mesh, insides.as_mut_ptr(), 18, &mut needed), nm_status::NM_OK);
    }
    facets.sort_unstable();
    // Of the corner that is there twice the first; each point between two edges.
    let on_curve = std::iter::once(0).chain(3..18).flat_map(|input| [input; 2]);
    assert!(facets.into_iter().eq(on_curve), "{facets:?}");
    assert_eq!((left_out, genera), ([1], [0]));
    // The distinct points, of which the second is left out.
    let is_on = |(vertex, ratio): (usize, &f64)| ratio.is_nan() == (vertex == 1);
    assert!(sampling.iter().enumerate().all(is_on), "{sampling:?}");
    // A polygon of 16 corners.
    assert_eq!(insides[..needed as usize].iter().map(|&is| usize::from(is)).sum::<usize>(), 14);
}

#[test]
fn a_surface_is_certified_and_written() {
    let mesh = delaunay();
    let mut report = cleared(|report: &mut nm_report| &mut report.struct_size);
    // SAFETY: a live handle, a whole struct, C strings.
    unsafe {
        assert_eq!(nm_mesh_validate_surface(&mesh, closed(), &mut report), nm_status::NM_OK);
        assert_eq!((report.level, report.violations), (3, 0));
        let of_surface = report.checked;
        assert_eq!(nm_mesh_validate(&mesh, 3, &mut report), nm_status::NM_OK);
        assert!(of_surface > report.checked);
        let path = std::env::temp_dir().join(format!("netmesh_surface_{}.off", std::process::id()));
        let name = CString::new(path.to_str().unwrap()).unwrap();
        assert_eq!(nm_export_surface(&mesh, closed(), name.as_ptr()), nm_status::NM_OK);
        assert!(std::fs::read_to_string(&path).unwrap().starts_with("OFF\n16 16 0\n"));
        std::fs::remove_file(path).unwrap();
        let status = nm_export_surface(&mesh, closed(), c"surface.stl".as_ptr());
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
        assert_eq!(nm_mesh_surface(&mesh, closed(), null_mut()), nm_status::NM_NULL_ARGUMENT);
        assert_eq!(last_message(), "surface is NULL");
        assert_eq!(nm_mesh_surface(null(), closed(), &mut surface), nm_status::NM_NULL_ARGUMENT);
        let other = from_c(2);
        let status = nm_mesh_surface(&mesh, other, &mut surface);
        assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
        assert_eq!(last_message(), "kind is 2; it must be one of nm_surface_kind, 0 to 1");
        let unfinished = square();
        assert_eq!(nm_mesh_surface(&unfinished, closed(), &mut surface), nm_status::NM_STATE);
    }
    let mut refined = square();
    // SAFETY: a live handle.
    let status = unsafe {
        assert_eq!(nm_run(&mut refined, null()), nm_status::NM_OK);
        nm_mesh_surface(&refined, closed(), &mut surface)
    };
    assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
    assert!(last_message().contains("NM_ALGORITHM_DELAUNAY"), "{}", last_message());
}
