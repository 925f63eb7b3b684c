//! Facets of TetGen's `.poly` and `.smesh`.

use super::super::polygons::Polygons;
use super::super::text::{Line, Lines};
use super::super::values::Outline;
use super::loops::Loops;
use super::{PointIds, coordinates, read_counts};
use crate::error::{Error, ErrorKind, Result};
use crate::memory::{TryGrow, with_capacity};

/// The two ways in which TetGen lists facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::io) enum Grammar {
    /// `.poly`: a facet is a line of counts, then its polygons and its holes, a line each.
    Poly,
    /// `.smesh`: a facet is a line, a polygon and perhaps its marker.
    Smesh,
}

/// Reads the section of facets.
pub(super) fn read_facets(
    lines: &mut Lines<'_>,
    grammar: Grammar,
    ids: &PointIds,
    points: &[f64],
    outline: &mut Outline,
) -> Result<()> {
    let what = "number of facets";
    let (count, markers) = read_counts(&lines.require(|| format!("the {what} is missing"))?, what)?;
    let mut polygons = Polygons::default();
    let mut facet = Facet::default();
    for index in 0..count {
        facet.clear();
        let lacks = || format!("{index} of {count} facets");
        match grammar {
            Grammar::Poly => facet.read(lines, lacks, markers, ids, points)?,
            Grammar::Smesh => facet.read_polygon(lines, lacks, ids, Some(markers))?,
        }
        facet.add_to(&mut polygons, points, outline)?;
    }
    outline.facets = polygons.finish();
    Ok(())
}

/// A facet while it is read.
#[derive(Default)]
struct Facet {
    marker: i32,
    /// Points of the polygons, one polygon after the other.
    corners: Vec<u32>,
    /// Polygon -> the end of its points among `corners`.
    ends: Vec<usize>,
    /// Points in holes.
    holes: u64,
    /// Polygon -> false if its sides are segments in the facet; empty if all bound it.
    bounds: Vec<bool>,
}

impl Facet {
    fn clear(&mut self) {
        self.marker = 0;
        self.holes = 0;
        self.corners.clear();
        self.ends.clear();
        self.bounds.clear();
    }

    /// Reads a facet of a `.poly` file.
    fn read(
        &mut self,
        lines: &mut Lines<'_>,
        lacks: impl Fn() -> String,
        markers: usize,
        ids: &PointIds,
        points: &[f64],
    ) -> Result<()> {
        let line = lines.require(&lacks)?;
        let counts = self.read_counts(&line, markers)?;
        for index in 0..counts {
            let lacks = || format!("{index} of {counts} polygons of a facet, {}", lacks());
            self.read_polygon(lines, lacks, ids, None)?;
        }
        self.read_holes(lines, lacks, points)
    }

    /// Reads the line of counts: polygons, then perhaps holes and a marker. Returns the number of
    /// polygons.
    fn read_counts(&mut self, line: &Line<'_>, markers: usize) -> Result<u64> {
        if line.word_count() > 2 + markers {
            let marker = ["", " marker"][markers];
            let message = format!(
                "{} columns; a facet begins with: polygons holes{marker}",
                line.word_count()
            );
            return Err(line.error(message));
        }
        let mut polygons = 0;
        for (column, word) in line.words() {
            match column {
                0 => polygons = line.integer(column, word, "number of polygons")?,
                1 => self.holes = line.integer(column, word, "number of holes")?,
                _ => self.marker = line.whole(column, word, "marker")?,
            }
        }
        match polygons {
            0 => Err(line.error("0 polygons; a facet has one or more")),
            _ => Ok(polygons),
        }
    }

