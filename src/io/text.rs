//! Reading of text formats: lines with a bound on their length, numbers, and the numbers' way back
//! to text.

use super::{PointCloud, io_error};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::TryGrow;
use crate::mesh::{MAX_DIM, MIN_DIM};
use std::fmt::Display;
use std::io::{self, BufRead, Read, Write};
use std::ops::Range;

/// The longest line that is read, with its end: a file without line ends must not fill the memory.
const MAX_LINE: usize = 1 << 20;

const NUL: &str = "a NUL byte; this is not a text file";

/// The lines of a text that say something: comments are dropped, blank lines skipped.
pub(super) struct Lines<'a> {
    input: &'a mut dyn BufRead,
    /// The line that was read last, as it is in the file.
    line: String,
    /// Part of it without its comment and blanks.
    content: Range<usize>,
    number: u64,
    /// A `#` between quotes begins no comment.
    has_quotes: bool,
}

/// A line, without comment and surrounding blanks; never empty.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    /// Number of the line, counted from 1, blank lines and comments included.
    number: u64,
    pub text: &'a str,
}

impl<'a> Lines<'a> {
    pub fn new(input: &'a mut dyn BufRead) -> Self {
        Self { input, line: String::new(), content: 0..0, number: 0, has_quotes: false }
    }

    /// Reads lines of a format in which fields may stand between quotes.
    pub fn with_quotes(input: &'a mut dyn BufRead) -> Self {
        Self { has_quotes: true, ..Self::new(input) }
    }

    /// Returns the next line that says something.
    pub fn next(&mut self) -> Result<Option<Line<'_>>> {
        Ok(if self.advance()? { Some(self.current()) } else { None })
    }

    /// Returns the next line; the error of a file that ends instead tells what it `lacks`.
    pub fn require(&mut self, lacks: impl FnOnce() -> String) -> Result<Line<'_>> {
        if !self.advance()? {
            let message = format!("the file ends after line {}: {}", self.number, lacks());
            return Err(Error::format(message));
        }
        Ok(self.current())
    }

    /// Refuses further data.
    pub fn require_end(&mut self, after: &str) -> Result<()> {
        match self.next()? {
            None => Ok(()),
            Some(line) => Err(line.error(format!("more data after {after}"))),
        }
    }

    /// Reads up to the next line that is neither blank nor a comment; false at the end of the file.
    fn advance(&mut self) -> Result<bool> {
        while self.fill()? {
            if !self.content.is_empty() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn current(&self) -> Line<'_> {
        Line { number: self.number, text: &self.line[self.content.clone()] }
    }

    /// Reads one line, whatever is in it; false at the end of the file.
    fn fill(&mut self) -> Result<bool> {
        let mut bytes = std::mem::take(&mut self.line).into_bytes();
        bytes.clear();
        self.skip_empty_lines()?;
        let mut bounded = (&mut *self.input).take(MAX_LINE as u64 + 1);
        let length = bounded
            .read_until(b'\n', &mut bytes)
            .map_err(|error| cannot_read_on(self.number, &error))?;
        if length == 0 {
            return Ok(false);
        }
        self.number += 1;
        if length > MAX_LINE {
            // What is no text at all has no lines either, and that says more.
            self.refuse_byte(&bytes, 0, NUL)?;
            return Err(self.refused("the line is longer than 1 MiB"));
        }
        self.decode(bytes)?;
        Ok(true)
    }

    /// Passes over the empty lines at the front of the input's buffer, some ten times faster than
    /// line by line: a file may be a gigabyte of nothing else.
    fn skip_empty_lines(&mut self) -> Result<()> {
        loop {
            let buffered = match self.input.fill_buf() {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                buffered => buffered.map_err(|error| cannot_read_on(self.number, &error))?,
            };
            let (mut length, mut lines) = (0, 0);
            loop {
                length += match &buffered[length..] {
                    [b'\n', ..] => 1,
                    [b'\r', b'\n', ..] => 2,
                    _ => break,
                };
                lines += 1;
            }
            let more_may_follow = length > 0 && length == buffered.len();
            self.input.consume(length);
            self.number += lines;
            if !more_may_follow {
                return Ok(());
            }
        }
    }

    /// Takes the bytes of a line as text, and finds what it says.
    fn decode(&mut self, bytes: Vec<u8>) -> Result<()> {
        const MARK: &[u8] = b"\xef\xbb\xbf";
        let start = if self.number == 1 && bytes.starts_with(MARK) { MARK.len() } else { 0 };
        let mut line = &bytes[start..];
        line = line.strip_suffix(b"\n").unwrap_or(line);
        line = line.strip_suffix(b"\r").unwrap_or(line);
        self.refuse_byte(line, 0, NUL)?;
        // As a blank it would join two lines of an old text file into one point.
        let why = "a carriage return inside the line; lines end with LF or CR LF";
        self.refuse_byte(line, b'\r', why)?;
        let end = start + line.len();
        self.line = String::from_utf8(bytes).map_err(|error| {
            let index = error.utf8_error().valid_up_to() - start;
            self.refused_byte(index, "the line is not valid UTF-8")
        })?;
        let (first, length) = content(&self.line[start..end], self.has_quotes);
        self.content = start + first..start + first + length;
        Ok(())
    }

    fn refuse_byte(&self, line: &[u8], byte: u8, why: &str) -> Result<()> {
        // To ask whether it is there takes a fraction of the time that it takes to ask where.
        if !line.contains(&byte) {
            return Ok(());
        }
        let index = line.iter().position(|b| *b == byte).unwrap_or_default();
        Err(self.refused_byte(index, why))
    }

    /// Returns the error of a byte of the line, counted from 0 here and from 1 in the message.
    fn refused_byte(&self, index: usize, why: &str) -> Error {
        let message = format!("line {}, byte {}: {why}", self.number, index + 1);
        Error::format(message)
    }

    fn refused(&self, why: &str) -> Error {
        self.error(ErrorKind::Format, why)
    }

    /// Returns the error of the line that was read last.
    pub fn error(&self, kind: ErrorKind, why: &str) -> Error {
        Error::new(kind, format!("line {}: {why}", self.number))
    }
}

