//! STL: the triangles of surfaces, as text or as binary data. Each triangle has corners of its own;
//! equal ones are one point here. The marker of a triangle is the number of its solid, from 1.
//! Normals and the two bytes of attributes say nothing that counts. The boundary of a mesh in space
//! is written, as binary data.

use super::binary::Binary;
use super::io_error;
use super::outer::outer_triangles;
use super::polygons::Polygons;
use super::text::{Line, Lines, Points};
use super::values::{Outline, Table};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::AllocError;
use crate::mesh::{LeftOut, Triangulation};
use std::collections::HashMap;
use std::io::{self, BufRead, Read, Write};

/// Bytes before the triangles of binary data: a header, and the number of triangles.
const HEAD: usize = 84;

pub(super) fn read(input: &mut dyn BufRead) -> Result<Table> {
    let mut head = [0; HEAD];
    let mut length = 0;
    while length < HEAD {
        match input.read(&mut head[length..]) {
            Ok(0) => break,
            Ok(count) => length += count,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
            Err(error) => return Err(io_error("cannot read", &error)),
        }
    }
    let head = &head[..length];
    let mut whole = head.chain(input);
    match is_text(head) {
        true => read_text(Lines::new(&mut whole)),
        false => read_binary(Binary::new(&mut whole, "")),
    }
}

/// Returns true if a file that begins so is text. Some programs begin the header of binary data
/// with the word that text begins with; text has no zeros, and the number of triangles has one.
fn is_text(head: &[u8]) -> bool {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    let word = text.get(..5).unwrap_or_default();
    word.eq_ignore_ascii_case(b"solid") && !head.contains(&0)
}

/// Triangles that have been read so far, and their corners without duplicates.
struct Soup {
    points: Points,
    /// Coordinates of a point -> its number.
    numbers: HashMap<[u64; 3], u32>,
    polygons: Polygons,
    left_out: LeftOut,
}

impl Soup {
    fn new() -> Self {
        Self {
            points: Points::of_dimension(3),
            numbers: HashMap::new(),
            polygons: Polygons::default(),
            left_out: LeftOut::default(),
        }
    }

    /// Adds a triangle. One with two equal corners is a line or a point, and is left out.
    fn add(&mut self, corners: [[f64; 3]; 3], solid: i32) -> Result<()> {
        let [a, b, c] = corners;
        let [a, b, c] = [self.number(a)?, self.number(b)?, self.number(c)?];
        if a == b || b == c || c == a {
            self.left_out.add(2, 1);
            return Ok(());
        }
        self.polygons.add([&[a, b, c][..]], solid)
    }

    /// Returns the number of the point at a place.
    fn number(&mut self, place: [f64; 3]) -> Result<u32> {
        // Zeros of either sign are one place.
        let key = place.map(|x| (x + 0.0).to_bits());
        if let Some(&number) = self.numbers.get(&key) {
            return Ok(number);
        }
        // There are fewer points than ids of 32 bits, or the mesh will refuse them.
        let number = u32::try_from(self.numbers.len()).unwrap_or(u32::MAX);
        place.iter().try_for_each(|&x| self.points.push(x))?;
        self.numbers.try_reserve(1).map_err(AllocError::from)?;
        self.numbers.insert(key, number);
        Ok(number)
    }

    fn finish(self) -> Result<Table> {
        let outline = Outline { facets: self.polygons.surface(), ..Outline::default() };
        let points = self.points.finish()?;
        Ok(Table { outline, left_out: self.left_out, ..Table::new(points, Vec::new()) })
    }
}

fn read_binary(mut data: Binary<'_>) -> Result<Table> {
    data.skip(80, || "the header of 80 bytes is not complete".into())?;
    let count = u32::from_le_bytes(data.next(|| "the number of triangles is missing".into())?);
    let mut soup = Soup::new();
    for index in 0..count {
        let row: [u8; 50] = data.next(|| format!("{index} of {count} triangles"))?;
        let mut numbers = [0.0; 12];
        for (at, number) in numbers.iter_mut().enumerate() {
            let bytes = [0, 1, 2, 3].map(|byte| row[4 * at + byte]);
            *number = f64::from(f32::from_le_bytes(bytes));
        }
        let corner = |at: usize| [0, 1, 2].map(|axis| numbers[3 + 3 * at + axis]);
        let corners = [0, 1, 2].map(corner);
        if let Some(at) = numbers[3..].iter().position(|x| !x.is_finite()) {
            let message = format!("{}; every coordinate must be finite", numbers[3 + at]);
            let back = (row.len() - 4 * (3 + at)) as u64;
            return Err(data.error_at(back, ErrorKind::NonFinite, &message));
        }
        soup.add(corners, 1)?;
    }
    data.require_end(&format!("the {count} triangles"))?;
    soup.finish()
}

