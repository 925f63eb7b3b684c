//! Well-known text (OGC 06-103r4, 7): geometries of the plane, one after another.

use super::features::{Features, Ring};
use super::scanner::{Scanner, Shown, TextPosition};
use super::values::Table;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::TryGrow;
use std::io::BufRead;

/// Largest number of collections inside each other: reading them is recursive.
const MAX_DEPTH: u32 = 100;

pub(super) fn read(input: &mut dyn BufRead) -> Result<Table> {
    let mut wkt = Wkt { text: Scanner::new(input)?, positions: Vec::new() };
    let mut features = Features::new("geometry");
    let mut number = 0;
    while wkt.next_byte()?.is_some() {
        number += 1;
        features.begin(number, wkt.text.place())?;
        wkt.skip_reference_system()?;
        wkt.read_geometry(&mut features, 0)?;
        // Some programs end each with a semicolon, as statements.
        wkt.next_is(b';')?;
    }
    features.finish()
}

struct Wkt<'a> {
    text: Scanner<'a>,
    /// Positions of the list that was read last.
    positions: Vec<[f64; 2]>,
}

/// Geometry of a geometry between its parentheses.
#[derive(Clone, Copy)]
enum Geometry {
    Point,
    Points,
    Line,
    Lines,
    Polygon,
    Polygons,
    Geometries,
}

const KEYWORDS: [(&str, Geometry); 7] = [
    ("POINT", Geometry::Point),
    ("MULTIPOINT", Geometry::Points),
    ("LINESTRING", Geometry::Line),
    ("MULTILINESTRING", Geometry::Lines),
    ("POLYGON", Geometry::Polygon),
    ("MULTIPOLYGON", Geometry::Polygons),
    ("GEOMETRYCOLLECTION", Geometry::Geometries),
];

/// Words that follow a keyword where points have more than two coordinates.
const MORE_COORDINATES: [&str; 3] = ["Z", "M", "ZM"];

