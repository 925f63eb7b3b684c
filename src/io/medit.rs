//! Medit's `.mesh`, as text.

use super::columns::OrRule;
use super::text::{Line, Lines, Points, write_point};
use super::{Markers, Table};
use crate::arrays::domains::simplices;
use crate::error::{Error, ErrorKind, Result};
use crate::mesh::{Boundary, LeftOut, Triangulation};
use std::io::{self, Write};

pub(super) fn read(mut lines: Lines<'_>) -> Result<Table> {
    let first = lines.require(|| "a Medit file begins with MeshVersionFormatted".into())?;
    if first.words().next().map(|(_, word)| word) != Some("MeshVersionFormatted") {
        return Err(first.error("the file does not begin with MeshVersionFormatted"));
    }
    let mut dim = None;
    let mut points = None;
    let mut left_out = LeftOut::default();
    let mut elements: Option<Elements> = None;
    while let Some(line) = lines.next()? {
        let keyword = keyword(&line);
        if keyword.is_empty() {
            // Numbers of elements, or of a field that says nothing here.
            elements.iter_mut().for_each(|elements| elements.words += line.word_count() as u64);
            continue;
        }
        if let Some(elements) = elements.take() {
            elements.leave_out(&mut left_out).map_err(|message| line.error(message))?;
        }
        match keyword {
            "Dimension" if dim.is_some() => return Err(line.error("a second Dimension")),
            "Dimension" => {
                let here = number_of(&line, "dimension")?;
                dim =
                    Some(checked_dimension(number_after(&mut lines, here, "dimension")?, &lines)?);
            }
            "Vertices" if points.is_some() => return Err(line.error("a second field Vertices")),
            "Vertices" => {
                let dim = dim.ok_or_else(|| line.error("Vertices before Dimension"))?;
                let here = number_of(&line, COUNT)?;
                let count = number_after(&mut lines, here, COUNT)?;
                points = Some(read_vertices(&mut lines, dim, count)?);
            }
            "End" => {
                lines.require_end("End")?;
                break;
            }
            name => {
                let Some(field) = FIELDS.iter().find(|field| field.name == name) else { continue };
                let what = "number of elements";
                let here = number_of(&line, what)?;
                let count = number_after(&mut lines, here, what)?;
                elements = Some(Elements { field, count, words: 0 });
            }
        }
    }
    if let Some(elements) = elements {
        let left = elements.leave_out(&mut left_out);
        left.map_err(|message| lines.error(ErrorKind::Format, &message))?;
    }
    let points = points.ok_or_else(|| Error::format("no field Vertices"))?;
    Ok(Table { left_out, ..Table::new(points.finish()?, Vec::new()) })
}

const COUNT: &str = "number of vertices";

/// A field of elements.
struct Field {
    name: &'static str,
    dimension: u64,
    /// Numbers of an element: its vertices and its reference.
    numbers: u64,
}

const FIELDS: [Field; 8] = [
    Field { name: "Edges", dimension: 1, numbers: 3 },
    Field { name: "Triangles", dimension: 2, numbers: 4 },
    Field { name: "Quadrilaterals", dimension: 2, numbers: 5 },
    Field { name: "Tetrahedra", dimension: 3, numbers: 5 },
    Field { name: "Pyramids", dimension: 3, numbers: 6 },
    Field { name: "Prisms", dimension: 3, numbers: 7 },
    Field { name: "Pentahedra", dimension: 3, numbers: 7 },
    Field { name: "Hexahedra", dimension: 3, numbers: 9 },
];

/// Elements that are left out, and what was seen of them.
struct Elements {
    field: &'static Field,
    count: u64,
    /// Words that have followed.
    words: u64,
}

impl Elements {
    /// Adds the elements, if all of them were there; the rule otherwise.
    fn leave_out(self, left_out: &mut LeftOut) -> OrRule<()> {
        let Self { field: Field { name, dimension, numbers }, count, words } = self;
        if count.checked_mul(*numbers) != Some(words) {
            return Err(format!(
                "the field {name} has {words} numbers; {count} elements have {numbers} each"
            ));
        }
        left_out.add(*dimension, count);
        Ok(())
    }
}

/// Returns the first word of a line that begins with a letter, "" for numbers.
fn keyword<'a>(line: &Line<'a>) -> &'a str {
    let word = line.words().next().map_or("", |(_, word)| word);
    if word.starts_with(|first: char| first.is_ascii_alphabetic()) { word } else { "" }
}

/// Returns the number that stands beside a keyword.
fn number_of(line: &Line<'_>, what: &str) -> Result<Option<u64>> {
    if line.word_count() > 2 {
        return Err(line.error(format!("more than the {what} beside the keyword")));
    }
    line.words().nth(1).map(|(column, word)| line.integer(column, word, what)).transpose()
}

/// Returns the number that belongs to a keyword: the one `here` beside it, or the next line.
fn number_after(lines: &mut Lines<'_>, here: Option<u64>, what: &str) -> Result<u64> {
    match here {
        Some(number) => Ok(number),
        None => {
            let [number] = lines.require(|| format!("the {what} is missing"))?.integers([what])?;
            Ok(number)
        }
    }
}