fn cannot_read_on(line: u64, error: &io::Error) -> Error {
    io_error(&format!("cannot read on after line {line}"), error)
}

/// Returns where the part before the comment begins, without blanks around it, and its length.
fn content(line: &str, has_quotes: bool) -> (usize, usize) {
    let mut is_between = false;
    let begins_comment = |c: char| {
        is_between ^= has_quotes && c == '"';
        c == '#' && !is_between
    };
    let end = match has_quotes && line.contains('"') {
        true => line.find(begins_comment),
        false => line.find('#'),
    };
    let content = line[..end.unwrap_or(line.len())].trim_ascii_end();
    let trimmed = content.trim_ascii_start();
    (content.len() - trimmed.len(), trimmed.len())
}

impl<'a> Line<'a> {
    pub fn error(&self, message: impl AsRef<str>) -> Error {
        self.error_of_kind(ErrorKind::Format, message)
    }

    pub fn error_of_kind(&self, kind: ErrorKind, message: impl AsRef<str>) -> Error {
        Error::new(kind, format!("line {}: {}", self.number, message.as_ref()))
    }

    /// Returns the error of the field in `column`, counted from 0 here and from 1 in the message.
    pub fn field_error(&self, kind: ErrorKind, column: usize, message: impl AsRef<str>) -> Error {
        let message = format!("line {}, column {}: {}", self.number, column + 1, message.as_ref());
        Error::new(kind, message)
    }

