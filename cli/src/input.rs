//! Input: the file of points, or standard input.

use crate::arguments::Arguments;
use crate::choices::AddedValues;
use crate::exit_code::{ExitCode, Failure};
use crate::merging;
use crate::numbers::counted;
use crate::standard;
use netmesh::io::{self, Choice, Format, Table};
use netmesh::{Error, ErrorKind, Mesh, Result};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Input that was read.
pub struct Input {
    pub mesh: Mesh,
    /// Lines about the files of `--with`.
    pub further: Vec<String>,
    /// Line about corners that `--merge` has made one.
    pub merged: Option<String>,
}

/// Returns the name of the input in messages about what was read, with the number of files of
/// `--with`.
pub fn names(arguments: &Arguments) -> String {
    let name = standard::input_name(&arguments.input);
    match arguments.with.len() {
        0 => name,
        more => format!("{name} and {}", counted(more as u64, "further file", "further files")),
    }
}

/// Reads the input and the files of `--with`.
pub fn read(arguments: &Arguments) -> std::result::Result<Input, Failure> {
    let reading = |error: Error| {
        let failure = Failure::reading(&standard::input_name(&arguments.input), &error);
        let may_need_columns = error.message().ends_with(NO_OTHER_COLUMNS);
        match error.kind() {
            ErrorKind::Dimension => with_hint(failure, arguments),
            _ if may_need_columns => with_hint(failure, arguments),
            _ => failure,
        }
    };
    let mut table = table(arguments).map_err(reading)?;
    let append = |path: &PathBuf| append(&mut table, path, arguments);
    let further = arguments.with.iter().map(append).collect::<std::result::Result<_, Failure>>()?;
    let merged = merging::merge(&mut table, arguments)?;
    let mesh = table.mesh(arguments.added_values == AddedValues::Linear).map_err(reading)?;
    Ok(Input { mesh, further, merged })
}

/// Appends what a further file has; returns a line about it.
fn append(
    table: &mut Table,
    path: &Path,
    arguments: &Arguments,
) -> std::result::Result<String, Failure> {
    let name = path.display().to_string();
    let choice = Choice { has_points_alone: arguments.points, ..Choice::default() };
    let further = io::read_table_file(path, Format::Auto, &choice);
    let further = further.map_err(|error| Failure::reading(&name, &error))?;
    let (facets, segments) = (table.outline.facets.count(), table.outline.segments.len());
    table.append(&further).map_err(|error| Failure::reading(&name, &error.of_content()))?;
    let points = further.points.coordinates.len() / further.points.dim;
    let mut line = format!("{name}: {}", counted(points as u64, "point", "points"));
    let outline = &table.outline;
    for (markers, one, many) in [
        (&outline.facets.markers[facets..], "facet", "facets"),
        (&outline.markers[segments..], "segment", "segments"),
    ] {
        if let Some((least, largest)) = markers.iter().min().zip(markers.iter().max()) {
            let range = if least == largest { "marker" } else { "markers" };
            let count = counted(markers.len() as u64, one, many);
            let _ = write!(line, ", {count} with the {range} {least}");
            if least != largest {
                let _ = write!(line, " to {largest}");
            }
        }
    }
    Ok(line)
}

/// End of the library's refusal of `--attributes all` where there are no attributes.
const NO_OTHER_COLUMNS: &str = "every column of the file is a coordinate";

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
