//! STL: the triangles of surfaces, as text or as binary data. Each triangle has corners of its own;
//! equal ones are one point here. The marker of a triangle is the number of its solid, from 1.
//! Normals and the two bytes of attributes say nothing that counts.

use super::binary::Binary;
use super::io_error;
use super::polygons::Polygons;
use super::text::{Line, Lines, Points};
use super::values::{Outline, Table};
use crate::error::{ErrorKind, Result, message};
use crate::memory::AllocError;
use crate::mesh::LeftOut;
use std::collections::HashMap;
use std::io::{BufRead, Read};

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

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, Table, read_table};
    use crate::error::{ErrorKind, Result};
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
}
