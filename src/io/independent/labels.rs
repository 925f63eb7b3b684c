//! Labels of regions, markers of facets and of segments.

use super::{as_read_by, python_has};
use crate::io::samples;
use crate::mesh::{Mesh, Region};
use crate::options::{Extent, Options, Output};

const MESHIO: &str = include_str!("meshio_labels.py");
const VTK: &str = include_str!("vtk_labels.py");
const GMSH: &str = include_str!("gmsh_labels.py");

/// Makes a square in three strips, one of which has no label, and all of whose sides have markers.
fn strips() -> Mesh {
    let points = [0, 1, 2, 3].map(|x| [[f64::from(x), 0.0], [f64::from(x), 3.0]]);
    let mut mesh = Mesh::new(2, 8, points.as_flattened().as_flattened(), 0).unwrap();
    let segments = [0, 2, 2, 4, 4, 6, 6, 7, 7, 5, 5, 3, 3, 1, 1, 0, 2, 3, 4, 5];
    let markers = [7, 7, 0, -2, i32::MAX, 1, 1, 2, i32::MIN, -2];
    mesh.set_segments(&segments, Some(&markers)).unwrap();
    let seed = |x, label| Region { seed: [x, 1.5, 0.0], label, ..Region::default() };
    mesh.set_regions(&[seed(0.5, 3), seed(2.5, -3)]).unwrap();
    let extent = Extent::Boundary;
    let options =
        Options { output: Output::WellSpaced, extent, min_angle: 25.0, ..Options::default() };
    mesh.run(&options, None).unwrap();
    mesh
}

/// Returns what the scripts print.
fn expected(mesh: &Mesh) -> String {
    let triangulation = mesh.triangulation().unwrap();
    let row = |vertices: &[u32], label: i32| {
        let vertices = vertices.iter().map(|vertex| i64::from(*vertex));
        vertices.chain([i64::from(label)]).collect::<Vec<i64>>()
    };
    let labels = &triangulation.boundary.simplex_regions;
    let simplices = triangulation.simplices.chunks_exact(triangulation.dim + 1).zip(labels);
    let mut simplices: Vec<_> = simplices.map(|(ids, label)| row(ids, *label)).collect();
    simplices.sort();
    let marked = triangulation.boundary.marked_facets(&mesh.facets_of_result().markers);
    let mut triangles: Vec<_> = marked.map(|(ids, marker)| row(&ids, marker)).collect();
    triangles.sort();
    let marked = triangulation.boundary.marked(mesh.markers_of_result());
    let mut edges: Vec<_> = marked.map(|(ends, marker)| row(&ends, marker)).collect();
    edges.sort();
    match triangulation.dim {
        2 => format!("{simplices:?}\n{edges:?}\n"),
        _ => format!("{simplices:?}\n{triangles:?}\n{edges:?}\n"),
    }
}

fn assert_reads(script: &str, reader: &str, extension: &str) {
    for (which, mesh) in [
        ("square", samples::square_with_segments()),
        ("solid", samples::solid_with_facets()),
        ("strips", strips()),
    ] {
        let name = format!("{reader}-labels-{which}.{extension}");
        assert_eq!(as_read_by(script, &mesh, &name, &[]), expected(&mesh), "{name}");
    }
}

#[test]
fn the_strips_have_every_kind_of_label() {
    let mesh = strips();
    let boundary = &mesh.triangulation().unwrap().boundary;
    assert!([3, 0, -3].iter().all(|label| boundary.simplex_regions.contains(label)));
    let markers: Vec<i32> = boundary.marked(mesh.markers_of_result()).map(|(_, m)| m).collect();
    assert!([7, 0, -2, 1, 2, i32::MAX, i32::MIN].iter().all(|marker| markers.contains(marker)));
}

#[test]
fn meshio_reads_labels() {
    if python_has("meshio") {
        for extension in ["msh", "vtu", "mesh"] {
            assert_reads(MESHIO, "meshio", extension);
        }
    }
}

#[test]
fn vtk_reads_labels() {
    if python_has("vtkmodules.vtkIOXML") {
        assert_reads(VTK, "vtk", "vtu");
    }
}

#[test]
fn gmsh_reads_labels() {
    if python_has("gmsh") {
        assert_reads(GMSH, "gmsh", "msh");
    }
}
