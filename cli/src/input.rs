//! Where the points come from.

use crate::arguments::Arguments;
use crate::exit_code::{ExitCode, Failure};
use crate::standard;
use netmesh::io::{self, Columns, Format, PointCloud};
use netmesh::{Error, ErrorKind, Mesh, Result};

pub fn read(arguments: &Arguments) -> std::result::Result<Mesh, Failure> {
    let reading = |error: Error| {
        let failure = Failure::reading(&standard::input_name(&arguments.input), &error);
        match error.kind() {
            ErrorKind::Dimension => with_hint(failure, arguments),
            _ => failure,
        }
    };
    let cloud = points(arguments).map_err(reading)?;
    let count = cloud.coordinates.len().checked_div(cloud.dim).unwrap_or(0);
    Mesh::new(cloud.dim, count, &cloud.coordinates, 0).map_err(reading)
}

fn points(arguments: &Arguments) -> Result<PointCloud> {
    let none = Columns::default();
    let columns = arguments.columns.as_ref().unwrap_or(&none);
    let format = arguments.input_format();
    match standard::is_meant(&arguments.input) {
        true => io::read_columns(&mut std::io::stdin().lock(), format, columns),
        false => io::read_points_of_columns(&arguments.input, format, columns),
    }
}

/// Refuses standard input without a format.
pub fn require_format(arguments: &Arguments) -> std::result::Result<(), Failure> {
    if !standard::is_meant(&arguments.input) || arguments.input_format() != Format::Auto {
        return Ok(());
    }
    let message = "standard input has no name that tells the format; add --input-format, for \
                   example --input-format xyz";
    Err(Failure::new(ExitCode::Usage, message))
}

/// Points of too many dimensions are often points with other columns beside their coordinates.
pub fn with_hint(failure: Failure, arguments: &Arguments) -> Failure {
    let format = match arguments.input_format() {
        Format::Auto => Format::from_path(&arguments.input).unwrap_or_default(),
        named => named,
    };
    if arguments.columns.is_some() || !matches!(format, Format::Xyz | Format::Csv | Format::Npy) {
        return failure;
    }
    let hint =
        "; if not all columns of the input are coordinates, name those that are with --columns";
    Failure::new(failure.code, failure.message + hint)
}
