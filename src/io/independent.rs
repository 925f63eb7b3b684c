//! Readers that others wrote, on files that this crate wrote. They need `python3` with `meshio` on
//! the search path; where that is missing these tests say so and pass.

use super::{Format, samples, write_file};
use crate::mesh::{Mesh, Triangulation};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Prints the bits of the points, then the corners of all cells of the type, then integer arrays.
const SCRIPT: &str = "
import sys, contextlib
with contextlib.redirect_stdout(sys.stderr):
    import meshio, numpy
    mesh = meshio.read(sys.argv[1])
print(numpy.ascontiguousarray(mesh.points, '<f8').view('<u8').ravel().tolist())
print(numpy.concatenate([block.data.ravel() for block in mesh.cells if block.type == sys.argv[2]]).tolist())
for name in sys.argv[3:]:
    print(mesh.point_data[name].astype('i8').ravel().tolist())
";

fn python_has_meshio() -> bool {
    let import = Command::new("python3").args(["-c", "import meshio"]).output();
    let found = import.is_ok_and(|output| output.status.success());
    if !found {
        eprintln!("skipped: python3 cannot import meshio");
    }
    found
}

/// What meshio finds in the file that `write_file` makes of `mesh`.
fn as_read_by_meshio(mesh: &Mesh, name: &str, format: Format, arguments: &[&str]) -> String {
    let directory = std::env::temp_dir().join(format!("netmesh-{}-{name}", std::process::id()));
    fs::create_dir(&directory).unwrap();
    let path = directory.join(name);
    write_file(mesh, &path, format).unwrap();
    let output = run_script(&path, arguments);
    fs::remove_dir_all(&directory).unwrap();
    output
}

fn run_script(path: &Path, arguments: &[&str]) -> String {
    let mut python = Command::new("python3");
    let output = python.args(["-c", SCRIPT]).arg(path).args(arguments).output().unwrap();
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

#[test]
fn meshio_reads_vtu() {
    if !python_has_meshio() {
        return;
    }
    for (dim, cells) in [(2, "triangle"), (3, "tetra")] {
        let mesh = samples::mesh(dim);
        let triangulation = mesh.triangulation().unwrap();
        let arguments = [cells, "kind", "domain", "precision_limited"];
        let read = as_read_by_meshio(&mesh, &format!("{dim}.vtu"), Format::Auto, &arguments);
        let kinds: Vec<u8> = triangulation.kinds.iter().map(|kind| *kind as u8).collect();
        let limited: Vec<u8> = triangulation.precision_limited.iter().map(|l| *l as u8).collect();
        let arrays = format!("{kinds:?}\n{:?}\n{limited:?}\n", triangulation.vertex_domains);
        assert_eq!(read, expected(triangulation, 3) + &arrays);
    }
}

#[test]
fn meshio_reads_tetgen() {
    if !python_has_meshio() {
        return;
    }
    let mesh = samples::mesh(3);
    let read = as_read_by_meshio(&mesh, "a.ele", Format::Auto, &["tetra"]);
    assert_eq!(read, expected(mesh.triangulation().unwrap(), 3));
}

#[test]
fn meshio_reads_planar_off() {
    if !python_has_meshio() {
        return;
    }
    let mesh = samples::mesh(2);
    let read = as_read_by_meshio(&mesh, "a.off", Format::Auto, &["triangle"]);
    assert_eq!(read, expected(mesh.triangulation().unwrap(), 3));
}
