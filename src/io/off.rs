//! Geomview's OFF (three coordinates, polygons) and nOFF (any dimension).

use super::polygons::Polygons;
use super::text::{Line, Lines, Points, write_point};
use super::values::{Outline, Table};
use crate::error::{ErrorKind, Result};
use crate::memory::TryGrow;
use crate::mesh::{LeftOut, Triangulation};
use std::io::{self, Write};

pub(super) fn read(mut lines: Lines<'_>) -> Result<Table> {
    let header = Header::read(&mut lines)?;
    let mut points = Points::of_dimension(header.dim);
    for index in 0..header.vertices {
        let line = lines.require(|| format!("{index} of {} vertices", header.vertices))?;
        points.add(&line, line.words())?;
    }
    let (mut left_out, mut outline) = (LeftOut::default(), Outline::default());
    let (mut polygons, mut face) = (Polygons::default(), Vec::new());
    for index in 0..header.faces {
        let line = lines.require(|| format!("{index} of {} faces", header.faces))?;
        read_face(&line, header.vertices, &mut face)?;
        match header.is_surface {
            true => polygons.add_face(&face, 0, &mut outline)?,
            false => left_out.add(header.dimension_of(face.len() as u64), 1),
        }
    }
    outline.facets = polygons.surface();
    let promised = format!("the {} vertices and {} faces", header.vertices, header.faces);
    lines.require_end(&promised)?;
    Ok(Table { left_out, outline, ..Table::new(points.finish()?, Vec::new()) })
}

struct Header {
    /// True for `OFF`, whose faces are polygons in space.
    is_surface: bool,
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
        Ok(Self {
            is_surface: first == 0,
            has_cells,
            dim,
            vertices: values[first],
            faces: values[first + 1],
        })
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

/// Reads a face (the number of its vertices, their ids, and any colour) into the list of its
/// vertices.
fn read_face(line: &Line<'_>, vertices: u64, face: &mut Vec<u32>) -> Result<()> {
    face.clear();
    let mut words = line.words();
    let mut missing = 0;
    if let Some((column, word)) = words.next() {
        missing = line.integer(column, word, "number of vertices")?;
    }
    for (column, word) in words {
        if missing == 0 {
            line.skip_number(column, word)?;
            continue;
        }
        let vertex = line.integer(column, word, "vertex id")?;
        if vertex >= vertices {
            let message = format!("vertex id {vertex} of {vertices} vertices");
            return Err(line.field_error(ErrorKind::Format, column, message).of_content());
        }
        // There are fewer vertices than ids of 32 bits, or the mesh will refuse them.
        face.try_push(u32::try_from(vertex).unwrap_or(u32::MAX))?;
        missing -= 1;
    }
    match missing {
        0 => Ok(()),
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
    use super::super::{Choice, Format, PointCloud, Table, read, read_table, samples, write};
    use crate::error::ErrorKind;

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

    fn table(text: &str, has_points_alone: bool) -> crate::error::Result<Table> {
        let choice = Choice { has_points_alone, ..Choice::default() };
        read_table(&mut text.as_bytes(), Format::Off, &choice)
    }

    #[test]
    fn faces_are_triangles_or_facets() {
        let points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n";
        let read = |faces: &str| {
            let count = faces.lines().count();
            table(&format!("OFF\n5 {count} 0\n{points}{faces}"), false).unwrap()
        };
        let triangles = read("3 0 1 4\n3 1 2 4 255 0 0\n2 2 3\n1 4\n0\n");
        let facets = &triangles.outline.facets;
        assert!(facets.are_triangles && facets.count() == 2);
        assert_eq!(facets.inputs, [0, 1, 4, 1, 2, 4]);
        assert_eq!(triangles.outline.segments, [[2, 3]]);
        assert!(triangles.left_out.is_empty());
        let polygons = read("3 0 1 4\n4 3 2 1 0\n").outline.facets;
        assert!(!polygons.are_triangles);
        assert_eq!(polygons.loops(1).collect::<Vec<_>>(), [[3, 2, 1, 0]]);
        // Elements of a mesh are no surface.
        let cells = table(&format!("nOFF\n3\n5 2 0\n{points}4 0 1 2 4\n3 0 1 2\n"), false).unwrap();
        assert_eq!((cells.outline.facets.count(), cells.left_out.cells), (0, 1));
        assert_eq!(cells.left_out.faces, 1);
        let alone = table(&format!("OFF\n5 2 0\n{points}3 0 1 4\n2 0 1\n"), true).unwrap();
        assert_eq!((alone.left_out.faces, alone.left_out.edges), (1, 1));
        assert_eq!(alone.outline.facets.count(), 0);
    }

    #[test]
    fn what_is_wrong_with_a_face_is_named() {
        let points = "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n";
        for (face, message, is_of_content) in [
            ("3 0 1 3", "line 6, column 4: vertex id 3 of 3 vertices", true),
            ("3 0 1", "line 6: the face ends before its last 1 vertices", false),
            ("3 0 1 -2", "line 6, column 4: \"-2\" is no vertex id", false),
            ("x", "line 6, column 1: \"x\" is no number of vertices", false),
            ("3 0 1 2 red", "line 6, column 5: \"red\" is not a number", false),
            ("", "the file ends after line 5: 0 of 1 faces", false),
        ] {
            let error = table(&format!("{points}{face}"), false).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Format);
            assert_eq!(error.message(), message);
            assert_eq!(error.is_of_content(), is_of_content, "{message}");
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
