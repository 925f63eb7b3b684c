//! The getters of arrays of a selection, and exports of one.

use super::arrays::*;
use super::enums::*;
use super::handle::*;
use super::structs::nm_selection;
use super::voronoi::*;
use crate::arrays::Selection;
use crate::capi::export::{nm_export_write, nm_export_write_selected};
use crate::capi::test_support::{from_c, last_message, square};
use crate::io::Format;
use crate::mesh::{Mesh, NONE};
use crate::numerics::testing::{Family, Random, points};
use crate::options::Options;
use std::ffi::c_void;
use std::ptr::{null, null_mut};

type Getter<T> =
    unsafe extern "C" fn(*const nm_mesh, *const nm_selection, *mut T, u64, *mut u64) -> nm_status;

fn get_all<T: Copy + Default>(
    mesh: &nm_mesh,
    selection: *const nm_selection,
    getter: Getter<T>,
) -> Vec<T> {
    let mut needed = u64::MAX;
    // SAFETY: a live handle; NULL asks for the size.
    let status = unsafe { getter(mesh, selection, null_mut(), 0, &mut needed) };
    assert_eq!(status, nm_status::NM_OK, "{}", last_message());
    let mut values = vec![T::default(); needed as usize];
    // SAFETY: the buffer has room for `needed`.
    let status = unsafe { getter(mesh, selection, values.as_mut_ptr(), needed, null_mut()) };
    assert_eq!(status, nm_status::NM_OK);
    values
}

fn select(extent: i32, across: u32, domain: u32) -> nm_selection {
    let struct_size = size_of::<nm_selection>() as u32;
    nm_selection { struct_size, extent: from_c(extent), across, domain }
}

fn meshed() -> Mesh {
    let mut points = points::<2>(Family::Uniform, 40, &mut Random(8));
    points.extend((0..6).map(|i| [0.25 + 1e-9 * f64::from(i), 0.5 + 1e-9 * f64::from(i * i % 5)]));
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.run(&Options::default(), None).unwrap();
    mesh
}

#[test]
fn getters_have_the_arrays_of_the_selection() {
    let mesh = meshed();
    let handle = nm_mesh::new(mesh.clone());
    let prepared = crate::prepared::Prepared::default();
    let selections = [
        (select(0, 0, NONE), Selection::default()),
        (
            select(2, 0, NONE),
            Selection { extent: crate::arrays::SelectionExtent::Hull, across: false, domain: NONE },
        ),
        (
            select(3, 1, 0),
            Selection { extent: crate::arrays::SelectionExtent::Box, across: true, domain: 0 },
        ),
        (select(0, 0, 1), Selection { domain: 1, ..Selection::default() }),
    ];
    for (given, selection) in &selections {
        let part = prepared.part(&mesh, selection).unwrap();
        let ids = |getter: Getter<u32>| get_all(&handle, given, getter);
        let doubles = |getter: Getter<f64>| get_all(&handle, given, getter);
        let starts = |getter: Getter<u64>| -> Vec<usize> {
            get_all(&handle, given, getter).iter().map(|&start| start as usize).collect()
        };
        assert_eq!(ids(nm_mesh_get_selected), part.simplices().collect::<Vec<_>>());
        assert_eq!(ids(nm_mesh_get_edges), part.edges().unwrap());
        let facets = part.facets().unwrap();
        assert_eq!(ids(nm_mesh_get_facets), facets.vertices);
        assert_eq!(ids(nm_mesh_get_facet_simplices), facets.simplices);
        let hull = part.hull().unwrap();
        assert_eq!(ids(nm_mesh_get_hull), hull.vertices);
        assert_eq!(ids(nm_mesh_get_hull_simplices), hull.simplices);
        let lists = part.vertex_simplices().unwrap();
        assert_eq!(ids(nm_mesh_get_vertex_simplices), lists.ids);
        assert_eq!(starts(nm_mesh_get_vertex_simplex_starts), lists.starts);
        let lists = part.vertex_neighbors().unwrap();
        assert_eq!(ids(nm_mesh_get_vertex_neighbors), lists.ids);
        assert_eq!(starts(nm_mesh_get_vertex_neighbor_starts), lists.starts);
        let centers = part.circumcenters().unwrap();
        assert_eq!(doubles(nm_mesh_get_circumcenters), centers.centers);
        assert_eq!(doubles(nm_mesh_get_circumradii), centers.radii);
        assert_eq!(doubles(nm_mesh_get_volumes), part.volumes().unwrap());
        let voronoi = part.voronoi().unwrap();
        assert_eq!(ids(nm_mesh_get_regions), voronoi.regions.ids);
        assert_eq!(starts(nm_mesh_get_region_starts), voronoi.regions.starts);
        assert_eq!(doubles(nm_mesh_get_region_volumes), voronoi.volumes);
        assert_eq!(doubles(nm_mesh_get_region_shares), voronoi.shares);
        assert_eq!(ids(nm_mesh_get_ridge_corners), voronoi.ridge_corners.ids);
        assert_eq!(starts(nm_mesh_get_ridge_starts), voronoi.ridge_corners.starts);
        let bounded: Vec<u8> = voronoi.is_ridge_bounded.iter().map(|&b| u8::from(b)).collect();
        assert_eq!(get_all(&handle, given, nm_mesh_get_ridge_bounded), bounded);
        assert!(bounded.contains(&0) && bounded.contains(&1));
    }
    let all = get_all(&handle, null(), nm_mesh_get_edges);
    assert_eq!(all, mesh.edges().unwrap());
    let mut bytes = vec![9; mesh.triangulation().unwrap().simplex_count()];
    let capacity = bytes.len() as u64;
    // SAFETY: a live handle; the buffer has room for `capacity`.
    let status = unsafe {
        nm_mesh_get_placements(&handle, from_c(2), bytes.as_mut_ptr(), capacity, null_mut())
    };
    assert_eq!(status, nm_status::NM_OK);
    let expected = prepared.placements(&mesh, crate::arrays::SelectionExtent::Hull).unwrap();
    assert!(bytes.iter().zip(expected).all(|(&byte, &placement)| byte == placement as u8));
    assert!((0..3).all(|byte| bytes.contains(&byte)));
}

