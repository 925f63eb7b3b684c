//! The rows that a header declares. All must be there; only the points are kept.

use super::super::binary::Binary;
use super::super::text::{Line, Lines, quoted, whole};
use super::Rows;
use super::header::{Element, Header, Kind, Scalar};
use crate::error::{ErrorKind, Result, message};
use crate::memory::TryGrow;
use std::fmt::Display;
use std::io::BufRead;

/// Reads a row per line.
pub(super) fn read_text(header: &Header, lines: &mut Lines<'_>, rows: &mut Rows) -> Result<()> {
    for element in &header.elements {
        for index in 0..element.count {
            let line = lines.require(|| lacks(element, index))?;
            let mut row = TextRow { line: &line, words: line.words() };
            let mut point = [0.0; 3];
            for (property, column) in element.properties.iter().zip(0..) {
                let (place, word) = row.next()?;
                match (property.axis, property.kind) {
                    (Some(axis), _) => point[axis] = line.coordinate(place, word)?,
                    (None, Kind::Scalar(_)) if property.is_marker => {
                        rows.marker = line.whole(place, word, "marker")?;
                    }
                    (None, Kind::Scalar(_)) => line.skip_number(place, word)?,
                    (None, Kind::List { .. }) => {
                        let length = line.integer(place, word, "length of a list")?;
                        match property.is_face {
                            true => row.read_face(length, header.vertices, &mut rows.face)?,
                            false => row.skip(length)?,
                        }
                    }
                }
                if element.holds_points() {
                    rows.values.add(&line, place, column, word)?;
                }
            }
            row.require_end()?;
            let added = match element.holds_points() {
                true => rows.add_point(&point[..header.dim]),
                false => rows.add_face(),
            };
            added.map_err(|error| line.error_of_kind(error.kind(), error.message()))?;
        }
    }
    lines.require_end("the elements of the header")
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

    fn skip(&mut self, count: u64) -> Result<()> {
        for _ in 0..count {
            let (column, word) = self.next()?;
            self.line.skip_number(column, word)?;
        }
        Ok(())
    }

    /// Reads the vertices of a face.
    fn read_face(&mut self, count: u64, vertices: u64, face: &mut Vec<u32>) -> Result<()> {
        for _ in 0..count {
            let (column, word) = self.next()?;
            let vertex = self.line.integer(column, word, "vertex id")?;
            if vertex >= vertices {
                let message = outside(vertex, vertices);
                return Err(self.line.field_error(ErrorKind::Format, column, message).of_content());
            }
            face.try_push(u32::try_from(vertex).unwrap_or(u32::MAX))?;
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

fn outside(vertex: impl Display, vertices: u64) -> String {
    format!("vertex id {vertex} of {vertices} vertices")
}

pub(super) fn read_binary(
    header: &Header,
    input: &mut dyn BufRead,
    big_endian: bool,
    rows: &mut Rows,
) -> Result<()> {
    let mut file = BinaryRows { binary: Binary::new(input, " after the header"), big_endian };
    for element in &header.elements {
        match element.row_size() {
            Some(size) if !element.holds_points() => {
                // At most 1000 properties of 8 bytes: beyond 2^64 bytes is beyond every file.
                let bytes = element.count.saturating_mul(size);
                file.binary
                    .skip(bytes, || format!("not all elements {}", quoted(&element.name)))?;
            }
            _ => {
                for index in 0..element.count {
                    file.read(header, element, index, rows)?;
                }
            }
        }
    }
    file.binary.require_end("the elements of the header")
}

struct BinaryRows<'a> {
    binary: Binary<'a>,
    big_endian: bool,
}

impl BinaryRows<'_> {
    fn read(
        &mut self,
        header: &Header,
        element: &Element,
        index: u64,
        rows: &mut Rows,
    ) -> Result<()> {
        let lacks = || lacks(element, index);
        let mut point = [0.0; 3];
        for (property, column) in element.properties.iter().zip(0..) {
            let attribute = match element.holds_points() {
                true => rows.values.of_column(column),
                false => None,
            };
            match property.kind {
                Kind::Scalar(scalar) if property.axis.is_some() || attribute.is_some() => {
                    let value = self.scalar(scalar, lacks)?;
                    if let Some(axis) = property.axis {
                        self.require_finite(value, scalar, index, &property.name)?;
                        point[axis] = value;
                    }
                    if let Some(attribute) = attribute {
                        rows.values.push(attribute, value)?;
                    }
                }
                Kind::Scalar(scalar) if property.is_marker => {
                    rows.marker = self.read_marker(scalar, lacks)?;
                }
                Kind::Scalar(scalar) => self.binary.skip(scalar.size() as u64, lacks)?,
                Kind::List { length, item } => {
                    let count = self.scalar(length, lacks)?;
                    if count < 0.0 {
                        let message = message!("a list of {count} numbers");
                        let size = length.size() as u64;
                        return Err(self.binary.error_at(size, ErrorKind::Format, &message));
                    }
                    match property.is_face {
                        true => {
                            self.read_face((count as u64, item), header.vertices, lacks, rows)?;
                        }
                        false => self.binary.skip(count as u64 * item.size() as u64, lacks)?,
                    }
                }
            }
        }
        match element.holds_points() {
            true => rows.add_point(&point[..header.dim]),
            false => rows.add_face(),
        }
    }

    /// Reads the vertices of a face: as many numbers of a type.
    fn read_face(
        &mut self,
        (count, item): (u64, Scalar),
        vertices: u64,
        lacks: impl Fn() -> String,
        rows: &mut Rows,
    ) -> Result<()> {
        for _ in 0..count {
            let vertex = self.scalar(item, &lacks)?;
            if !(0.0..vertices as f64).contains(&vertex) || vertex != vertex.trunc() {
                let (size, message) = (item.size() as u64, outside(vertex, vertices));
                let error = self.binary.error_at(size, ErrorKind::Format, &message);
                return Err(error.of_content());
            }
            rows.face.try_push(if vertex < f64::from(u32::MAX) {
                vertex as u32
            } else {
                u32::MAX
            })?;
        }
        Ok(())
    }

    /// Reads the marker of a face, a whole number of any type.
    fn read_marker(&mut self, scalar: Scalar, lacks: impl FnOnce() -> String) -> Result<i32> {
        let value = self.scalar(scalar, lacks)?;
        whole(value, value, "marker").map_err(|why| {
            self.binary.error_at(scalar.size() as u64, ErrorKind::Format, &why).of_content()
        })
    }

    fn require_finite(&self, value: f64, scalar: Scalar, index: u64, name: &str) -> Result<()> {
        if value.is_finite() {
            return Ok(());
        }
        let message = message!("vertex {index}, {name}: {value}; every coordinate must be finite");
        Err(self.binary.error_at(scalar.size() as u64, ErrorKind::NonFinite, &message))
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
