//! io

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use std::io::Write;
use std::path::Path;

/// File formats, with the C ABI's values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(i32)]
pub enum Format {
    /// By the file's extension.
    #[default]
    Auto = 0,
    Vtu = 1,
    /// `.node` and `.ele`.
    TetgenNode = 2,
    Gmsh = 3,
    Medit = 4,
    /// nOFF for dimensions above 3.
    Off = 5,
    Ply = 6,
    /// Text points, one per line.
    Xyz = 7,
    Csv = 8,
    Npy = 9,
}

/// Points as read from a file: `coordinates` is `n x dim`.
#[derive(Clone, Debug, PartialEq)]
pub struct PointCloud {
    pub dim: usize,
    pub coordinates: Vec<f64>,
}

/// Reads the points of a file.
///
/// # Errors
/// `Io`, `Format` (names the line), `InvalidArgument` (a format that cannot be read).
pub fn read_points(_path: &Path, _format: Format) -> Result<PointCloud> {
    Err(Error::new(ErrorKind::InvalidArgument, "not yet"))
}

/// Writes `mesh` to `path`: beside it first, then renamed, so no half-written file is left.
///
/// # Errors
/// `Io`, `State` (a mesh format before a run), `InvalidArgument` (a format that is not available).
pub fn write_file(_mesh: &Mesh, _path: &Path, _format: Format) -> Result<()> {
    Err(Error::new(ErrorKind::InvalidArgument, "not yet"))
}

/// Writes `mesh` to `out`; for `TetgenNode` the `.node` part, then the `.ele` part.
///
/// # Errors
/// As [`write_file`]; [`Format::Auto`] is refused, as there is no extension.
pub fn write(_mesh: &Mesh, _format: Format, _out: &mut dyn Write) -> Result<()> {
    Err(Error::new(ErrorKind::InvalidArgument, "not yet"))
}
