//! TetGen's `.node` and `.ele` (Triangle's in the plane), continued to any dimension.

use super::Table;
use super::choice::{AttributeColumns, MAX_ATTRIBUTES};
use super::text::{Line, Lines, Points, write_number, write_point};
use super::values::Values;
use crate::error::{Error, Result};
use crate::memory::collected;
use crate::mesh::{Attribute, LeftOut, Region, Triangulation};
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Files that there are beside the pair, with segments or facets.
pub(super) struct Parts {
    /// Edges that segments have become.
    pub edge: PathBuf,
    /// Path of the domain's segments in the plane, with holes.
    pub poly: PathBuf,
    /// Triangles that facets have become.
    pub face: PathBuf,
}

impl Parts {
    /// Returns the files beside the pair that `path` names.
    pub fn new(path: &Path) -> Self {
        let (_, ele) = paths(path);
        let [edge, poly, face] = ["edge", "poly", "face"].map(|part| ele.with_extension(part));
        Self { edge, poly, face }
    }
}

/// Returns the files of the pair that `path` names: `.node` part, `.ele` part.
pub(super) fn paths(path: &Path) -> (PathBuf, PathBuf) {
    let has_extension = |expected: &str| {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(expected))
    };
    if has_extension("ele") {
        return (path.with_extension("node"), path.to_path_buf());
    }
    if has_extension("node") {
        return (path.to_path_buf(), path.with_extension("ele"));
    }
    // What follows a dot need not be an extension: these programs name their meshes `a.1`.
    let mut ele = OsString::from(path);
    ele.push(".ele");
    (path.to_path_buf(), PathBuf::from(ele))
}

pub(super) fn read(mut lines: Lines<'_>, attributes: &AttributeColumns) -> Result<Table> {
    match read_alone(&mut lines, attributes)? {
        Some((table, _)) => Ok(table),
        None => Err(Error::format("the file holds no points")),
    }
}

/// Counts the elements of an `.ele` file, which are left out.
pub(super) fn leave_out(mut lines: Lines<'_>, left_out: &mut LeftOut) -> Result<()> {
    let header = lines.require(|| "an .ele file begins with its counts".into())?;
    let mut counts = [0; 2];
    for (column, word) in header.words().take(2) {
        counts[column] = header.integer(column, word, ["number of elements", "size"][column])?;
    }
    let [elements, size] = counts;
    for index in 0..elements {
        let line = lines.require(|| format!("{index} of {elements} elements"))?;
        if (line.word_count() as u64) <= size {
            let message = format!("an element of {size} points has its id before them");
            return Err(line.error(message));
        }
    }
    lines.require_end(&format!("the {elements} elements of the header"))?;
    // Triangles of second order have six points.
    left_out.add(if matches!(size, 3 | 6) { 2 } else { 3 }, elements);
    Ok(())
}

/// Reads points as [`read_points`] does, and requires that nothing follows them.
pub(super) fn read_alone(
    lines: &mut Lines<'_>,
    attributes: &AttributeColumns,
) -> Result<Option<(Table, u64)>> {
    let read = read_points(lines, attributes)?;
    let count = read.as_ref().map_or(0, |(table, _)| table.points.count());
    lines.require_end(&format!("the {count} points of the header"))?;
    Ok(read)
}

/// Reads the points that a header begins, and the id of the first; `None` where it promises none.
pub(super) fn read_points(
    lines: &mut Lines<'_>,
    attributes: &AttributeColumns,
) -> Result<Option<(Table, u64)>> {
    let first = lines.require(|| "a .node file begins with its counts".into())?;
    let header = Header::read(&first)?;
    let mut values = header.values(&first, attributes)?;
    let mut points = Points::of_dimension(header.dim);
    let mut first_id = 0;
    for index in 0..header.points {
        let line = lines.require(|| format!("{index} of {} points", header.points))?;
        let id = header.read_point(&line, &mut points, &mut values)?;
        if index == 0 && id <= 1 {
            first_id = id;
        }
        if id != first_id + index {
            let expected = match index {
                0 => "the first is 0 or 1".to_string(),
                _ => format!("{} comes next", first_id + index),
            };
            return Err(line.error(format!("point id {id}; ids count up, {expected}")));
        }
    }
    if header.points == 0 {
        return Ok(None);
    }
    Ok(Some((Table::new(points.finish()?, values.finish()), first_id)))
}

