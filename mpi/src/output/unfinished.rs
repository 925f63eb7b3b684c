//! Files under temporary names, which all ranks write and one renames.

use super::of_path;
use crate::comm::{Communicator, agreed};
use netmesh::Result;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Files that belong together, as all ranks know them. Unless [`Self::take_place`] succeeds they are
/// gone when this is, in whichever way the call ends; but for a process that is killed, whose files
/// keep their temporary names.
pub struct Unfinished {
    /// Temporary name and final one; the last is the one that names the others.
    files: Vec<(PathBuf, PathBuf)>,
    is_first_rank: bool,
    are_in_place: bool,
}

impl Unfinished {
    /// Collective. `names`: the final names, the same on all ranks.
    pub fn new(comm: &dyn Communicator, names: Vec<PathBuf>) -> Result<Self> {
        static CALLS: AtomicU64 = AtomicU64::new(0);
        // Rank 0 tells what no other run has.
        let call = CALLS.fetch_add(1, Ordering::Relaxed);
        let own = format!("{}-{call}", std::process::id());
        let told = comm.all_gather(if comm.rank() == 0 { own.as_bytes() } else { &[] })?;
        let token = String::from_utf8_lossy(&told[0]).into_owned();
        let temporary = |(index, name): (usize, PathBuf)| {
            (name.with_file_name(format!(".netmesh-mpi-{token}-{index}.tmp")), name)
        };
        let files = names.into_iter().enumerate().map(temporary).collect();
        Ok(Self { files, is_first_rank: comm.rank() == 0, are_in_place: false })
    }

    /// Where to write a file meanwhile.
    pub fn temporary(&self, file: usize) -> &Path {
        &self.files[file].0
    }

    /// Collective, when all ranks have written: gives the files their names. The last one, without
    /// which nobody finds the others, is away before them and comes after them.
    pub fn take_place(mut self, comm: &dyn Communicator) -> Result<()> {
        agreed(comm, || if self.is_first_rank { self.rename() } else { Ok(()) })?;
        self.are_in_place = true;
        Ok(())
    }

    fn rename(&self) -> Result<()> {
        let Some((_, last)) = self.files.last() else { return Ok(()) };
        match fs::remove_file(last) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(of_path(last, "cannot replace", &error));
            }
            _ => {}
        }
        for (renamed, (temporary, name)) in self.files.iter().enumerate() {
            if let Err(error) = fs::rename(temporary, name) {
                self.files[..renamed].iter().for_each(|(_, name)| drop(fs::remove_file(name)));
                return Err(of_path(name, "cannot replace", &error));
            }
        }
        Ok(())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if !self.are_in_place {
            // Every rank its own, and the first all that are left; an error is already on its way.
            self.files.iter().for_each(|(temporary, _)| drop(fs::remove_file(temporary)));
        }
    }
}
