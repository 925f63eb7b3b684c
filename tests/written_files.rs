//! Files of real meshes: what comes back, that it is always the same, and an independent reader.

use crate::directory::Directory;
use netmesh::io::{Format, read_points, write, write_file};
use netmesh::{Algorithm, Mesh, Options};
use std::fs;
use std::process::Command;

/// A mesh that a run made.
fn real_mesh(dim: usize) -> Mesh {
    let points: Vec<f64> = (0..60 * dim)
        .map(|i| {
            (i as f64 * 0.754_877_666_246_692_7 + (i * i) as f64 * 0.569_840_290_998_053_3).fract()
        })
        .collect();
    let mut mesh = Mesh::new(dim, 60, &points, 0).unwrap();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    mesh.run(&options, None).unwrap();
    mesh
}

#[test]
fn a_real_mesh_survives_its_files() {
    let directory = Directory::new("real");
    for dim in 2..=5 {
        let mesh = real_mesh(dim);
        let points = &mesh.triangulation().unwrap().points;
        let mut names = vec!["a.node", "a.xyz", "a.csv", "a.npy", "a.off"];
        if dim < 4 {
            names.extend(["a.msh", "a.mesh", "a.ply"]);
        }
        for name in names {
            let path = directory.join(name);
            write_file(&mesh, &path, Format::Auto).unwrap();
            let read = read_points(&path, Format::Auto).unwrap();
            let in_space = dim == 2 && ["a.off", "a.ply"].contains(&name);
            if in_space {
                let expected: Vec<f64> =
                    points.chunks_exact(2).flat_map(|p| [p[0], p[1], 0.0]).collect();
                assert_eq!((read.dim, &read.coordinates), (3, &expected), "{name}");
            } else {
                assert_eq!((read.dim, &read.coordinates), (dim, points), "{name}");
            }
        }
    }
    let names = ["a.csv", "a.ele", "a.mesh", "a.msh", "a.node", "a.npy", "a.off", "a.ply", "a.xyz"];
    assert_eq!(directory.names(), names);
}

/// Two runs, two files: not one byte differs, whatever the format and the way out.
#[test]
fn the_same_mesh_makes_the_same_bytes() {
    let directory = Directory::new("same");
    for dim in [2, 3, 4] {
        let (one, other) = (real_mesh(dim), real_mesh(dim));
        for format in WRITABLE {
            let (mut first, mut second) = (Vec::new(), Vec::new());
            let written = write(&one, format, &mut first);
            let only = match format {
                Format::Stl => 3,
                Format::Svg => 2,
                _ => dim,
            };
            if (dim > 3 || dim != only) && written.is_err() {
                continue;
            }
            written.unwrap();
            write(&other, format, &mut second).unwrap();
            assert!(first == second && !first.is_empty(), "{format:?}");
            if format != Format::TetgenNode {
                let path = directory.join("a");
                write_file(&one, &path, format).unwrap();
                assert!(fs::read(&path).unwrap() == first, "{format:?}");
            }
        }
    }
}

const WRITABLE: [Format; 14] = [
    Format::Vtu,
    Format::TetgenNode,
    Format::Gmsh,
    Format::Medit,
    Format::Off,
    Format::Ply,
    Format::Stl,
    Format::Xyz,
    Format::Csv,
    Format::Npy,
    Format::VoronoiJson,
    Format::DomainsJson,
    Format::Svg,
    Format::Html,
];

#[test]
fn meshio_reads_a_real_mesh() {
    const SCRIPT: &str = "
import sys, meshio
mesh = meshio.read(sys.argv[1])
print(mesh.points.astype('<f8').tobytes().hex(), sum(len(block.data) for block in mesh.cells))
";
    let import = Command::new("python3").args(["-c", "import meshio"]).output();
    if !import.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: python3 cannot import meshio");
        return;
    }
    let mesh = real_mesh(3);
    let directory = Directory::new("meshio");
    let path = directory.join("a.vtu");
    write_file(&mesh, &path, Format::Auto).unwrap();
    let output = Command::new("python3").args(["-c", SCRIPT]).arg(&path).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let triangulation = mesh.triangulation().unwrap();
    let bytes = triangulation.points.iter().flat_map(|x| x.to_le_bytes());
    let hex: String = bytes.map(|byte| format!("{byte:02x}")).collect();
    let expected = format!("{hex} {}\n", triangulation.simplex_count());
    assert_eq!(String::from_utf8(output.stdout).unwrap(), expected);
}
