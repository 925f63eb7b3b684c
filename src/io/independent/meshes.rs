//! Meshes: points bit by bit, simplices, arrays.

use super::super::samples;
use super::{as_read_by, bits, python_has};
use crate::arrays::domains;
use crate::mesh::{Mesh, NONE, Triangulation};

pub(super) const MESHIO: &str = include_str!("meshio_mesh.py");
pub(super) const VTK: &str = include_str!("vtk_mesh.py");
pub(super) const GMSH: &str = include_str!("gmsh_mesh.py");

/// Returns the points with three coordinates.
fn in_space(mesh: &Triangulation) -> Vec<f64> {
    let points = mesh.points.chunks_exact(mesh.dim);
    points.flat_map(|p| [p[0], p[1], p.get(2).copied().unwrap_or(0.0)]).collect()
}

/// Returns a script's first two lines for `mesh`.
fn expected(mesh: &Triangulation, points: &[f64]) -> String {
    format!("{:?}\n{:?}\n", bits(points), mesh.simplices)
}

fn kinds(mesh: &Triangulation) -> Vec<u8> {
    mesh.kinds.iter().map(|kind| *kind as u8).collect()
}

fn cell_domains(mesh: &Triangulation) -> Vec<u32> {
    domains::simplices(mesh).map(|(_, domain)| domain).collect()
}

