//! Files: points are read, points and meshes are written, a file per format.
//!
//! | Format | extensions | read | write |
//! |---|---|---|---|
//! | [`Format::Vtu`] | `.vtu` | | mesh, d = 2, 3 |
//! | [`Format::TetgenNode`] | `.node`, `.ele` | points | mesh |
//! | [`Format::Poly`] | `.poly` | points, segments (d = 2), facets (d = 3), regions | |
//! | [`Format::Smesh`] | `.smesh` | points, facets, regions, d = 3 | |
//! | [`Format::Stl`] | `.stl` | points, triangles, d = 3 | boundary, d = 3 |
//! | [`Format::Obj`] | `.obj` | points, facets, segments, d = 3 | |
//! | [`Format::Geojson`] | `.geojson` | points, segments, d = 2 | |
//! | [`Format::Wkt`] | `.wkt` | points, segments, d = 2 | |
//! | [`Format::Gmsh`] | `.msh` | points, d = 2, 3 | mesh, d = 2, 3 |
//! | [`Format::Medit`] | `.mesh` | points, d = 2, 3 | mesh, d = 2, 3 |
//! | [`Format::Off`] | `.off` | points, faces | mesh |
//! | [`Format::Ply`] | `.ply` | points, d = 2, 3; faces, d = 3 | mesh, d = 2; boundary, d = 3 |
//! | [`Format::Xyz`] | `.xyz`, `.txt`, `.xy`, `.pts` | points | points |
//! | [`Format::Csv`] | `.csv` | points | points |
//! | [`Format::Npy`] | `.npy` | points | points |
//! | [`Format::VoronoiJson`] | `.voronoi.json` | | Voronoi diagram |
//! | [`Format::DomainsJson`] | `.domains.json` | | domains and cages |
//! | [`Format::Svg`] | `.svg` | | picture, d = 2 |
//! | [`Format::Html`] | `.html` | | mesh with a viewer, d = 2, 3 |
//!
//! [`read_table`] reads columns of a file as attributes of its points, [`write_with`] writes
//! attributes to the formats that hold them ([`Format::holds_attributes`]).
//!
//! **Text that is read** is UTF-8 (a byte order mark is skipped), with lines of at most 1 MiB that
//! end with LF or CR LF. From `#` to the end of a line is a comment; blank lines are skipped.
//! Numbers are decimal (`-1.5e-7`), correctly rounded to the nearest double: one too large for a
//! double is refused, one too small becomes a zero. Files are streamed and no declared count is
//! believed before its data is there.
//!
//! **Text that is written** carries the shortest decimal that reads back as the same double, bit by
//! bit, -0.0 and subnormals included. The same mesh makes the same bytes.

mod append;
mod attributes;
mod binary;
mod buffered;
mod choice;
mod columns;
mod csv;
mod data;
mod diagnosis;
mod domains;
mod features;
mod filtration;
mod format;
mod geojson;
mod gmsh;
mod html;
#[cfg(test)]
mod independent;
mod json;
mod layout;
mod medit;
mod merging;
mod npy;
mod obj;
mod off;
mod outer;
mod picture;
mod ply;
mod poly;
mod polygons;
mod replace;
#[cfg(test)]
pub(crate) mod samples;
mod scanner;
mod stl;
mod surface;
mod svg;
mod tetgen;
mod text;
mod values;
mod voronoi;
pub mod vtk;
mod vtu;
mod wkt;
mod xyz;

pub(crate) use buffered::Buffered;
pub use choice::{AttributeColumns, Choice};
pub use columns::Columns;
pub use data::Data;
pub use diagnosis::write_diagnosis_file;
pub use filtration::{FiltrationFormat, write_filtration, write_filtration_file};
pub use format::Format;
pub use merging::Merged;
pub use surface::{SurfaceFormat, write_surface, write_surface_file};
pub use values::{Outline, Table};

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::AllocError;
use crate::mesh::{Attribute, Boundary, Mesh, Triangulation};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

/// Points as read from a file: `coordinates` is `n x dim`, n >= 1, every coordinate finite.
#[derive(Clone, Debug, PartialEq)]
pub struct PointCloud {
    pub dim: usize,
    pub coordinates: Vec<f64>,
}

impl PointCloud {
    pub(crate) fn count(&self) -> usize {
        self.coordinates.len().checked_div(self.dim).unwrap_or(0)
    }
}

