//! `.poly` files of Triangle (points of the plane and segments between them) and of TetGen (points
//! of space and facets), with holes and regions; TetGen's `.smesh`.

mod loops;
mod space;

use super::choice::AttributeColumns;
use super::tetgen;
use super::text::{Line, Lines};
use super::values::{Outline, Table};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::TryGrow;
use crate::mesh::Region;
pub(super) use space::Grammar;
use std::path::Path;

/// Reads a `.poly` or `.smesh` file. `path` is that of the file, if it has one: its points may be
/// in a `.node` file beside it.
pub(super) fn read(
    mut lines: Lines<'_>,
    grammar: Grammar,
    attributes: &AttributeColumns,
    path: Option<&Path>,
) -> Result<Table> {
    let (mut table, first) = match tetgen::read_points(&mut lines, attributes)? {
        Some(points) => points,
        None => points_beside(attributes, path)?,
    };
    let dim = table.points.dim;
    let ids = PointIds { first, count: table.points.count() as u64 };
    let (points, outline) = (&table.points.coordinates, &mut table.outline);
    match (grammar, dim) {
        (Grammar::Poly, 2) => read_segments(&mut lines, &ids, outline)?,
        (_, 3) => space::read_facets(&mut lines, grammar, &ids, points, outline)?,
        _ => {
            let rule = match grammar {
                Grammar::Poly => "a .poly file has 2, as Triangle's, or 3, as TetGen's",
                Grammar::Smesh => "a .smesh file has 3",
            };
            let message = format!("points of dimension {dim}; {rule}");
            return Err(lines.error(ErrorKind::Dimension, &message));
        }
    }
    read_holes(&mut lines, dim, outline)?;
    read_regions(&mut lines, dim, outline)?;
    lines.require_end("the regions")?;
    Ok(table)
}

/// Ids of the points of a file, which count up from 0 or 1.
struct PointIds {
    first: u64,
    count: u64,
}

impl PointIds {
    /// Reads an id; returns the number of the point, counted from 0.
    fn read(&self, line: &Line<'_>, column: usize, word: &str) -> Result<u32> {
        let id = line.integer(column, word, "point id")?;
        let Self { first, count } = *self;
        match id.checked_sub(first) {
            // There are fewer points than ids of 32 bits, or the mesh will refuse them.
            Some(number) if number < count => Ok(u32::try_from(number).unwrap_or(u32::MAX)),
            _ => {
                let message = format!("point id {id}; ids are {first} to {}", first + count - 1);
                Err(line.field_error(ErrorKind::Format, column, message).of_content())
            }
        }
    }
}

/// Reads the points of the `.node` file with the same name, and the id of the first.
fn points_beside(attributes: &AttributeColumns, path: Option<&Path>) -> Result<(Table, u64)> {
    let Some(path) = path else {
        let message =
            "the points are in a .node file beside the .poly file, which has no name here";
        return Err(Error::invalid(message));
    };
    let path = path.with_extension("node");
    super::in_file(&path, |input| {
        let mut lines = Lines::new(input);
        let points = tetgen::read_alone(&mut lines, attributes)?;
        points.ok_or_else(|| Error::format("the file holds no points"))
    })
}

/// Reads a count, and whether a marker follows each of what is counted.
fn read_counts(line: &Line<'_>, what: &str) -> Result<(u64, usize)> {
    let mut counts = [0, 0];
    let columns = line.word_count();
    if columns > 2 {
        return Err(line.error(format!("{columns} columns; here is the {what}, and of markers")));
    }
    for (column, word) in line.words() {
        counts[column] = line.integer(column, word, [what, "number of markers"][column])?;
    }
    match counts {
        [count, 0 | 1] => Ok((count, counts[1] as usize)),
        [_, markers] => Err(line.error(format!("{markers} markers each; there is one or none"))),
    }
}

fn read_segments(lines: &mut Lines<'_>, ids: &PointIds, outline: &mut Outline) -> Result<()> {
    let what = "number of segments";
    let (count, markers) = read_counts(&lines.require(|| format!("the {what} is missing"))?, what)?;
    for index in 0..count {
        let line = lines.require(|| format!("{index} of {count} segments"))?;
        line.require_words(3 + markers)?;
        let mut ends = [0; 2];
        for (column, word) in line.words() {
            match column {
                0 => _ = line.integer(column, word, "segment id")?,
                1 | 2 => ends[column - 1] = ids.read(&line, column, word)?,
                _ => outline.markers.try_push(line.whole(column, word, "marker")?)?,
            }
        }
        if ends[0] == ends[1] {
            return Err(line.error("the segment has one point as both ends").of_content());
        }
        outline.segments.try_push(ends)?;
        if markers == 0 {
            outline.markers.try_push(0)?;
        }
    }
    Ok(())
}

