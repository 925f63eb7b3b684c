//! One file that all ranks write into: by MPI-IO, or where ranks are threads at offsets.

use super::of_path;
use crate::comm::mpi::SharedFile;
use crate::comm::{Communicator, Operation, agreed};
use netmesh::Result;
use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Bytes, and where in the file they are.
pub type Part<'a> = (u64, &'a [u8]);

/// Collective: writes a new file. Each rank has the same number of parts, which may be empty.
pub fn write(comm: &dyn Communicator, path: &Path, parts: &[Part<'_>]) -> Result<()> {
    match comm.mpi() {
        Some(ranks) => {
            let mut file = agreed(comm, || SharedFile::create(ranks, path))?;
            let written = write_parts(comm, &mut file, parts);
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

/// All parts, whatever becomes of one: the other ranks are in them too.
fn write_parts(comm: &dyn Communicator, file: &mut SharedFile, parts: &[Part<'_>]) -> Result<()> {
    let mut written = Ok(());
    for (offset, bytes) in parts {
        let mut rounds = [SharedFile::rounds(bytes.len())];
        comm.all_reduce_integers(&mut rounds, Operation::Max)?;
        written = written.and(file.write(*offset, bytes, rounds[0]));
    }
    written
}

fn write_at(path: PathBuf, parts: &[Part<'_>]) -> Result<()> {
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
