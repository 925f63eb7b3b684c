//! Header of a `.ply` file.

use super::super::choice::AttributeColumns;
use super::super::text::{Line, Lines, quoted};
use super::super::values::Values;
use crate::error::{Error, ErrorKind, Name, Result, say};
use crate::mesh::LeftOut;

/// The most elements and properties that are read: a header is kept in memory.
const MAX_DECLARATIONS: usize = 1000;

pub(super) struct Header {
    pub encoding: Encoding,
    /// Elements, in the order of the file.
    pub elements: Vec<Element>,
    /// Dimension of the points: 2 where the vertices have no z.
    pub dim: usize,
    /// Number of vertices.
    pub vertices: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoding {
    Text,
    Binary { big_endian: bool },
}

/// A kind of rows: vertices, faces, or something else.
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
    /// Axis of the coordinate of a point that the property is, if it is one.
    pub axis: Option<usize>,
    /// True for the list of the vertices of a face in space.
    pub is_face: bool,
    /// True for the marker of a face in space.
    pub is_marker: bool,
}

#[derive(Clone, Copy)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { length: Scalar, item: Scalar },
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scalar {
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Float,
    Double,
}

impl Header {
    pub fn read(lines: &mut Lines<'_>) -> Result<Self> {
        let lacks = || "the header of a PLY file is not complete".to_string();
        let first = lines.require(lacks)?;
        if first.text != "ply" {
            return Err(first.error("the file does not begin with ply"));
        }
        let encoding = read_encoding(&lines.require(lacks)?)?;
        let mut elements: Vec<Element> = Vec::new();
        let mut declarations = 0;
        loop {
            let line = lines.require(lacks)?;
            let (keyword, rest) = split_word(line.text);
            match keyword {
                "comment" | "obj_info" => continue,
                "element" => elements.push(Element::declared(&line, &elements)?),
                "property" => match elements.last_mut() {
                    Some(element) => element.add_property(&line, rest)?,
                    None => return Err(line.error("a property before the first element")),
                },
                "end_header" if rest.is_empty() => break,
                _ => return Err(line.error(format!("{} in the header", quoted(line.text)))),
            }
            declarations += 1;
            if declarations > MAX_DECLARATIONS {
                let message = format!("more than {MAX_DECLARATIONS} elements and properties");
                return Err(line.error(message));
            }
        }
        Self::checked(encoding, elements, lines)
    }

    fn checked(encoding: Encoding, mut elements: Vec<Element>, lines: &Lines<'_>) -> Result<Self> {
        let error = |why: &str| Err(lines.error(ErrorKind::Format, why));
        // Rows of nothing take no bytes: there could be any number of them.
        if let Some(empty) = elements.iter().find(|element| element.properties.is_empty()) {
            return error(&format!("the element {} has no properties", quoted(&empty.name)));
        }
        let Some(vertices) = elements.iter().find(|element| element.name == VERTEX) else {
            return error("there is no element vertex");
        };
        let has = |axis| vertices.properties.iter().any(|property| property.axis == Some(axis));
        if !(has(0) && has(1)) {
            return error("the element vertex has no x or no y");
        }
        let dim = if has(2) { 3 } else { 2 };
        let vertices = vertices.count;
        if dim == 3 {
            let faces = elements.iter_mut().filter(|element| element.name == FACE);
            faces.for_each(Element::mark_face);
        }
        Ok(Self { encoding, elements, dim, vertices })
    }

    /// Counts the elements of a mesh or a surface that are not read.
    pub fn left_out(&self) -> LeftOut {
        let mut left_out = LeftOut::default();
        let holds_faces = |element: &&Element| element.properties.iter().any(|p| p.is_face);
        for element in self.elements.iter().filter(|element| !holds_faces(element)) {
            let dimension = ELEMENTS.iter().find(|(name, _)| *name == element.name);
            left_out.add(dimension.map_or(0, |(_, dimension)| *dimension), element.count);
        }
        left_out
    }

    /// Returns those properties of vertices that are wanted as attributes. Coordinates and lists
    /// are not among all of them.
    pub fn values(&self, wanted: &AttributeColumns) -> Result<Values> {
        let vertices = self.elements.iter().find(|element| element.holds_points());
        let properties = vertices.map_or(&[][..], |vertices| &vertices.properties);
        let names: Vec<&str> = properties.iter().map(|property| property.name.as_str()).collect();
        let columns = || properties.iter().zip(0u64..);
        let is_list = |property: &Property| matches!(property.kind, Kind::List { .. });
        let left_out: Vec<u64> = columns()
            .filter(|(property, _)| property.axis.is_some() || is_list(property))
            .map(|(_, column)| column)
            .collect();
        let values = wanted.of(names.len() as u64, Some(&names), &left_out)?;
        let mut lists = columns().filter(|(property, _)| is_list(property));
        match lists.find(|(_, column)| values.of_column(*column).is_some()) {
            None => Ok(values),
            Some((property, _)) => {
                let name = quoted(&property.name);
                let rule = "an attribute has one number a point";
                let message = say!(Name::Attributes, ": the property {name} is a list; {rule}");
                Err(Error::invalid(message))
            }
        }
    }
}

const VERTEX: &str = "vertex";
const FACE: &str = "face";

/// The names that programs give to the list of the vertices of a face.
const FACE_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The name of the property of a face that is its marker.
const MARKER: &str = "marker";

/// The names of elements of a mesh, and their dimensions. A strip of triangles is one element.
const ELEMENTS: [(&str, u64); 6] =
    [("edge", 1), ("face", 2), ("tristrips", 2), ("cell", 3), ("tetra", 3), ("tetrahedron", 3)];

