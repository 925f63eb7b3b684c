//! Files that all ranks write: complete under their names, or not there at all.

mod npy;
mod rows;
mod shared;
mod unfinished;
mod vtu;
mod work;

use crate::agreement::{Arguments, require_same};
use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::{Error, ErrorKind, Result};
use std::io;
use std::path::{Path, PathBuf};
use unfinished::Unfinished;

pub use work::write_work;

/// Formats of distributed meshes. Append only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Format {
    /// Format that the extension of the path names.
    Auto = 0,
    /// VTK's parallel unstructured grid: NAME.pvtu and a NAME_RANK.vtu of each rank. 2D and 3D.
    Pvtu = 1,
    /// NumPy arrays: NAME.points.npy and NAME.simplices.npy, for NAME.npy.
    Npy = 2,
}

impl Format {
    fn resolved(self, path: &Path) -> Result<Self> {
        if path.file_stem().is_none() {
            return Err(Error::invalid("the path names no file"));
        }
        match (self, path.extension().and_then(|extension| extension.to_str())) {
            (Self::Auto, Some("pvtu")) => Ok(Self::Pvtu),
            (Self::Auto, Some("npy")) => Ok(Self::Npy),
            (Self::Auto, _) => Err(Error::invalid(format!(
                "{}: the extension must be .pvtu or .npy",
                path.display()
            ))),
            (format, _) => Ok(format),
        }
    }
}

/// Collective. Finds out, before there is a mesh, whether [`write`] can write its files; nothing of
/// what it makes for that stays.
///
/// # Errors
/// Fails as [`write`] does, but for a disk that is full.
pub fn require_writable(comm: &dyn Communicator, path: &Path, format: Format) -> Result<()> {
    let format = resolved(comm, path, format)?;
    Unfinished::new(comm, files_of(path, format, comm.size())).map(drop)
}

/// Collective. Finds out whether [`write_work`] can write its file.
pub fn require_writable_file(comm: &dyn Communicator, path: &Path) -> Result<()> {
    Unfinished::new(comm, vec![path.to_path_buf()]).map(drop)
}

/// Returns the files that [`write`] makes on so many ranks.
///
/// # Errors
/// `InvalidArgument`: an extension that names no format; a path that names no file.
pub fn files(path: &Path, format: Format, ranks: usize) -> Result<Vec<PathBuf>> {
    Ok(files_of(path, format.resolved(path)?, ranks))
}

/// Returns the files, of which the last one is that which names the others.
fn files_of(path: &Path, format: Format, ranks: usize) -> Vec<PathBuf> {
    match format {
        Format::Npy => npy::files(path).to_vec(),
        _ => vtu::files(path, ranks),
    }
}

/// Collective. Writes the mesh. All ranks must see the same files under `path`.
///
/// # Errors
/// All ranks answer one error: `InvalidArgument` (the extension; a path or a format that is not the
/// same on all ranks; a dimension that the format does not hold), `Io`, `OutOfMemory`. There is no
/// file of this call then.
pub fn write(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    path: &Path,
    format: Format,
) -> Result<()> {
    let format = resolved(comm, path, format)?;
    agreed(comm, || {
        if format == Format::Pvtu && mesh.dim > 3 {
            let message =
                format!("VTK's files hold 2 and 3 dimensions, not {}; use .npy", mesh.dim);
            return Err(Error::invalid(message));
        }
        Ok(())
    })?;
    let unfinished = Unfinished::new(comm, files_of(path, format, comm.size()))?;
    match format {
        Format::Npy => npy::write(comm, mesh, unfinished),
        _ => vtu::write(comm, mesh, path, unfinished),
    }
}

/// Collective. Returns the format that all ranks ask for.
fn resolved(comm: &dyn Communicator, path: &Path, format: Format) -> Result<Format> {
    require_same(comm, "", || {
        let own = Arguments::of_call("nm_mpi_export").and("path_utf8", format!("{path:?}"));
        Ok(own.and("format", format as i32))
    })?;
    agreed(comm, || format.resolved(path))
}

fn of_path(path: &Path, what: &str, error: &io::Error) -> Error {
    let kind = match error.kind() {
        io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
        _ => ErrorKind::Io,
    };
    Error::new(kind, format!("{}: {what}: {error}", path.display()))
}
