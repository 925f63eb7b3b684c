//! One file that all ranks write into: by MPI-IO, or where ranks are threads at offsets.

use super::of_path;
use crate::comm::mpi::SharedFile;
use crate::comm::{Communicator, agreed};
use netmesh::Result;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Chunk of a file: its offset and its bytes.
pub type Chunk<'a> = (u64, &'a [u8]);

/// Collective. Writes a new file.
pub fn write(comm: &dyn Communicator, path: &Path, parts: &[Chunk<'_>]) -> Result<()> {
    match comm.mpi() {
        Some(ranks) => {
            let mut file = agreed(comm, || SharedFile::create(ranks, path))?;
            let mut parts = parts.iter();
            let written = parts.try_for_each(|(offset, bytes)| file.write(*offset, bytes));
            let closed = file.close();
            agreed(comm, || written.and(closed)).map_err(|error| at_path(path, error))
        }
        None => {
            agreed(comm, || match comm.rank() {
                0 => File::create_new(path)
                    .map(drop)
                    .map_err(|error| of_path(path, "cannot create", &error)),
                _ => Ok(()),
            })?;
            agreed(comm, || write_at(path.to_owned(), parts))
        }
    }
}

fn write_at(path: PathBuf, parts: &[Chunk<'_>]) -> Result<()> {
    let failed = |error: std::io::Error| of_path(&path, "cannot write", &error);
    let mut file = OpenOptions::new().write(true).open(&path).map_err(failed)?;
    for (offset, bytes) in parts {
        file.seek(SeekFrom::Start(*offset)).map_err(failed)?;
        file.write_all(bytes).map_err(failed)?;
    }
    file.sync_all().map_err(failed)
}

fn at_path(path: &Path, error: netmesh::Error) -> netmesh::Error {
    netmesh::Error::new(error.kind(), format!("{}: cannot write: {error}", path.display()))
}
