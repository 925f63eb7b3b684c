//! Files under temporary names, which all ranks write and one renames.

use super::of_path;
use crate::comm::{Communicator, agreed};
use netmesh::{Result, io};
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Files that belong together, as all ranks know them. Unless [`Self::take_place`] succeeds they
/// are gone when this is, in whichever way the call ends; but for a process that is killed, whose
/// files keep their temporary names.
pub struct Unfinished {
    /// Temporary name and final one; the last is the one that names the others.
    files: Vec<(PathBuf, PathBuf)>,
    is_first_rank: bool,
    are_in_place: bool,
}

impl Unfinished {
    /// Collective. Finds out, before there is anything to write, that all ranks can write these
    /// files. `names` are the final names, the same on all ranks; where one is a link, what it
    /// leads to.
    ///
    /// # Errors
    /// `Io`: a rank that cannot write its file there, or one that does not see what rank 0 makes
    /// there.
    pub fn new(comm: &dyn Communicator, names: Vec<PathBuf>) -> Result<Self> {
        static CALLS: AtomicU64 = AtomicU64::new(0);
        let names = agreed(comm, || {
            let names: Result<Vec<_>> = names.iter().map(|name| io::follow_links(name)).collect();
            names.and_then(|names| require_writable(comm, &names).map(|()| names))
        })?;
        // Rank 0 tells what no other run has.
        let call = CALLS.fetch_add(1, Ordering::Relaxed);
        let own = format!("{}-{call}", std::process::id());
        let told = comm.all_gather(if comm.rank() == 0 { own.as_bytes() } else { &[] })?;
        let token = String::from_utf8_lossy(&told[0]).into_owned();
        require_one_directory(comm, &names, &token)?;
        let temporary = |(index, name): (usize, PathBuf)| {
            (name.with_file_name(format!(".netmesh-mpi-{token}-{index}.tmp")), name)
        };
        let files = names.into_iter().enumerate().map(temporary).collect();
        Ok(Self { files, is_first_rank: comm.rank() == 0, are_in_place: false })
    }

    /// Returns the path to write a file to meanwhile.
    pub fn temporary(&self, file: usize) -> &Path {
        &self.files[file].0
    }

    /// Collective. Gives the files their names, when all ranks have written. The last one, without
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

/// Refuses names that no file can have. Each rank looks at some of them, rank 0 at the last as
/// well.
fn require_writable(comm: &dyn Communicator, names: &[PathBuf]) -> Result<()> {
    let own = names.iter().skip(comm.rank()).step_by(comm.size());
    let last = names.last().filter(|_| comm.rank() == 0);
    own.chain(last).try_for_each(|name| io::require_writable(name))
}

/// Collective. Refuses directories of the names that are not the same for all ranks, as the current
/// ones of processes on several machines may be.
fn require_one_directory(comm: &dyn Communicator, names: &[PathBuf], token: &str) -> Result<()> {
    let probe = |name: &PathBuf| name.with_file_name(format!(".netmesh-mpi-{token}-probe.tmp"));
    let mut probes: Vec<(PathBuf, &PathBuf)> =
        names.iter().map(|name| (probe(name), name)).collect();
    probes.dedup_by(|a, b| a.0 == b.0);
    let created = agreed(comm, || {
        let mut created = Removed(Vec::new());
        for (probe, name) in probes.iter().filter(|_| comm.rank() == 0) {
            fs::File::create_new(probe)
                .map_err(|error| of_path(name, "cannot create a file beside it", &error))?;
            created.0.push(probe.clone());
        }
        Ok(created)
    })?;
    let seen = agreed(comm, || {
        for (probe, name) in &probes {
            OpenOptions::new().write(true).open(probe).map_err(|error| {
                let what = "what rank 0 has created beside it cannot be opened here; all ranks \
                    must see the same directory";
                of_path(name, what, &error)
            })?;
        }
        Ok(())
    });
    drop(created);
    seen
}

/// Files that are removed in the end.
struct Removed(Vec<PathBuf>);

impl Drop for Removed {
    fn drop(&mut self) {
        self.0.iter().for_each(|file| drop(fs::remove_file(file)));
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
