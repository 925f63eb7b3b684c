//! Files that all ranks write: complete under their names, or not there at all.

mod npy;
mod rows;
mod shared;
mod unfinished;
mod vtu;
mod work;

use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::{Error, ErrorKind, Result};
use std::io;
use std::path::Path;

pub use work::write_work;

/// Formats of distributed meshes. Append only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Format {
    /// By the extension of the path.
    Auto = 0,
    /// VTK's parallel unstructured grid: NAME.pvtu and a NAME_RANK.vtu of each rank. 2D and 3D.
    Pvtu = 1,
    /// NumPy arrays: NAME.points.npy and NAME.simplices.npy, for NAME.npy.
    Npy = 2,
}

impl Format {
    fn resolved(self, path: &Path) -> Result<Self> {
        match (self, path.extension().and_then(|extension| extension.to_str())) {
            (Self::Auto, Some("pvtu")) => Ok(Self::Pvtu),
            (Self::Auto, Some("npy")) => Ok(Self::Npy),
            (Self::Auto, _) => Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("{}: the extension must be .pvtu or .npy", path.display()),
            )),
            (format, _) => Ok(format),
        }
    }
}

/// Collective: writes the mesh. All ranks must see the same files under `path`.
///
/// # Errors
/// The same on all ranks: `InvalidArgument` (the extension; a dimension that the format does not hold),
/// `Io`, `OutOfMemory`. There is no file of this call then.
pub fn write(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    path: &Path,
    format: Format,
) -> Result<()> {
    let format = agreed(comm, || {
        if path.file_stem().is_none() {
            return Err(Error::new(ErrorKind::InvalidArgument, "the path names no file"));
        }
        let format = format.resolved(path)?;
        if format == Format::Pvtu && mesh.dim > 3 {
            let message =
                format!("VTK's files hold 2 and 3 dimensions, not {}; use .npy", mesh.dim);
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        Ok(format)
    })?;
    match format {
        Format::Npy => npy::write(comm, mesh, path),
        _ => vtu::write(comm, mesh, path),
    }
}

fn of_path(path: &Path, what: &str, error: &io::Error) -> Error {
    let kind = match error.kind() {
        io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
        _ => ErrorKind::Io,
    };
    Error::new(kind, format!("{}: {what}: {error}", path.display()))
}
