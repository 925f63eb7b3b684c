//! Rows of an array whose ids are anywhere, as blocks of rows that follow each other.

use crate::comm::Communicator;
use crate::words::{Words, append, empty_messages};
use netmesh::distributed::memory::{TryGrow, collected, filled};
use netmesh::{Error, ErrorKind, Result};

/// The rows of a rank.
pub struct Block {
    /// The first row's id.
    pub start: u64,
    pub bytes: Vec<u8>,
}

/// Collective. Gathers a block of the rows 0 to `all`, of `columns` numbers, on each rank; `rows`
/// are those that this rank has, each of which no other rank has.
pub fn gather<'a>(
    comm: &dyn Communicator,
    all: u64,
    columns: usize,
    rows: impl Iterator<Item = (u64, &'a [f64])>,
) -> Result<Block> {
    let ranks = comm.size() as u64;
    let start_of = |rank: u64| (u128::from(all) * u128::from(rank) / u128::from(ranks)) as u64;
    let starts: Vec<u64> = collected((0..=ranks).map(start_of))?;
    let mut messages = empty_messages(comm.size())?;
    for (id, row) in rows {
        let rank = starts.partition_point(|start| *start <= id) - 1;
        append(&mut messages[rank], &[id])?;
        row.iter().try_for_each(|x| messages[rank].try_extend(&x.to_le_bytes()))?;
    }
    let (start, end) = (starts[comm.rank()], starts[comm.rank() + 1]);
    let mut bytes = filled((end - start) as usize * columns * 8, 0)?;
    let mut count = 0;
    for message in comm.all_to_all(messages)? {
        let mut words = Words::new(&message);
        while !words.is_empty() {
            let at = (words.next()? - start) as usize * columns * 8;
            for to in bytes[at..at + columns * 8].chunks_exact_mut(8) {
                to.copy_from_slice(&words.next()?.to_le_bytes());
            }
            count += 1;
        }
    }
    if count != end - start {
        let message = "internal error: rows of an array are missing; please report it";
        return Err(Error::new(ErrorKind::Panic, message));
    }
    Ok(Block { start, bytes })
}
