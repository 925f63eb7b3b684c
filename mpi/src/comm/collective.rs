//! A [`Communicator`] on a [`Transport`]: the checkpoints at which ranks learn of failures.

use super::mpi::Ranks;
use super::{Communicator, Operation, Transport};
use netmesh::distributed::memory::{collected, filled, with_capacity};
use netmesh::{Error, ErrorKind, Result};
use std::cell::{Cell, RefCell};

/// Number of bytes of an error's message that other ranks are told.
const MESSAGE_BYTES: usize = 1024;

/// Ranks that fail together. Not for several threads of a rank at a time.
pub struct Collective<T> {
    transport: T,
    bytes_sent: Cell<u64>,
    /// Says an error in the words of the caller, since ranks tell each other no more than text.
    words: fn(&Error) -> String,
    /// Error that all ranks have agreed on.
    failure: RefCell<Option<Error>>,
}

impl<T: Transport> Collective<T> {
    /// Makes ranks whose messages are in the words of C.
    pub fn new(transport: T) -> Self {
        Self::in_words(transport, netmesh::capi::shared::in_words_of_c)
    }

    /// Makes ranks whose messages are those of `words`.
    pub fn in_words(transport: T, words: fn(&Error) -> String) -> Self {
        Self { transport, bytes_sent: Cell::new(0), words, failure: RefCell::new(None) }
    }

    /// Returns a communicator for another call: what has failed before is past.
    pub fn again(&self) -> Collective<&T> {
        Collective::in_words(&self.transport, self.words)
    }

    /// Begins every collective call: learns whether a rank has failed.
    fn checkpoint(&self, local: Option<&Error>) -> Result<()> {
        if let Some(error) = &*self.failure.borrow() {
            return Err(error.clone());
        }
        let all_are_well = self.transport.size();
        let mut first = [if local.is_some() { self.transport.rank() } else { all_are_well } as u64];
        let known = self.transport.reduce_integers(&mut first, Operation::Min);
        if known.is_ok() && first[0] == all_are_well as u64 {
            return Ok(());
        }
        let error = known
            .and_then(|()| self.error_of(first[0] as usize, local))
            .unwrap_or_else(|error| error);
        *self.failure.borrow_mut() = Some(error.clone());
        Err(error)
    }

    /// Returns the error of a rank, as all ranks tell it.
    fn error_of(&self, rank: usize, local: Option<&Error>) -> Result<Error> {
        let mut packet = [0; 8 + MESSAGE_BYTES];
        if let (Some(error), true) = (local, rank == self.transport.rank()) {
            let message = (self.words)(error);
            let message = prefix(&message, MESSAGE_BYTES);
            packet[..4].copy_from_slice(&(error.kind() as i32).to_le_bytes());
            packet[4..8].copy_from_slice(&(message.len() as u32).to_le_bytes());
            packet[8..][..message.len()].copy_from_slice(message.as_bytes());
        }
        self.transport.broadcast(rank, &mut packet)?;
        let word = |at: usize| packet[at..][..4].try_into().map(u32::from_le_bytes).unwrap_or(0);
        let length = (word(4) as usize).min(MESSAGE_BYTES);
        let message = String::from_utf8_lossy(&packet[8..][..length]);
        let kind = kind_of(word(0) as i32);
        if self.transport.size() == 1 {
            return Ok(Error::new(kind, message.into_owned()));
        }
        Ok(Error::new(kind, format!("{message} (rank {rank})")))
    }

    /// Collective. Makes an own failure inside of a call, such as of an allocation, one of all
    /// ranks.
    fn agree_on<V>(&self, local: Result<V>) -> Result<V> {
        match local {
            Ok(value) => self.checkpoint(None).map(|()| value),
            Err(error) => Err(self.fail(error)),
        }
    }

    fn count(&self, bytes: usize, receivers: usize) {
        self.bytes_sent.set(self.bytes_sent.get() + (bytes as u64) * receivers as u64);
    }
}

impl<T: Transport> Communicator for Collective<T> {
    fn rank(&self) -> usize {
        self.transport.rank()
    }

    fn size(&self) -> usize {
        self.transport.size()
    }

    fn barrier(&self) -> Result<()> {
        self.checkpoint(None)
    }

