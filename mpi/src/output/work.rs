//! Costs of a run, as a table for spreadsheets and scripts.

use super::of_path;
use super::unfinished::Unfinished;
use crate::comm::{Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::Result;
use std::fmt::Write;
use std::fs;
use std::path::Path;

const HEAD: &str = "rank,step,phase,partition,inputs,simplices,seconds,sent\n";

/// Collective. Writes the costs of the steps of the run on all ranks ([`DistributedMesh::work`]) as
/// comma-separated values, rank after rank.
///
/// # Errors
/// All ranks answer one error: `Io`. There is no file of this call then.
pub fn write_work(comm: &dyn Communicator, mesh: &DistributedMesh, path: &Path) -> Result<()> {
    let mut own = String::new();
    let number = |value: Option<u32>| value.map_or(String::new(), |value| value.to_string());
    for work in &mesh.work {
        let (name, phase, partition) = work.step.parts();
        let (phase, partition) = (number(phase), number(partition));
        // Writing to a string does not fail.
        let _ = writeln!(
            own,
            "{},{name},{phase},{partition},{},{},{:.6},{}",
            mesh.rank, work.inputs, work.simplices, work.seconds, work.sent
        );
    }
    let all = comm.all_gather(own.as_bytes())?;
    let file = Unfinished::new(comm, vec![path.to_path_buf()])?;
    agreed(comm, || match comm.rank() {
        0 => fs::write(file.temporary(0), [HEAD.as_bytes(), &all.concat()].concat())
            .map_err(|error| of_path(path, "cannot write", &error)),
        _ => Ok(()),
    })?;
    file.take_place(comm)
}