impl Wkt<'_> {
    /// Skips `SRID=4326;`, as PostGIS has it before a geometry.
    fn skip_reference_system(&mut self) -> Result<()> {
        if !self.text.ahead()?.is_some_and(|byte| byte.eq_ignore_ascii_case(&b's')) {
            return Ok(());
        }
        let place = self.text.place();
        let word = self.text.read_word(is_part_of_word)?;
        if !word.eq_ignore_ascii_case("SRID") {
            return Err(unknown(place, word));
        }
        self.require(b'=')?;
        self.next_byte()?;
        let place = self.text.place();
        let word = self.text.read_word(is_part_of_word)?;
        if word.parse::<u32>().is_err() {
            return Err(place.error(format_args!("{} is no number of an SRID", Shown(word))));
        }
        self.require(b';')
    }

    /// Reads a geometry that is in `depth` collections.
    fn read_geometry(&mut self, features: &mut Features, depth: u32) -> Result<()> {
        self.next_byte()?;
        let place = self.text.place();
        if depth > MAX_DEPTH {
            let message = format_args!("more than {MAX_DEPTH} collections in each other");
            return Err(place.error(message));
        }
        match self.read_keyword()? {
            Geometry::Point => {
                self.read_positions()?;
                match self.positions.len() {
                    0 | 1 => features.add_points(&self.positions),
                    _ => Err(place.error("a POINT with several positions")),
                }
            }
            Geometry::Points => self.each(|wkt, _, _| wkt.read_point_of_many(features)),
            Geometry::Line => self.read_line(features, place),
            Geometry::Lines => self.each(|wkt, place, _| wkt.read_line(features, place)),
            Geometry::Polygon => self.read_polygon(features),
            Geometry::Polygons => self.each(|wkt, _, _| wkt.read_polygon(features)),
            Geometry::Geometries => self.each(|wkt, _, _| wkt.read_geometry(features, depth + 1)),
        }
    }

    fn read_keyword(&mut self) -> Result<Geometry> {
        let place = self.text.place();
        let word = self.text.read_word(is_part_of_word)?;
        if word.is_empty() {
            return Err(self.text.unexpected("the name of a geometry"));
        }
        let found = KEYWORDS.iter().find_map(|&(keyword, content)| {
            let (head, tail) = word.split_at_checked(keyword.len())?;
            head.eq_ignore_ascii_case(keyword).then_some((keyword, content, tail))
        });
        let Some((keyword, content, tail)) = found else { return Err(unknown(place, word)) };
        let is_tag = |word: &str| MORE_COORDINATES.iter().any(|tag| word.eq_ignore_ascii_case(tag));
        if !tail.is_empty() && !is_tag(tail) {
            return Err(unknown(place, word));
        }
        let mut has_more = !tail.is_empty();
        if !has_more && matches!(self.next_byte()?, Some(b'Z' | b'z' | b'M' | b'm')) {
            let place = self.text.place();
            let word = self.text.read_word(is_part_of_word)?;
            has_more = is_tag(word);
            if !has_more {
                return Err(no_list(place, word));
            }
        }
        match has_more {
            false => Ok(content),
            true => Err(more_coordinates(place, keyword)),
        }
    }

    /// Reads a point of many: each has parentheses of its own, or none has.
    fn read_point_of_many(&mut self, features: &mut Features) -> Result<()> {
        let place = self.text.place();
        match self.text.ahead()? {
            Some(byte) if byte == b'(' || byte.is_ascii_alphabetic() => self.read_positions()?,
            _ => {
                self.positions.clear();
                self.add_position()?;
            }
        }
        match self.positions.len() {
            0 | 1 => features.add_points(&self.positions),
            _ => Err(place.error("a point of a MULTIPOINT with several positions")),
        }
    }

    fn read_line(&mut self, features: &mut Features, place: TextPosition) -> Result<()> {
        self.read_positions()?;
        match self.positions.len() {
            0 => Ok(()),
            _ => features.add_line(&self.positions, place),
        }
    }

    fn read_polygon(&mut self, features: &mut Features) -> Result<()> {
        self.each(|wkt, place, number| {
            wkt.read_positions()?;
            features.add_ring(&wkt.positions, Ring { number, place })
        })
    }

    fn read_positions(&mut self) -> Result<()> {
        self.positions.clear();
        self.each(|wkt, _, _| wkt.add_position())
    }

    /// Adds a position of two coordinates.
    fn add_position(&mut self) -> Result<()> {
        let mut position = [0.0; 2];
        for coordinate in &mut position {
            self.next_byte()?;
            let place = self.text.place();
            let word = self.text.read_word(is_part_of_word)?;
            if word.is_empty() {
                return Err(self.text.unexpected("a number"));
            }
            *coordinate = place.coordinate(word)?;
        }
        if self.next_byte()?.is_some_and(is_part_of_word) {
            return Err(more_coordinates(self.text.place(), "a position"));
        }
        Ok(self.positions.try_push(position)?)
    }

    /// Reads what stands between parentheses and commas: `read` takes each, given its position and
    /// its number from 1. `EMPTY` stands for none.
    fn each(
        &mut self,
        mut read: impl FnMut(&mut Self, TextPosition, usize) -> Result<()>,
    ) -> Result<()> {
        if self.next_byte()?.is_some_and(|byte| byte.is_ascii_alphabetic()) {
            let place = self.text.place();
            let word = self.text.read_word(is_part_of_word)?;
            return match word.eq_ignore_ascii_case("EMPTY") {
                true => Ok(()),
                false => Err(no_list(place, word)),
            };
        }
        self.require(b'(')?;
        for number in 1.. {
            self.next_byte()?;
            let place = self.text.place();
            read(self, place, number)?;
            if !self.next_is(b',')? {
                break;
            }
        }
        self.require(b')')
    }

    fn require(&mut self, byte: u8) -> Result<()> {
        match self.next_is(byte)? {
            true => Ok(()),
            false => Err(self.text.unexpected(format_args!("\"{}\"", byte as char))),
        }
    }

    fn next_is(&mut self, byte: u8) -> Result<bool> {
        self.next_byte()?;
        self.text.next_is(byte)
    }

    /// Returns the next byte that is neither a blank nor of a comment.
    fn next_byte(&mut self) -> Result<Option<u8>> {
        self.text.pass_over(|byte| byte.is_ascii_whitespace())?;
        while self.text.ahead()? == Some(b'#') {
            self.text.pass_over(|byte| byte != b'\n')?;
            self.text.pass_over(|byte| byte.is_ascii_whitespace())?;
        }
        self.text.ahead()
    }
}

fn is_part_of_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'-' | b'.' | b'_')
}

fn unknown(place: TextPosition, word: &str) -> Error {
    place.error(format_args!(
        "{}; POINT, LINESTRING, POLYGON, their MULTI and GEOMETRYCOLLECTION are read",
        Shown(word)
    ))
}