    /// Reads a polygon: the number of its points, then their ids, perhaps on several lines. With
    /// `markers` given it is a facet of its own, and 1 says that its marker may follow.
    fn read_polygon(
        &mut self,
        lines: &mut Lines<'_>,
        lacks: impl Fn() -> String,
        ids: &PointIds,
        markers: Option<usize>,
    ) -> Result<()> {
        let first = self.corners.len();
        let (mut size, mut read) = (None, 0);
        let mut may_have_marker = markers == Some(1);
        while size != Some(read) {
            let line = match size {
                None => lines.require(&lacks)?,
                Some(size) => lines.require(|| format!("{read} of {size} points of a polygon"))?,
            };
            for (column, word) in line.words() {
                match size {
                    None => size = Some(polygon_size(&line, word)?),
                    Some(size) if read < size => {
                        let corner = ids.read(&line, column, word)?;
                        if read > 0 && self.corners.last() == Some(&corner) {
                            return Err(repeated(&line, column, word));
                        }
                        self.corners.try_push(corner)?;
                        read += 1;
                        if read == size && read > 1 && self.corners[first] == corner {
                            return Err(repeated(&line, column, word));
                        }
                    }
                    Some(_) if may_have_marker => {
                        self.marker = line.whole(column, word, "marker")?;
                        may_have_marker = false;
                    }
                    Some(size) => {
                        let message = format!("more numbers than the {size} points of the polygon");
                        return Err(line.field_error(ErrorKind::Format, column, message));
                    }
                }
            }
        }
        Ok(self.ends.try_push(self.corners.len())?)
    }

    /// Reads the points in holes, which decide which polygons bound the facet.
    fn read_holes(
        &mut self,
        lines: &mut Lines<'_>,
        lacks: impl Fn() -> String,
        points: &[f64],
    ) -> Result<()> {
        let mut loops = match self.polygons().filter(|polygon| polygon.len() > 2).count() {
            0 if self.holes > 0 => {
                let message = "a facet with holes has no polygon of three points or more";
                return Err(lines.error(ErrorKind::Format, message).of_content());
            }
            0 | 1 if self.holes == 0 => return Ok(()),
            _ => Loops::new(self.polygons(), points)?,
        };
        for index in 0..self.holes {
            let lacks = || format!("{index} of {} holes of a facet, {}", self.holes, lacks());
            let line = lines.require(lacks)?;
            let hole = coordinates(&line, 3)?;
            if let Err(rule) = loops.add_hole(hole) {
                return Err(line.error(rule).of_content());
            }
        }
        self.bounds = loops.bounds()?;
        Ok(())
    }

    /// Returns the points of each polygon.
    fn polygons(&self) -> impl Iterator<Item = &[u32]> + Clone {
        let begins = std::iter::once(0).chain(self.ends.iter().copied());
        begins.zip(&self.ends).map(|(begin, &end)| &self.corners[begin..end])
    }

    /// Adds the facet to those of the file. Without a polygon of three points or more it is
    /// segments.
    fn add_to(&self, polygons: &mut Polygons, points: &[f64], outline: &mut Outline) -> Result<()> {
        debug_assert!(self.corners.iter().all(|&corner| (corner as usize) < points.len() / 3));
        if self.polygons().all(|polygon| polygon.len() < 3) {
            for polygon in self.polygons() {
                if let [from, to] = *polygon {
                    outline.segments.try_push([from, to])?;
                    outline.markers.try_push(self.marker)?;
                }
            }
            return Ok(());
        }
        // The sides of a polygon that does not bound the facet, two points each.
        let bounds = |at: usize| self.bounds.get(at).is_none_or(|bounds| *bounds);
        let mut sides: Vec<[u32; 2]> = with_capacity(0)?;
        for (at, polygon) in self.polygons().enumerate() {
            if !bounds(at) {
                for (corner, &from) in polygon.iter().enumerate() {
                    sides.try_push([from, polygon[(corner + 1) % polygon.len()]])?;
                }
            }
        }
        let kept = self.polygons().enumerate().filter(|(at, _)| bounds(*at));
        let kept = kept.map(|(_, polygon)| polygon);
        polygons.add(kept.chain(sides.iter().map(<[u32; 2]>::as_slice)), self.marker)
    }
}