fn read_text(mut lines: Lines<'_>) -> Result<Table> {
    let mut soup = Soup::new();
    let (mut solids, mut is_inside) = (0i32, false);
    while let Some(line) = lines.next()? {
        match (keyword(&line).as_str(), is_inside) {
            ("solid", false) => {
                solids = solids.saturating_add(1);
                is_inside = true;
            }
            ("endsolid", true) => is_inside = false,
            ("facet", true) => {
                read_normal(&line)?;
                let corners = read_loop(&mut lines)?;
                soup.add(corners, solids)?;
            }
            (_, true) => return Err(expected(&line, "\"facet\" or \"endsolid\"")),
            (_, false) => return Err(expected(&line, "\"solid\"")),
        }
    }
    if is_inside {
        lines.require(|| "the solid has no \"endsolid\"".into())?;
    }
    soup.finish()
}

/// Reads the three corners of a triangle, up to the end of its facet.
fn read_loop(lines: &mut Lines<'_>) -> Result<[[f64; 3]; 3]> {
    let lacks = || "the last facet has no \"endfacet\"".into();
    require_words(&lines.require(lacks)?, &["outer", "loop"])?;
    let mut corners = [[0.0; 3]; 3];
    for corner in &mut corners {
        let line = lines.require(lacks)?;
        if keyword(&line) != "vertex" {
            return Err(expected(&line, "\"vertex\""));
        }
        line.require_words(4)?;
        for (column, word) in line.words().skip(1) {
            corner[column - 1] = line.coordinate(column, word)?;
        }
    }
    require_words(&lines.require(lacks)?, &["endloop"])?;
    require_words(&lines.require(lacks)?, &["endfacet"])?;
    Ok(corners)
}

/// Reads "facet normal" and three numbers, which need not be finite: many programs write "nan" for
/// the normals of small triangles.
fn read_normal(line: &Line<'_>) -> Result<()> {
    line.require_words(5)?;
    let mut words = line.words();
    words.next();
    if !words.next().is_some_and(|(_, word)| word.eq_ignore_ascii_case("normal")) {
        return Err(expected(line, "\"facet normal\""));
    }
    words.try_for_each(|(column, word)| line.skip_number(column, word))
}

fn require_words(line: &Line<'_>, words: &[&str]) -> Result<()> {
    let found = line.words().map(|(_, word)| word);
    match found.map(str::to_ascii_lowercase).eq(words.iter().copied()) {
        true => Ok(()),
        false => Err(expected(line, &format!("\"{}\"", words.join(" ")))),
    }
}

/// Returns the first word of a line, in lower case.
fn keyword(line: &Line<'_>) -> String {
    line.words().next().map_or(String::new(), |(_, word)| word.to_ascii_lowercase())
}

fn expected(line: &Line<'_>, what: &str) -> crate::error::Error {
    let word = line.words().next().map_or("", |(_, word)| word);
    line.field_error(
        ErrorKind::Format,
        0,
        message!("{} where {what} is expected", super::text::quoted(word)),
    )
}

/// Fails if single precision does not hold the boundary of a mesh: a coordinate that is too large,
/// or a triangle that has a point twice.
///
/// # Errors
/// `InvalidArgument`, naming the vertices and the rule; `Limit` (more triangles than STL counts).
pub(super) fn check_precision(mesh: &Triangulation) -> Result<()> {
    check_triangles(mesh, outer_triangles(mesh).map(|(_, vertices)| vertices))
}

