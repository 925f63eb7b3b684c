//! Input: the file of points, or standard input.

use crate::arguments::Arguments;
use crate::choices::AddedValues;
use crate::exit_code::{ExitCode, Failure};
use crate::merging;
use crate::numbers::counted;
use crate::standard;
use netmesh::io::{self, Choice, Format, Merged, Table};
use netmesh::{Error, ErrorKind, Mesh, Result};
use std::fmt::{Display, Formatter};
use std::path::{Path, PathBuf};

/// Input that was read.
pub struct Input {
    pub mesh: Mesh,
    /// Files of `--with`.
    pub further: Vec<Further>,
    /// Number of corners that `--merge` has made one.
    pub merged: Option<Merged>,
    /// Number of polygons that have become triangles, since other files have some.
    pub mixed: usize,
}

/// File that is meshed together with the input.
pub struct Further {
    pub name: String,
    pub points: usize,
    pub facets: Marked,
    pub segments: Marked,
}

/// Number of facets or segments of a file, and the least and largest of their markers, if there are
/// any.
pub struct Marked {
    pub count: usize,
    pub markers: Option<(i32, i32)>,
}

impl Marked {
    fn of(markers: &[i32]) -> Self {
        let range = markers.iter().min().zip(markers.iter().max());
        Self { count: markers.len(), markers: range.map(|(&least, &largest)| (least, largest)) }
    }
}

impl Display for Further {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.name, counted(self.points as u64, "point", "points"))?;
        for (marked, one, many) in
            [(&self.facets, "facet", "facets"), (&self.segments, "segment", "segments")]
        {
            let Some((least, largest)) = marked.markers else { continue };
            write!(f, ", {}", counted(marked.count as u64, one, many))?;
            match least == largest {
                true => write!(f, " with the marker {least}")?,
                false => write!(f, " with the markers {least} to {largest}")?,
            }
        }
        Ok(())
    }
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
    let mut mixed = 0;
    let append = |path: &PathBuf| append(&mut table, path, &mut mixed, arguments);
    let further = arguments.with.iter().map(append).collect::<std::result::Result<_, Failure>>()?;
    let merged = merging::merge(&mut table, arguments)?;
    let mesh = table.mesh(arguments.added_values == AddedValues::Linear).map_err(reading)?;
    Ok(Input { mesh, further, merged, mixed })
}

/// Appends what a further file has.
fn append(
    table: &mut Table,
    path: &Path,
    mixed: &mut usize,
    arguments: &Arguments,
) -> std::result::Result<Further, Failure> {
    let name = path.display().to_string();
    let choice = Choice { has_points_alone: arguments.points, ..Choice::default() };
    let further = io::read_table_file(path, Format::Auto, &choice);
    let mut further = further.map_err(|error| Failure::reading(&name, &error))?;
    *mixed += split_unless_alike(table, &mut further, &name, arguments)?;
    let (facets, segments) = (table.outline.facets.count(), table.outline.segments.len());
    table.append(&further).map_err(|error| Failure::reading(&name, &error.of_content()))?;
    let outline = &table.outline;
    Ok(Further {
        name,
        points: further.points.coordinates.len() / further.points.dim,
        facets: Marked::of(&outline.facets.markers[facets..]),
        segments: Marked::of(&outline.markers[segments..]),
    })
}

/// Makes triangles of polygons if one file has polygons and the other one triangles. Returns the
/// number of polygons.
fn split_unless_alike(
    table: &mut Table,
    further: &mut Table,
    name: &str,
    arguments: &Arguments,
) -> std::result::Result<usize, Failure> {
    let [own, given] = [&*table, &*further].map(|table| &table.outline.facets);
    if own.count() == 0 || given.count() == 0 || own.are_triangles == given.are_triangles {
        return Ok(0);
    }
    let (polygons, name) = match own.are_triangles {
        true => (further, name.to_owned()),
        false => (table, standard::input_name(&arguments.input)),
    };
    split(polygons).map_err(|error| {
        let Failure { code, message } = Failure::reading(&name, &error.of_content());
        let rule = "beside the triangles of other files, polygons have to become triangles";
        Failure::new(code, format!("{message}; {rule}"))
    })
}

/// Makes triangles of polygons. Returns the number of polygons.
fn split(table: &mut Table) -> Result<usize> {
    let mut mesh = table.mesh(false)?;
    let polygons = mesh.triangulate_facets()?;
    table.outline.facets = mesh.given_facets().clone();
    Ok(polygons)
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