fn polygon_size(line: &Line<'_>, word: &str) -> Result<u64> {
    match line.integer(0, word, "number of points of a polygon")? {
        0 => Err(line.field_error(ErrorKind::Format, 0, "a polygon of 0 points")),
        size => Ok(size),
    }
}

fn repeated(line: &Line<'_>, column: usize, word: &str) -> Error {
    let message = format!("the polygon has point {word} twice in a row");
    line.field_error(ErrorKind::Format, column, message).of_content()
}

#[cfg(test)]
mod tests {
    use super::super::super::{Choice, Format, Table, read_table, read_table_file};
    use super::*;
    use crate::mesh::{Facets, Region};

    const POINTS: &str = "5 3\n1 0 0 0\n2 4 0 0\n3 4 4 0\n4 0 4 0\n5 2 2 3\n";

    fn read(text: &str, format: Format) -> Result<Table> {
        read_table(&mut text.as_bytes(), format, &Choice::default())
    }

    /// Returns the loops of each facet.
    fn loops(facets: &Facets) -> Vec<Vec<Vec<u32>>> {
        let of = |facet| facets.loops(facet).map(<[u32]>::to_vec).collect();
        (0..facets.count()).map(of).collect()
    }

    #[test]
    fn facets_segments_holes_and_regions_are_read() {
        let text = format!(
            "# a pyramid\n{POINTS}6 1\n1 0 7\n4 1 2 3 4\n1 0 -8\n3 1 2\n5\n1\n3\n2 3 5\n\
             2 0 9\n3 3 4 5\n1 1\n3\n3 4 1 5\n2 4 1\n1 2\n1 0 5\n2 2 4\n\
             1\n1 2 2 1\n2\n1 1 1 0.5 3 0.25\n2 3 3 0.5 -4 -1\n"
        );
        let Table { points, outline, .. } = read(&text, Format::Poly).unwrap();
        assert_eq!((points.dim, points.count()), (3, 5));
        let expected: Vec<Vec<Vec<u32>>> = vec![
            vec![vec![0, 1, 2, 3]],
            vec![vec![0, 1, 4]],
            vec![vec![1, 2, 4]],
            vec![vec![2, 3, 4], vec![0]],
            vec![vec![3, 0, 4], vec![3, 0], vec![1]],
        ];
        assert_eq!(loops(&outline.facets), expected);
        assert_eq!(outline.facets.markers, [7, -8, 0, 9, 0]);
        assert!(!outline.facets.are_triangles);
        assert_eq!((outline.segments, outline.markers), (vec![[1, 3]], vec![5]));
        let [hole, first, second] = outline.regions[..] else { panic!("a hole, two regions") };
        assert_eq!(hole, Region { seed: [2.0, 2.0, 1.0], is_hole: true, ..Region::default() });
        // A regular tetrahedron of that volume.
        assert!((first.max_edge.powi(3) / (6.0 * 2f64.sqrt()) - 0.25).abs() < 1e-15);
        let region = |seed, label| Region { seed, label, ..Region::default() };
        assert_eq!(Region { max_edge: 0.0, ..first }, region([1.0, 1.0, 0.5], 3));
        assert_eq!(second, region([3.0, 3.0, 0.5], -4));
    }

    /// Holes of facets are TetGen's, and not by the even-odd rule.
    #[test]
    fn a_polygon_in_another_one_is_a_hole_only_with_a_point_in_it() {
        let points =
            "8 3\n0 0 0 0\n1 4 0 0\n2 4 4 0\n3 0 4 0\n4 1 1 0\n5 3 1 0\n6 3 3 0\n7 1 3 0\n";
        let facet = |holes: &str| {
            let count = holes.lines().count();
            let text = format!("{points}1\n2 {count}\n4 0 1 2 3\n4 4 5 6 7\n{holes}");
            loops(&read(&text, Format::Poly).unwrap().outline.facets)
        };
        assert_eq!(facet("0 2 2 0\n"), [[[0, 1, 2, 3], [4, 5, 6, 7]]]);
        let expected: [&[u32]; 5] = [&[0, 1, 2, 3], &[4, 5], &[5, 6], &[6, 7], &[7, 4]];
        assert_eq!(facet(""), [expected]);
        assert_eq!(facet("0 9 9 0\n"), [expected]);
    }