    /// Returns the fields between blanks, each with its column.
    pub fn words(&self) -> impl Iterator<Item = (usize, &'a str)> + use<'a> {
        self.text.split_ascii_whitespace().enumerate()
    }

    pub fn word_count(&self) -> usize {
        self.text.split_ascii_whitespace().count()
    }

    /// Parses a count or an id: decimal digits.
    pub fn integer(&self, column: usize, field: &str, what: &str) -> Result<u64> {
        field.parse().map_err(|_| {
            let message = format!("{} is no {what}", quoted(field));
            self.field_error(ErrorKind::Format, column, message)
        })
    }

    /// Parses a line of counts and ids, and nothing else.
    pub fn integers<const N: usize>(&self, names: [&str; N]) -> Result<[u64; N]> {
        self.require_words(N)?;
        let mut numbers = [0; N];
        for (column, word) in self.words() {
            numbers[column] = self.integer(column, word, names[column])?;
        }
        Ok(numbers)
    }

    pub fn require_words(&self, count: usize) -> Result<()> {
        match self.word_count() {
            words if words == count => Ok(()),
            words => Err(self.error(format!("{words} columns where {count} are expected"))),
        }
    }

    /// Looks at a number only to see that the columns are what they should be.
    pub fn skip_number(&self, column: usize, field: &str) -> Result<()> {
        match field.parse::<f64>() {
            Ok(_) => Ok(()),
            Err(_) => Err(self.not_a_number(column, field)),
        }
    }

    /// Parses a coordinate: a decimal number that a double can hold.
    ///
    /// # Errors
    /// `Format`: empty, not a number, or too large; `NonFinite`: `nan` or `inf`.
    pub fn coordinate(&self, column: usize, field: &str) -> Result<f64> {
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) if field.bytes().any(|byte| byte.is_ascii_digit()) => {
                let message = format!("{} is too large for a double", quoted(field));
                Err(self.field_error(ErrorKind::Format, column, message))
            }
            Ok(_) => {
                let message = format!("{}; every coordinate must be finite", quoted(field));
                Err(self.field_error(ErrorKind::NonFinite, column, message))
            }
            Err(_) => Err(self.not_a_number(column, field)),
        }
    }

    /// Parses a whole number of 32 bits, which some programs also write as `3.0`.
    pub fn whole(&self, column: usize, field: &str, what: &str) -> Result<i32> {
        let found = whole(self.coordinate(column, field)?, field, what);
        found.map_err(|why| self.field_error(ErrorKind::Format, column, why).of_content())
    }

    /// Parses the value of an attribute: any double, nan and infinity too. An empty field stands
    /// for nan.
    pub fn value(&self, column: usize, field: &str, name: &str) -> Result<f64> {
        let rule = match field.parse::<f64>() {
            _ if field.is_empty() => return Ok(f64::NAN),
            Ok(value) if value.is_infinite() && field.bytes().any(|b| b.is_ascii_digit()) => {
                "is too large for a double"
            }
            Ok(value) => return Ok(value),
            Err(_) => "is not a number",
        };
        let message = format!("{} {rule}; attribute {name} has numbers", quoted(field));
        Err(self.field_error(ErrorKind::Format, column, message))
    }

    pub fn not_a_number(&self, column: usize, field: &str) -> Error {
        let message = match field {
            "" => "the field is empty".to_string(),
            _ if field.contains(';') => format!(
                "{} is not a number; semicolons separate no numbers here, and the decimal sign is \
                 a point",
                quoted(field)
            ),
            _ => format!("{} is not a number", quoted(field)),
        };
        self.field_error(ErrorKind::Format, column, message)
    }

    /// Returns a dimension that this crate meshes, and refuses others.
    pub fn check_dimension(&self, dim: u64) -> Result<usize> {
        if !(MIN_DIM as u64..=MAX_DIM as u64).contains(&dim) {
            let message = format!("points of dimension {dim}; it must be {MIN_DIM} to {MAX_DIM}");
            return Err(self.error_of_kind(ErrorKind::Dimension, message));
        }
        Ok(dim as usize)
    }
}

/// Returns a number as one of 32 bits, or the message about one, `shown`, that is none.
pub(super) fn whole(
    value: f64,
    shown: impl Display,
    what: &str,
) -> std::result::Result<i32, String> {
    match (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&value) {
        true if value == value.trunc() => Ok(value as i32),
        _ => Err(format!("{shown} is no {what}: a whole number of 32 bits")),
    }
}