/// Fails if single precision does not hold some triangles of a mesh in space.
///
/// # Errors
/// Fails as [`check_precision`] does.
pub(super) fn check_triangles(
    mesh: &Triangulation,
    triangles: impl Iterator<Item = [u32; 3]> + Clone,
) -> Result<()> {
    for vertices in triangles.clone() {
        let corners = vertices.map(|vertex| single(mesh, vertex));
        for (corner, vertex) in corners.iter().zip(vertices) {
            if let Some(axis) = corner.iter().position(|x| x.is_infinite()) {
                let x = mesh.point(vertex)[axis];
                return Err(Error::invalid(message!(
                    "points[{vertex}] of the mesh has the coordinate {x:e}; STL has single \
                     precision, up to {:e}; use PLY",
                    f32::MAX
                )));
            }
        }
        let [a, b, c] = corners;
        let pairs = [(a == b, [0, 1]), (b == c, [1, 2]), (c == a, [0, 2])];
        if let Some((_, ends)) = pairs.iter().find(|(are_equal, _)| *are_equal) {
            let [from, to] = ends.map(|at| vertices[at]);
            return Err(Error::invalid(message!(
                "points[{from}] and points[{to}] of the mesh, of one triangle of its boundary, \
                 are the same point in single precision, which STL has; use PLY"
            )));
        }
    }
    let count = triangles.count();
    if u32::try_from(count).is_err() {
        let message = message!("the boundary has {count} triangles; STL counts {}", u32::MAX);
        return Err(Error::new(ErrorKind::Limit, message));
    }
    Ok(())
}

/// Returns a vertex as STL has it.
fn single(mesh: &Triangulation, vertex: u32) -> [f32; 3] {
    let point = mesh.point(vertex);
    [0, 1, 2].map(|axis| point[axis] as f32)
}

/// Writes the boundary of a mesh in space as binary data, whose triangles are counterclockwise as
/// seen from outside, where their normals point to.
pub(super) fn write(mesh: &Triangulation, out: &mut dyn Write) -> io::Result<()> {
    write_triangles(mesh, outer_triangles(mesh).map(|(_, vertices)| vertices), out)
}

/// Writes triangles of a mesh in space as binary data.
pub(super) fn write_triangles(
    mesh: &Triangulation,
    triangles: impl Iterator<Item = [u32; 3]> + Clone,
    out: &mut dyn Write,
) -> io::Result<()> {
    let mut head = [b' '; 80];
    head[..TITLE.len()].copy_from_slice(TITLE);
    out.write_all(&head)?;
    out.write_all(&(triangles.clone().count() as u32).to_le_bytes())?;
    for vertices in triangles {
        let corners = vertices.map(|vertex| single(mesh, vertex));
        let rows = [normal(vertices.map(|vertex| mesh.point(vertex)))].into_iter().chain(corners);
        for x in rows.flatten() {
            out.write_all(&x.to_le_bytes())?;
        }
        out.write_all(&[0; 2])?;
    }
    Ok(())
}

/// Beginning of the header of binary data, which must not be the word that text begins with.
const TITLE: &[u8] = b"netmesh: the boundary of the tetrahedra";

