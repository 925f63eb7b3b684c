//! Files: points are read, points and meshes are written, a file per format.
//!
//! | Format | extensions | read | write |
//! |---|---|---|---|
//! | [`Format::Vtu`] | `.vtu` | | mesh, d = 2, 3 |
//! | [`Format::TetgenNode`] | `.node`, `.ele` | points | mesh |
//! | [`Format::Off`] | `.off` | points | mesh |
//! | [`Format::Xyz`] | `.xyz`, `.txt`, `.xy`, `.pts` | points | points |
//! | [`Format::Csv`] | `.csv` | points | points |
//!
//! `.msh`, `.mesh`, `.ply` and `.npy` are recognised, and refused until a later version.
//!
//! **Text that is read** is UTF-8 (a byte order mark is skipped), with lines of at most 1 MiB that
//! end with LF or CR LF. From `#` to the end of a line is a comment; blank lines are skipped.
//! Numbers are decimal (`-1.5e-7`), correctly rounded to the nearest double: one too large for a
//! double is refused, one too small becomes a zero. Files are streamed and no declared count is
//! believed before its data is there.
//!
//! **Text that is written** carries the shortest decimal that reads back as the same double, bit by
//! bit, -0.0 and subnormals included.

mod buffered;
mod csv;
#[cfg(test)]
mod independent;
mod off;
mod replace;
#[cfg(test)]
mod samples;
mod tetgen;
mod text;
mod vtu;
mod xyz;

pub(crate) use buffered::Buffered;

use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::{Mesh, Triangulation};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;

/// File formats, with the C ABI's values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Format {
    /// By the file's extension.
    #[default]
    Auto = 0,
    /// VTK's XML unstructured grid, for ParaView: triangles (z = 0) or tetrahedra as appended raw
    /// little-endian binary. Per point: `kind` ([`crate::VertexKind`]), `domain` (index, or
    /// [`crate::NONE`]) and `precision_limited` (0 or 1). Dimensions 2 and 3; cannot be read.
    Vtu = 1,
    /// TetGen's (3D) and Triangle's (2D) `.node` and `.ele`, continued to any dimension.
    ///
    /// Written with ids from 0, no attributes and [`crate::VertexKind`] as the boundary marker.
    /// Read: ids from 0 or 1; attributes and markers are checked and dropped. Where the path ends
    /// with `.ele` the points are in its `.node` sibling.
    TetgenNode = 2,
    /// Gmsh's `.msh`. Not available in this version.
    Gmsh = 3,
    /// Medit's `.mesh`. Not available in this version.
    Medit = 4,
    /// In the plane `OFF`, with z = 0 and triangles, which every viewer opens (and which reads back
    /// as points of dimension 3, the dimension of `OFF`). In dimension d >= 3 `nOFF`: d, the counts,
    /// the vertices, then the simplices as cells of d + 1 indices; tetrahedra are not polygons, and
    /// an `OFF` that lists them as such would be read wrongly.
    ///
    /// Read: the vertices of `OFF` and `nOFF`, one per line; faces are checked and dropped.
    Off = 5,
    /// Stanford's `.ply`. Not available in this version.
    Ply = 6,
    /// Text points, one per line, separated by whitespace or commas, but not by both in one line (a
    /// decimal comma would read so). The first point's number of columns is the dimension.
    Xyz = 7,
    /// Comma-separated points. A first line without any number is a header; its columns are counted,
    /// quotes have no meaning. A last column with the header `kind`, as [`write()`] adds it, is
    /// skipped: it is no coordinate.
    Csv = 8,
    /// NumPy's `.npy`. Not available in this version.
    Npy = 9,
}

