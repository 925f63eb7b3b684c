//! Input: the file of points, or standard input.

use crate::arguments::Arguments;
use crate::choices::AddedValues;
use crate::exit_code::{ExitCode, Failure};
use crate::standard;
use netmesh::io::{self, Format, Table};
use netmesh::{Error, ErrorKind, Mesh, Result};

pub fn read(arguments: &Arguments) -> std::result::Result<Mesh, Failure> {
    let reading = |error: Error| {
        let failure = Failure::reading(&standard::input_name(&arguments.input), &error);
        let may_need_columns = error.message().ends_with(NO_OTHER_COLUMNS);
        match error.kind() {
            ErrorKind::Dimension => with_hint(failure, arguments),
            _ if may_need_columns => with_hint(failure, arguments),
            _ => failure,
        }
    };
    mesh(arguments).map_err(reading)
}

/// End of the library's refusal of `--attributes all` where there are no attributes.
const NO_OTHER_COLUMNS: &str = "every column of the file is a coordinate";

/// Returns the points of the input with their attributes.
fn mesh(arguments: &Arguments) -> Result<Mesh> {
    table(arguments)?.mesh(arguments.added_values == AddedValues::Linear)
}

fn table(arguments: &Arguments) -> Result<Table> {
    let (choice, format) = (arguments.choice(), arguments.input_format());
    match standard::is_meant(&arguments.input) {
        true => io::read_table(&mut std::io::stdin().lock(), format, &choice),
        false => io::read_table_file(&arguments.input, format, &choice),
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

/// Adds a hint about `--columns` to a failure: points of too many dimensions are often points with
/// other columns beside their coordinates.
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
