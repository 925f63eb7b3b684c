//! NumPy's `.npy`: a header in Python's notation, then the array's numbers.

mod header;

use super::binary::Binary;
use super::columns::transposed;
use super::text::{Points, quoted};
use super::values::Values;
use super::xyz::for_each_vertex;
use super::{Choice, PointCloud, Table};
use crate::error::{Error, ErrorKind, Result, message};
use crate::mesh::{Attribute, MAX_DIM, Mesh};
use header::{Header, Row, check_dimension};
use std::fmt::Write as _;
use std::io::{self, BufRead, Write};

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// The longest header that is read. NumPy's own limit is 10,000 bytes.
const MAX_HEADER: usize = 1 << 16;

pub(super) fn read(input: &mut dyn BufRead, choice: &Choice) -> Result<Table> {
    let mut binary = Binary::new(input, "");
    let header = read_header(&mut binary, *choice == Choice::default())?;
    let (coordinates, values) = chosen(&header.row, choice)?;
    let points = Points::of_dimension(coordinates.len());
    let mut array = Array { binary, header, coordinates, points, values };
    match array.header.fortran_order {
        _ if array.header.points == 0 => {}
        false => array.read_by_point()?,
        true => array.read_by_column()?,
    }
    array.finish()
}

/// Returns the columns of the coordinates, and the attributes.
fn chosen(row: &Row, choice: &Choice) -> Result<(Vec<u64>, Values)> {
    let names = row.names();
    let otherwise = |_: &[u64]| {
        let rule = "the fields name no coordinates: x and y, x0 and x1, or points; choose them";
        Err(Error::format(rule))
    };
    let (coordinates, values) = choice.of_table(row.count(), names.as_deref(), otherwise)?;
    check_dimension(coordinates.len() as u64)?;
    for column in coordinates.iter().copied().chain(values.columns()) {
        if let (Some(names), false) = (&names, row.number(column).is_number()) {
            let name = quoted(names[column as usize]);
            let message = message!("the field {name} has no numbers");
            return Err(Error::invalid(message));
        }
    }
    Ok((coordinates, values))
}

/// An array, and what was read of it.
struct Array<'a> {
    binary: Binary<'a>,
    header: Header,
    /// Columns counted from 0, in the order of the coordinates.
    coordinates: Vec<u64>,
    points: Points,
    values: Values,
}

impl Array<'_> {
    /// Reads an array in C order: point by point.
    fn read_by_point(&mut self) -> Result<()> {
        let mut point = [0.0; MAX_DIM];
        for row in 0..self.header.points {
            for column in 0..self.header.row.count() {
                let points = self.header.points;
                let lacks = || format!("{row} of {points} points");
                let value = self.header.row.number(column).read(&mut self.binary, lacks)?;
                if let Some(axis) = self.coordinates.iter().position(|other| *other == column) {
                    point[axis] = self.finite(value, row, column)?;
                }
                if let Some(attribute) = self.values.of_column(column) {
                    self.values.push(attribute, value)?;
                }
            }
            let point = &point[..self.coordinates.len()];
            point.iter().try_for_each(|value| self.points.push(*value))?;
        }
        self.binary.require_end("the array")
    }

    /// Reads an array in Fortran's order: the coordinates are transposed at the end.
    fn read_by_column(&mut self) -> Result<()> {
        for column in 0..self.header.row.count() {
            let is_coordinate = self.coordinates.contains(&column);
            let attribute = self.values.of_column(column);
            for row in 0..self.header.points {
                let points = self.header.points;
                let lacks = || format!("{row} of {points} points, coordinate {column}");
                let value = self.header.row.number(column).read(&mut self.binary, lacks)?;
                if is_coordinate {
                    let value = self.finite(value, row, column)?;
                    self.points.push(value)?;
                }
                if let Some(attribute) = attribute {
                    self.values.push(attribute, value)?;
                }
            }
        }
        self.binary.require_end("the array")
    }

    fn finite(&self, value: f64, point: u64, column: u64) -> Result<f64> {
        if value.is_finite() {
            return Ok(value);
        }
        let message = message!(
            "point {point}, coordinate {column}: {value}; every coordinate must be finite"
        );
        let size = self.header.row.number(column).size();
        Err(self.binary.error_at(size, ErrorKind::NonFinite, &message))
    }

    fn finish(self) -> Result<Table> {
        let PointCloud { dim, mut coordinates } = self.points.finish()?;
        if self.header.fortran_order {
            coordinates = transposed(&coordinates, &self.coordinates)?;
        }
        let points = PointCloud { dim, coordinates };
        Ok(Table::new(points, self.values.finish()))
    }
}