fn checked_dimension(dim: u64, lines: &Lines<'_>) -> Result<usize> {
    match dim {
        2 | 3 => Ok(dim as usize),
        _ => {
            let message = format!("points of dimension {dim}; a Medit file has 2 or 3");
            Err(lines.error(ErrorKind::Dimension, &message))
        }
    }
}

/// Reads a vertex per line: its coordinates and its reference.
fn read_vertices(lines: &mut Lines<'_>, dim: usize, count: u64) -> Result<Points> {
    let mut points = Points::of_dimension(dim);
    for index in 0..count {
        let line = lines.require(|| format!("{index} of {count} vertices"))?;
        line.require_words(dim + 1)?;
        points.add(&line, line.words().take(dim))?;
        for (column, word) in line.words().skip(dim) {
            line.skip_number(column, word)?;
        }
    }
    Ok(points)
}

/// Writes the mesh. With segments and facets, edges and the triangles of facets have their markers
/// as references, and simplices the labels of their regions.
pub(super) fn write(
    triangulation: &Triangulation,
    markers: Markers<'_>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let dim = triangulation.dim;
    write!(out, "MeshVersionFormatted 2\nDimension {dim}\n")?;
    writeln!(out, "Vertices\n{}", triangulation.vertex_count())?;
    for (point, kind) in triangulation.points.chunks_exact(dim).zip(&triangulation.kinds) {
        write_point(out, point, " ")?;
        writeln!(out, " {}", *kind as u8)?;
    }
    let Boundary { subsegments, subfacets, simplex_regions, .. } = &triangulation.boundary;
    if !subsegments.is_empty() {
        writeln!(out, "Edges\n{}", subsegments.len())?;
        for (ends, marker) in triangulation.boundary.marked(markers.segments) {
            let [from, to] = ends.map(|end| u64::from(end) + 1);
            writeln!(out, "{from} {to} {marker}")?;
        }
    }
    if !subfacets.is_empty() {
        writeln!(out, "Triangles\n{}", subfacets.len())?;
        for (corners, marker) in triangulation.boundary.marked_facets(markers.facets) {
            let [a, b, c] = corners.map(|corner| u64::from(corner) + 1);
            writeln!(out, "{a} {b} {c} {marker}")?;
        }
    }
    let field = if dim == 2 { "Triangles" } else { "Tetrahedra" };
    writeln!(out, "{field}\n{}", triangulation.simplex_count())?;
    for (at, (simplex, domain)) in simplices(triangulation).enumerate() {
        simplex.iter().try_for_each(|vertex| write!(out, "{} ", u64::from(*vertex) + 1))?;
        match simplex_regions.get(at) {
            Some(label) => writeln!(out, "{label}")?,
            None => writeln!(out, "{domain}")?,
        }
    }
    out.write_all(b"End\n")
}

#[cfg(test)]
mod tests {
    use super::super::{Format, PointCloud, read, samples, write};

    #[test]
    fn vertices_are_read_and_other_fields_skipped() {
        let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, -3.0, 4e9] };
        for text in [
            "MeshVersionFormatted 2\nDimension 2\nVertices\n2\n1 2 0\n-3 4e9 -1\nEnd\n",
            "MeshVersionFormatted\n1\n\nDimension\n2\n# c\nVertices 2\n1 2 0\n-3 4e9 7",
            "MeshVersionFormatted 2\r\nDimension 2\r\nAngleOfCornerBound 45\r\nCorners\r\n1\r\n\
             1\r\n\
             Vertices\r\n2\r\n1 2 0\r\n-3 4e9 1\r\nTriangles\r\n1\r\n1 2 2 0\r\nEnd\r\n",
        ] {
            assert_eq!(read(&mut text.as_bytes(), Format::Medit).unwrap(), expected, "{text:?}");
        }
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in [2, 3] {
            let mesh = samples::mesh(dim);
            let mut text = Vec::new();
            write(&mesh, Format::Medit, &mut text).unwrap();
            let read = read(&mut text.as_slice(), Format::Medit).unwrap();
            assert_eq!(read.dim, dim);
            samples::assert_same_bits(&read.coordinates, &mesh.triangulation().unwrap().points);
        }
    }

    #[test]
    fn kinds_and_domains_are_references() {
        let mut text = Vec::new();
        write(&samples::square(), Format::Medit, &mut text).unwrap();
        let expected = "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 1\n\
             0 1 2\n\
            Triangles\n2\n1 2 3 0\n1 3 4 0\nEnd\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }

    #[test]
    fn markers_and_labels_are_references() {
        let mut text = Vec::new();
        write(&samples::square_with_segments(), Format::Medit, &mut text).unwrap();
        let expected = "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 1\n\
             0 1 2\n\
            Edges\n2\n1 3 -5\n2 1 6\nTriangles\n2\n1 2 3 7\n1 3 4 -8\nEnd\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
        let mut text = Vec::new();
        write(&samples::solid_with_facets(), Format::Medit, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let expected = "\nEdges\n3\n4 2 6\n2 3 0\n3 4 0\nTriangles\n3\n2 1 3 -5\n4 2 3 9\n5 3 4 0\n\
                        Tetrahedra\n2\n1 2 3 4 7\n2 3 4 5 -8\nEnd\n";
        assert!(text.ends_with(expected), "{text}");
    }
}
