//! Each rank's share of a file of points: NumPy's arrays by rows, text by bytes between line ends.

mod npy;
mod text;

use crate::agreement::{Arguments, digest, require_same};
use crate::comm::{Communicator, Operation, agreed};
use netmesh::io::Format;
use netmesh::{Error, ErrorKind, Result};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

/// Points of a rank.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Share {
    pub dim: usize,
    pub points: Vec<f64>,
}

/// Collective. Reads the file, of which all ranks see the same, each under its path. Earlier rows
/// are on lower ranks.
///
/// # Errors
/// All ranks answer one error, with the path of the rank that has it: `InvalidArgument` (a format
/// other than NumPy's and XYZ; a format or a file that is not the same on all ranks), `Io`,
/// `Format`, `Dimension`, `NonFinite` and `OutOfMemory`, as the core's readers have them; lines and
/// points count from the file's first.
pub fn read(comm: &dyn Communicator, path: &Path, format: Format) -> Result<Share> {
    let (rank, ranks) = (comm.rank() as u64, comm.size() as u64);
    let in_file =
        |error: Error| Error::new(error.kind(), format!("{}: {}", path.display(), error.message()));
    let (file, format, own) = agreed(comm, || {
        let format = match format {
            Format::Auto => Format::from_path(path)?,
            format => format,
        };
        let mut file = File::open(path).map_err(|error| io_error("cannot open", &error));
        let own = file.as_mut().map_err(|error| error.clone()).and_then(fingerprint);
        let own = own.map_err(in_file)?.and("the format", format.name());
        Ok((file?, format, own))
    })?;
    require_same(comm, &format!("{}: ", path.display()), || Ok(own))?;
    let mut share = agreed(comm, || {
        let share = match format {
            Format::Npy => npy::read(file, rank, ranks),
            Format::Xyz => text::read(file, rank, ranks),
            _ => Err(Error::invalid(
                "ranks read NumPy's arrays (.npy) and points as text (.xyz) only",
            )),
        };
        share.map_err(in_file)
    })?;
    agreed(comm, || {
        let own = share.dim as u64;
        let mut least = [if share.points.is_empty() { u64::MAX } else { own }];
        comm.all_reduce_integers(&mut least, Operation::Min)?;
        let mut most = [if share.points.is_empty() { 0 } else { own }];
        comm.all_reduce_integers(&mut most, Operation::Max)?;
        let refused = |message| Err(in_file(Error::format(message)));
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

/// Tells files of different lengths apart, and those that differ in one of some places.
fn fingerprint(file: &mut File) -> Result<Arguments> {
    const PLACES: u64 = 16;
    const BLOCK: u64 = 1 << 12;
    let failed = |error: io::Error| io_error("cannot read", &error);
    let length = file.seek(SeekFrom::End(0)).map_err(failed)?;
    let mut blocks = Vec::new();
    for place in 0..PLACES {
        let start = start_of(place, PLACES - 1, length.saturating_sub(BLOCK));
        file.seek(SeekFrom::Start(start)).map_err(failed)?;
        Read::take(&mut *file, BLOCK).read_to_end(&mut blocks).map_err(failed)?;
    }
    // Readers begin where the file does.
    file.rewind().map_err(failed)?;
    let content = format!("{:016x}", digest([&blocks[..]]));
    let own = Arguments::of_call("reading").and("the file's length in bytes", length);
    Ok(own.and("a digest of the file's content", content))
}

/// Returns the row at which the share of a rank begins.
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