/// Reads the points of a file. Messages name the path, and where it applies line and column, both
/// counted from 1, or the byte of binary data.
///
/// # Errors
/// - `Io`: no such file, a directory, or reading fails;
/// - `InvalidArgument`: a format that cannot be read, or an extension that names none or a format
///   of surfaces that is not read (3MF, glTF);
/// - `Format`: not a number, a number too large for a double, rows of differing length, no points,
///   counts and ids that do not fit the data, a file that ends early or goes on after its end, a
///   line over 1 MiB, NUL bytes, text that is not UTF-8, a variant of the format that is not read;
/// - `NonFinite`: `nan` or `inf` where a coordinate should be;
/// - `Dimension`: points of a dimension outside 2 to 8;
/// - `OutOfMemory`.
pub fn read_points(path: &Path, format: Format) -> Result<PointCloud> {
    Ok(read_table_file(path, format, &Choice::default())?.points)
}

/// Reads points as [`read_points`] does, with a choice of the columns that are the coordinates, as
/// files often have more, and of those that become attributes of the points.
///
/// # Errors
/// Fails as [`read_points`] does; `InvalidArgument`: columns that are not there, names in a file
/// that has none, a format without columns to choose, a name that no attribute can have.
pub fn read_table_file(path: &Path, format: Format, choice: &Choice) -> Result<Table> {
    let format = format.resolve_input(path)?;
    let points = input_path(path, format)?;
    let mut table = in_file(&points, |input| read_named(input, format, choice, Some(&points)))?;
    // An `.ele` file by whose name the points are found has more to say, where it is.
    if points != path && path.exists() {
        let left_out = &mut table.left_out;
        in_file(path, |input| tetgen::leave_out(text::Lines::new(input), left_out))?;
    }
    Ok(table)
}

/// Returns what `read` makes of a file, whose name it gives to errors.
fn in_file<T>(path: &Path, read: impl FnOnce(&mut dyn BufRead) -> Result<T>) -> Result<T> {
    let in_file = |error: Error| error.within(&path.display());
    let file = File::open(path).map_err(|error| in_file(io_error("cannot open", &error)))?;
    read(&mut BufReader::with_capacity(1 << 16, file)).map_err(in_file)
}

/// Returns the file that [`read_points`] opens: of TetGen's pair the `.node` part.
///
/// # Errors
/// `InvalidArgument`: a format that cannot be read, or an extension that names none.
pub fn input_path(path: &Path, format: Format) -> Result<PathBuf> {
    let format = format.resolve_input(path)?;
    format.check_readable()?;
    match format {
        Format::TetgenNode => Ok(tetgen::paths(path).0),
        _ => Ok(path.to_path_buf()),
    }
}

/// Returns the files that [`write_file`] makes of every mesh: one, of TetGen's format two.
///
/// # Errors
/// `InvalidArgument`: an extension that names no format.
pub fn output_paths(path: &Path, format: Format) -> Result<Vec<PathBuf>> {
    match format.resolve_output(path)? {
        Format::TetgenNode => {
            let (node, ele) = tetgen::paths(path);
            Ok(vec![node, ele])
        }
        _ => Ok(vec![path.to_path_buf()]),
    }
}

/// Returns the files that [`write_file`] makes besides, of a mesh of a dimension with segments or
/// facets: of TetGen's format the `.edge` part, and the `.poly` part in the plane or the `.face`
/// part in space.
///
/// # Errors
/// `InvalidArgument`: an extension that names no format.
pub fn part_paths(path: &Path, format: Format, dim: usize) -> Result<Vec<PathBuf>> {
    let format = format.resolve_output(path)?;
    let tetgen::Parts { edge, poly, face } = tetgen::Parts::new(path);
    match (format, dim) {
        (Format::TetgenNode, 2) => Ok(vec![edge, poly]),
        (Format::TetgenNode, 3) => Ok(vec![edge, face]),
        _ => Ok(Vec::new()),
    }
}

/// Returns the files under temporary names that [`write_file`] has made for `path` in this process
/// and not yet renamed or removed: those that a program that ends in the middle must remove.
pub fn unfinished_files(path: &Path) -> Vec<PathBuf> {
    replace::temporary_files(path)
}

/// Refuses a path that [`write_file`] could not write to, at once and before there is a mesh: a
/// missing directory or one that takes no files, a directory, a read-only file, a name that is too
/// long. Makes a file under a temporary name beside it, and removes it. A disk may still fill up
/// until the mesh is there; a device or a pipe is not opened.
///
/// # Errors
/// `Io`, as [`write_file`] has it.
pub fn require_writable(path: &Path) -> Result<()> {
    replace::require_writable(path)
}