/// Meshes that are hard to read, and such that have domains.
fn meshes(dim: usize) -> [(&'static str, Mesh); 2] {
    [("awkward", samples::mesh(dim)), ("nested", samples::nested(dim))]
}

fn assert_reads_vtu(script: &str, reader: &str, types: [&str; 2]) {
    for (dim, cell_type) in [(2, types[0]), (3, types[1])] {
        for (which, mesh) in meshes(dim) {
            let triangulation = mesh.triangulation().unwrap();
            let arguments =
                [cell_type, "kind", "domain", "input", "precision_limited", "cell cell_domain"];
            let name = format!("{reader}-{which}-{dim}.vtu");
            let read = as_read_by(script, &mesh, &name, &arguments);
            let limited: Vec<u8> =
                triangulation.precision_limited.iter().map(|l| *l as u8).collect();
            let inputs = mesh.inputs().distinct() as u32;
            let vertices = 0..triangulation.vertex_count() as u32;
            let inputs: Vec<u32> = vertices.map(|v| if v < inputs { v } else { NONE }).collect();
            let simplices = triangulation.simplices.chunks_exact(dim + 1);
            let domains: Vec<u32> =
                simplices.map(|s| domains::domain_of(triangulation, s)).collect();
            let arrays = format!(
                "{:?}\n{:?}\n{inputs:?}\n{limited:?}\n{domains:?}\n",
                kinds(triangulation),
                triangulation.vertex_domains,
            );
            assert!(read == expected(triangulation, &in_space(triangulation)) + &arrays, "{name}");
        }
    }
}

#[test]
fn meshio_reads_vtu() {
    if python_has("meshio") {
        assert_reads_vtu(MESHIO, "meshio", ["triangle", "tetra"]);
    }
}

#[test]
fn vtk_reads_vtu() {
    if python_has("vtkmodules.vtkIOXML") {
        assert_reads_vtu(VTK, "vtk", ["5", "10"]);
    }
}

#[test]
fn meshio_reads_tetgen() {
    if python_has("meshio") {
        let mesh = samples::mesh(3);
        let triangulation = mesh.triangulation().unwrap();
        let read = as_read_by(MESHIO, &mesh, "meshio.ele", &["tetra"]);
        assert_eq!(read, expected(triangulation, &triangulation.points));
    }
}

#[test]
fn meshio_reads_planar_off() {
    if python_has("meshio") {
        let mesh = samples::mesh(2);
        let triangulation = mesh.triangulation().unwrap();
        let read = as_read_by(MESHIO, &mesh, "meshio.off", &["triangle"]);
        assert_eq!(read, expected(triangulation, &in_space(triangulation)));
    }
}

fn assert_reads_gmsh(script: &str, reader: &str, types: [&str; 2]) {
    for (dim, cell_type) in [(2, types[0]), (3, types[1])] {
        for (which, mesh) in meshes(dim) {
            let triangulation = mesh.triangulation().unwrap();
            let name = format!("{reader}-{which}-{dim}.msh");
            let arguments = [cell_type, "kind", "cell domain"];
            let read = as_read_by(script, &mesh, &name, &arguments);
            let (kinds, domains) = (kinds(triangulation), cell_domains(triangulation));
            let arrays = format!("{kinds:?}\n{domains:?}\n");
            assert!(read == expected(triangulation, &in_space(triangulation)) + &arrays, "{name}");
        }
    }
}

#[test]
fn meshio_reads_gmsh() {
    if python_has("meshio") {
        assert_reads_gmsh(MESHIO, "meshio", ["triangle", "tetra"]);
    }
}

#[test]
fn gmsh_reads_gmsh() {
    if python_has("gmsh") {
        assert_reads_gmsh(GMSH, "gmsh", ["2", "4"]);
    }
}

#[test]
fn meshio_reads_medit() {
    if !python_has("meshio") {
        return;
    }
    for (dim, cell_type) in [(2, "triangle"), (3, "tetra")] {
        for (which, mesh) in meshes(dim) {
            let triangulation = mesh.triangulation().unwrap();
            let name = format!("meshio-{which}-{dim}.mesh");
            let arguments = [cell_type, "medit:ref", "cell medit:ref"];
            let read = as_read_by(MESHIO, &mesh, &name, &arguments);
            let (kinds, domains) = (kinds(triangulation), cell_domains(triangulation));
            let arrays = format!("{kinds:?}\n{domains:?}\n");
            assert!(read == expected(triangulation, &triangulation.points) + &arrays, "{name}");
        }
    }
}

#[test]
fn gmsh_reads_medit() {
    if !python_has("gmsh") {
        return;
    }
    for (dim, cell_type) in [(2, "2"), (3, "4")] {
        for (which, mesh) in meshes(dim) {
            let triangulation = mesh.triangulation().unwrap();
            let name = format!("gmsh-{which}-{dim}.mesh");
            let read = as_read_by(GMSH, &mesh, &name, &[cell_type]);
            let (points, vertices) = read.trim_end().split_once('\n').unwrap();
            assert_eq!(points, format!("{:?}", bits(&in_space(triangulation))), "{name}");
            // Gmsh makes an entity of each reference: simplices of one domain stand together.
            let mut simplices: Vec<(u32, &[u32])> =
                domains::simplices(triangulation).map(|(s, domain)| (domain, s)).collect();
            simplices.sort_by_key(|(domain, _)| *domain);
            let expected: Vec<u32> = simplices.iter().flat_map(|(_, s)| *s).copied().collect();
            assert_eq!(vertices, format!("{expected:?}"), "{name}");
        }
    }
}

/// Returns the vertices of the facets that one simplex has alone, in order.
fn boundary(mesh: &Triangulation) -> Vec<Vec<u32>> {
    let mut facets: Vec<Vec<u32>> = mesh
        .simplices
        .chunks_exact(mesh.dim + 1)
        .flat_map(|simplex| {
            simplex.iter().map(|opposite| {
                let mut facet = simplex.to_vec();
                facet.retain(|vertex| vertex != opposite);
                facet.sort_unstable();
                facet
            })
        })
        .collect();
    facets.sort();
    let alone = facets.chunk_by(|a, b| a == b).filter(|same| same.len() == 1);
    alone.map(|same| same[0].clone()).collect()
}

/// Returns what the script says of the triangles of a file, in order.
fn triangles(vertices: &str) -> Vec<Vec<u32>> {
    let numbers = vertices.trim_matches(['[', ']']).split(", ").map(|word| word.parse().unwrap());
    let numbers: Vec<u32> = numbers.collect();
    let mut triangles: Vec<Vec<u32>> = numbers.chunks_exact(3).map(<[u32]>::to_vec).collect();
    triangles.iter_mut().for_each(|triangle| triangle.sort_unstable());
    triangles.sort();
    triangles
}

#[test]
fn meshio_reads_ply() {
    if !python_has("meshio") {
        return;
    }
    for (which, mesh) in meshes(2) {
        let triangulation = mesh.triangulation().unwrap();
        let name = format!("meshio-{which}-2.ply");
        let read = as_read_by(MESHIO, &mesh, &name, &["triangle", "kind", "domain"]);
        let (kinds, domains) = (kinds(triangulation), &triangulation.vertex_domains);
        let arrays = format!("{kinds:?}\n{domains:?}\n");
        assert!(read == expected(triangulation, &in_space(triangulation)) + &arrays, "{name}");
    }
    for (which, mesh) in meshes(3) {
        let triangulation = mesh.triangulation().unwrap();
        let name = format!("meshio-{which}-3.ply");
        let read = as_read_by(MESHIO, &mesh, &name, &["triangle"]);
        let (points, vertices) = read.trim_end().split_once('\n').unwrap();
        assert_eq!(points, format!("{:?}", bits(&triangulation.points)), "{name}");
        assert_eq!(triangles(vertices), boundary(triangulation), "{name}");
    }
}

#[test]
fn vtk_reads_ply() {
    if !python_has("vtkmodules.vtkIOXML") {
        return;
    }
    for dim in [2, 3] {
        let mesh = samples::nested(dim);
        let triangulation = mesh.triangulation().unwrap();
        let read = as_read_by(VTK, &mesh, &format!("vtk-{dim}.ply"), &["5"]);
        let (points, vertices) = read.trim_end().split_once('\n').unwrap();
        let rounded: Vec<u32> =
            in_space(triangulation).iter().map(|x| (*x as f32).to_bits()).collect();
        assert_eq!(points, format!("{rounded:?}"));
        let expected = match dim {
            2 => triangles(&format!("{:?}", triangulation.simplices)),
            _ => boundary(triangulation),
        };
        assert_eq!(triangles(vertices), expected);
    }
}
