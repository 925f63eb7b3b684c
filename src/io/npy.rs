//! NumPy's `.npy`: a header in Python's notation, then the array's numbers.

use super::PointCloud;
use super::binary::Binary;
use super::columns::{Columns, transposed};
use super::text::{Points, quoted};
use super::xyz::for_each_vertex;
use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::{MAX_DIM, MIN_DIM, Mesh};
use std::io::{self, BufRead, Write};

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// The longest header that is read. NumPy's own limit is 10,000 bytes.
const MAX_HEADER: usize = 1 << 16;

pub(super) fn read(input: &mut dyn BufRead, columns: &Columns) -> Result<PointCloud> {
    let mut binary = Binary::new(input, "");
    let header = read_header(&mut binary, columns)?;
    let chosen = match columns.are_chosen() {
        true => columns.indices(header.columns, None)?,
        false => (0..header.columns).collect(),
    };
    let points = Points::of_dimension(chosen.len());
    if header.points == 0 {
        return points.finish();
    }
    match header.fortran_order {
        false => read_by_point(&mut binary, &header, &chosen, points),
        true => read_by_column(&mut binary, &header, &chosen, points),
    }
}

/// C order.
fn read_by_point(
    binary: &mut Binary<'_>,
    header: &Header,
    chosen: &[u64],
    mut points: Points,
) -> Result<PointCloud> {
    let mut point = [0.0; MAX_DIM];
    for row in 0..header.points {
        for column in 0..header.columns {
            let lacks = || format!("{row} of {} points", header.points);
            let value = header.number.read(binary, lacks)?;
            if let Some(axis) = chosen.iter().position(|other| *other == column) {
                point[axis] = finite(binary, header, value, row, column)?;
            }
        }
        point[..chosen.len()].iter().try_for_each(|value| points.push(*value))?;
    }
    binary.require_end("the array")?;
    points.finish()
}

/// Fortran's order.
fn read_by_column(
    binary: &mut Binary<'_>,
    header: &Header,
    chosen: &[u64],
    mut points: Points,
) -> Result<PointCloud> {
    for column in 0..header.columns {
        let is_chosen = chosen.contains(&column);
        for row in 0..header.points {
            let lacks = || format!("{row} of {} points, coordinate {column}", header.points);
            let value = header.number.read(binary, lacks)?;
            if is_chosen {
                points.push(finite(binary, header, value, row, column)?)?;
            }
        }
    }
    binary.require_end("the array")?;
    transposed(points.finish()?, chosen)
}

fn finite(
    binary: &Binary<'_>,
    header: &Header,
    value: f64,
    point: u64,
    column: u64,
) -> Result<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    let message =
        message!("point {point}, coordinate {column}: {value}; every coordinate must be finite");
    Err(binary.error_at(header.number.size(), ErrorKind::NonFinite, &message))
}

fn check_dimension(columns: u64) -> Result<()> {
    match (MIN_DIM as u64..=MAX_DIM as u64).contains(&columns) {
        true => Ok(()),
        false => {
            let message =
                message!("points of dimension {columns}; it must be {MIN_DIM} to {MAX_DIM}");
            Err(Error::new(ErrorKind::Dimension, message))
        }
    }
}

/// What the bytes of a number mean.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Double { big_endian: bool },
    Float { big_endian: bool },
}

impl Number {
    fn of_description(description: &str) -> Option<Self> {
        let (order, kind) = description.split_at_checked(1)?;
        let big_endian = match order {
            "<" => false,
            ">" => true,
            "=" => cfg!(target_endian = "big"),
            _ => return None,
        };
        match kind {
            "f8" => Some(Self::Double { big_endian }),
            "f4" => Some(Self::Float { big_endian }),
            _ => None,
        }
    }

    fn size(self) -> u64 {
        match self {
            Self::Double { .. } => 8,
            Self::Float { .. } => 4,
        }
    }