unsafe extern "C" fn append(data: *const c_void, size: usize, text: *mut c_void) -> i32 {
    // SAFETY: the test passes its own vector, and `size` bytes are readable.
    unsafe {
        (*text.cast::<Vec<u8>>()).extend(std::slice::from_raw_parts(data.cast(), size));
    }
    0
}

/// Returns the bytes of an export.
fn export(mesh: &nm_mesh, selection: *const nm_selection, format: Format) -> Vec<u8> {
    let mut text = Vec::<u8>::new();
    let to = (&raw mut text).cast();
    // SAFETY: a live handle; the callback gets its vector.
    let status = unsafe {
        nm_export_write_selected(mesh, selection, from_c(format as i32), Some(append), to)
    };
    assert_eq!(status, nm_status::NM_OK, "{}", last_message());
    text
}

#[test]
fn exports_have_the_selection() {
    let mesh = meshed();
    let handle = nm_mesh::new(mesh.clone());
    let all = export(&handle, null(), Format::Vtu);
    let mut whole = Vec::<u8>::new();
    // SAFETY: a live handle; the callback gets its vector.
    let status = unsafe {
        let to = (&raw mut whole).cast();
        nm_export_write(&handle, from_c(Format::Vtu as i32), Some(append), to)
    };
    assert_eq!((status, &all), (nm_status::NM_OK, &whole));
    let hull = select(2, 0, NONE);
    let part = get_all(&handle, &hull, nm_mesh_get_selected).len();
    let text = export(&handle, &hull, Format::Xyz);
    let cloud = crate::io::read(&mut text.as_slice(), Format::Xyz).unwrap();
    let points = cloud.coordinates.len() / 2;
    // Some of the vertices, in their order.
    let triangulation = mesh.triangulation().unwrap();
    let mut vertices = triangulation.points.chunks_exact(2);
    let rows = cloud.coordinates.chunks_exact(2);
    assert!(points < triangulation.vertex_count() && points > mesh.inputs().distinct() / 2);
    rows.for_each(|row| assert!(vertices.any(|vertex| vertex == row)));
    let vtu = export(&handle, &hull, Format::Vtu);
    let count = format!("NumberOfCells=\"{part}\"");
    assert!(String::from_utf8_lossy(&vtu).contains(&count));
    // SAFETY: a live handle; the callback gets its vector.
    let status = unsafe {
        let to = (&raw mut whole).cast();
        let format = from_c(Format::DomainsJson as i32);
        nm_export_write_selected(&handle, &hull, format, Some(append), to)
    };
    assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
    assert!(last_message().contains("NM_FORMAT_DOMAINS_JSON"));
}

#[test]
fn wrong_selections_are_named() {
    let mesh = meshed();
    let domains = mesh.triangulation().unwrap().domains.len() as u32;
    let handle = nm_mesh::new(mesh);
    let mut needed = 17;
    let mut refused = |selection: &nm_selection, message: &str| {
        // SAFETY: a live handle and a struct as long as it says, or refused.
        let status = unsafe { nm_mesh_get_edges(&handle, selection, null_mut(), 0, &mut needed) };
        assert_eq!((status, needed), (nm_status::NM_INVALID_ARGUMENT, 17));
        assert!(last_message().starts_with(message), "{}", last_message());
    };
    refused(&select(4, 0, NONE), "selection.extent is 4");
    refused(&select(0, 0, 999), "selection.domain is 999; the mesh has");
    refused(&select(0, 0, domains), "selection.domain is");
    refused(&nm_selection { struct_size: 6, ..select(0, 0, NONE) }, "selection.struct_size is 6");
    let short = nm_selection { struct_size: 4, ..select(3, 0, 999) };
    assert_eq!(
        get_all(&handle, &short, nm_mesh_get_volumes),
        get_all(&handle, null(), nm_mesh_get_volumes)
    );
    let before = square();
    // SAFETY: a live handle.
    let status = unsafe { nm_mesh_get_hull(&before, null(), null_mut(), 0, &mut needed) };
    assert_eq!(status, nm_status::NM_STATE);
    // SAFETY: a live handle.
    let status = unsafe { nm_mesh_get_placements(&before, from_c(1), null_mut(), 0, &mut needed) };
    assert_eq!(status, nm_status::NM_STATE);
}