    #[test]
    fn facets_of_smesh_are_a_line_each() {
        let text = format!("{POINTS}3 1\n4 1 2 3 4 6\n3 1 2 5\n3 2 3\n5 -1\n0\n");
        let Table { outline, .. } = read(&text, Format::Smesh).unwrap();
        let expected: Vec<Vec<Vec<u32>>> =
            vec![vec![vec![0, 1, 2, 3]], vec![vec![0, 1, 4]], vec![vec![1, 2, 4]]];
        assert_eq!(loops(&outline.facets), expected);
        assert_eq!(outline.facets.markers, [6, 0, -1]);
        let Table { outline, .. } = read(&format!("{POINTS}1\n2 1 3\n"), Format::Smesh).unwrap();
        assert_eq!(outline.segments, [[0, 2]]);
    }

    #[test]
    fn points_may_be_in_a_file_beside() {
        let name = format!("netmesh-{}-smesh", std::process::id());
        let path = std::env::temp_dir().join(name).with_extension("smesh");
        let node = path.with_extension("node");
        std::fs::write(&path, "0 3 0 0\n1 0\n3 0 2 1\n0\n").unwrap();
        std::fs::write(&node, "3 3 0 0\n0 5 6 1\n1 7 8 1\n2 9 9 1\n").unwrap();
        let table = read_table_file(&path, Format::Auto, &Choice::default());
        std::fs::remove_file(&path).unwrap();
        std::fs::remove_file(&node).unwrap();
        let table = table.unwrap();
        assert_eq!(table.points.count(), 3);
        assert_eq!(loops(&table.outline.facets), [[[0, 2, 1]]]);
    }

