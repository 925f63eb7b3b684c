//! Records on their way between ranks: each rank brings some, and gets those that are for it.

use crate::comm::Communicator;
use crate::words::{append, words_of};
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, with_capacity};

/// Records of `W` words, and the ranks that they go to.
pub struct Outbox<const W: usize> {
    messages: Vec<Vec<u8>>,
}

impl<const W: usize> Outbox<W> {
    pub fn new(ranks: usize) -> Result<Self> {
        let mut messages = with_capacity(ranks)?;
        messages.resize_with(ranks, Vec::new);
        Ok(Self { messages })
    }

    pub fn put(&mut self, rank: usize, record: [u64; W]) -> Result<()> {
        append(&mut self.messages[rank], &record)
    }

    /// Adds a record for the rank that keeps what begins with the same `names` words.
    pub fn put_by_names(&mut self, names: usize, record: [u64; W]) -> Result<()> {
        let mix = |hash: u64, word: &u64| {
            (hash.rotate_left(23) ^ word).wrapping_mul(0x9fb2_1c65_1e98_df25)
        };
        let hash = record[..names].iter().fold(0, mix);
        let rank = (hash ^ hash >> 32) % self.messages.len() as u64;
        self.put(rank as usize, record)
    }

    /// Collective. Delivers the records; returns those for this rank and the ranks that they come
    /// from, sorted.
    pub fn deliver(self, comm: &dyn Communicator) -> Result<Vec<([u64; W], usize)>> {
        let mut records = Vec::new();
        for (rank, message) in comm.all_to_all(self.messages)?.iter().enumerate() {
            let mut words = words_of(message);
            while words.len() >= W {
                let record = std::array::from_fn(|_| words.next().unwrap_or_default());
                records.try_push((record, rank))?;
            }
        }
        records.sort_unstable();
        Ok(records)
    }
}

/// Returns the bits of up to three coordinates.
pub fn bits(point: &[f64]) -> [u64; 3] {
    std::array::from_fn(|axis| point.get(axis).map_or(0, |x| x.to_bits()))
}
