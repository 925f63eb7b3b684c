//! Communication of ranks: [`Communicator`], over MPI ([`mpi`]) or between threads of one process
//! ([`threads`]).
//!
//! **Failures are collective.** Every collective call begins with a checkpoint, at which all ranks
//! learn whether one has failed. A rank that fails between two calls says so ([`agree`],
//! [`Communicator::fail`]), which takes part in the next checkpoint of the others, whatever they
//! call there: all of them then answer its error, and nobody waits for ever. A rank that waits for
//! a message is told as well. After a failure every call answers that error at once.

mod collective;
pub mod mpi;
pub mod threads;
mod transport;

pub use collective::Collective;
pub use transport::{Operation, Transport};

use netmesh::{Error, ErrorKind, Result};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The ranks of a run. Collective calls are made by all ranks in the same order; they answer the
/// same error on all, that of the lowest rank that has failed.
pub trait Communicator {
    /// Returns the rank of this process, from 0 on.
    fn rank(&self) -> usize;

    /// Returns the number of ranks.
    fn size(&self) -> usize;

    /// Collective. Ends when all ranks have begun it.
    fn barrier(&self) -> Result<()>;

    /// Collective. Returns what each rank has given, by rank. Lengths may differ.
    fn all_gather(&self, bytes: &[u8]) -> Result<Vec<Vec<u8>>>;

    /// Collective. Sends `messages[r]` to rank r; returns what each rank has sent here, by rank.
    /// Lengths may differ, and be of any size. There is one message for each rank.
    fn all_to_all(&self, messages: Vec<Vec<u8>>) -> Result<Vec<Vec<u8>>>;

    /// Sends to one rank, which calls [`Self::receive`]; may end only when that has begun. Messages
    /// of one tag arrive in the order in which they were sent.
    fn send(&self, to: usize, tag: u16, bytes: &[u8]) -> Result<()>;

    /// Waits for the next message of a rank with a tag.
    fn receive(&self, from: usize, tag: u16) -> Result<Vec<u8>>;

    /// Collective. Returns the sum over the ranks before this one, and that over all.
    fn exclusive_sum(&self, value: u64) -> Result<(u64, u64)>;

    /// Collective. Reduces each of `values` over all ranks. Lengths are equal.
    fn all_reduce_integers(&self, values: &mut [u64], operation: Operation) -> Result<()>;

    /// Collective. Reduces each of `values` over all ranks. A sum may depend on the number of ranks
    /// in its last bits.
    fn all_reduce_numbers(&self, values: &mut [f64], operation: Operation) -> Result<()>;

    /// Returns the number of bytes that this rank has sent to others, without what MPI adds.
    fn bytes_sent(&self) -> u64;

    /// Returns the ranks of MPI, where that is what there is.
    fn mpi(&self) -> Option<&mpi::Ranks>;

    /// Tells all ranks that this one has failed; answers the error that all of them answer. Those
    /// that have not failed learn it in their next call.
    fn fail(&self, error: Error) -> Error;
}

/// Collective. Returns `local` where all ranks have succeeded, else one error on all ranks.
pub fn agree<T>(comm: &dyn Communicator, local: Result<T>) -> Result<T> {
    match local {
        Ok(value) => comm.barrier().map(|()| value),
        Err(error) => Err(comm.fail(error)),
    }
}

/// Collective. Does what needs no other rank so that a panic on one is an error on all.
pub fn agreed<T>(comm: &dyn Communicator, act: impl FnOnce() -> Result<T>) -> Result<T> {
    let local = catch_unwind(AssertUnwindSafe(act)).unwrap_or_else(|payload| {
        let reason = payload.downcast_ref::<&str>().copied();
        let reason = reason.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
        let reason = reason.unwrap_or("no reason given");
        let message = format!("internal error: {reason}; please report it");
        Err(Error::new(ErrorKind::Panic, message))
    });
    agree(comm, local)
}