    fn read(self, binary: &mut Binary<'_>, lacks: impl FnOnce() -> String) -> Result<f64> {
        Ok(match self {
            Self::Double { big_endian: false } => f64::from_le_bytes(binary.next(lacks)?),
            Self::Double { big_endian: true } => f64::from_be_bytes(binary.next(lacks)?),
            Self::Float { big_endian: false } => f32::from_le_bytes(binary.next(lacks)?).into(),
            Self::Float { big_endian: true } => f32::from_be_bytes(binary.next(lacks)?).into(),
        })
    }
}

struct Header {
    number: Number,
    fortran_order: bool,
    points: u64,
    /// Numbers of a point: its coordinates, and what else a file may have.
    columns: u64,
}

fn read_header(binary: &mut Binary<'_>, columns: &Columns) -> Result<Header> {
    let lacks = || "the header of an .npy file is not complete".to_string();
    let magic: [u8; 6] = binary.next(lacks)?;
    if magic != *MAGIC {
        let message = "the file does not begin as an .npy file does";
        return Err(binary.error_at(6, ErrorKind::Format, message));
    }
    let version: [u8; 2] = binary.next(lacks)?;
    let length = match version {
        [1, 0] => u32::from(u16::from_le_bytes(binary.next(lacks)?)),
        [2 | 3, 0] => u32::from_le_bytes(binary.next(lacks)?),
        [major, minor] => {
            let message = message!("version {major}.{minor}; versions 1.0, 2.0 and 3.0 are read");
            return Err(binary.error_at(2, ErrorKind::Format, &message));
        }
    };
    if length as usize > MAX_HEADER {
        let message = message!("a header of {length} bytes; at most {MAX_HEADER} are read");
        let size = if version[0] == 1 { 2 } else { 4 };
        return Err(binary.error_at(size, ErrorKind::Format, &message));
    }
    let mut header = [0; MAX_HEADER];
    let header = &mut header[..length as usize];
    binary.fill(header, lacks)?;
    Header::parse(header, columns).map_err(|error| {
        let at = binary.error_at(length.into(), error.kind(), error.message());
        // Where nothing of the header is there, there is no byte to name.
        if length == 0 { error } else { at }
    })
}

impl Header {
    /// From `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }`.
    fn parse(text: &[u8], columns: &Columns) -> Result<Self> {
        let mut parser = Parser { rest: text };
        let (mut description, mut fortran_order, mut shape) = (None, None, None);
        parser.expect("{")?;
        while !parser.skip("}") {
            let key = parser.string()?;
            parser.expect(":")?;
            let seen_before = match key {
                "descr" => description.replace(parser.number()?).is_some(),
                "fortran_order" => fortran_order.replace(parser.boolean()?).is_some(),
                "shape" => {
                    let (points, numbers) = parser.shape()?;
                    if !columns.are_chosen() {
                        check_dimension(numbers)?;
                    }
                    shape.replace((points, numbers)).is_some()
                }
                _ => return Err(bad(message!("the unknown key {}", quoted(key)))),
            };
            if seen_before {
                return Err(bad(message!("the key {} twice", quoted(key))));
            }
            if !parser.skip(",") {
                parser.expect("}")?;
                break;
            }
        }
        if !parser.rest.trim_ascii().is_empty() {
            return Err(bad("more than a dictionary".into()));
        }
        let (Some(number), Some(fortran_order), Some((points, numbers))) =
            (description, fortran_order, shape)
        else {
            return Err(bad("'descr', 'fortran_order' and 'shape' are needed".into()));
        };
        Ok(Self { number, fortran_order, points, columns: numbers })
    }
}

fn bad(why: String) -> Error {
    Error::new(ErrorKind::Format, message!("in the header: {why}"))
}

/// Reads Python's notation, as much of it as headers have.
struct Parser<'a> {
    rest: &'a [u8],
}

impl<'a> Parser<'a> {
    fn skip(&mut self, token: &str) -> bool {
        let rest = self.rest.trim_ascii_start();
        match rest.strip_prefix(token.as_bytes()) {
            Some(rest) => self.rest = rest,
            None => return false,
        }
        true
    }

    fn expect(&mut self, token: &str) -> Result<()> {
        if self.skip(token) { Ok(()) } else { Err(self.unexpected(&message!("{token:?}"))) }
    }

