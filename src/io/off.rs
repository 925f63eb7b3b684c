//! Geomview's OFF (three coordinates, polygons) and nOFF (any dimension).

use super::Table;
use super::text::{Line, Lines, Points, write_point};
use crate::error::Result;
use crate::mesh::{LeftOut, Triangulation};
use std::io::{self, Write};

pub(super) fn read(mut lines: Lines<'_>) -> Result<Table> {
    let header = Header::read(&mut lines)?;
    let mut points = Points::of_dimension(header.dim);
    for index in 0..header.vertices {
        let line = lines.require(|| format!("{index} of {} vertices", header.vertices))?;
        points.add(&line, line.words())?;
    }
    let mut left_out = LeftOut::default();
    for index in 0..header.faces {
        let line = lines.require(|| format!("{index} of {} faces", header.faces))?;
        let size = checked_face(&line, header.vertices)?;
        left_out.add(header.dimension_of(size), 1);
    }
    let promised = format!("the {} vertices and {} faces", header.vertices, header.faces);
    lines.require_end(&promised)?;
    Ok(Table { left_out, ..Table::new(points.finish()?, Vec::new()) })
}

struct Header {
    /// True where the file lists cells (nOFF above the plane), false where it lists polygons.
    has_cells: bool,
    dim: usize,
    vertices: u64,
    faces: u64,
}

impl Header {
    /// Reads up to the end of the line that completes the header: programs differ in how many lines
    /// they spread it over, and some leave out the number of edges.
    fn read(lines: &mut Lines<'_>) -> Result<Self> {
        let mut names: &[&str] = &[];
        let mut values = Vec::new();
        let mut dim = 3;
        while names.is_empty() || values.len() + 1 < names.len() {
            let line = lines.require(|| "the header of an OFF file is not complete".into())?;
            let mut words = line.words();
            if names.is_empty() {
                names = names_after(&line, words.next().map_or("", |(_, keyword)| keyword))?;
            }
            for (column, word) in words {
                let Some(name) = names.get(values.len()) else {
                    return Err(line.error("the header goes on after the number of edges"));
                };
                values.push(line.integer(column, word, name)?);
                if *name == DIMENSION && values.len() == 1 {
                    dim = line.check_dimension(values[0])?;
                }
            }
        }
        let first = usize::from(names[0] == DIMENSION);
        let has_cells = first == 1 && dim > 2;
        Ok(Self { has_cells, dim, vertices: values[first], faces: values[first + 1] })
    }

    /// Returns the dimension of a face with `size` vertices.
    fn dimension_of(&self, size: u64) -> u64 {
        match size {
            0 | 1 => 0,
            2 | 3 => size - 1,
            _ if self.has_cells => 3,
            _ => 2,
        }
    }
}

const DIMENSION: &str = "dimension";
const COUNTS: [&str; 4] = [DIMENSION, "number of vertices", "number of faces", "number of edges"];

/// Returns the names of the numbers that follow the keyword.
fn names_after(line: &Line<'_>, keyword: &str) -> Result<&'static [&'static str]> {
    match keyword {
        "OFF" => Ok(&COUNTS[1..]),
        "nOFF" => Ok(&COUNTS),
        _ => {
            Err(line.error("the file begins with neither OFF nor nOFF; other kinds cannot be read"))
        }
    }
}

/// Checks a face (the number of its vertices, their ids, and any colour) and returns that number.
fn checked_face(line: &Line<'_>, vertices: u64) -> Result<u64> {
    let mut words = line.words();
    let mut size = 0;
    if let Some((column, word)) = words.next() {
        size = line.integer(column, word, "number of vertices")?;
    }
    let mut missing = size;
    for (column, word) in words {
        if missing == 0 {
            line.skip_number(column, word)?;
            continue;
        }
        let vertex = line.integer(column, word, "vertex id")?;
        if vertex >= vertices {
            let message = format!("vertex id {vertex} of {vertices} vertices");
            return Err(line.error(message).of_content());
        }
        missing -= 1;
    }
    match missing {
        0 => Ok(size),
        _ => Err(line.error(format!("the face ends before its last {missing} vertices"))),
    }
}

/// Writes `OFF` in the plane, `nOFF` above.
pub(super) fn write(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let (dim, vertices) = (triangulation.dim, triangulation.dim + 1);
    match dim {
        2 => writeln!(out, "OFF")?,
        _ => writeln!(out, "nOFF\n{dim}")?,
    }
    writeln!(out, "{} {} 0", triangulation.vertex_count(), triangulation.simplex_count())?;
    for point in triangulation.points.chunks_exact(dim) {
        write_point(out, point, " ")?;
        out.write_all(if dim == 2 { b" 0\n" } else { b"\n" })?;
    }
    for simplex in triangulation.simplices.chunks_exact(vertices) {
        write!(out, "{vertices}")?;
        for vertex in simplex {
            write!(out, " {vertex}")?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Format, PointCloud, read, samples, write};

    #[test]
    fn reads_headers_however_they_are_spread() {
        let expected = PointCloud { dim: 3, coordinates: vec![1.0, 2.0, 0.0, -3.0, 4e9, 1.0] };
        let data = "1 2 0\n-3 4e9 1\n3 0 1 0\n2 1 0 0.5 0.5 0.5\n";
        for header in
            ["OFF\n2 2 0", "OFF 2 2 0", "# c\n\nOFF # c\n2 2", "nOFF\n3\n2 2 0", "nOFF 3\n2 2 0"]
        {
            let text = format!("{header}\n{data}");
            assert_eq!(read(&mut text.as_bytes(), Format::Off).unwrap(), expected, "{header:?}");
        }
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in 2..=8 {
            let mesh = samples::mesh(dim);
            let mut text = Vec::new();
            write(&mesh, Format::Off, &mut text).unwrap();
            let read = read(&mut text.as_slice(), Format::Off).unwrap();
            let mut expected = mesh.triangulation().unwrap().points.clone();
            if dim == 2 {
                expected = expected.chunks_exact(2).flat_map(|p| [p[0], p[1], 0.0]).collect();
            }
            assert_eq!(read.dim, dim.max(3));
            samples::assert_same_bits(&read.coordinates, &expected);
        }
    }

    #[test]
    fn planar_meshes_are_polygons_and_others_say_their_dimension() {
        let text = |mesh: crate::mesh::Mesh| {
            let mut text = Vec::new();
            write(&mesh, Format::Off, &mut text).unwrap();
            String::from_utf8(text).unwrap()
        };
        let expected = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
        assert_eq!(text(samples::square()), expected);
        let solid = text(samples::mesh(3));
        assert!(solid.starts_with("nOFF\n3\n5 2 0\n"), "{solid}");
        assert!(solid.ends_with("\n4 0 1 2 3\n4 1 2 3 4\n"), "{solid}");
    }
}
