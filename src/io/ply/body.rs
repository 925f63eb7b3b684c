//! The rows that a header declares. All must be there; only the points are kept.

use super::super::binary::Binary;
use super::super::text::{Line, Lines, Points, quoted};
use super::header::{Element, Header, Kind, Scalar};
use crate::error::{ErrorKind, Result, message};
use std::io::BufRead;

/// A row per line.
pub(super) fn read_text(header: &Header, lines: &mut Lines<'_>, points: &mut Points) -> Result<()> {
    for element in &header.elements {
        for index in 0..element.count {
            let line = lines.require(|| lacks(element, index))?;
            let mut row = TextRow { line: &line, words: line.words() };
            let mut point = [0.0; 3];
            for property in &element.properties {
                match (property.axis, property.kind) {
                    (Some(axis), _) => point[axis] = row.coordinate()?,
                    (None, Kind::Scalar(_)) => row.skip(1)?,
                    (None, Kind::List { .. }) => {
                        let length = row.length()?;
                        row.skip(length)?;
                    }
                }
            }
            row.require_end()?;
            if element.holds_points() {
                add(points, &point[..header.dim])
                    .map_err(|error| line.error_of_kind(error.kind(), error.message()))?;
            }
        }
    }
    lines.require_end("the elements of the header")
}

fn add(points: &mut Points, point: &[f64]) -> Result<()> {
    point.iter().try_for_each(|value| points.push(*value))
}

fn lacks(element: &Element, index: u64) -> String {
    format!("{index} of {} elements {}", element.count, quoted(&element.name))
}

struct TextRow<'a, W> {
    line: &'a Line<'a>,
    words: W,
}

impl<'a, W: Iterator<Item = (usize, &'a str)>> TextRow<'a, W> {
    fn next(&mut self) -> Result<(usize, &'a str)> {
        self.words.next().ok_or_else(|| self.line.error("the line ends before its last property"))
    }

    fn coordinate(&mut self) -> Result<f64> {
        let (column, word) = self.next()?;
        self.line.coordinate(column, word)
    }

    fn length(&mut self) -> Result<u64> {
        let (column, word) = self.next()?;
        self.line.integer(column, word, "length of a list")
    }

    fn skip(&mut self, count: u64) -> Result<()> {
        for _ in 0..count {
            let (column, word) = self.next()?;
            self.line.skip_number(column, word)?;
        }
        Ok(())
    }

    fn require_end(&mut self) -> Result<()> {
        match self.words.next() {
            None => Ok(()),
            Some((column, _)) => {
                let message = "more numbers than the element has properties";
                Err(self.line.field_error(ErrorKind::Format, column, message))
            }
        }
    }
}

pub(super) fn read_binary(
    header: &Header,
    input: &mut dyn BufRead,
    big_endian: bool,
    points: &mut Points,
) -> Result<()> {
    let mut rows = BinaryRows { binary: Binary::new(input, " after the header"), big_endian };
    for element in &header.elements {
        match element.row_size() {
            Some(size) if !element.holds_points() => {
                // At most 1000 properties of 8 bytes: beyond 2^64 bytes is beyond every file.
                let bytes = element.count.saturating_mul(size);
                rows.binary
                    .skip(bytes, || format!("not all elements {}", quoted(&element.name)))?;
            }
            _ => {
                for index in 0..element.count {
                    rows.read(element, index, header.dim, points)?;
                }
            }
        }
    }
    rows.binary.require_end("the elements of the header")
}

struct BinaryRows<'a> {
    binary: Binary<'a>,
    big_endian: bool,
}

impl BinaryRows<'_> {
    fn read(
        &mut self,
        element: &Element,
        index: u64,
        dim: usize,
        points: &mut Points,
    ) -> Result<()> {
        let lacks = || lacks(element, index);
        let mut point = [0.0; 3];
        for property in &element.properties {
            match (property.axis, property.kind) {
                (Some(axis), Kind::Scalar(scalar)) => {
                    let value = self.scalar(scalar, lacks)?;
                    if !value.is_finite() {
                        let message = message!(
                            "vertex {index}, {}: {value}; every coordinate must be finite",
                            property.name
                        );
                        let size = scalar.size() as u64;
                        return Err(self.binary.error_at(size, ErrorKind::NonFinite, &message));
                    }
                    point[axis] = value;
                }
                (_, Kind::Scalar(scalar)) => self.binary.skip(scalar.size() as u64, lacks)?,
                (_, Kind::List { length, item }) => {
                    let count = self.scalar(length, lacks)?;
                    if count < 0.0 {
                        let message = message!("a list of {count} numbers");
                        let size = length.size() as u64;
                        return Err(self.binary.error_at(size, ErrorKind::Format, &message));
                    }
                    self.binary.skip(count as u64 * item.size() as u64, lacks)?;
                }
            }
        }
        if element.holds_points() { add(points, &point[..dim]) } else { Ok(()) }
    }

    fn scalar(&mut self, scalar: Scalar, lacks: impl FnOnce() -> String) -> Result<f64> {
        let mut bytes = [0; 8];
        let used = &mut bytes[..scalar.size()];
        self.binary.fill(used, lacks)?;
        if self.big_endian {
            used.reverse();
        }
        Ok(scalar.value(bytes))
    }
}
