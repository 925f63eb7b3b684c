//! Makes the points of one case and meshes them once, for a tool that counts what a process does;
//! prints the number of vertices. bench/instructions.sh runs it under callgrind.
//!
//!     one_run <dim> <n> <uniform | gaussian | clusters | sphere | lattice | finished | delaunay>

use netmesh_speed::cases::{Case, Kind};
use std::process::ExitCode;

fn case(arguments: &[String]) -> Option<Case> {
    let [dim, n, kind] = arguments else { return None };
    Some(Case { dim: dim.parse().ok()?, n: n.parse().ok()?, kind: Kind::named(kind)? })
}

fn vertices(case: &Case) -> netmesh::Result<usize> {
    let mut mesh = case.mesh()?;
    mesh.run(&case.options(), None)?;
    Ok(mesh.triangulation().map_or(0, |triangulation| triangulation.vertex_count()))
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(case) = case(&arguments) else {
        let kinds = Kind::ALL.map(Kind::name).join(" | ");
        eprintln!("usage: one_run <dim> <n> <{kinds}>");
        return ExitCode::from(2);
    };
    match vertices(&case) {
        Ok(vertices) => {
            println!("{vertices}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