    fn all_gather(&self, bytes: &[u8]) -> Result<Vec<Vec<u8>>> {
        self.checkpoint(None)?;
        let buffers = || {
            let mut sizes = filled(self.size(), 0)?;
            self.transport.gather_integers(bytes.len() as u64, &mut sizes)?;
            empty_buffers(&sizes)
        };
        let mut gathered: Vec<Vec<u8>> = self.agree_on(buffers())?;
        self.transport.gather(bytes, &mut gathered)?;
        self.count(8 + bytes.len(), self.size() - 1);
        Ok(gathered)
    }

    fn all_to_all(&self, mut messages: Vec<Vec<u8>>) -> Result<Vec<Vec<u8>>> {
        debug_assert_eq!(messages.len(), self.size());
        self.checkpoint(None)?;
        let rank = self.rank();
        let kept = std::mem::take(&mut messages[rank]);
        let buffers = || {
            let sizes = collected(messages.iter().map(|message| message.len() as u64))?;
            let mut received = filled(self.size(), 0)?;
            self.transport.exchange_integers(&sizes, &mut received)?;
            empty_buffers(&received)
        };
        let mut received: Vec<Vec<u8>> = self.agree_on(buffers())?;
        self.transport.exchange(&messages, &mut received)?;
        messages.iter().for_each(|message| self.count(message.len(), 1));
        self.count(8, self.size() - 1);
        received[rank] = kept;
        Ok(received)
    }

    fn send(&self, to: usize, tag: u16, bytes: &[u8]) -> Result<()> {
        if let Some(error) = &*self.failure.borrow() {
            return Err(error.clone());
        }
        if !self.transport.send(to, tag, bytes)? {
            return self.checkpoint(None);
        }
        self.count(bytes.len(), usize::from(to != self.rank()));
        Ok(())
    }

    fn receive(&self, from: usize, tag: u16) -> Result<Vec<u8>> {
        if let Some(error) = &*self.failure.borrow() {
            return Err(error.clone());
        }
        match self.transport.receive(from, tag)? {
            Some(message) => Ok(message),
            // Some rank is at a checkpoint by now, or will be, to say why.
            None => Err(self.checkpoint(None).err().unwrap_or_else(|| {
                Error::new(ErrorKind::Panic, "internal error: a wait was ended without a failure")
            })),
        }
    }

    fn exclusive_sum(&self, value: u64) -> Result<(u64, u64)> {
        self.checkpoint(None)?;
        let mut values = self.agree_on(filled(self.size(), 0).map_err(Error::from))?;
        self.transport.gather_integers(value, &mut values)?;
        self.count(8, self.size() - 1);
        let sum =
            |values: &[u64]| values.iter().fold(0, |sum: u64, value| sum.wrapping_add(*value));
        Ok((sum(&values[..self.rank()]), sum(&values)))
    }

    fn all_reduce_integers(&self, values: &mut [u64], operation: Operation) -> Result<()> {
        self.checkpoint(None)?;
        self.count(8 * values.len(), usize::from(self.size() > 1));
        self.transport.reduce_integers(values, operation)
    }

    fn all_reduce_numbers(&self, values: &mut [f64], operation: Operation) -> Result<()> {
        self.checkpoint(None)?;
        self.count(8 * values.len(), usize::from(self.size() > 1));
        self.transport.reduce_numbers(values, operation)
    }

    fn bytes_sent(&self) -> u64 {
        self.bytes_sent.get()
    }

    fn mpi(&self) -> Option<&Ranks> {
        self.transport.mpi()
    }

    fn fail(&self, error: Error) -> Error {
        if self.failure.borrow().is_none() {
            self.transport.notify();
        }
        self.checkpoint(Some(&error)).err().unwrap_or(error)
    }
}

/// Returns a buffer of each of the sizes.
fn empty_buffers(sizes: &[u64]) -> Result<Vec<Vec<u8>>> {
    let mut buffers = with_capacity(sizes.len())?;
    for size in sizes {
        buffers.push(filled(*size as usize, 0)?);
    }
    Ok(buffers)
}

/// Returns the longest prefix of `text` of at most `limit` bytes that ends between characters.
fn prefix(text: &str, limit: usize) -> &str {
    let mut end = limit.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    &text[..end]
}

fn kind_of(number: i32) -> ErrorKind {
    use ErrorKind::*;
    let kinds = [
        NullArgument,
        InvalidArgument,
        NonFinite,
        Dimension,
        Capacity,
        DegenerateInput,
        Limit,
        Cancelled,
        Io,
        Format,
        State,
        OutOfMemory,
    ];
    kinds.into_iter().find(|kind| *kind as i32 == number).unwrap_or(Panic)
}