/// Reads the points in holes of the domain.
fn read_holes(lines: &mut Lines<'_>, dim: usize, outline: &mut Outline) -> Result<()> {
    let Some(count) = next_count(lines, "number of holes")? else { return Ok(()) };
    for index in 0..count {
        let line = lines.require(|| format!("{index} of {count} holes"))?;
        let region = Region { seed: coordinates(&line, dim)?, is_hole: true, ..Region::default() };
        outline.regions.try_push(region)?;
    }
    Ok(())
}

/// Reads seeds with a label, and perhaps the largest area or volume that a simplex may have there.
fn read_regions(lines: &mut Lines<'_>, dim: usize, outline: &mut Outline) -> Result<()> {
    let Some(count) = next_count(lines, "number of regions")? else { return Ok(()) };
    for index in 0..count {
        let line = lines.require(|| format!("{index} of {count} regions"))?;
        let columns = line.word_count();
        if !(dim + 2..=dim + 3).contains(&columns) {
            let names = if dim == 2 { "x y label area" } else { "x y z label volume" };
            let message = format!("{columns} columns; a region has: id {names}");
            return Err(line.error(message));
        }
        let mut region = Region { seed: seed(&line, dim)?, ..Region::default() };
        for (column, word) in line.words().skip(1 + dim) {
            match column - dim {
                1 => region.label = line.whole(column, word, "label")?,
                _ => region.max_edge = edge_of(line.coordinate(column, word)?, dim),
            }
        }
        outline.regions.try_push(region)?;
    }
    Ok(())
}

/// Returns the edge of the equilateral triangle of an area, or of the regular tetrahedron of a
/// volume; 0, for none, where that is not above 0.
fn edge_of(measure: f64, dim: usize) -> f64 {
    match dim {
        _ if measure <= 0.0 => 0.0,
        2 => (4.0 / 3.0_f64.sqrt()).sqrt() * measure.sqrt(),
        _ => (6.0 * 2.0_f64.sqrt()).cbrt() * measure.cbrt(),
    }
}

fn next_count(lines: &mut Lines<'_>, what: &str) -> Result<Option<u64>> {
    let Some(line) = lines.next()? else { return Ok(None) };
    let [count] = line.integers([what])?;
    Ok(Some(count))
}

/// Reads a line of an id and a point, and nothing else.
fn coordinates(line: &Line<'_>, dim: usize) -> Result<[f64; 3]> {
    line.require_words(1 + dim)?;
    seed(line, dim)
}

