//! The header of a `.npy` file: what the elements of its array are, and how many there are.

use super::super::binary::Binary;
use super::super::text::quoted;
use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::{MAX_DIM, MIN_DIM};

/// The most values that the structure of an array may have.
const MAX_COLUMNS: usize = 10_000;

pub(super) struct Header {
    pub fortran_order: bool,
    pub points: u64,
    pub row: Row,
}

/// Columns that the file has of a point: its coordinates, and what else there may be.
pub(super) enum Row {
    Numbers { number: NumberType, count: u64 },
    Fields(Vec<Field>),
}

/// A value of a structure.
pub(super) struct Field {
    name: String,
    number: NumberType,
}

/// An element of the array as the header describes it.
enum Element {
    Number(NumberType),
    Structure(Vec<Field>),
}

impl Row {
    /// Returns the number of columns.
    pub fn count(&self) -> u64 {
        match self {
            Self::Numbers { count, .. } => *count,
            Self::Fields(fields) => fields.len() as u64,
        }
    }

    /// Returns the type of the numbers in a column.
    pub fn number(&self, column: u64) -> NumberType {
        match self {
            Self::Numbers { number, .. } => *number,
            Self::Fields(fields) => fields[column as usize].number,
        }
    }

    /// Returns the names of the columns, if they have any.
    pub fn names(&self) -> Option<Vec<&str>> {
        match self {
            Self::Numbers { .. } => None,
            Self::Fields(fields) => Some(fields.iter().map(|field| &*field.name).collect()),
        }
    }
}

/// Meaning of the bytes of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NumberType {
    kind: Kind,
    size: u64,
    big_endian: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Float,
    Signed,
    Unsigned,
    /// Type of no number that is read.
    Other,
}

impl NumberType {
    fn of_description(description: &str) -> Option<Self> {
        let (order, rest) = description.split_at_checked(1)?;
        let big_endian = match order {
            "<" | "|" => false,
            ">" => true,
            "=" => cfg!(target_endian = "big"),
            _ => return None,
        };
        let (kind, rest) = rest.split_at_checked(1)?;
        // A unit of time may follow the size.
        let size: u64 = rest.split('[').next()?.parse().ok().filter(|size| *size < 1 << 20)?;
        let (kind, size) = match (kind, size) {
            ("f", 4 | 8) => (Kind::Float, size),
            ("i", 1 | 2 | 4 | 8) => (Kind::Signed, size),
            ("u", 1 | 2 | 4 | 8) | ("b", 1) => (Kind::Unsigned, size),
            ("U", _) => (Kind::Other, 4 * size),
            ("f" | "c" | "S" | "a" | "V" | "M" | "m", _) => (Kind::Other, size),
            _ => return None,
        };
        Some(Self { kind, size, big_endian })
    }

    fn is_float(self) -> bool {
        self.kind == Kind::Float
    }

    pub fn is_number(self) -> bool {
        self.kind != Kind::Other
    }

    /// Returns the number of bytes.
    pub fn size(self) -> u64 {
        self.size
    }

    /// Reads the next number; NaN for a value that is none.
    pub fn read(self, binary: &mut Binary<'_>, lacks: impl FnOnce() -> String) -> Result<f64> {
        let bits = match self.size {
            _ if self.kind == Kind::Other => {
                return binary.skip(self.size, lacks).map(|()| f64::NAN);
            }
            1 => self.bits(binary.next::<1>(lacks)?),
            2 => self.bits(binary.next::<2>(lacks)?),
            4 => self.bits(binary.next::<4>(lacks)?),
            _ => self.bits(binary.next::<8>(lacks)?),
        };
        let unused = 64 - 8 * self.size as u32;
        let signed = (bits << unused) as i64 >> unused;
        let (value, is_exact) = match (self.kind, self.size) {
            (Kind::Float, 4) => (f32::from_bits(bits as u32).into(), true),
            (Kind::Float, _) => (f64::from_bits(bits), true),
            (Kind::Signed, _) => (signed as f64, signed as f64 as i128 == signed.into()),
            _ => (bits as f64, bits as f64 as i128 == bits.into()),
        };
        if is_exact {
            return Ok(value);
        }
        let number = if self.kind == Kind::Signed { signed.into() } else { i128::from(bits) };
        let message = message!("{number} is not a double");
        Err(binary.error_at(self.size, ErrorKind::Format, &message))
    }

