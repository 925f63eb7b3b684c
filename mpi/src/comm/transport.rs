//! Operations of a network, without a word on failures of ranks.

use super::mpi::Ranks;
use netmesh::Result;

/// Operation of a reduction of the values of all ranks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Operation {
    Min = 0,
    Max = 1,
    Sum = 2,
}

impl Operation {
    pub fn of_integers(self, a: u64, b: u64) -> u64 {
        match self {
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Sum => a.wrapping_add(b),
        }
    }

    pub fn of_numbers(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Sum => a + b,
        }
    }
}

/// A network of ranks. Errors are the network's own; [`super::Collective`] makes a
/// [`super::Communicator`] of it.
pub trait Transport {
    fn rank(&self) -> usize;

    fn size(&self) -> usize;

    /// Collective. Reduces each of `values` over all ranks.
    fn reduce_integers(&self, values: &mut [u64], operation: Operation) -> Result<()>;

    /// Collective. Reduces each of `values` over all ranks.
    fn reduce_numbers(&self, values: &mut [f64], operation: Operation) -> Result<()>;

    /// Collective. Replaces `bytes` by those of rank `root`; lengths are equal.
    fn broadcast(&self, root: usize, bytes: &mut [u8]) -> Result<()>;

    /// Collective. Gathers one value of each rank into `values`, by rank.
    fn gather_integers(&self, value: u64, values: &mut [u64]) -> Result<()>;

    /// Collective. Sends `values[r]` to rank r; `received[r]` becomes what that sent here.
    fn exchange_integers(&self, values: &[u64], received: &mut [u64]) -> Result<()>;

    /// Collective. Gathers bytes: `gathered[r]` becomes what rank r has; each is as long as that
    /// already.
    fn gather(&self, bytes: &[u8], gathered: &mut [Vec<u8>]) -> Result<()>;

    /// Collective. Sends `messages[r]` to rank r; `received[r]` becomes what that sent here, and is
    /// as long as that already. The message of a rank to itself is not sent.
    fn exchange(&self, messages: &[Vec<u8>], received: &mut [Vec<u8>]) -> Result<()>;

    /// Sends bytes to a rank; returns false where a rank has failed meanwhile ([`Self::notify`]).
    fn send(&self, to: usize, tag: u16, bytes: &[u8]) -> Result<bool>;

    /// Waits for the next message of a rank with a tag; `None` where a rank has failed meanwhile.
    fn receive(&self, from: usize, tag: u16) -> Result<Option<Vec<u8>>>;

    /// Returns the ranks of MPI, where that is what there is.
    fn mpi(&self) -> Option<&Ranks> {
        None
    }

    /// Wakes all ranks that wait for a message, now and later.
    fn notify(&self);
}

impl<T: Transport> Transport for &T {
    fn rank(&self) -> usize {
        (**self).rank()
    }

    fn size(&self) -> usize {
        (**self).size()
    }

    fn reduce_integers(&self, values: &mut [u64], operation: Operation) -> Result<()> {
        (**self).reduce_integers(values, operation)
    }

    fn reduce_numbers(&self, values: &mut [f64], operation: Operation) -> Result<()> {
        (**self).reduce_numbers(values, operation)
    }

    fn broadcast(&self, root: usize, bytes: &mut [u8]) -> Result<()> {
        (**self).broadcast(root, bytes)
    }

    fn gather_integers(&self, value: u64, values: &mut [u64]) -> Result<()> {
        (**self).gather_integers(value, values)
    }

    fn exchange_integers(&self, values: &[u64], received: &mut [u64]) -> Result<()> {
        (**self).exchange_integers(values, received)
    }

    fn gather(&self, bytes: &[u8], gathered: &mut [Vec<u8>]) -> Result<()> {
        (**self).gather(bytes, gathered)
    }

    fn exchange(&self, messages: &[Vec<u8>], received: &mut [Vec<u8>]) -> Result<()> {
        (**self).exchange(messages, received)
    }

    fn send(&self, to: usize, tag: u16, bytes: &[u8]) -> Result<bool> {
        (**self).send(to, tag, bytes)
    }

    fn receive(&self, from: usize, tag: u16) -> Result<Option<Vec<u8>>> {
        (**self).receive(from, tag)
    }

    fn mpi(&self) -> Option<&Ranks> {
        (**self).mpi()
    }

    fn notify(&self) {
        (**self).notify();
    }
}