/// Returns the path that the symbolic links at `path` lead to, whether a file is there or not.
///
/// # Errors
/// `Io`: links that lead to each other.
pub fn follow_links(path: &Path) -> Result<PathBuf> {
    replace::follow_links(path)
}

/// Writes text to a file as [`write_file`] does a mesh: all or nothing, links followed, a device
/// or a pipe written into.
///
/// # Errors
/// `Io`.
pub fn write_text_file(path: &Path, text: &str) -> Result<()> {
    let body = |out: &mut dyn Write| out.write_all(text.as_bytes());
    match replace::open_stream(path)? {
        Some(mut stream) => body(&mut stream).map_err(|error| io_error("cannot write", &error)),
        None => replace::replace(&[(path, &body)]),
    }
}

/// Reads points from a stream.
///
/// # Errors
/// Fails as [`read_points`] does; [`Format::Auto`] is refused, as there is no extension.
pub fn read(input: &mut dyn BufRead, format: Format) -> Result<PointCloud> {
    Ok(read_table(input, format, &Choice::default())?.points)
}

/// Reads points and attributes from a stream.
///
/// # Errors
/// Fails as [`read_table_file`] does; [`Format::Auto`] is refused, as there is no extension.
pub fn read_table(input: &mut dyn BufRead, format: Format, choice: &Choice) -> Result<Table> {
    read_named(input, format, choice, None)
}

/// Reads points and attributes from a stream. `path` is that of the file, if there is one.
fn read_named(
    input: &mut dyn BufRead,
    format: Format,
    choice: &Choice,
    path: Option<&Path>,
) -> Result<Table> {
    format.check_readable()?;
    if !matches!(format, Format::Auto | Format::Xyz | Format::Csv | Format::Npy) {
        choice.coordinates.require_none(format.name())?;
    }
    let has_points_alone = matches!(format, Format::Gmsh | Format::Medit | Format::Off);
    let has_outline_alone =
        matches!(format, Format::Stl | Format::Obj | Format::Geojson | Format::Wkt);
    if has_points_alone || has_outline_alone {
        choice.attributes.require_none(format.name())?;
    }
    let mut table = match format {
        Format::Xyz => xyz::read(text::Lines::new(input), choice, path),
        Format::Csv => csv::read(text::Lines::with_quotes(input), choice),
        Format::Npy => npy::read(input, choice),
        Format::Ply => ply::read(input, &choice.attributes),
        Format::TetgenNode => tetgen::read(text::Lines::new(input), &choice.attributes),
        Format::Poly | Format::Smesh => {
            let grammar = match format {
                Format::Poly => poly::Grammar::Poly,
                _ => poly::Grammar::Smesh,
            };
            poly::read(text::Lines::new(input), grammar, &choice.attributes, path)
        }
        Format::Geojson => geojson::read(input),
        Format::Wkt => wkt::read(input),
        Format::Gmsh => gmsh::read(text::Lines::new(input)),
        Format::Medit => medit::read(text::Lines::new(input)),
        Format::Off => off::read(text::Lines::new(input)),
        Format::Stl => stl::read(input),
        Format::Obj => obj::read(text::Lines::new(input)),
        _ => Err(auto_without_path()),
    }?;
    if choice.has_points_alone {
        table.leave_outline();
    }
    Ok(table)
}

/// Writes `mesh` to `path`, all or nothing: to a new file beside it that is flushed, synchronised
/// and then renamed, so that a reader sees the old file or the complete new one. After an error the
/// old file is untouched and nothing is left beside it.
///
/// `TetgenNode` writes two files. `a.node` and `a.ele` both stand for the pair; any other name `b`
/// is that of the `.node` part and the other is `b.ele`. With segments or facets there are an
/// `.edge` part and, in the plane, a `.poly` part, in space a `.face` part too. All are complete
/// before any is renamed.
///
/// A symbolic link is followed, also to where no file is yet; a read-only file is refused; a
/// device or a pipe, which cannot be replaced, is written as by [`write()`].
///
/// # Errors
/// `Io`, and as [`write()`]; `InvalidArgument` for an extension that names no format.
pub fn write_file(mesh: &Mesh, path: &Path, format: Format) -> Result<()> {
    write_file_with(mesh, Data::default(), path, format)
}