    fn bits<const N: usize>(self, mut bytes: [u8; N]) -> u64 {
        if self.big_endian {
            bytes.reverse();
        }
        let mut wide = [0; 8];
        wide[..N].copy_from_slice(&bytes);
        u64::from_le_bytes(wide)
    }
}

impl Header {
    /// Parses a header such as `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }`. With
    /// `is_plain` every number of a point is a coordinate.
    pub fn parse(text: &[u8], is_plain: bool) -> Result<Self> {
        let mut parser = Parser { rest: text };
        let (mut element, mut fortran_order, mut shape) = (None, None, None);
        parser.expect("{")?;
        while !parser.skip("}") {
            let key = parser.string()?;
            parser.expect(":")?;
            let seen_before = match key {
                "descr" => element.replace(parser.element()?).is_some(),
                "fortran_order" => fortran_order.replace(parser.boolean()?).is_some(),
                "shape" => shape.replace(parser.shape()?).is_some(),
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
        let needed = || bad("'descr', 'fortran_order' and 'shape' are needed".into());
        let (element, shape) = element.zip(shape).ok_or_else(needed)?;
        let (points, row) = match (element, &*shape) {
            (Element::Number(number), &[points, count]) => {
                if is_plain {
                    check_dimension(count)?;
                }
                (points, Row::Numbers { number, count })
            }
            (Element::Structure(fields), &[points]) => (points, Row::Fields(fields)),
            (element, _) => {
                let is_structure = matches!(element, Element::Structure(_));
                let wanted = if is_structure { "(points,)" } else { "(points, dim)" };
                let count = shape.len();
                return Err(bad(message!("a shape of {count} lengths; {wanted} is needed")));
            }
        };
        let fortran_order = fortran_order.ok_or_else(needed)?;
        // An array of one length has no other order.
        let fortran_order = fortran_order && matches!(row, Row::Numbers { .. });
        Ok(Self { fortran_order, points, row })
    }
}

pub(super) fn check_dimension(columns: u64) -> Result<()> {
    match (MIN_DIM as u64..=MAX_DIM as u64).contains(&columns) {
        true => Ok(()),
        false => {
            let message =
                message!("points of dimension {columns}; it must be {MIN_DIM} to {MAX_DIM}");
            Err(Error::new(ErrorKind::Dimension, message))
        }
    }
}

fn bad(why: String) -> Error {
    Error::format(message!("in the header: {why}"))
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

    /// Reads what is quoted once or twice, without escapes.
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

    /// Reads the type of an element.
    fn element(&mut self) -> Result<Element> {
        if self.skip("[") {
            return Ok(Element::Structure(self.fields()?));
        }
        let description = self.string()?;
        match NumberType::of_description(description) {
            Some(number) if number.is_float() => Ok(Element::Number(number)),
            _ => Err(bad(message!(
                "numbers of type {}; doubles ('<f8', '>f8') and floats ('<f4', '>f4') are read",
                quoted(description)
            ))),
        }
    }

    /// Reads what follows `[` in `[('x', '<f8'), ('velocity', '<f4', (3,))]`.
    fn fields(&mut self) -> Result<Vec<Field>> {
        let mut fields = Vec::new();
        while !self.skip("]") {
            self.expect("(")?;
            let name = self.string()?;
            self.expect(",")?;
            let description = self.string()?;
            let number = NumberType::of_description(description).ok_or_else(|| {
                let (name, kind) = (quoted(name), quoted(description));
                bad(message!("the field {name} is of type {kind}, which is not read"))
            })?;
            let shape = if self.skip(",") { self.shape()? } else { Vec::new() };
            self.expect(")")?;
            let size = shape.iter().try_fold(1u64, |size, length| size.checked_mul(*length));
            let size = size.unwrap_or(u64::MAX);
            if size > (MAX_COLUMNS - fields.len()) as u64 {
                return Err(bad(message!("fields of more than {MAX_COLUMNS} values in all")));
            }
            fields.extend((0..size).map(|at| {
                let name = if shape.is_empty() { name.into() } else { format!("{name}_{at}") };
                Field { name, number }
            }));
            if !self.skip(",") {
                self.expect("]")?;
                break;
            }
        }
        Ok(fields)
    }

    fn shape(&mut self) -> Result<Vec<u64>> {
        let mut lengths = Vec::new();
        self.expect("(")?;
        while !self.skip(")") {
            lengths.push(self.integer()?);
            if !self.skip(",") {
                self.expect(")")?;
                break;
            }
        }
        Ok(lengths)
    }
}