    #[test]
    fn without_the_facets_their_number_is_known() {
        let text = format!("{POINTS}2 0\n1\n4 1 2 3 4\n1\n2 1 5\n0\n1\n1 1 1 1 3\n");
        let choice = Choice { has_points_alone: true, ..Choice::default() };
        let table = read_table(&mut text.as_bytes(), Format::Poly, &choice).unwrap();
        assert_eq!(table.outline, Outline::default());
        assert_eq!((table.left_out.edges, table.left_out.faces), (1, 1));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        // Error of a format, or of its content where it is the second.
        let cases = [
            (Format::Poly, "", "the file ends after line 6: the number of facets is missing"),
            (Format::Poly, "2 1\n1 0 3\n3 1 2 3\n", "the file ends after line 9: 1 of 2 facets"),
            (Format::Poly, "1 0\n2\n3 1 2 3\n", "the file ends after line 9: 1 of 2 polygons of a"),
            (
                Format::Poly,
                "1 0\n1\n3 1 2\n",
                "the file ends after line 9: 2 of 3 points of a polygon",
            ),
            (
                Format::Poly,
                "1 0\n1 1\n3 1 2 3\n",
                "the file ends after line 9: 0 of 1 holes of a facet",
            ),
            (Format::Poly, "1 2\n", "line 7: 2 markers each; there is one or none"),
            (Format::Poly, "1 0 0\n", "line 7: 3 columns; here is the number of facets"),
            (
                Format::Poly,
                "1 0\n1 0 5\n",
                "line 8: 3 columns; a facet begins with: polygons holes",
            ),
            (
                Format::Poly,
                "1 1\n1 0 5 6\n",
                "line 8: 4 columns; a facet begins with: polygons holes marker",
            ),
            (Format::Poly, "1 0\nx\n", "line 8, column 1: \"x\" is no number of polygons"),
            (Format::Poly, "1 0\n1 -1\n", "line 8, column 2: \"-1\" is no number of holes"),
            (Format::Poly, "1 0\n0 0\n", "line 8: 0 polygons; a facet has one or more"),
            (Format::Poly, "1 1\n1 0 0.5\n", "line 8, column 3: 0.5 is no marker: a whole number"),
            (Format::Poly, "1\n1\ny 1 2\n", "line 9, column 1: \"y\" is no number of points of a"),
            (Format::Poly, "1\n1\n0\n", "line 9, column 1: a polygon of 0 points"),
            (Format::Poly, "1\n1\n3 1 2 6\n", "line 9, column 4: point id 6; ids are 1 to 5"),
            (Format::Poly, "1\n1\n3 1\n0 2\n", "line 10, column 1: point id 0; ids are 1 to 5"),
            (Format::Poly, "1\n1\n3 1 2 -3\n", "line 9, column 4: \"-3\" is no point id"),
            (Format::Poly, "1\n1\n3 1 2 3 4\n", "line 9, column 5: more numbers than the 3 points"),
            (
                Format::Poly,
                "1\n1\n4 1 2 2 3\n",
                "line 9, column 4: the polygon has point 2 twice in a",
            ),
            (
                Format::Poly,
                "1\n1\n4 1 2 3 1\n",
                "line 9, column 5: the polygon has point 1 twice in a",
            ),
            (Format::Poly, "1\n1\n2 3 3\n", "line 9, column 3: the polygon has point 3 twice in a"),
            (Format::Poly, "1\n1 1\n2 3 4\n", "line 9: a facet with holes has no polygon of three"),
            (Format::Poly, "1\n1 1\n3 1 2 3\n1 3 1\n", "line 10: 3 columns where 4 are expected"),
            (
                Format::Poly,
                "1\n1 1\n3 1 2 3\n1 3 1 z\n",
                "line 10, column 4: \"z\" is not a number",
            ),
            (
                Format::Poly,
                "1\n1 1\n3 1 2 3\n1 3 1 0\n",
                "line 10: the point of the hole is in the facet;",
            ),
            (
                Format::Poly,
                "1\n1 1\n3 1 2 3\n1 1 1 0\n",
                "line 10: the point of the hole is on a polygon",
            ),
            (Format::Poly, "0\n1\n1 0.5 1\n", "line 9: 3 columns where 4 are expected"),
            (
                Format::Poly,
                "0\n0\n1\n1 0 0 1\n",
                "line 10: 4 columns; a region has: id x y z label volume",
            ),
            (
                Format::Poly,
                "0\n0\n1\n1 0 0 1 1.5\n",
                "line 10, column 5: 1.5 is no label: a whole number",
            ),
            (Format::Poly, "0\n0\n1\n1 0 0 1 1 v\n", "line 10, column 6: \"v\" is not a number"),
            (Format::Poly, "0\n0\n0\n7\n", "line 10: more data after the regions"),
            (
                Format::Smesh,
                "1\n3 1 2 3 7\n",
                "line 8, column 5: more numbers than the 3 points of",
            ),
            (
                Format::Smesh,
                "1 1\n3 1 2 3 7 8\n",
                "line 8, column 6: more numbers than the 3 points",
            ),
            (Format::Smesh, "1 1\n3 1 2 3 m\n", "line 8, column 5: \"m\" is not a number"),
            (Format::Smesh, "2 1\n3 1 2 3 7\n", "the file ends after line 8: 1 of 2 facets"),
        ];
        let of_content =
            ["point id 6", "point id 0", "twice", "of the hole", "with holes", "whole"];
        for (format, text, message) in cases {
            let error = read(&(POINTS.to_owned() + text), format).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Format);
            assert!(error.message().starts_with(message), "{text:?}: {}", error.message());
            let is_of_content = of_content.iter().any(|words| message.contains(words));
            assert_eq!(error.is_of_content(), is_of_content, "{message}");
        }
        let error = read("2 2\n0 0 0\n1 1 1\n0\n0\n", Format::Smesh).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Dimension);
        assert!(error.message().ends_with("points of dimension 2; a .smesh file has 3"), "{error}");
    }
}