/// Reads the header. With `is_plain` every column is a coordinate.
fn read_header(binary: &mut Binary<'_>, is_plain: bool) -> Result<Header> {
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
    Header::parse(header, is_plain).map_err(|error| {
        let at = binary.error_at(length.into(), error.kind(), error.message());
        // Where nothing of the header is there, there is no byte to name.
        if length == 0 { error } else { at }
    })
}

/// Writes the vertices, or before a run the inputs, in C order: without attributes an array of
/// doubles, with them one of structures.
pub(super) fn write(mesh: &Mesh, attributes: &[Attribute], out: &mut dyn Write) -> io::Result<()> {
    let dim = mesh.inputs().dim();
    let points = mesh.triangulation().map_or(mesh.inputs().distinct(), |mesh| mesh.vertex_count());
    let has_fields = !attributes.is_empty();
    match has_fields {
        false => write_header(out, "'<f8'", &format!("({points}, {dim})"))?,
        true => write_header(out, &fields(dim, attributes), &format!("({points},)"))?,
    }
    let mut vertex = 0;
    for_each_vertex(mesh, |kind, point| {
        point.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))?;
        if has_fields {
            out.write_all(&[kind])?;
            let mut values = attributes.iter().flat_map(|attribute| attribute.of(vertex));
            values.try_for_each(|value| out.write_all(&value.to_le_bytes()))?;
        }
        vertex += 1;
        Ok(())
    })
}

/// Returns the type of a structure with a point, its kind and its attributes.
fn fields(dim: usize, attributes: &[Attribute]) -> String {
    let mut text = format!("[('points', '<f8', ({dim},)), ('kind', '|u1')");
    for Attribute { name, components, .. } in attributes {
        let _ = match components {
            1 => write!(text, ", ('{name}', '<f8')"),
            _ => write!(text, ", ('{name}', '<f8', ({components},))"),
        };
    }
    text + "]"
}

