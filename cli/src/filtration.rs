//! A filtration in place of the mesh.

use crate::arguments::Arguments;
use crate::choices::FiltrationName;
use crate::exit_code::{ExitCode, Failure};
use crate::standard;
use netmesh::io::{FiltrationFormat, write_filtration_file};
use netmesh::prepared::Prepared;
use netmesh::{Algorithm, Mesh};
use std::path::Path;

/// Refuses what no filtration can come of.
pub fn require(arguments: &Arguments, path: &Path) -> Result<(), Failure> {
    let algorithm = arguments.meshing.options.algorithm;
    if arguments.filtration == Some(FiltrationName::Alpha) && algorithm == Algorithm::Svr {
        let message = "--filtration alpha is of the Delaunay triangulation of the input; leave \
                       --algorithm svr out";
        return Err(Failure::new(ExitCode::Usage, message));
    }
    format(path).map(|_| ())
}

/// Refuses a path whose extension names no format of filtrations, and standard output.
fn format(path: &Path) -> Result<FiltrationFormat, Failure> {
    if standard::is_meant(path) {
        let message = "standard output has no name that tells the format of a filtration; name a \
                       file that ends with .filtration or .dipha";
        return Err(Failure::new(ExitCode::Usage, message));
    }
    FiltrationFormat::from_path(path)
        .map_err(|error| Failure::writing(&path.display().to_string(), &error))
}

/// Makes the filtration and writes it.
pub fn write(
    mesh: &Mesh,
    kind: FiltrationName,
    path: &Path,
    arguments: &Arguments,
) -> Result<(), Failure> {
    let format = format(path)?;
    let (prepared, threads) = (Prepared::default(), arguments.meshing.options.threads);
    let filtration = match kind {
        FiltrationName::Alpha => prepared.alpha(mesh, threads)?,
        FiltrationName::Mesh => prepared.distances(mesh, threads)?,
    };
    let faces = prepared.faces(mesh, threads)?;
    write_filtration_file(mesh.inputs(), faces, filtration, format, path)
        .map_err(|error| Failure::writing(&path.display().to_string(), &error))
}