/// Reads the seed of a region: the columns after the first.
fn seed(line: &Line<'_>, dim: usize) -> Result<[f64; 3]> {
    let mut seed = [0.0; 3];
    for (column, word) in line.words().take(1 + dim) {
        match column {
            0 => _ = line.integer(column, word, "id")?,
            _ => seed[column - 1] = line.coordinate(column, word)?,
        }
    }
    Ok(seed)
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, PointCloud, read_table, read_table_file};
    use super::*;

    fn read(text: &str) -> Result<Table> {
        read_table(&mut text.as_bytes(), Format::Poly, &Choice::default())
    }

    const SQUARE: &str = "4 2 1 1\n1 0 0 5 1\n2 1 0 5 1\n3 1 1 5 1\n4 0 1 5 1\n";

    #[test]
    fn segments_holes_and_regions_are_read() {
        let text = format!(
            "# a square\n{SQUARE}# its sides\n5 1\n1 1 2 10\n2 2 3 -1\n3 3 4 2.0\n4 4 1 0\n\
             5 1 3 7\n1\n1 0.25 0.75\n2\n1 0.75 0.25 4 0.5\n2 0.9 0.1 -3 -1\n"
        );
        let table = read(&text).unwrap();
        let coordinates = vec![0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
        assert_eq!(table.points, PointCloud { dim: 2, coordinates });
        let Outline { segments, markers, regions, .. } = table.outline;
        assert_eq!(segments, [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]);
        assert_eq!(markers, [10, -1, 2, 0, 7]);
        let hole = Region { seed: [0.25, 0.75, 0.0], is_hole: true, ..Region::default() };
        let [first, second] = [([0.75, 0.25, 0.0], 4), ([0.9, 0.1, 0.0], -3)]
            .map(|(seed, label)| Region { seed, label, ..Region::default() });
        assert_eq!((regions[0], regions[2]), (hole, second));
        // Half the area of a square of side 1: an equilateral triangle.
        let max_edge = regions[1].max_edge;
        assert!((max_edge * max_edge * 3f64.sqrt() / 4.0 - 0.5).abs() < 1e-15);
        assert_eq!(Region { max_edge: 0.0, ..regions[1] }, first);
    }

    #[test]
    fn what_is_not_needed_may_be_missing() {
        let table = read("2 2\n0 1 2\n1 3 4\n1\n1 0 1\n").unwrap();
        assert_eq!(table.outline.segments, [[0, 1]]);
        assert_eq!((table.outline.markers, table.outline.regions), (vec![0], vec![]));
        assert_eq!(read("2 2\n0 1 2\n1 3 4\n0\n0\n").unwrap().outline, Outline::default());
    }

    #[test]
    fn points_may_be_in_a_file_beside() {
        let name = format!("netmesh-{}-poly", std::process::id());
        let path = std::env::temp_dir().join(name).with_extension("poly");
        let node = path.with_extension("node");
        std::fs::write(&path, "0 2 0 0\n1 0\n1 2 3\n0\n").unwrap();
        let from_files = || read_table_file(&path, Format::Auto, &Choice::default());
        let missing = from_files().unwrap_err();
        assert_eq!(missing.kind(), ErrorKind::Io);
        assert!(missing.message().contains(".node: cannot open"), "{}", missing.message());
        std::fs::write(&node, "3 2 0 0\n1 5 6\n2 7 8\n3 9 9\n").unwrap();
        let table = from_files().unwrap();
        std::fs::remove_file(&path).unwrap();
        std::fs::remove_file(&node).unwrap();
        assert_eq!(table.points.coordinates, [5.0, 6.0, 7.0, 8.0, 9.0, 9.0]);
        assert_eq!(table.outline.segments, [[1, 2]]);
        let error = read("0 2 0 0\n1 0\n1 2 3\n0\n").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let cases = [
            ("", "the file ends after line 5: the number of segments is missing"),
            ("1 2\n", "line 6: 2 markers each; there is one or none"),
            ("1 0 0\n", "line 6: 3 columns; here is the number of segments, and of markers"),
            ("x\n", "line 6, column 1: \"x\" is no number of segments"),
            ("2 0\n1 1 2\n", "the file ends after line 7: 1 of 2 segments"),
            ("1 0\n1 1 2 3\n", "line 7: 4 columns where 3 are expected"),
            ("1 0\n1 0 2\n", "line 7, column 2: point id 0; ids are 1 to 4"),
            ("1 0\n1 2 5\n", "line 7, column 3: point id 5; ids are 1 to 4"),
            ("1 0\n1 2 2\n", "line 7: the segment has one point as both ends"),
            ("1 1\n1 2 3 0.5\n", "line 7, column 4: 0.5 is no marker: a whole number of 32 bits"),
            ("1 1\n1 2 3 3e9\n", "line 7, column 4: 3e9 is no marker: a whole number of 32 bits"),
            ("0\n1\n1 0.5\n", "line 8: 2 columns where 3 are expected"),
            ("0\n1\n1 0.5 y\n", "line 8, column 3: \"y\" is not a number"),
            ("0\n0\n1\n1 0 0\n", "line 9: 3 columns; a region has: id x y label area"),
            ("0\n0\n1\n1 0 0 1.5 1\n", "line 9, column 4: 1.5 is no label: a whole number"),
            ("0\n0\n0\n7\n", "line 9: more data after the regions"),
        ];
        for (text, message) in cases {
            let error = read(&(SQUARE.to_owned() + text)).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Format);
            let is_of_content = ["point id", "as both ends", "whole number"];
            let is_of_content = is_of_content.iter().any(|words| message.contains(words));
            assert_eq!(error.is_of_content(), is_of_content, "{message}");
            assert!(error.message().starts_with(message), "{text:?}: {}", error.message());
        }
        let error = read("2 4\n1 0 0 0 0\n2 1 0 0 0\n0\n0\n").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Dimension);
        assert!(error.message().contains("has 2, as Triangle's, or 3"), "{}", error.message());
    }
}