impl Format {
    /// The format that a path's extension stands for, in either case.
    ///
    /// # Errors
    /// `InvalidArgument` where the extension is missing or unknown; the message lists the known.
    pub fn from_path(path: &Path) -> Result<Self> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("vtu") => Ok(Self::Vtu),
            Some("node" | "ele") => Ok(Self::TetgenNode),
            Some("msh") => Ok(Self::Gmsh),
            Some("mesh") => Ok(Self::Medit),
            Some("off") => Ok(Self::Off),
            Some("ply") => Ok(Self::Ply),
            Some("xyz" | "txt" | "xy" | "pts") => Ok(Self::Xyz),
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            _ => Err(Error::new(
                ErrorKind::InvalidArgument,
                message!(
                    "{}: the extension names no known format; name one, or use .vtu, .node, .ele, .off, \
                     .xyz, .txt, .xy, .pts or .csv (.msh, .mesh, .ply and .npy are not available in this version)",
                    path.display()
                ),
            )),
        }
    }

    fn resolve(self, path: &Path) -> Result<Self> {
        if self == Self::Auto { Self::from_path(path) } else { Ok(self) }
    }

    fn not_available(self) -> Error {
        let message = message!("format {self:?} is not available in this version");
        Error::new(ErrorKind::InvalidArgument, message)
    }
}

/// Points as read from a file: `coordinates` is `n x dim`, n >= 1, every coordinate finite.
#[derive(Clone, Debug, PartialEq)]
pub struct PointCloud {
    pub dim: usize,
    pub coordinates: Vec<f64>,
}

/// Reads the points of a file. Messages name the path, and where it applies line and column, both
/// counted from 1.
///
/// # Errors
/// - `Io`: no such file, a directory, or reading fails;
/// - `InvalidArgument`: a format that cannot be read, or an extension that names none;
/// - `Format`: not a number, a number too large for a double, rows of differing length, no points,
///   counts and ids that do not fit the data, a file that ends early, a line over 1 MiB, NUL bytes,
///   text that is not UTF-8;
/// - `NonFinite`: `nan` or `inf` where a coordinate should be;
/// - `Dimension`: points of a dimension outside 2..=8;
/// - `OutOfMemory`.
pub fn read_points(path: &Path, format: Format) -> Result<PointCloud> {
    let format = format.resolve(path)?;
    check_readable(format)?;
    let sibling = (format == Format::TetgenNode).then(|| tetgen::paths(path).0);
    let path = sibling.as_deref().unwrap_or(path);
    let in_file = |error: Error| {
        Error::new(error.kind(), message!("{}: {}", path.display(), error.message()))
    };
    let file = File::open(path).map_err(|error| in_file(io_error("cannot open", &error)))?;
    read(&mut BufReader::with_capacity(1 << 16, file), format).map_err(in_file)
}

/// Reads points from a stream.
///
/// # Errors
/// As [`read_points`]; [`Format::Auto`] is refused, as there is no extension.
pub fn read(input: &mut dyn BufRead, format: Format) -> Result<PointCloud> {
    check_readable(format)?;
    let lines = text::Lines::new(input);
    match format {
        Format::TetgenNode => tetgen::read(lines),
        Format::Off => off::read(lines),
        Format::Csv => csv::read(lines),
        _ => xyz::read(lines),
    }
}

fn check_readable(format: Format) -> Result<()> {
    match format {
        Format::TetgenNode | Format::Off | Format::Xyz | Format::Csv => Ok(()),
        Format::Auto => Err(auto_without_path()),
        Format::Vtu => Err(Error::new(
            ErrorKind::InvalidArgument,
            "format Vtu cannot be read, only written; points are read from TetgenNode, Off, Xyz and Csv",
        )),
        Format::Gmsh | Format::Medit | Format::Ply | Format::Npy => Err(format.not_available()),
    }
}