/// Returns a field as a message shows it: a line may be one field of a million bytes.
pub(super) fn quoted(field: &str) -> String {
    const SHOWN: usize = 40;
    let mut characters = field.chars();
    let shown: String = characters.by_ref().take(SHOWN).collect();
    let rest = if characters.next().is_some() { "..." } else { "" };
    format!("{:?}", shown + rest)
}

/// The points read so far. Grows with the data, never with what a header claims.
#[derive(Default)]
pub(super) struct Points {
    /// Dimension of the points: 0 before the first point.
    dim: usize,
    coordinates: Vec<f64>,
}

impl Points {
    /// Makes an empty list of points of a dimension that a header gave.
    pub fn of_dimension(dim: usize) -> Self {
        Self { dim, coordinates: Vec::new() }
    }

    /// Adds the point whose coordinates are `fields` (each with its column); the first point sets
    /// the dimension where no header did.
    pub fn add<'f>(
        &mut self,
        line: &Line<'_>,
        fields: impl Iterator<Item = (usize, &'f str)>,
    ) -> Result<()> {
        let mut count = 0;
        for (column, field) in fields {
            let value = line.coordinate(column, field)?;
            self.push(value).map_err(|e| line.error_of_kind(e.kind(), e.message()))?;
            count += 1;
        }
        if self.dim == 0 {
            self.dim = line.check_dimension(count as u64)?;
        }
        if count != self.dim {
            let message = format!("{count} coordinates where {} are expected", self.dim);
            return Err(line.error(message));
        }
        Ok(())
    }

    /// Returns the number of points, whose dimension is known.
    pub fn count(&self) -> usize {
        self.coordinates.len() / self.dim
    }

    /// Adds one coordinate; here it is the caller who counts.
    pub fn push(&mut self, value: f64) -> Result<()> {
        self.coordinates.try_push(value).map_err(|_| {
            let message = message!("no memory for more than {} numbers", self.coordinates.len());
            Error::new(ErrorKind::OutOfMemory, message)
        })
    }

    pub fn finish(self) -> Result<PointCloud> {
        if self.coordinates.is_empty() {
            return Err(Error::format("the file holds no points"));
        }
        Ok(PointCloud { dim: self.dim, coordinates: self.coordinates })
    }
}

/// Writes `value` as the shortest decimal that reads back as the same bits; far from 1 with an
/// exponent, as 1e300 would otherwise take 301 digits.
pub(super) fn write_number(out: &mut dyn Write, value: f64) -> io::Result<()> {
    if value == 0.0 || (1e-5..1e16).contains(&value.abs()) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    }
}