/// Returns the normal of a triangle, of length 1; of one without an area nothing but zeros.
fn normal([a, b, c]: [&[f64]; 3]) -> [f32; 3] {
    // Edges are scaled one by one, so that no product is too small or too large.
    let edge = |to: &[f64]| {
        let edge = [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let largest = edge.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        edge.map(|x| x / largest)
    };
    let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
    let normal = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { normal.map(|x| (x / length) as f32) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, Table, read_table, samples, write};
    use crate::error::{ErrorKind, Result};
    use crate::mesh::Mesh;
    use std::io::BufReader;

    fn table(data: &[u8]) -> Result<Table> {
        let whole = read_table(&mut &*data, Format::Stl, &Choice::default());
        let in_pieces =
            read_table(&mut BufReader::with_capacity(3, data), Format::Stl, &Choice::default());
        assert_eq!(whole, in_pieces);
        whole
    }

    fn binary(header: &str, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut data = header.as_bytes().to_vec();
        data.resize(80, b' ');
        data.extend((triangles.len() as u32).to_le_bytes());
        for corners in triangles {
            data.extend([f32::NAN; 3].iter().flat_map(|x| x.to_le_bytes()));
            data.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
            data.extend([7, 1]);
        }
        data
    }

    fn text(triangles: &[[[f32; 3]; 3]]) -> String {
        let corner = |[x, y, z]: &[f32; 3]| format!("vertex {x} {y} {z}\n");
        let facet = |corners: &[[f32; 3]; 3]| {
            let corners: String = corners.iter().map(corner).collect();
            format!("facet normal 0 nan 1\n outer loop\n{corners} endloop\nendfacet\n")
        };
        let facets: String = triangles.iter().map(facet).collect();
        format!("solid a name # with a comment\n{facets}endsolid a name\n")
    }

    const TRIANGLES: [[[f32; 3]; 3]; 3] = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.5, 0.0]],
        [[1.0, 0.0, -0.0], [1.0, 1.0, 0.25], [0.0, 1.5, 0.0]],
        [[1.0, 1.0, 0.25], [1.0, 1.0, 0.25], [0.0, 0.0, 0.0]],
    ];

    #[test]
    fn equal_corners_are_one_point_in_both_kinds() {
        let read = table(&binary("a header", &TRIANGLES)).unwrap();
        let points = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.5, 0.0, 1.0, 1.0, 0.25];
        assert_eq!((read.points.dim, &read.points.coordinates[..]), (3, &points[..]));
        let facets = &read.outline.facets;
        assert!(facets.are_triangles);
        assert_eq!(facets.inputs, [0, 1, 2, 1, 3, 2]);
        assert_eq!(facets.markers, [1, 1]);
        // The last one has two equal corners.
        assert_eq!(read.left_out.faces, 1);
        assert_eq!(table(text(&TRIANGLES).as_bytes()).unwrap(), read);
        assert_eq!(table(text(&TRIANGLES).to_uppercase().as_bytes()).unwrap(), read);
        assert_eq!(table(&binary("solid but binary", &TRIANGLES)).unwrap(), read);
    }

    #[test]
    fn solids_have_their_numbers_as_markers() {
        let two = text(&TRIANGLES[..1]) + &text(&TRIANGLES[1..2]);
        let read = table(two.as_bytes()).unwrap();
        assert_eq!(read.outline.facets.markers, [1, 2]);
        assert_eq!(read.points.coordinates.len(), 12);
    }

    #[test]
    fn what_is_wrong_is_named() {
        let good = text(&TRIANGLES[..1]);
        for (from, to, expected) in [
            (
                "facet normal",
                "face normal",
                "line 2, column 1: \"face\" where \"facet\" or \"endsolid\" is expected",
            ),
            ("vertex 1", "vertex x", "line 5, column 2: \"x\" is not a number"),
            ("vertex 1", "corner 1", "line 5, column 1: \"corner\" where \"vertex\" is expected"),
            ("vertex 1 0 0", "vertex 1 0", "line 5: 3 columns where 4 are expected"),
            ("outer loop", "outer", "line 3, column 1: \"outer\" where \"outer loop\" is expected"),
            ("normal 0 nan 1", "normal 0 1", "line 2: 4 columns where 5 are expected"),
            (
                " endloop\nendfacet\nendsolid a name\n",
                "",
                "the file ends after line 6: the last facet has no \"endfacet\"",
            ),
            ("endsolid a name\n", "", "the file ends after line 8: the solid has no \"endsolid\""),
            (
                "endsolid a name\n",
                "endsolid\nfacet\n",
                "line 10, column 1: \"facet\" where \"solid\" is expected",
            ),
        ] {
            let changed = good.replacen(from, to, 1);
            assert_ne!(changed, good, "{from:?}");
            let error = table(changed.as_bytes()).unwrap_err();
            assert_eq!((error.kind(), error.message()), (ErrorKind::Format, expected));
        }
        let infinite = table(good.replacen("vertex 1", "vertex inf", 1).as_bytes()).unwrap_err();
        assert_eq!(infinite.kind(), ErrorKind::NonFinite);
    }

    #[test]
    fn binary_data_that_ends_early_or_late_is_refused() {
        let good = binary("x", &TRIANGLES[..2]);
        for (length, expected) in [
            (0, "the file ends after byte 0: the header of 80 bytes is not complete"),
            (82, "the file ends after byte 82: the number of triangles is missing"),
            (150, "the file ends after byte 150: 1 of 2 triangles"),
        ] {
            assert_eq!(table(&good[..length]).unwrap_err().message(), expected);
        }
        let longer = [&good[..], b"x"].concat();
        let error = table(&longer).unwrap_err();
        assert_eq!(error.message(), "byte 185: more data after the 2 triangles");
        let mut infinite = good;
        infinite[84 + 12 + 4..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
        let error = table(&infinite).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NonFinite);
        assert_eq!(error.message(), "byte 101: inf; every coordinate must be finite");
    }

    /// Returns a tetrahedron, scaled and moved.
    fn tetrahedron(scale: f64, place: f64) -> Mesh {
        let corners = [0., 0., 0., 3., 0., 0., 0., 4., 0., 0., 0., 5.];
        let points = corners.map(|x| place + scale * x);
        let mut mesh = Mesh::new(3, 4, &points, 0).unwrap();
        mesh.run(&samples::delaunay(), None).unwrap();
        mesh
    }

    #[test]
    fn the_boundary_is_written_with_normals_that_look_outward() {
        let mesh = tetrahedron(1.0, 0.5);
        let mut file = Vec::new();
        write(&mesh, Format::Stl, &mut file).unwrap();
        assert_eq!(file.len(), 84 + 4 * 50);
        let mut normals = Vec::new();
        for row in file[84..].chunks_exact(50) {
            let numbers: Vec<f32> = row[..48]
                .chunks_exact(4)
                .map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()))
                .collect();
            let point = |at: usize| [0, 1, 2].map(|k| f64::from(numbers[3 * at + k]));
            let [normal, a, b, c] = [0, 1, 2, 3].map(point);
            let [u, v] = [b, c].map(|to| [0, 1, 2].map(|k| to[k] - a[k]));
            let cross = [1, 2, 0].map(|i| u[i] * v[(i + 1) % 3] - u[(i + 1) % 3] * v[i]);
            let length = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((0..3).all(|k| (cross[k] / length - normal[k]).abs() < 1e-6), "{normal:?}");
            // From the centre of the tetrahedron to the triangle.
            let height: f64 = (0..3).map(|k| normal[k] * (a[k] - 1.5)).sum();
            assert!(height > 0.1, "{height}");
            assert_eq!(row[48..], [0, 0]);
            normals.push(normal);
        }
        for axis in 0..3 {
            let side = [0, 1, 2].map(|k| if k == axis { -1.0 } else { 0.0 });
            assert!(normals.contains(&side), "{normals:?}");
        }
        let table = table(&file).unwrap();
        assert_eq!((table.points.count(), table.outline.facets.count()), (4, 4));
    }

    #[test]
    fn what_single_precision_does_not_hold_is_refused() {
        let refusal = |mesh: &Mesh| {
            let mut file = Vec::new();
            let error = write(mesh, Format::Stl, &mut file).unwrap_err();
            assert_eq!((error.kind(), file.len()), (ErrorKind::InvalidArgument, 0));
            error.message().to_string()
        };
        let large = refusal(&tetrahedron(1e38, 0.0));
        let rule = "STL has single precision, up to 3.4028235e38; use PLY";
        assert!(large.starts_with("points[") && large.ends_with(rule), "{large}");
        assert!(large.contains("] of the mesh has the coordinate "), "{large}");
        let small = refusal(&tetrahedron(1e-9, 1.0));
        let rule = "are the same point in single precision, which STL has; use PLY";
        assert!(small.starts_with("points[") && small.ends_with(rule), "{small}");
        // The largest numbers that fit, and the smallest that are different.
        for mesh in [tetrahedron(6.8e37, 0.0), tetrahedron(1e-45, 0.0), tetrahedron(1e-6, 1.0)] {
            let mut file = Vec::new();
            write(&mesh, Format::Stl, &mut file).unwrap();
            assert_eq!(table(&file).unwrap().outline.facets.count(), 4);
        }
        let plane = refusal(&samples::square());
        assert_eq!(plane, "STL holds the boundary of meshes of dimension 3, not 2; use PLY");
        let high = refusal(&samples::mesh(4));
        assert!(high.ends_with("dimension 3, not 4; use OFF (nOFF) or TetGen"), "{high}");
    }
}
