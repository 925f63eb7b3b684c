//! Text whose lines mean nothing: bytes, each with its place. One line may hold all of a file.

use super::io_error;
use crate::error::{Error, ErrorKind, Result, message};
use std::fmt;
use std::io::{self, BufRead};

/// The longest word that is read. A double whose decimals are all written out has up to 1077.
const MAX_WORD: usize = 2048;

pub(super) struct Scanner<'a> {
    input: &'a mut dyn BufRead,
    place: TextPosition,
    word: [u8; MAX_WORD],
}

/// Line and byte of a position in a text, both counted from 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct TextPosition {
    line: u64,
    byte: u64,
}

impl fmt::Display for TextPosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, byte {}", self.line, self.byte)
    }
}

impl TextPosition {
    pub fn error(self, message: impl fmt::Display) -> Error {
        self.error_of_kind(ErrorKind::Format, message)
    }

    pub fn error_of_kind(self, kind: ErrorKind, message: impl fmt::Display) -> Error {
        Error::new(kind, message!("{self}: {message}"))
    }

    /// Parses a coordinate: a decimal number that a double can hold.
    ///
    /// # Errors
    /// `Format`: not a number, or too large; `NonFinite`: `nan` or `inf`.
    pub fn coordinate(self, word: &str) -> Result<f64> {
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) if word.bytes().any(|byte| byte.is_ascii_digit()) => {
                Err(self.error(format_args!("{} is too large for a double", Shown(word))))
            }
            Ok(_) => {
                let message = format_args!("{}; every coordinate must be finite", Shown(word));
                Err(self.error_of_kind(ErrorKind::NonFinite, message))
            }
            Err(_) => Err(self.error(format_args!("{} is not a number", Shown(word)))),
        }
    }

    fn after(self, bytes: &[u8]) -> Self {
        let lines = bytes.iter().filter(|byte| **byte == b'\n').count() as u64;
        let last = bytes.iter().rev().take_while(|byte| **byte != b'\n').count() as u64;
        match lines {
            0 => Self { byte: self.byte + last, ..self },
            _ => Self { line: self.line + lines, byte: last + 1 },
        }
    }
}

/// A word as a message shows it: it may be long.
pub(super) struct Shown<'a>(pub &'a str);

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 40;
        match self.0.char_indices().nth(SHOWN) {
            Some((end, _)) => write!(f, "\"{}...\"", self.0[..end].escape_debug()),
            None => write!(f, "\"{}\"", self.0.escape_debug()),
        }
    }
}

impl<'a> Scanner<'a> {
    /// Begins after a byte order mark.
    pub fn new(input: &'a mut dyn BufRead) -> Result<Self> {
        let mut scanner =
            Self { input, place: TextPosition { line: 1, byte: 1 }, word: [0; MAX_WORD] };
        if scanner.next_is(0xef)? && !(scanner.next_is(0xbb)? && scanner.next_is(0xbf)?) {
            return Err(scanner.unexpected("text"));
        }
        Ok(scanner)
    }

    /// Returns the position of the next byte.
    pub fn place(&self) -> TextPosition {
        self.place
    }

    pub fn ahead(&mut self) -> Result<Option<u8>> {
        Ok(buffered(self.input, self.place)?.first().copied())
    }

    pub fn take(&mut self) -> Result<Option<u8>> {
        let next = self.ahead()?;
        if let Some(byte) = next {
            self.place = self.place.after(&[byte]);
            self.input.consume(1);
        }
        Ok(next)
    }

    /// Takes the next byte if it is this one.
    pub fn next_is(&mut self, byte: u8) -> Result<bool> {
        let is_next = self.ahead()? == Some(byte);
        if is_next {
            self.take()?;
        }
        Ok(is_next)
    }

    /// Takes all bytes that follow and `belong`.
    pub fn pass_over(&mut self, belong: impl Fn(u8) -> bool) -> Result<()> {
        self.pass(belong, |_, _| Ok(()))
    }

    /// Reads the bytes that follow and `belong`, which must be ASCII.
    pub fn read_word(&mut self, belong: impl Fn(u8) -> bool) -> Result<&str> {
        let begin = self.place;
        let mut length = 0;
        self.pass(
            |byte| byte.is_ascii() && belong(byte),
            |word, bytes| {
                let Some(room) = word.get_mut(length..length + bytes.len()) else {
                    let message = format_args!("a word of more than {MAX_WORD} bytes");
                    return Err(begin.error(message));
                };
                room.copy_from_slice(bytes);
                length += bytes.len();
                Ok(())
            },
        )?;
        Ok(std::str::from_utf8(&self.word[..length]).unwrap_or_default())
    }

    /// Takes all bytes that follow and `belong`; `see` gets them in pieces, and room for a word.
    pub fn pass(
        &mut self,
        belong: impl Fn(u8) -> bool,
        mut see: impl FnMut(&mut [u8; MAX_WORD], &[u8]) -> Result<()>,
    ) -> Result<()> {
        loop {
            let bytes = buffered(self.input, self.place)?;
            let length = bytes.iter().position(|byte| !belong(*byte)).unwrap_or(bytes.len());
            if length == 0 {
                return Ok(());
            }
            see(&mut self.word, &bytes[..length])?;
            self.place = self.place.after(&bytes[..length]);
            self.input.consume(length);
        }
    }

    /// Returns the error of the next byte where something else is expected.
    pub fn unexpected(&mut self, expected: impl fmt::Display) -> Error {
        let place = self.place;
        match self.ahead() {
            Ok(None) => {
                let message = message!("the file ends at {place}, where {expected} is expected");
                Error::format(message)
            }
            Ok(Some(0)) => place.error("a NUL byte; this is not a text file"),
            Ok(Some(byte)) => {
                let byte = [byte];
                let found = byte.escape_ascii();
                place.error(format_args!("\"{found}\" where {expected} is expected"))
            }
            Err(error) => error,
        }
    }
}

/// Returns the next bytes; none at the end of the file.
fn buffered(input: &mut dyn BufRead, place: TextPosition) -> Result<&[u8]> {
    // The borrow of a buffer that is returned at once would last for the loop.
    while let Err(error) = input.fill_buf() {
        if error.kind() != io::ErrorKind::Interrupted {
            return Err(io_error(&message!("cannot read on at {place}"), &error));
        }
    }
    input.fill_buf().map_err(|error| io_error(&message!("cannot read on at {place}"), &error))
}