fn write_header(out: &mut dyn Write, description: &str, shape: &str) -> io::Result<()> {
    let mut header =
        format!("{{'descr': {description}, 'fortran_order': False, 'shape': {shape}, }}");
    // As short as version 1.0 allows, or a longer one.
    let start = if header.len() < 65_000 { MAGIC.len() + 4 } else { MAGIC.len() + 6 };
    // Numbers begin at a multiple of 64, and at 128 where nothing is longer than that.
    let length = (start + header.len() + 1).next_multiple_of(64).max(128) - start;
    while header.len() + 1 < length {
        header.push(' ');
    }
    header.push('\n');
    out.write_all(MAGIC)?;
    match u16::try_from(length) {
        Ok(length) if start == MAGIC.len() + 4 => {
            out.write_all(&[1, 0])?;
            out.write_all(&length.to_le_bytes())?;
        }
        _ => {
            out.write_all(&[2, 0])?;
            out.write_all(&(length as u32).to_le_bytes())?;
        }
    }
    out.write_all(header.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read, read_table, samples, write};
    use super::*;

    /// Returns a file of version 1.0 with this header.
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
                let choice = Choice { coordinates: list.parse().unwrap(), ..Choice::default() };
                read_table(&mut file.as_slice(), Format::Npy, &choice).map(|table| table.points)
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
        let choice = Choice { coordinates: "1-2".parse().unwrap(), ..Choice::default() };
        let file = file(empty, &[]);
        let error = read_table(&mut file.as_slice(), Format::Npy, &choice).unwrap_err();
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

    fn read_columns(file: &[u8], columns: &str, attributes: &str) -> Result<Table> {
        let mut choice = Choice::default();
        if !columns.is_empty() {
            choice.coordinates = columns.parse()?;
        }
        if !attributes.is_empty() {
            choice.attributes = attributes.parse()?;
        }
        read_table(&mut &*file, Format::Npy, &choice)
    }

    #[test]
    fn attributes_are_read_from_either_order() {
        for (order, values) in
            [("False", [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), ("True", [1.0, 4.0, 2.0, 5.0, 3.0, 6.0])]
        {
            let header = format!("{{'descr': '<f8', 'fortran_order': {order}, 'shape': (2, 3), }}");
            let file = file(&header, &bytes(&values));
            let table = read_columns(&file, "", "w=2").unwrap();
            assert_eq!(table.points.coordinates, [1.0, 3.0, 4.0, 6.0], "{order}");
            assert_eq!(
                (&*table.attributes[0].name, &*table.attributes[0].values),
                ("w", &[2.0, 5.0][..])
            );
        }
        let wide = "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 1000000000000000), }";
        let error = read_columns(&file(wide, &[]), "1-2", "all").unwrap_err();
        assert_eq!(error.message(), "attributes: more than 1000 columns; take fewer");
    }

    /// Reads every type, padding, and fields that are no numbers.
    #[test]
    fn structures_have_names_for_their_columns() {
        let header = "{'descr': [('id', '<U2'), ('y', '>f4'), ('', '|V3'), ('flag', '|b1'), \
                      ('when', '<M8[ns]'), ('x', '<f8'), ('v', '<i2', (2,)), ('big', '>u8'), \
                      ('small', '|i1'), ('w', '<i8')], 'fortran_order': False, 'shape': (2,), }";
        let row = |x: f64, y: f32, v: [i16; 2], big: u64, w: i64| {
            let v = v.map(i16::to_le_bytes).concat();
            let start = [&[0; 8][..], &y.to_be_bytes(), &[9; 3], &[1], &[7; 8]].concat();
            [&start, &x.to_le_bytes()[..], &v, &big.to_be_bytes(), &[0xfe], &w.to_le_bytes()]
                .concat()
        };
        let data =
            [row(1.0, 2.0, [-3, 4], 1 << 60, -5), row(6.0, 7.0, [8, 9], 10, 1 << 40)].concat();
        let file = file(header, &data);
        let table = read_columns(&file, "", "v_1,big,flag,small,w,v_0").unwrap();
        assert_eq!(table.points, PointCloud { dim: 2, coordinates: vec![1.0, 2.0, 6.0, 7.0] });
        let at = |row: usize| table.attributes.iter().map(|a| a.values[row]).collect::<Vec<_>>();
        assert_eq!(at(0), [4.0, 2f64.powi(60), 1.0, -2.0, -5.0, -3.0]);
        assert_eq!(at(1), [9.0, 10.0, 1.0, -2.0, 2f64.powi(40), 8.0]);
        let chosen = read_columns(&file, "v_0,v_1,x", "").unwrap().points;
        assert_eq!(chosen.coordinates, [-3.0, 4.0, 1.0, 8.0, 9.0, 6.0]);
        for (columns, attributes, message) in [
            ("", "id", "the field \"id\" has no numbers"),
            ("when,x", "", "the field \"when\" has no numbers"),
            ("", "height", "attributes: no column is called \"height\"; there are \"id\", \"y\""),
            ("x,z", "", "columns: no column is called \"z\""),
        ] {
            let error = read_columns(&file, columns, attributes).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
            assert!(error.message().starts_with(message), "{error}");
        }
        let mut odd = file.clone();
        // The last bit of `big`, which is 2^60, makes it a number between two doubles.
        let place = file.len() - data.len() / 2 - 10;
        odd[place] = 1;
        let error = read_columns(&odd, "", "big").unwrap_err();
        let expected = format!("byte {}: 1152921504606846977 is not a double", place - 6);
        assert_eq!((error.kind(), error.message()), (ErrorKind::Format, &*expected));
    }

    #[test]
    fn attributes_are_written_as_structures() {
        let mesh = samples::square();
        let attribute = |name: &str, components: usize| Attribute {
            name: name.into(),
            components,
            values: (0..4 * components).map(|value| value as f64).collect(),
            is_extended: true,
        };
        let attributes = [attribute("heat", 1), attribute("flow", 3)];
        let mut out = Vec::new();
        super::super::write_with(&mesh, &attributes, Format::Npy, &mut out).unwrap();
        let table = read_columns(&out, "", "all").unwrap();
        samples::assert_same_bits(&table.points.coordinates, &mesh.triangulation().unwrap().points);
        let found = |name: &str| &table.attributes.iter().find(|a| a.name == name).unwrap().values;
        assert_eq!(found("heat"), &[0.0, 1.0, 2.0, 3.0]);
        assert_eq!(found("flow_1"), &[1.0, 4.0, 7.0, 10.0]);
        assert_eq!(table.attributes.len(), 4);
        assert_eq!((out.len() - 4 * (16 + 1 + 32)) % 64, 0);
        // A header beyond version 1.0.
        let many: Vec<Attribute> =
            (0..1000).map(|i| attribute(&format!("{}{i}", "long_".repeat(12)), 1)).collect();
        out.clear();
        super::super::write_with(&mesh, &many, Format::Npy, &mut out).unwrap();
        assert_eq!(out[6..8], [2, 0]);
        let length = u32::from_le_bytes(out[8..12].try_into().unwrap()) as usize;
        assert_eq!(out.len(), 12 + length + 4 * (16 + 1 + 8000));
        assert_eq!((12 + length) % 64, 0);
    }
}
