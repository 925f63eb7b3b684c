//! Readers that others wrote, on files that this crate wrote. They need `python3` on the search path,
//! with `meshio` and `vtk`; where one is missing its tests say so and pass.

use super::{Format, samples, write_file};
use crate::mesh::{Mesh, Triangulation};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Prints the bits of the points, then the corners of all cells of a type, then integer arrays.
/// Its arguments: the path, meshio's name and VTK's number of the cells' type, names of arrays.
const MESHIO: &str = "
import sys, contextlib
with contextlib.redirect_stdout(sys.stderr):
    import meshio, numpy
    mesh = meshio.read(sys.argv[1])
print(numpy.ascontiguousarray(mesh.points, '<f8').view('<u8').ravel().tolist())
print(numpy.concatenate([block.data.ravel() for block in mesh.cells if block.type == sys.argv[2]]).tolist())
for name in sys.argv[4:]:
    print(mesh.point_data[name].astype('i8').ravel().tolist())
";

/// The same with the reader that ParaView has.
const VTK: &str = "
import sys, vtk, numpy
from vtk.util.numpy_support import vtk_to_numpy
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
assert reader.GetErrorCode() == 0
grid = reader.GetOutput()
corners = []
for i in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(i)
    if cell.GetCellType() == int(sys.argv[3]):
        corners += [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
print(vtk_to_numpy(grid.GetPoints().GetData()).astype('<f8').view('<u8').ravel().tolist())
print(corners)
for name in sys.argv[4:]:
    print(vtk_to_numpy(grid.GetPointData().GetArray(name)).astype('i8').ravel().tolist())
";

fn python_has(module: &str) -> bool {
    let import = Command::new("python3").args(["-c", &format!("import {module}")]).output();
    let found = import.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: python3 cannot import {module}");
    }
    found
}

/// What `script` finds in the file called `name` that `write_file` makes of `mesh`.
fn as_read_by(script: &str, mesh: &Mesh, name: &str, arguments: &[&str]) -> String {
    let directory =
        std::env::temp_dir().join(format!("netmesh-{}-independent-{name}", std::process::id()));
    fs::create_dir(&directory).unwrap();
    let path = directory.join(name);
    write_file(mesh, &path, Format::Auto).unwrap();
    let output = run(script, &path, arguments);
    fs::remove_dir_all(&directory).unwrap();
    output
}

fn run(script: &str, path: &Path, arguments: &[&str]) -> String {
    let mut python = Command::new("python3");
    let output = python.args(["-c", script]).arg(path).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The script's first two lines for `mesh`, with points of `columns` coordinates.
fn expected(mesh: &Triangulation, columns: usize) -> String {
    let bits: Vec<u64> = mesh
        .points
        .chunks_exact(mesh.dim)
        .flat_map(|point| (0..columns).map(|axis| point.get(axis).unwrap_or(&0.0).to_bits()))
        .collect();
    format!("{bits:?}\n{:?}\n", mesh.simplices)
}

/// Both dimensions, with every array.
fn assert_reads_vtu(script: &str, reader: &str) {
    for (dim, meshio_type, vtk_type) in [(2, "triangle", "5"), (3, "tetra", "10")] {
        let mesh = samples::mesh(dim);
        let triangulation = mesh.triangulation().unwrap();
        let arguments = [meshio_type, vtk_type, "kind", "domain", "precision_limited"];
        let read = as_read_by(script, &mesh, &format!("{reader}-{dim}.vtu"), &arguments);
        let kinds: Vec<u8> = triangulation.kinds.iter().map(|kind| *kind as u8).collect();
        let limited: Vec<u8> = triangulation.precision_limited.iter().map(|l| *l as u8).collect();
        let arrays = format!("{kinds:?}\n{:?}\n{limited:?}\n", triangulation.vertex_domains);
        assert_eq!(read, expected(triangulation, 3) + &arrays);
    }
}

#[test]
fn meshio_reads_vtu() {
    if python_has("meshio") {
        assert_reads_vtu(MESHIO, "meshio");
    }
}

#[test]
fn vtk_reads_vtu() {
    if python_has("vtk") {
        assert_reads_vtu(VTK, "vtk");
    }
}

#[test]
fn meshio_reads_tetgen() {
    if python_has("meshio") {
        let mesh = samples::mesh(3);
        let read = as_read_by(MESHIO, &mesh, "a.ele", &["tetra", "10"]);
        assert_eq!(read, expected(mesh.triangulation().unwrap(), 3));
    }
}

#[test]
fn meshio_reads_planar_off() {
    if python_has("meshio") {
        let mesh = samples::mesh(2);
        let read = as_read_by(MESHIO, &mesh, "a.off", &["triangle", "5"]);
        assert_eq!(read, expected(mesh.triangulation().unwrap(), 3));
    }
}