    fn unexpected(&self, expected: &str) -> Error {
        let rest = String::from_utf8_lossy(&self.rest[..self.rest.len().min(200)]);
        bad(message!("{} where {expected} is expected", quoted(rest.trim_ascii())))
    }

    /// What is quoted once or twice, without escapes.
    fn string(&mut self) -> Result<&'a str> {
        let quote = if self.skip("'") {
            b'\''
        } else if self.skip("\"") {
            b'"'
        } else {
            return Err(self.unexpected("a string"));
        };
        let end = self.rest.iter().position(|&byte| byte == quote);
        let end = end.ok_or_else(|| bad("a string without an end".into()))?;
        let text = std::str::from_utf8(&self.rest[..end]).map_err(|_| bad("not UTF-8".into()))?;
        self.rest = &self.rest[end + 1..];
        Ok(text)
    }

    fn boolean(&mut self) -> Result<bool> {
        if self.skip("True") {
            Ok(true)
        } else if self.skip("False") {
            Ok(false)
        } else {
            Err(self.unexpected("True or False"))
        }
    }

    fn integer(&mut self) -> Result<u64> {
        let rest = self.rest.trim_ascii_start();
        let length = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let (digits, rest) = rest.split_at(length);
        let number = std::str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
        let number = number.ok_or_else(|| self.unexpected("a number below 2^64"))?;
        self.rest = rest;
        Ok(number)
    }

    /// The type of the numbers.
    fn number(&mut self) -> Result<Number> {
        let description = match self.rest.trim_ascii_start() {
            [b'[', ..] => {
                return Err(bad("an array of structures; one of doubles is needed".into()));
            }
            _ => self.string()?,
        };
        Number::of_description(description).ok_or_else(|| {
            bad(message!(
                "numbers of type {}; doubles ('<f8', '>f8') and floats ('<f4', '>f4') are read",
                quoted(description)
            ))
        })
    }

    /// Points, and numbers of each.
    fn shape(&mut self) -> Result<(u64, u64)> {
        let mut lengths = [0; 2];
        let mut count = 0;
        self.expect("(")?;
        while !self.skip(")") {
            let length = self.integer()?;
            if count < lengths.len() {
                lengths[count] = length;
            }
            count += 1;
            if !self.skip(",") {
                self.expect(")")?;
                break;
            }
        }
        if count != lengths.len() {
            return Err(bad(message!("a shape of {count} lengths; (points, dim) is needed")));
        }
        let [points, columns] = lengths;
        Ok((points, columns))
    }
}