fn no_list(place: TextPosition, word: &str) -> Error {
    place.error(format_args!("{} where \"(\" or EMPTY is expected", Shown(word)))
}

fn more_coordinates(place: TextPosition, what: &str) -> Error {
    let message =
        format_args!("{what} with more than 2 coordinates; points of the plane alone are read");
    place.error_of_kind(ErrorKind::Dimension, message)
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, Outline, PointCloud, read_table, samples};
    use super::*;

    fn read(text: &str) -> Result<Table> {
        read_table(&mut text.as_bytes(), Format::Wkt, &Choice::default())
    }

    fn segments(text: &str) -> Vec<([u32; 2], i32)> {
        let Outline { segments, markers, .. } = read(text).unwrap().outline;
        segments.into_iter().zip(markers).collect()
    }

    #[test]
    fn every_geometry_has_its_points_and_segments() {
        let text = "SRID=4326;POINT (9 8)\r\n# a comment ( \n linestring(0 0, 1 0,1 0, 1 1);\n\
            MultiLineString((0 0,2 0), EMPTY ,(5 5,6 6,5 5))\nPOLYGON EMPTY\n\
            POLYGON((0 0,4 0,0 4,0 0),(1 1,1 2,2 1,1 1))MULTIPOINT(1 2,3 4)\t\
            multipoint((5 6),EMPTY,(7 8))";
        let table = read(text).unwrap();
        let coordinates = vec![
            9.0, 8.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 0.0, 2.0, 0.0, 5.0, 5.0, 6.0,
            6.0, 5.0, 5.0, 0.0, 0.0, 4.0, 0.0, 0.0, 4.0, 1.0, 1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 2.0,
            3.0, 4.0, 5.0, 6.0, 7.0, 8.0,
        ];
        assert_eq!(table.points, PointCloud { dim: 2, coordinates });
        let lines = [([1, 2], 2), ([3, 4], 2), ([5, 6], 3), ([7, 8], 3), ([8, 9], 3)];
        let rings =
            [[10, 11], [11, 12], [12, 10], [13, 14], [14, 15], [15, 13]].map(|ends| (ends, 5));
        assert_eq!(segments(text), [&lines[..], &rings].concat());
        assert!(table.outline.regions.is_empty() && table.attributes.is_empty());
    }

    #[test]
    fn members_of_a_geometry_have_its_number() {
        let triangle = "((0 0,1 0,0 1,0 0))";
        let text = format!(
            "POINT(5 5)\nGEOMETRYCOLLECTION(POLYGON{triangle},GEOMETRYCOLLECTION EMPTY,\
             GEOMETRYCOLLECTION(LINESTRING(2 2,3 3)),POINT EMPTY)\n\
             MULTIPOLYGON({triangle},EMPTY,{triangle})"
        );
        let markers: Vec<i32> = segments(&text).iter().map(|(_, marker)| *marker).collect();
        assert_eq!(markers, [2, 2, 2, 2, 3, 3, 3, 3, 3, 3]);
    }

    /// Maps that were made coarser have them.
    #[test]
    fn rings_and_lines_of_few_distinct_points_are_inputs_and_segments() {
        let text = "POLYGON((0 0,9 0,0 9,0 0),(1 1,2 2,1 1,1 1),(3 3,3 3,3 3,3 3))\n\
                    LINESTRING(5 5,5 5)";
        let sides = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5]];
        assert_eq!(segments(text), sides.map(|side| (side, 1)));
        let points = read(text).unwrap().points.coordinates;
        assert_eq!(
            points[6..],
            [1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 5.0, 5.0, 5.0, 5.0]
        );
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        let numbers = samples::AWKWARD.chunks_exact(2).map(|p| format!("({:?} {:e})", p[0], p[1]));
        let text = format!("MULTIPOINT({})", numbers.collect::<Vec<_>>().join(","));
        samples::assert_same_bits(&read(&text).unwrap().points.coordinates, &samples::AWKWARD);
    }

    #[test]
    fn collections_are_in_each_other_a_hundred_times() {
        let nested = |depth: usize| {
            let begin = "GEOMETRYCOLLECTION(".repeat(depth);
            read(&format!("{begin}POINT(1 2){}", ")".repeat(depth)))
        };
        assert_eq!(nested(100).unwrap().points.count(), 1);
        let error = nested(101).unwrap_err();
        let expected = "line 1, byte 1920: more than 100 collections in each other";
        assert_eq!(error.message(), expected);
        assert_eq!(nested(1_000_000).unwrap_err().message(), expected);
    }
}