/// Writes a point's coordinates with `separator` between them.
pub(super) fn write_point(out: &mut dyn Write, point: &[f64], separator: &str) -> io::Result<()> {
    for (axis, value) in point.iter().enumerate() {
        if axis > 0 {
            out.write_all(separator.as_bytes())?;
        }
        write_number(out, *value)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    fn lines_of(text: &[u8]) -> Result<Vec<(u64, String)>> {
        let mut input = text;
        let mut lines = Lines::new(&mut input);
        let mut all = Vec::new();
        while let Some(line) = lines.next()? {
            all.push((line.number, line.text.to_string()));
        }
        Ok(all)
    }

    #[test]
    fn numbers_lines_past_comments_blank_lines_and_a_byte_order_mark() {
        let text = b"\xef\xbb\xbfa\r\n\n # c\n b # c\r\n\t\nc";
        let expected = [(1, "a"), (4, "b"), (6, "c")].map(|(n, text)| (n, text.to_string()));
        assert_eq!(lines_of(text).unwrap(), expected);
    }

    #[test]
    fn numbers_lines_past_any_empty_ones() {
        for (text, number) in [
            (&b"\n\n\na"[..], 4),
            (b"\r\n\r\na", 3),
            (b"\r\n\n \n\n\r\na\n\n", 6),
            (b"\xef\xbb\xbf\n\na", 3),
        ] {
            // However the input comes, a line's end in two pieces too.
            for capacity in [1, 2, 3, 100] {
                let mut input = io::BufReader::with_capacity(capacity, text);
                let mut lines = Lines::new(&mut input);
                let line = lines.next().unwrap().unwrap();
                assert_eq!((line.number, line.text), (number, "a"), "{}", text.escape_ascii());
                assert!(lines.next().unwrap().is_none());
            }
        }
        assert!(lines_of(b"\n\n").unwrap().is_empty());
        let error = lines_of(b"\n\r\r\n").unwrap_err();
        assert!(error.message().starts_with("line 2, byte 1: a carriage return"), "{error}");
    }

    #[test]
    fn bytes_that_are_no_text_are_counted_from_the_begin_of_their_line() {
        for (text, line, byte, why) in [
            (&b"a\0\r\xff\n"[..], 1, 2, "a NUL byte; this is not a text file"),
            (b"\xef\xbb\xbfa\0", 1, 2, "a NUL byte; this is not a text file"),
            (b" \n\xff\r\r\n", 2, 2, "a carriage return inside the line"),
            (b"# \xff\n", 1, 3, "the line is not valid UTF-8"),
            (b"\xef\xbb\xbf12\xe9\n", 1, 3, "the line is not valid UTF-8"),
            (b"\xc3\xa9\n\xef\xbb\xbf\xe9\r\n", 2, 4, "the line is not valid UTF-8"),
        ] {
            let refused = lines_of(text).unwrap_err();
            let expected = format!("line {line}, byte {byte}: {why}");
            assert!(refused.message().starts_with(&expected), "{refused}: {expected}");
        }
    }

    #[test]
    fn what_a_line_says_is_between_its_blanks_and_before_its_comment() {
        let text = "\u{feff} \t\u{e9} b \t# \u{e9}\r\n  \r\n #\n\u{feff}c#d\n e";
        let expected = [(1, "\u{e9} b"), (4, "\u{feff}c"), (5, "e")];
        let expected = expected.map(|(number, text)| (number, text.to_string()));
        assert_eq!(lines_of(text.as_bytes()).unwrap(), expected);
    }

    #[test]
    fn bounds_the_length_of_a_line() {
        let mut text = vec![b' '; MAX_LINE - 1];
        text.extend_from_slice(b"\n1");
        assert_eq!(lines_of(&text).unwrap(), [(2, "1".to_string())]);
        text.insert(0, b' ');
        let error = lines_of(&text).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Format);
        assert_eq!(error.message(), "line 1: the line is longer than 1 MiB");
    }

    #[test]
    fn does_not_read_on_in_a_line_that_is_too_long() {
        // An endless line: only the bound ends this test.
        let mut input = io::BufReader::new(io::repeat(b'1'));
        let mut lines = Lines::new(&mut input);
        assert_eq!(lines.next().err().unwrap().kind(), ErrorKind::Format);
    }

    #[test]
    fn messages_do_not_carry_long_fields() {
        let line = Line { number: 7, text: "" };
        let message = line.coordinate(1, &"x".repeat(1000)).unwrap_err().message().to_string();
        assert!(message.starts_with("line 7, column 2: \"xxx"), "{message}");
        assert!(message.len() < 100, "{message}");
    }

    #[test]
    fn a_reader_that_fails_is_an_io_error() {
        let mut input = io::BufReader::new(b"1 2\n".chain(crate::io::samples::FailingReader));
        let error = super::super::read(&mut input, super::super::Format::Xyz).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        assert_eq!(error.message(), "cannot read on after line 1: the disk is gone");
    }

    #[test]
    fn numbers_read_back_as_the_same_bits() {
        let mut random = Random(1);
        let mut values: Vec<f64> = (0..2000).map(|_| random.raw()).collect();
        values.extend_from_slice(&super::super::samples::AWKWARD);
        for value in values {
            let mut text = Vec::new();
            write_number(&mut text, value).unwrap();
            let text = String::from_utf8(text).unwrap();
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
            assert!(text.len() <= 24, "{text}");
        }
    }
}
