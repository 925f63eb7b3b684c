//! Each rank's share of a file of points: NumPy's arrays by rows, text by bytes between line ends.

mod npy;
mod text;

use crate::comm::{Communicator, Operation, agreed};
use netmesh::io::Format;
use netmesh::{Error, ErrorKind, Result};
use std::fs::File;
use std::io;
use std::path::Path;

/// Points of a rank.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Share {
    pub dim: usize,
    pub points: Vec<f64>,
}

/// Collective: reads the file, which all ranks see under this path. Earlier rows are on lower ranks.
///
/// # Errors
/// `InvalidArgument` (a format other than NumPy's and XYZ), `Io`, `Format`, `Dimension`, `NonFinite`
/// and `OutOfMemory`, as the core's readers have them; lines and points count from the file's first.
pub fn read(comm: &dyn Communicator, path: &Path, format: Format) -> Result<Share> {
    let (rank, ranks) = (comm.rank() as u64, comm.size() as u64);
    let mut share = agreed(comm, || {
        let format = match format {
            Format::Auto => Format::from_path(path)?,
            format => format,
        };
        let file = File::open(path).map_err(|error| io_error("cannot open", &error))?;
        match format {
            Format::Npy => npy::read(file, rank, ranks),
            Format::Xyz => text::read(file, rank, ranks),
            _ => Err(Error::new(
                ErrorKind::InvalidArgument,
                "ranks read NumPy's arrays (.npy) and points as text (.xyz) only",
            )),
        }
    })?;
    agreed(comm, || {
        let own = share.dim as u64;
        let mut least = [if share.points.is_empty() { u64::MAX } else { own }];
        comm.all_reduce_integers(&mut least, Operation::Min)?;
        let mut most = [if share.points.is_empty() { 0 } else { own }];
        comm.all_reduce_integers(&mut most, Operation::Max)?;
        let refused = |message| Err(Error::new(ErrorKind::Format, message));
        match (least[0], most[0]) {
            (u64::MAX, _) => refused("the file holds no points".to_owned()),
            (least, most) if least != most => refused(format!(
                "points of {least} coordinates in one place of the file and of {most} in another"
            )),
            (dim, _) => {
                share.dim = dim as usize;
                Ok(())
            }
        }
    })?;
    Ok(share)
}

/// Where the share of a rank begins.
fn start_of(rank: u64, ranks: u64, all: u64) -> u64 {
    (u128::from(all) * u128::from(rank) / u128::from(ranks)) as u64
}

fn io_error(what: &str, error: &io::Error) -> Error {
    let kind = match error.kind() {
        io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
        _ => ErrorKind::Io,
    };
    Error::new(kind, format!("{what}: {error}"))
}