/// Writes `mesh` to `path` as [`write_file`] does, with attributes at the vertices
/// ([`vertex_attributes`](crate::prepared::Prepared::vertex_attributes)), perhaps with measures
/// that have been made; formats that hold none do without.
///
/// # Errors
/// Fails as [`write_file`] does; `InvalidArgument` if the data is not that of the mesh.
pub fn write_file_with<'a>(
    mesh: &'a Mesh,
    data: impl Into<Data<'a>>,
    path: &Path,
    format: Format,
) -> Result<()> {
    let format = format.resolve_output(path)?;
    let content = Content::of(mesh, data.into(), format)?;
    if let Some(mut stream) = replace::open_stream(path)? {
        return content.write(&mut stream);
    }
    match content {
        Content::Tetgen(mesh, triangulation, attributes) => {
            let (node, ele) = tetgen::paths(path);
            let tetgen::Parts { edge, poly, face } = tetgen::Parts::new(path);
            let Markers { segments, facets } = Markers::of(mesh);
            let regions = mesh.outline_of_result().1;
            let write_poly: replace::Body<'_> =
                &|out| tetgen::write_poly(triangulation, segments, regions, out);
            let write_face: replace::Body<'_> =
                &|out| tetgen::write_face(triangulation, facets, out);
            let files: [(&Path, replace::Body<'_>); 4] = [
                (&node, &|out| tetgen::write_node(triangulation, attributes, out)),
                (&ele, &|out| tetgen::write_ele(triangulation, out)),
                (&edge, &|out| tetgen::write_edge(triangulation, segments, out)),
                match triangulation.dim {
                    2 => (&poly, write_poly),
                    _ => (&face, write_face),
                },
            ];
            let Boundary { subsegments, subfacets, .. } = &triangulation.boundary;
            let has_parts = !(subsegments.is_empty() && subfacets.is_empty());
            replace::replace(if has_parts { &files } else { &files[..2] })
        }
        _ => replace::replace(&[(path, &|out| content.write_unbuffered(out))]),
    }
}

/// Writes `mesh` to `out`; for `TetgenNode` the `.node` part, then the `.ele` part.
///
/// `Xyz`, `Csv` and `Npy` write the mesh's vertices, before a run the distinct inputs (which are
/// the first vertices of every mesh); `Csv` under the header `x0,x1,..,kind`. `VoronoiJson` and the
/// formats that need measures ([`Format::needs_measures`]) measure the mesh first, which takes
/// longer than writing it.
///
/// # Errors
/// - `Io`: `out` fails; it is not called again;
/// - `State`: all formats but these three before a run;
/// - `InvalidArgument`: a format that cannot hold the mesh's dimension, and [`Format::Auto`], as
///   there is no extension;
/// - `OutOfMemory`.
pub fn write(mesh: &Mesh, format: Format, out: &mut dyn Write) -> Result<()> {
    write_with(mesh, Data::default(), format, out)
}

/// Writes `mesh` to a stream as [`write()`] does, with data as [`write_file_with`] has it.
///
/// # Errors
/// Fails as [`write()`] does; `InvalidArgument` if the data is not that of the mesh.
pub fn write_with<'a>(
    mesh: &'a Mesh,
    data: impl Into<Data<'a>>,
    format: Format,
    out: &mut dyn Write,
) -> Result<()> {
    Content::of(mesh, data.into(), format)?.write(out)
}

/// Markers of what a mesh was made of.
#[derive(Clone, Copy)]
struct Markers<'a> {
    /// Markers of the segments that the result was made with.
    segments: &'a [i32],
    /// Markers of the facets that the result was made with.
    facets: &'a [i32],
}

impl<'a> Markers<'a> {
    fn of(mesh: &'a Mesh) -> Self {
        Self { segments: mesh.markers_of_result(), facets: &mesh.facets_of_result().markers }
    }
}

