//! Reading of binary formats: bytes that must be there, and their position in messages.

use super::io_error;
use crate::error::{Error, ErrorKind, Result, message};
use std::io::{self, BufRead};

/// Binary data, read in order.
pub(super) struct Binary<'a> {
    input: &'a mut dyn BufRead,
    /// Number of bytes that have been read.
    offset: u64,
    /// Name of the part that bytes are counted from, for messages: "" for the file.
    origin: &'static str,
}

impl<'a> Binary<'a> {
    pub fn new(input: &'a mut dyn BufRead, origin: &'static str) -> Self {
        Self { input, offset: 0, origin }
    }

    /// Returns the next bytes; the error of a file that ends before them tells what it `lacks`.
    pub fn next<const N: usize>(&mut self, lacks: impl FnOnce() -> String) -> Result<[u8; N]> {
        let mut bytes = [0; N];
        self.fill(&mut bytes, lacks)?;
        Ok(bytes)
    }

    /// Fills `bytes` with the next bytes; the error of a file that ends before them tells what it
    /// `lacks`.
    pub fn fill(&mut self, bytes: &mut [u8], lacks: impl FnOnce() -> String) -> Result<()> {
        let mut filled = 0;
        while filled < bytes.len() {
            let buffered = self.buffered()?;
            if buffered.is_empty() {
                return Err(self.ends(lacks));
            }
            let taken = buffered.len().min(bytes.len() - filled);
            bytes[filled..filled + taken].copy_from_slice(&buffered[..taken]);
            self.consume(taken);
            filled += taken;
        }
        Ok(())
    }

    /// Passes over `count` bytes that must be there.
    pub fn skip(&mut self, count: u64, lacks: impl FnOnce() -> String) -> Result<()> {
        let mut left = count;
        while left > 0 {
            let buffered = self.buffered()?.len();
            if buffered == 0 {
                return Err(self.ends(lacks));
            }
            let taken = usize::try_from(left).unwrap_or(usize::MAX).min(buffered);
            self.consume(taken);
            left -= taken as u64;
        }
        Ok(())
    }

    /// Refuses further data.
    pub fn require_end(&mut self, after: &str) -> Result<()> {
        if self.buffered()?.is_empty() {
            return Ok(());
        }
        Err(self.error_at(0, ErrorKind::Format, &format!("more data after {after}")))
    }

    /// Returns the error of what begins `back` bytes before the current position; bytes count from
    /// 1 in the message.
    pub fn error_at(&self, back: u64, kind: ErrorKind, why: &str) -> Error {
        Error::new(kind, message!("byte {}{}: {why}", self.offset - back + 1, self.origin))
    }

    fn ends(&self, lacks: impl FnOnce() -> String) -> Error {
        let message =
            message!("the file ends after byte {}{}: {}", self.offset, self.origin, lacks());
        Error::format(message)
    }

    /// Returns bytes that are there to be read, at least one before the end of the file.
    fn buffered(&mut self) -> Result<&[u8]> {
        while let Err(error) = self.input.fill_buf() {
            if error.kind() != io::ErrorKind::Interrupted {
                let what = message!("cannot read on after byte {}{}", self.offset, self.origin);
                return Err(io_error(&what, &error));
            }
        }
        // What was just filled; a reader that fails now answers the same as above.
        self.input.fill_buf().map_err(|error| io_error("cannot read on", &error))
    }

    fn consume(&mut self, count: usize) {
        self.input.consume(count);
        self.offset += count as u64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn bytes_come_in_order_whatever_the_pieces() {
        for pieces in 1..9 {
            let mut input = io::BufReader::with_capacity(pieces, &b"abcdefgh"[..]);
            let mut binary = Binary::new(&mut input, "");
            assert_eq!(&binary.next::<3>(String::new).unwrap(), b"abc");
            binary.skip(2, String::new).unwrap();
            assert_eq!(&binary.next::<2>(String::new).unwrap(), b"fg");
            let error = binary.require_end("all").unwrap_err();
            assert_eq!(error.message(), "byte 8: more data after all");
            let error = binary.skip(2, || "two".into()).unwrap_err();
            assert_eq!(error.message(), "the file ends after byte 8: two");
            binary.require_end("all").unwrap();
        }
    }

    #[test]
    fn a_reader_that_fails_is_an_io_error() {
        let mut input = io::BufReader::new(b"abc".chain(crate::io::samples::FailingReader));
        let mut binary = Binary::new(&mut input, " after the header");
        let error = binary.next::<4>(String::new).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        let expected = "cannot read on after byte 3 after the header: the disk is gone";
        assert_eq!(error.message(), expected);
    }
}
