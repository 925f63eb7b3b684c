//! A buffer before a writer, as `BufWriter`, but it asks for its memory, and what it holds when it
//! is dropped is gone: a writer that failed is not called again.

use crate::memory::{AllocResult, with_capacity};
use std::io::{Result, Write};

pub(crate) struct Buffered<W> {
    out: W,
    /// Never grows beyond its first capacity.
    bytes: Vec<u8>,
}

impl<W: Write> Buffered<W> {
    pub fn new(capacity: usize, out: W) -> AllocResult<Self> {
        Ok(Self { out, bytes: with_capacity(capacity)? })
    }

    /// Returns the writer; bytes that were not flushed are lost.
    pub fn into_inner(self) -> W {
        self.out
    }

    fn empty(&mut self) -> Result<()> {
        let written = self.out.write_all(&self.bytes);
        self.bytes.clear();
        written
    }
}

impl<W: Write> Write for Buffered<W> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        if bytes.len() > self.bytes.capacity() - self.bytes.len() {
            self.empty()?;
        }
        if bytes.len() >= self.bytes.capacity() {
            self.out.write_all(bytes)?;
        } else {
            self.bytes.extend_from_slice(bytes);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<()> {
        self.empty()?;
        self.out.flush()
    }
}
