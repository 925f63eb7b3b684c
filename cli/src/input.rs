//! Input: the file of points, or standard input.

use crate::arguments::Arguments;
use crate::choices::AddedValues;
use crate::exit_code::{ExitCode, Failure};
use crate::merging;
use crate::numbers::counted;
use crate::origins::{InFiles, Origins};
use crate::standard;
use crate::words::CommandLine;
use netmesh::io::{self, Choice, Format, Merged, Table};
use netmesh::mesh::FacetTriangulation;
use netmesh::{Error, ErrorKind, Mesh, Result};
use std::fmt::{Display, Formatter};
use std::path::{Path, PathBuf};

/// Input that was read.
pub struct Input {
    pub mesh: Mesh,
    /// Files of `--with`.
    pub further: Vec<Further>,
    pub origins: Origins,
    /// Result of `--merge`.
    pub merged: Option<Merged>,
    /// Polygons that have become triangles, since other files have some.
    pub mixed: Mixed,
}

/// Polygons of files that are meshed together with triangles of others.
#[derive(Default)]
pub struct Mixed {
    /// Number of polygons that have become triangles.
    pub polygons: usize,
    /// Number of these that have no area.
    pub without_area: usize,
    /// Number of triangles with a corner twice, which are no polygons.
    pub without_corners: usize,
    /// Reason why triangles were taken for polygons instead, for a diagnosis.
    pub refusal: Option<String>,
}

/// File that is meshed together with the input.
pub struct Further {
    pub name: String,
    pub points: usize,
    pub facets: Marked,
    pub segments: Marked,
}

/// Number of facets or segments that a file has, and the least and largest of their markers, if
/// there are any.
pub struct Marked {
    pub count: usize,
    pub markers: Option<(i32, i32)>,
}

impl Marked {
    fn of(count: usize, markers: &[i32]) -> Self {
        let range = markers.iter().min().zip(markers.iter().max());
        Self { count, markers: range.map(|(&least, &largest)| (least, largest)) }
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
    let name = standard::input_name(&arguments.input);
    let hinted = |failure: Failure, error: &Error| {
        let may_need_columns = error.message().ends_with(NO_OTHER_COLUMNS);
        match error.kind() {
            ErrorKind::Dimension => with_hint(failure, arguments),
            _ if may_need_columns => with_hint(failure, arguments),
            _ => failure,
        }
    };
    let table = table(arguments);
    let mut table = table.map_err(|error| hinted(Failure::reading(&name, &error), &error))?;
    let (mut mixed, mut origins) = (Mixed::default(), Origins::of(name, &table));
    let append = |path: &PathBuf| append(&mut table, &mut origins, path, &mut mixed, arguments);
    let further = arguments.with.iter().map(append).collect::<std::result::Result<_, Failure>>()?;
    let merged = merging::merge(&mut table, arguments)?;
    if let Some(merged) = &merged {
        origins.leave_out(&merged.left_out);
    }
    let mesh = table.mesh(arguments.added_values == AddedValues::Linear).map_err(|error| {
        let words = InFiles { words: CommandLine::default(), origins: &origins };
        hinted(Failure::reading_in(&names(arguments), &error, words), &error)
    })?;
    Ok(Input { mesh, further, origins, merged, mixed })
}

/// Appends what a further file has.
fn append(
    table: &mut Table,
    origins: &mut Origins,
    path: &Path,
    mixed: &mut Mixed,
    arguments: &Arguments,
) -> std::result::Result<Further, Failure> {
    let name = path.display().to_string();
    let choice = Choice { has_points_alone: arguments.points, ..Choice::default() };
    let further = io::read_table_file(path, Format::Auto, &choice);
    let mut further = further.map_err(|error| Failure::reading(&name, &error))?;
    let mut own = Origins::of(name.clone(), &further);
    let read = [further.outline.facets.count(), further.outline.segments.len()];
    make_alike([(table, origins), (&mut further, &mut own)], mixed, arguments)?;
    let (facets, segments) = (table.outline.facets.count(), table.outline.segments.len());
    origins.append(own, table);
    table.append(&further).map_err(|error| Failure::reading(&name, &error.of_content()))?;
    let outline = &table.outline;
    Ok(Further {
        name,
        points: further.points.coordinates.len() / further.points.dim,
        facets: Marked::of(read[0], &outline.facets.markers[facets..]),
        segments: Marked::of(read[1], &outline.markers[segments..]),
    })
}

/// Makes triangles of polygons if one of two tables has polygons and the other one triangles. Where
/// that cannot be, a diagnosis takes the triangles for polygons.
fn make_alike(
    mut tables: [(&mut Table, &mut Origins); 2],
    mixed: &mut Mixed,
    arguments: &Arguments,
) -> std::result::Result<(), Failure> {
    let facets = tables.each_ref().map(|(table, _)| &table.outline.facets);
    if facets.iter().any(|own| own.count() == 0) {
        return Ok(());
    }
    let Some(of_polygons) = facets.iter().position(|own| !own.are_triangles) else { return Ok(()) };
    if !facets[1 - of_polygons].are_triangles {
        return Ok(());
    }
    let (table, origins) = &mut tables[of_polygons];
    let error = match split(table) {
        Ok(made) => {
            mixed.polygons += origins.count();
            mixed.without_area += made.without_area;
            origins.split(&made.parents);
            return Ok(());
        }
        Err(error) => error,
    };
    let words = InFiles { words: CommandLine::default(), origins };
    let names = origins.files();
    let Failure { code, message } = Failure::reading_in(&names, &error.of_content(), words);
    let rule = "beside the triangles of other files, polygons have to become triangles";
    let failure = Failure::new(code, format!("{message}; {rule}"));
    if arguments.diagnose.is_none() || code != ExitCode::InputRefused {
        return Err(failure);
    }
    let (table, origins) = &mut tables[1 - of_polygons];
    let taken = table.take_triangles_as_polygons();
    let left_out = taken.map_err(|error| Failure::reading(&origins.files(), &error))?;
    origins.leave_out(&left_out);
    mixed.refusal.get_or_insert(failure.message);
    mixed.without_corners += left_out.len();
    Ok(())
}

/// Makes triangles of the polygons of a table.
fn split(table: &mut Table) -> Result<FacetTriangulation> {
    let mut mesh = table.mesh(false)?;
    let made = mesh.split_facets()?;
    table.outline.facets = mesh.given_facets().clone();
    Ok(made)
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