/// The first line of a `.node` file: `points dim attributes markers`, the last two optional.
struct Header {
    points: u64,
    dim: usize,
    attributes: u64,
    markers: u64,
    /// Columns of a point's line: id, coordinates, attributes, marker.
    columns: u64,
}

impl Header {
    fn read(line: &Line<'_>) -> Result<Self> {
        let columns = line.word_count();
        if !(2..=4).contains(&columns) {
            let message = format!(
                "{columns} columns; a .node file begins with: points dim attributes markers"
            );
            return Err(line.error(message));
        }
        let mut counts = [0; 4];
        let names = ["number of points", "dimension", "number of attributes", "number of markers"];
        for (column, field) in line.words() {
            counts[column] = line.integer(column, field, names[column])?;
        }
        let [points, dim, attributes, markers] = counts;
        let dim = line.check_dimension(dim)?;
        if markers > 1 {
            return Err(line.error(format!("{markers} markers per point; there is one or none")));
        }
        let columns = attributes.saturating_add(1 + dim as u64 + markers);
        Ok(Self { points, dim, attributes, markers, columns })
    }

    /// Returns those of the attributes and the marker that are wanted. The file has no names for
    /// them.
    fn values(&self, line: &Line<'_>, wanted: &AttributeColumns) -> Result<Values> {
        if !wanted.are_chosen() {
            return Ok(Values::default());
        }
        if self.attributes > MAX_ATTRIBUTES as u64 {
            let message =
                format!("{} attributes; at most {MAX_ATTRIBUTES} are read", self.attributes);
            return Err(line.error(message));
        }
        let numbered = (1..=self.attributes).map(|number| format!("attribute_{number}"));
        let names: Vec<String> = collected(numbered)?;
        let marker = (self.markers > 0).then_some("marker");
        let names: Vec<&str> = collected(names.iter().map(String::as_str).chain(marker))?;
        wanted.of(names.len() as u64, Some(&names), &[self.attributes])
    }

    /// Adds the line's point; returns its id.
    fn read_point(&self, line: &Line<'_>, points: &mut Points, values: &mut Values) -> Result<u64> {
        let columns = line.word_count() as u64;
        if columns != self.columns {
            let message = format!("{columns} columns where the header promises {}", self.columns);
            return Err(line.error(message));
        }
        let mut id = 0;
        for (column, field) in line.words().take(1) {
            id = line.integer(column, field, "point id")?;
        }
        points.add(line, line.words().skip(1).take(self.dim))?;
        for (place, field) in line.words().skip(1 + self.dim) {
            line.skip_number(place, field)?;
            values.add(line, place, (place - 1 - self.dim) as u64, field)?;
        }
        Ok(id)
    }
}

pub(super) fn write_node(
    triangulation: &Triangulation,
    attributes: &[Attribute],
    out: &mut dyn Write,
) -> io::Result<()> {
    let dim = triangulation.dim;
    let columns: usize = attributes.iter().map(|attribute| attribute.components).sum();
    writeln!(out, "{} {dim} {columns} 1", triangulation.vertex_count())?;
    let points = triangulation.points.chunks_exact(dim);
    for (id, (point, kind)) in points.zip(&triangulation.kinds).enumerate() {
        write!(out, "{id} ")?;
        write_point(out, point, " ")?;
        for &value in attributes.iter().flat_map(|attribute| attribute.of(id)) {
            out.write_all(b" ")?;
            write_number(out, value)?;
        }
        writeln!(out, " {}", *kind as u8)?;
    }
    Ok(())
}