/// Writes `mesh` to `path`, all or nothing: to a new file beside it that is flushed, synchronised
/// and then renamed, so that a reader sees the old file or the complete new one. After an error the
/// old file is untouched and nothing is left beside it.
///
/// `TetgenNode` writes two files. `a.node` and `a.ele` both stand for the pair; any other name `b`
/// is that of the `.node` part and the other is `b.ele`. Both are complete before either is renamed.
///
/// A symbolic link is followed, a read-only file is refused; a device or a pipe, which cannot be
/// replaced, is written as by [`write()`].
///
/// # Errors
/// `Io`, and as [`write()`]; `InvalidArgument` for an extension that names no format.
pub fn write_file(mesh: &Mesh, path: &Path, format: Format) -> Result<()> {
    let format = format.resolve(path)?;
    let content = Content::of(mesh, format)?;
    if let Some(mut stream) = replace::open_stream(path)? {
        return content.write(&mut stream);
    }
    match content {
        Content::Tetgen(triangulation) => {
            let (node, ele) = tetgen::paths(path);
            replace::replace(&[
                (&node, &|out| tetgen::write_node(triangulation, out)),
                (&ele, &|out| tetgen::write_ele(triangulation, out)),
            ])
        }
        _ => replace::replace(&[(path, &|out| content.write_unbuffered(out))]),
    }
}

/// Writes `mesh` to `out`; for `TetgenNode` the `.node` part, then the `.ele` part.
///
/// `Xyz` and `Csv` write the mesh's vertices, before a run the distinct inputs (which are the first
/// vertices of every mesh); `Csv` under the header `x0,x1,..,kind`.
///
/// # Errors
/// - `Io`: `out` fails; it is not called again;
/// - `State`: `Vtu`, `TetgenNode` and `Off` before a run;
/// - `InvalidArgument`: a format that is not available or cannot hold the mesh's dimension, and
///   [`Format::Auto`], as there is no extension.
pub fn write(mesh: &Mesh, format: Format, out: &mut dyn Write) -> Result<()> {
    Content::of(mesh, format)?.write(out)
}

/// What goes into a file: everything that can be refused has been.
enum Content<'a> {
    Vtu(&'a Triangulation),
    Tetgen(&'a Triangulation),
    Off(&'a Triangulation),
    Xyz(&'a Mesh),
    Csv(&'a Mesh),
}

impl<'a> Content<'a> {
    fn of(mesh: &'a Mesh, format: Format) -> Result<Self> {
        let triangulation = || {
            mesh.triangulation().ok_or_else(|| {
                let message =
                    message!("format {format:?} holds a mesh; run first, or write Xyz or Csv");
                Error::new(ErrorKind::State, message)
            })
        };
        match format {
            Format::Auto => Err(auto_without_path()),
            Format::Vtu => {
                vtu::check_dimension(mesh.inputs().dim())?;
                triangulation().map(Self::Vtu)
            }
            Format::TetgenNode => triangulation().map(Self::Tetgen),
            Format::Off => triangulation().map(Self::Off),
            Format::Xyz => Ok(Self::Xyz(mesh)),
            Format::Csv => Ok(Self::Csv(mesh)),
            Format::Gmsh | Format::Medit | Format::Ply | Format::Npy => Err(format.not_available()),
        }
    }

    /// In large pieces, whatever `out` is.
    fn write(&self, out: &mut dyn Write) -> Result<()> {
        let mut buffered = Buffered::new(1 << 16, out)?;
        let written = self.write_unbuffered(&mut buffered).and_then(|()| buffered.flush());
        written.map_err(|error| io_error("cannot write", &error))
    }

    fn write_unbuffered(&self, out: &mut dyn Write) -> std::io::Result<()> {
        match self {
            Self::Vtu(triangulation) => vtu::write(triangulation, out),
            Self::Tetgen(triangulation) => {
                tetgen::write_node(triangulation, out)?;
                tetgen::write_ele(triangulation, out)
            }
            Self::Off(triangulation) => off::write(triangulation, out),
            Self::Xyz(mesh) => xyz::write(mesh, out),
            Self::Csv(mesh) => csv::write(mesh, out),
        }
    }
}

fn auto_without_path() -> Error {
    let message = "format Auto needs a path with an extension; name a format";
    Error::new(ErrorKind::InvalidArgument, message)
}

fn io_error(what: &str, error: &std::io::Error) -> Error {
    let kind = match error.kind() {
        std::io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
        _ => ErrorKind::Io,
    };
    Error::new(kind, message!("{what}: {error}"))
}