/// Content of a file: everything that can be refused has been.
enum Content<'a> {
    Vtu(&'a Mesh, &'a Triangulation, Data<'a>),
    Tetgen(&'a Mesh, &'a Triangulation, &'a [Attribute]),
    Gmsh(&'a Mesh, &'a Triangulation, &'a [Attribute]),
    Medit(&'a Mesh, &'a Triangulation),
    Off(&'a Triangulation),
    Ply(&'a Mesh, &'a Triangulation, &'a [Attribute]),
    Stl(&'a Triangulation),
    Xyz(&'a Mesh),
    Csv(&'a Mesh, &'a [Attribute]),
    Npy(&'a Mesh, &'a [Attribute]),
    Voronoi(&'a Mesh, &'a Triangulation),
    Domains(&'a Triangulation),
    Svg(&'a Triangulation, Data<'a>),
    Html(&'a Mesh, &'a Triangulation, Data<'a>),
}

impl<'a> Content<'a> {
    fn of(mesh: &'a Mesh, data: Data<'a>, format: Format) -> Result<Self> {
        format.check_dimension(mesh.inputs().dim())?;
        let inputs = mesh.inputs().distinct();
        let vertices = mesh.triangulation().map_or(inputs, Triangulation::vertex_count);
        data.check(vertices, mesh.triangulation())?;
        let attributes = data.attributes;
        let triangulation = || {
            mesh.triangulation().ok_or_else(|| {
                let message = message!(
                    "{} holds a mesh; run first, or write XYZ, CSV or NumPy",
                    format.name()
                );
                Error::new(ErrorKind::State, message)
            })
        };
        match format {
            Format::Auto => Err(auto_without_path()),
            Format::Vtu => Ok(Self::Vtu(mesh, triangulation()?, data)),
            Format::TetgenNode => Ok(Self::Tetgen(mesh, triangulation()?, attributes)),
            Format::Gmsh => Ok(Self::Gmsh(mesh, triangulation()?, attributes)),
            Format::Medit => Ok(Self::Medit(mesh, triangulation()?)),
            Format::Off => triangulation().map(Self::Off),
            Format::Ply => Ok(Self::Ply(mesh, triangulation()?, attributes)),
            Format::Stl => {
                let triangulation = triangulation()?;
                stl::check_precision(triangulation)?;
                Ok(Self::Stl(triangulation))
            }
            Format::Xyz => Ok(Self::Xyz(mesh)),
            Format::Csv => Ok(Self::Csv(mesh, attributes)),
            Format::Npy => Ok(Self::Npy(mesh, attributes)),
            Format::VoronoiJson => Ok(Self::Voronoi(mesh, triangulation()?)),
            Format::DomainsJson => triangulation().map(Self::Domains),
            Format::Svg => Ok(Self::Svg(triangulation()?, data)),
            Format::Html => Ok(Self::Html(mesh, triangulation()?, data)),
            Format::Poly | Format::Smesh | Format::Obj | Format::Geojson | Format::Wkt => {
                Err(format.read_only())
            }
        }
    }

    /// Writes the content in large pieces, whatever `out` is.
    fn write(&self, out: &mut dyn Write) -> Result<()> {
        let mut buffered = Buffered::new(1 << 16, out)?;
        let written = self.write_unbuffered(&mut buffered).and_then(|()| buffered.flush());
        written.map_err(|error| io_error("cannot write", &error))
    }

    fn write_unbuffered(&self, out: &mut dyn Write) -> std::io::Result<()> {
        match self {
            Self::Vtu(mesh, triangulation, data) => {
                vtu::write(mesh.inputs(), triangulation, Markers::of(mesh), data, out)
            }
            Self::Tetgen(_, triangulation, attributes) => {
                tetgen::write_node(triangulation, attributes, out)?;
                tetgen::write_ele(triangulation, out)
            }
            Self::Gmsh(mesh, triangulation, attributes) => {
                gmsh::write(triangulation, Markers::of(mesh), attributes, out)
            }
            Self::Medit(mesh, triangulation) => medit::write(triangulation, Markers::of(mesh), out),
            Self::Off(triangulation) => off::write(triangulation, out),
            Self::Ply(mesh, triangulation, attributes) => {
                ply::write(triangulation, Markers::of(mesh).facets, attributes, out)
            }
            Self::Stl(triangulation) => stl::write(triangulation, out),
            Self::Xyz(mesh) => xyz::write(mesh, out),
            Self::Csv(mesh, attributes) => csv::write(mesh, attributes, out),
            Self::Npy(mesh, attributes) => npy::write(mesh, attributes, out),
            Self::Voronoi(mesh, triangulation) => voronoi::write(mesh.inputs(), triangulation, out),
            Self::Domains(triangulation) => domains::write(triangulation, out),
            Self::Svg(triangulation, data) => svg::write(triangulation, data, out),
            Self::Html(mesh, triangulation, data) => {
                html::write(triangulation, Markers::of(mesh).facets, data, out)
            }
        }
    }
}

fn auto_without_path() -> Error {
    let message = "without a file name there is no extension that tells the format; name a format";
    Error::invalid(message)
}

/// Turns a refused allocation into a writer's error; [`io_error`] makes it `OutOfMemory` again.
fn allocation_failed(_: AllocError) -> std::io::Error {
    std::io::ErrorKind::OutOfMemory.into()
}

fn io_error(what: &str, error: &std::io::Error) -> Error {
    let kind = match error.kind() {
        std::io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
        _ => ErrorKind::Io,
    };
    match message!("{what}: {error}") {
        // Not even for that there was memory.
        message if message.is_empty() => AllocError::Memory.into(),
        message => Error::new(kind, message).with_system_code(error.raw_os_error()),
    }
}