pub(super) fn write_ele(triangulation: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    let vertices = triangulation.dim + 1;
    let labels = &triangulation.boundary.simplex_regions;
    let attributes = u8::from(!labels.is_empty());
    writeln!(out, "{} {vertices} {attributes}", triangulation.simplex_count())?;
    for (id, simplex) in triangulation.simplices.chunks_exact(vertices).enumerate() {
        write!(out, "{id}")?;
        for vertex in simplex {
            write!(out, " {vertex}")?;
        }
        if let Some(label) = labels.get(id) {
            write!(out, " {label}")?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// Writes the edges that segments have become, with the markers of their segments.
pub(super) fn write_edge(
    triangulation: &Triangulation,
    markers: &[i32],
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "{} 1", triangulation.boundary.subsegments.len())?;
    for (id, ([from, to], marker)) in triangulation.boundary.marked(markers).enumerate() {
        writeln!(out, "{id} {from} {to} {marker}")?;
    }
    Ok(())
}

/// Writes the triangles that facets have become, with the markers of their facets.
pub(super) fn write_face(
    triangulation: &Triangulation,
    markers: &[i32],
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "{} 1", triangulation.boundary.subfacets.len())?;
    for (id, ([a, b, c], marker)) in triangulation.boundary.marked_facets(markers).enumerate() {
        writeln!(out, "{id} {a} {b} {c} {marker}")?;
    }
    Ok(())
}

/// Writes the edges that segments have become, as segments between the points of the `.node` part,
/// and the holes.
pub(super) fn write_poly(
    triangulation: &Triangulation,
    markers: &[i32],
    regions: &[Region],
    out: &mut dyn Write,
) -> io::Result<()> {
    out.write_all(b"0 2 0 1\n")?;
    write_edge(triangulation, markers, out)?;
    let holes = || regions.iter().filter(|region| region.is_hole);
    writeln!(out, "{}", holes().count())?;
    for (id, hole) in holes().enumerate() {
        write!(out, "{id} ")?;
        write_point(out, &hole.seed[..2], " ")?;
        out.write_all(b"\n")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{Format, PointCloud, read, samples, write};
    use super::*;

    #[test]
    fn ids_count_from_0_or_1_and_the_rest_is_dropped() {
        let expected = PointCloud { dim: 2, coordinates: vec![1.0, 2.0, -3.0, 4e9] };
        for text in [
            "2 2 0 0\n0 1 2\n1 -3 4e9\n",
            "# nodes\r\n2 2\r\n\r\n1 1 2 # here\r\n2 -3 4e9",
            "2 2 2 1\n1 1 2 0.5 nan -1\n2 -3 4e9 7 8 9\n# end\n",
        ] {
            let read = read(&mut text.as_bytes(), Format::TetgenNode).unwrap();
            assert_eq!(read, expected, "{text:?}");
        }
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        for dim in 2..=8 {
            let mesh = samples::mesh(dim);
            let triangulation = mesh.triangulation().unwrap();
            let mut text = Vec::new();
            write_node(triangulation, &[], &mut text).unwrap();
            let read = read(&mut text.as_slice(), Format::TetgenNode).unwrap();
            assert_eq!(read.dim, dim);
            samples::assert_same_bits(&read.coordinates, &triangulation.points);
        }
    }

    #[test]
    fn a_stream_holds_the_node_part_and_then_the_ele_part() {
        let mut text = Vec::new();
        write(&samples::square(), Format::TetgenNode, &mut text).unwrap();
        let expected = "4 2 0 1\n0 0 0 0\n1 1 0 0\n2 1 1 1\n3 0 1 2\n2 3 0\n0 0 1 2\n1 0 2 3\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }

    #[test]
    fn the_pair_has_one_name() {
        let pair = |path: &str| {
            let (node, ele) = paths(Path::new(path));
            (node.to_str().unwrap().to_string(), ele.to_str().unwrap().to_string())
        };
        let expected = |node: &str, ele: &str| (node.to_string(), ele.to_string());
        assert_eq!(pair("d/a.node"), expected("d/a.node", "d/a.ele"));
        assert_eq!(pair("d/a.1.ele"), expected("d/a.1.node", "d/a.1.ele"));
        assert_eq!(pair("d.x/a.NODE"), expected("d.x/a.NODE", "d.x/a.ele"));
        assert_eq!(pair("a.1"), expected("a.1", "a.1.ele"));
        assert_eq!(pair("a"), expected("a", "a.ele"));
    }

    #[test]
    fn segments_have_files_of_their_own() {
        let mesh = samples::square_with_segments();
        let (triangulation, markers) = (mesh.triangulation().unwrap(), mesh.markers_of_result());
        let mut text = Vec::new();
        write_ele(triangulation, &mut text).unwrap();
        write_edge(triangulation, markers, &mut text).unwrap();
        let hole = Region { seed: [0.5, -0.25, 0.0], is_hole: true, ..Region::default() };
        let regions = [Region::default(), hole];
        write_poly(triangulation, markers, &regions, &mut text).unwrap();
        let edges = "2 1\n0 0 2 -5\n1 1 0 6\n";
        let expected =
            format!("2 3 1\n0 0 1 2 7\n1 0 2 3 -8\n{edges}0 2 0 1\n{edges}1\n0 0.5 -0.25\n");
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }

    #[test]
    fn facets_have_a_file_of_their_own() {
        let directory = std::env::temp_dir().join(format!("netmesh-{}-face", std::process::id()));
        std::fs::create_dir_all(&directory).unwrap();
        let mesh = samples::solid_with_facets();
        super::super::write_file(&mesh, &directory.join("a.ele"), Format::Auto).unwrap();
        let text = |name: &str| std::fs::read_to_string(directory.join(name)).unwrap();
        let (face, edge, ele) = (text("a.face"), text("a.edge"), text("a.ele"));
        let parts = super::super::part_paths(&directory.join("a.node"), Format::Auto, 3).unwrap();
        let are_there = parts.iter().all(|path| path.exists());
        let has_poly = directory.join("a.poly").exists();
        std::fs::remove_dir_all(&directory).unwrap();
        assert_eq!(face, "3 1\n0 1 0 2 -5\n1 3 1 2 9\n2 4 2 3 0\n");
        assert_eq!(edge, "3 1\n0 3 1 6\n1 1 2 0\n2 2 3 0\n");
        assert_eq!(ele, "2 4 1\n0 0 1 2 3 7\n1 1 2 3 4 -8\n");
        assert!(are_there && parts.len() == 2 && !has_poly);
    }

    #[test]
    fn all_four_files_are_written_and_read_back() {
        let directory = std::env::temp_dir().join(format!("netmesh-{}-edge", std::process::id()));
        std::fs::create_dir_all(&directory).unwrap();
        let mesh = samples::square_with_segments();
        super::super::write_file(&mesh, &directory.join("a.node"), Format::Auto).unwrap();
        assert!(directory.join("a.edge").exists());
        let choice = super::super::Choice::default();
        let path = directory.join("a.poly");
        let table = super::super::read_table_file(&path, Format::Auto, &choice).unwrap();
        super::super::write_file(&samples::square(), &directory.join("b"), Format::TetgenNode)
            .unwrap();
        assert!(directory.join("b.ele").exists() && !directory.join("b.poly").exists());
        std::fs::remove_dir_all(&directory).unwrap();
        assert_eq!(table.points.coordinates, mesh.triangulation().unwrap().points);
        assert_eq!(table.outline.segments, [[0, 2], [1, 0]]);
        assert_eq!(table.outline.markers, [-5, 6]);
    }
}