/// Doubles in C order behind a header of version 1.0, the vertices or before a run the inputs.
pub(super) fn write(mesh: &Mesh, out: &mut dyn Write) -> io::Result<()> {
    let dim = mesh.inputs().dim();
    let points = mesh.triangulation().map_or(mesh.inputs().distinct(), |mesh| mesh.vertex_count());
    out.write_all(MAGIC)?;
    out.write_all(&[1, 0])?;
    // Padded to 128 bytes in all: numbers begin at a multiple of 64.
    let mut header = [b' '; 118];
    header[117] = b'\n';
    write!(
        &mut header[..117],
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({points}, {dim}), }}"
    )?;
    out.write_all(&(header.len() as u16).to_le_bytes())?;
    out.write_all(&header)?;
    for_each_vertex(mesh, |_, point| {
        point.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read, read_columns, samples, write};
    use super::*;

    /// A file of version 1.0 with this header.
    fn file(header: &str, data: &[u8]) -> Vec<u8> {
        let length = (header.len() as u16).to_le_bytes();
        [MAGIC, &[1, 0][..], &length, header.as_bytes(), data].concat()
    }

    fn bytes(values: &[f64]) -> Vec<u8> {
        values.iter().flat_map(|value| value.to_le_bytes()).collect()
    }

    #[test]
    fn headers_are_read_however_they_are_written() {
        let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, -3.0, 4e9] };
        for header in [
            "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }",
            "{\"shape\":(2,2,),\"descr\":\"<f8\",\"fortran_order\":False}   \n",
            " { 'fortran_order' : False , 'shape' : ( 2 , 2 ) , 'descr' : '<f8' } ",
        ] {
            let file = file(header, &bytes(&expected.coordinates));
            assert_eq!(read(&mut file.as_slice(), Format::Npy).unwrap(), expected, "{header}");
        }
    }

    #[test]
    fn every_type_order_and_version_is_read() {
        let expected = [1.0, 2.0, 3.0, -0.0, 5.5, 6.25];
        let by_axis = [1.0, -0.0, 2.0, 5.5, 3.0, 6.25];
        for (order, values) in [("False", expected), ("True", by_axis)] {
            let data: [(&str, Vec<u8>); 4] = [
                ("<f8", bytes(&values)),
                (">f8", values.iter().flat_map(|x| x.to_be_bytes()).collect()),
                ("<f4", values.iter().flat_map(|x| (*x as f32).to_le_bytes()).collect()),
                (">f4", values.iter().flat_map(|x| (*x as f32).to_be_bytes()).collect()),
            ];
            for (kind, data) in data {
                let header =
                    format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': (2, 3), }}");
                let length = header.len() as u32;
                let wide = |version: u8| {
                    let start = [MAGIC, &[version, 0][..], &length.to_le_bytes()].concat();
                    [start, header.clone().into_bytes(), data.clone()].concat()
                };
                for file in [file(&header, &data), wide(2), wide(3)] {
                    let read = read(&mut file.as_slice(), Format::Npy).unwrap();
                    assert_eq!(read.dim, 3);
                    samples::assert_same_bits(&read.coordinates, &expected);
                }
            }
        }
    }

    #[test]
    fn chosen_columns_are_read_from_either_order() {
        let expected = PointCloud { dim: 2, coordinates: vec![3.0, 1.0, 7.0, 5.0] };
        let by_point = [1.0, f64::NAN, 3.0, 5.0, 0.0, 7.0];
        let by_column = [1.0, 5.0, f64::NAN, 0.0, 3.0, 7.0];
        for (order, values) in [("False", by_point), ("True", by_column)] {
            let header = format!("{{'descr': '<f8', 'fortran_order': {order}, 'shape': (2, 3), }}");
            let file = file(&header, &bytes(&values));
            let chosen = |list: &str| {
                let columns: Columns = list.parse().unwrap();
                read_columns(&mut file.as_slice(), Format::Npy, &columns)
            };
            assert_eq!(chosen("3,1").unwrap(), expected, "{order}");
            let error = chosen("1,2").unwrap_err();
            assert_eq!(error.kind(), ErrorKind::NonFinite);
            assert!(error.message().contains("point 0, coordinate 1"), "{error}");
            let error = chosen("1,4").unwrap_err();
            assert_eq!(error.message(), "columns: there is no column 4; the file has 3 columns");
        }
        // Nothing is read of points that a header does not have, however many their numbers.
        let empty = "{'descr': '<f8', 'fortran_order': True, 'shape': (0, 1000000000000000), }";
        let columns: Columns = "1-2".parse().unwrap();
        let file = file(empty, &[]);
        let error = read_columns(&mut file.as_slice(), Format::Npy, &columns).unwrap_err();
        assert_eq!(error.message(), "the file holds no points");
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in 2..=8 {
            let mesh = samples::mesh(dim);
            let mut file = Vec::new();
            write(&mesh, Format::Npy, &mut file).unwrap();
            assert_eq!(file.len(), 128 + 8 * dim * (dim + 2));
            let read = read(&mut file.as_slice(), Format::Npy).unwrap();
            assert_eq!(read.dim, dim);
            samples::assert_same_bits(&read.coordinates, &mesh.triangulation().unwrap().points);
        }
    }

    #[test]
    fn before_a_run_the_distinct_inputs_are_written() {
        let mesh = Mesh::new(2, 3, &[0.0, 0.5, -0.0, 0.5, 1e300, -0.0], 0).unwrap();
        let mut file = Vec::new();
        write(&mesh, Format::Npy, &mut file).unwrap();
        let read = read(&mut file.as_slice(), Format::Npy).unwrap();
        samples::assert_same_bits(&read.coordinates, &[0.0, 0.5, 1e300, -0.0]);
    }
}