const AXES: [&str; 3] = ["x", "y", "z"];

fn split_word(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((text, ""));
    (word, rest.trim_ascii_start())
}

fn read_encoding(line: &Line<'_>) -> Result<Encoding> {
    let words: Vec<&str> = line.text.split_ascii_whitespace().take(4).collect();
    match words[..] {
        ["format", "ascii", "1.0"] => Ok(Encoding::Text),
        ["format", "binary_little_endian", "1.0"] => Ok(Encoding::Binary { big_endian: false }),
        ["format", "binary_big_endian", "1.0"] => Ok(Encoding::Binary { big_endian: true }),
        _ => {
            let expected = "ascii, binary_little_endian or binary_big_endian";
            let shown = quoted(line.text);
            Err(line.error(format!("{shown} where format, {expected} and 1.0 are expected")))
        }
    }
}

impl Element {
    /// Reads `element NAME COUNT`.
    fn declared(line: &Line<'_>, others: &[Self]) -> Result<Self> {
        line.require_words(3)?;
        let mut element = Self { name: String::new(), count: 0, properties: Vec::new() };
        for (column, word) in line.words() {
            match column {
                1 => element.name = word.to_string(),
                2 => element.count = line.integer(column, word, "number of elements")?,
                _ => {}
            }
        }
        if others.iter().any(|other| other.name == element.name) {
            return Err(line.error(format!("a second element {}", quoted(&element.name))));
        }
        Ok(element)
    }

    /// Adds the property that `property TYPE NAME` or `property list TYPE TYPE NAME` declares.
    fn add_property(&mut self, line: &Line<'_>, rest: &str) -> Result<()> {
        let words: Vec<&str> = rest.split_ascii_whitespace().take(5).collect();
        let (kind, name) = match words[..] {
            ["list", length, item, name] => {
                let (length, item) = (Scalar::named(line, length)?, Scalar::named(line, item)?);
                if matches!(length, Scalar::Float | Scalar::Double) {
                    return Err(line.error("the length of a list is no integer"));
                }
                (Kind::List { length, item }, name)
            }
            [scalar, name] => (Kind::Scalar(Scalar::named(line, scalar)?), name),
            _ => return Err(line.error(format!("{} is no property", quoted(line.text)))),
        };
        if self.properties.iter().any(|other| other.name == name) {
            return Err(line.error(format!("a second property {}", quoted(name))));
        }
        let axis = AXES.iter().position(|axis| *axis == name).filter(|_| self.name == VERTEX);
        if axis.is_some() && matches!(kind, Kind::List { .. }) {
            return Err(line.error("a coordinate that is a list"));
        }
        let name = name.to_string();
        self.properties.push(Property { name, kind, axis, is_face: false, is_marker: false });
        Ok(())
    }

    /// Marks the list that has the vertices of a face, and beside it the whole number that is its
    /// marker.
    fn mark_face(&mut self) {
        let is_list = |property: &&mut Property| {
            matches!(property.kind, Kind::List { .. })
                && FACE_LISTS.contains(&property.name.as_str())
        };
        if let Some(list) = self.properties.iter_mut().find(is_list) {
            list.is_face = true;
            let is_marker = |property: &&mut Property| {
                property.name == MARKER && property.kind.is_whole_number()
            };
            if let Some(marker) = self.properties.iter_mut().find(is_marker) {
                marker.is_marker = true;
            }
        }
    }

    /// Returns the bytes of a row, where all rows have equally many.
    pub fn row_size(&self) -> Option<u64> {
        self.properties.iter().try_fold(0, |sum, property| match property.kind {
            Kind::Scalar(scalar) => Some(sum + scalar.size() as u64),
            Kind::List { .. } => None,
        })
    }

    pub fn holds_points(&self) -> bool {
        self.name == VERTEX
    }
}

impl Kind {
    fn is_whole_number(self) -> bool {
        !matches!(self, Self::List { .. } | Self::Scalar(Scalar::Float | Scalar::Double))
    }
}

impl Scalar {
    fn named(line: &Line<'_>, name: &str) -> Result<Self> {
        Ok(match name {
            "char" | "int8" => Self::Int8,
            "uchar" | "uint8" => Self::Uint8,
            "short" | "int16" => Self::Int16,
            "ushort" | "uint16" => Self::Uint16,
            "int" | "int32" => Self::Int32,
            "uint" | "uint32" => Self::Uint32,
            "float" | "float32" => Self::Float,
            "double" | "float64" => Self::Double,
            _ => return Err(line.error(format!("{} is no type of numbers", quoted(name)))),
        })
    }

    pub fn size(self) -> usize {
        match self {
            Self::Int8 | Self::Uint8 => 1,
            Self::Int16 | Self::Uint16 => 2,
            Self::Int32 | Self::Uint32 | Self::Float => 4,
            Self::Double => 8,
        }
    }

    /// Returns the number in the first `size` of little-endian `bytes`; a double holds each of them
    /// exactly.
    pub fn value(self, bytes: [u8; 8]) -> f64 {
        let [a, b, c, d, ..] = bytes;
        match self {
            Self::Int8 => i8::from_le_bytes([a]).into(),
            Self::Uint8 => a.into(),
            Self::Int16 => i16::from_le_bytes([a, b]).into(),
            Self::Uint16 => u16::from_le_bytes([a, b]).into(),
            Self::Int32 => i32::from_le_bytes([a, b, c, d]).into(),
            Self::Uint32 => u32::from_le_bytes([a, b, c, d]).into(),
            Self::Float => f32::from_le_bytes([a, b, c, d]).into(),
            Self::Double => f64::from_le_bytes(bytes),
        }
    }
}
