//! The boundary of an alpha shape in place of the mesh.

use crate::arguments::{AlphaChoice, Arguments};
use crate::exit_code::{ExitCode, Failure};
use crate::standard;
use netmesh::io::{SurfaceFormat, write_surface_file};
use netmesh::prepared::Prepared;
use netmesh::topology::{AlphaShape, Topology, connecting_alpha, optimal_alpha};
use netmesh::{Algorithm, Mesh};
use std::path::Path;

/// Measures of an alpha shape, for the summary and the record.
pub struct Measured {
    pub alpha: f64,
    pub volume: f64,
    pub topology: Topology,
}

/// Refuses what neither an alpha shape nor a surface through points can come of; `option` asks for
/// one of them.
pub fn require(arguments: &Arguments, option: &str, path: Option<&Path>) -> Result<(), Failure> {
    if arguments.meshing.options.algorithm == Algorithm::Svr {
        let message = format!(
            "{option} is of the Delaunay triangulation of the input; leave --algorithm svr out"
        );
        return Err(Failure::new(ExitCode::Usage, message));
    }
    path.map_or(Ok(()), |path| format(path).map(|_| ()))
}

/// Refuses a path whose extension names no format of surfaces, and standard output.
pub fn format(path: &Path) -> Result<SurfaceFormat, Failure> {
    if standard::is_meant(path) {
        let message = "standard output has no name that tells the format of a surface; name a file \
                       that ends with .ply, .off, .stl or .obj";
        return Err(Failure::new(ExitCode::Usage, message));
    }
    SurfaceFormat::from_path(path)
        .map_err(|error| Failure::writing(&path.display().to_string(), &error))
}

/// Refuses a dimension that no file of surfaces holds.
pub fn require_dimension(mesh: &Mesh, path: &Path) -> Result<(), Failure> {
    match mesh.inputs().dim() {
        2 | 3 => Ok(()),
        dim => {
            let message = format!(
                "{}: surfaces are written in 2D and 3D, and the input is {dim}D; without --output \
                 the summary has the shape's measures",
                path.display()
            );
            Err(Failure::new(ExitCode::Usage, message))
        }
    }
}

/// Measures the alpha shape, and writes its boundary if there is a path.
pub fn make(
    mesh: &Mesh,
    choice: AlphaChoice,
    path: Option<&Path>,
    threads: u32,
) -> Result<Measured, Failure> {
    let (prepared, triangulation) = (Prepared::default(), mesh.result()?);
    let (faces, values) = (prepared.faces(mesh, threads)?, prepared.alpha(mesh, threads)?);
    let alpha = match choice {
        AlphaChoice::Value(alpha) => alpha,
        AlphaChoice::Connected => connecting_alpha(faces, values)?,
        AlphaChoice::Optimal => optimal_alpha(faces, values, 1)?,
    };
    let shape = AlphaShape::new(faces, values, alpha)?;
    if let Some(path) = path {
        let boundary = shape.solid(triangulation)?.hull()?.vertices;
        let written =
            write_surface_file(mesh.inputs(), triangulation, &boundary, format(path)?, path);
        written.map_err(|error| Failure::writing(&path.display().to_string(), &error))?;
    }
    Ok(Measured { alpha, volume: shape.volume(triangulation)?, topology: shape.topology()? })
}
