//! GeoJSON (RFC 7946): points and polylines of the plane. Members may stand in any order, so that
//! coordinates are read before it is known what they are of.

mod json;

use super::features::{Features, Ring};
use super::scanner::TextPosition;
use super::values::Table;
use crate::error::{ErrorKind, Result};
use crate::memory::TryGrow;
use json::{Json, Kind, Name};
use std::io::BufRead;

pub(super) fn read(input: &mut dyn BufRead) -> Result<Table> {
    let mut json = Json::new(input)?;
    let mut features = Features::new("feature");
    read_object(&mut json, &mut features, Role::Whole)?;
    json.require_end()?;
    features.finish()
}

/// Kind of object that may stand at a position of the file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Whole,
    Feature,
    Geometry,
}

/// The members that say something here.
const FEATURES: &str = "features";
const GEOMETRY: &str = "geometry";
const GEOMETRIES: &str = "geometries";
const COORDINATES: &str = "coordinates";
const MEMBERS: [&str; 4] = [FEATURES, GEOMETRY, GEOMETRIES, COORDINATES];

fn read_object(json: &mut Json<'_>, features: &mut Features, role: Role) -> Result<()> {
    let place = json.place()?;
    let mut object = Object { place, name: None, is_there: [false; 4], coordinates: None };
    json.object("an object of GeoJSON", |json, member| object.read(json, features, member))?;
    object.finish(features, role)
}

/// Members that have been read of an object.
struct Object {
    place: TextPosition,
    /// The value of `type`.
    name: Option<Name>,
    /// True for each of [`MEMBERS`] that the object has.
    is_there: [bool; 4],
    coordinates: Option<Coordinates>,
}

impl Object {
    fn read(&mut self, json: &mut Json<'_>, features: &mut Features, member: Name) -> Result<()> {
        let place = json.place()?;
        let again = || place.error(format_args!("a second member {member} of one object"));
        if member.as_bytes() == b"type" {
            return match self.name.replace(json.string("the name of a type")?) {
                Some(_) => Err(again()),
                None => Ok(()),
            };
        }
        let at = MEMBERS.iter().position(|name| name.as_bytes() == member.as_bytes());
        let Some(at) = at else { return json.skip() };
        if std::mem::replace(&mut self.is_there[at], true) {
            return Err(again());
        }
        match MEMBERS[at] {
            FEATURES => {
                let mut number = 0;
                json.array("a list of features", |json| {
                    number += 1;
                    features.begin(number, json.place()?)?;
                    read_object(json, features, Role::Feature)
                })
            }
            GEOMETRY if json.is_null()? => Ok(()),
            GEOMETRY => read_object(json, features, Role::Geometry),
            GEOMETRIES => json
                .array("a list of geometries", |json| read_object(json, features, Role::Geometry)),
            _ => {
                self.coordinates = Some(Coordinates::read(json)?);
                Ok(())
            }
        }
    }

    /// Takes the object to the features when all members are known.
    fn finish(self, features: &mut Features, role: Role) -> Result<()> {
        let refuse = |message: std::fmt::Arguments<'_>| Err(self.place.error(message));
        let Some(name) = self.name else {
            return refuse(format_args!("an object without the member \"type\""));
        };
        let (own_role, needed, shape) = match name.as_bytes() {
            b"FeatureCollection" => (Role::Whole, FEATURES, None),
            b"Feature" => (Role::Feature, GEOMETRY, None),
            b"GeometryCollection" => (Role::Geometry, GEOMETRIES, None),
            b"Point" => (Role::Geometry, COORDINATES, Some(Shape::POINT)),
            b"MultiPoint" => (Role::Geometry, COORDINATES, Some(Shape::MULTI_POINT)),
            b"LineString" => (Role::Geometry, COORDINATES, Some(Shape::LINE)),
            b"MultiLineString" => (Role::Geometry, COORDINATES, Some(Shape::MULTI_LINE)),
            b"Polygon" => (Role::Geometry, COORDINATES, Some(Shape::POLYGON)),
            b"MultiPolygon" => (Role::Geometry, COORDINATES, Some(Shape::MULTI_POLYGON)),
            _ => return refuse(format_args!("the type {name}, which is none of GeoJSON's")),
        };
        if role != Role::Whole && role != own_role {
            let expected = if role == Role::Feature { "a Feature" } else { "a geometry" };
            return refuse(format_args!("the type {name} where {expected} is expected"));
        }
        for (member, is_there) in MEMBERS.into_iter().zip(self.is_there) {
            match (member == needed, is_there) {
                (true, false) => {
                    return refuse(format_args!("the type {name} without the member \"{member}\""));
                }
                (false, true) => {
                    return refuse(format_args!("the type {name} with a member \"{member}\""));
                }
                _ => {}
            }
        }
        match (shape, self.coordinates) {
            (Some(shape), Some(coordinates)) => coordinates.add_to(features, shape, name),
            _ => Ok(()),
        }
    }
}

/// Shape that coordinates are of.
#[derive(Clone, Copy)]
struct Shape {
    /// The number of lists around a number.
    level: usize,
    primitive: Primitive,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Primitive {
    Point,
    Line,
    Ring,
}

impl Shape {
    const POINT: Self = Self { level: 1, primitive: Primitive::Point };
    const MULTI_POINT: Self = Self { level: 2, primitive: Primitive::Point };
    const LINE: Self = Self { level: 2, primitive: Primitive::Line };
    const MULTI_LINE: Self = Self { level: 3, primitive: Primitive::Line };
    const POLYGON: Self = Self { level: 3, primitive: Primitive::Ring };
    const MULTI_POLYGON: Self = Self { level: MAX_LEVEL, primitive: Primitive::Ring };
}

/// The lists around a number of a MultiPolygon.
const MAX_LEVEL: usize = 4;

/// Nested lists of numbers, before it is known what they are of.
struct Coordinates {
    place: TextPosition,
    /// The number of lists around each number; `None` before the first.
    level: Option<usize>,
    positions: Vec<[f64; 2]>,
    /// The lists of positions: where each begins, and the number of positions up to its end.
    lines: Vec<(TextPosition, usize)>,
    /// The lists of those: the number of lines up to the end of each.
    polygons: Vec<usize>,
    /// First list without elements, by the number of lists around it, itself included.
    empty: [Option<TextPosition>; MAX_LEVEL + 1],
}

impl Coordinates {
    fn read(json: &mut Json<'_>) -> Result<Self> {
        let mut coordinates = Self {
            place: json.place()?,
            level: None,
            positions: Vec::new(),
            lines: Vec::new(),
            polygons: Vec::new(),
            empty: [None; MAX_LEVEL + 1],
        };
        coordinates.read_list(json, 1)?;
        Ok(coordinates)
    }

    /// Reads a list, whose elements have `level` lists around them.
    fn read_list(&mut self, json: &mut Json<'_>, level: usize) -> Result<()> {
        let place = json.place()?;
        if level > MAX_LEVEL {
            return Err(place.error("coordinates in more lists than those of a MultiPolygon"));
        }
        let (mut lists, mut position) = (0, Position::default());
        json.array("a list of coordinates", |json| match json.kind_of_next()? {
            Kind::Array if position.count == 0 => {
                lists += 1;
                self.read_list(json, level + 1)
            }
            Kind::Array => Err(json.unexpected("a number")),
            _ if lists > 0 => Err(json.unexpected("a list")),
            _ => position.add(json),
        })?;
        match (lists, position.count) {
            (0, 0) => _ = self.empty[level].get_or_insert(place),
            (0, _) => self.add(position.finished(place)?, level, place)?,
            _ if self.level == Some(level + 1) => {
                self.lines.try_push((place, self.positions.len()))?;
            }
            _ if self.level == Some(level + 2) => self.polygons.try_push(self.lines.len())?,
            _ => {}
        }
        Ok(())
    }

    fn add(&mut self, position: [f64; 2], level: usize, place: TextPosition) -> Result<()> {
        if *self.level.get_or_insert(level) != level {
            let message = "a position in more or fewer lists than those before it";
            return Err(place.error(message));
        }
        Ok(self.positions.try_push(position)?)
    }

    fn add_to(&self, features: &mut Features, shape: Shape, name: Name) -> Result<()> {
        let Shape { level, primitive } = shape;
        if self.level.is_some_and(|own| own != level) {
            let message = format_args!(
                "positions in {} lists; those of a {name} are in {}",
                self.level.map_or(0, |own| own - 1),
                level - 1
            );
            return Err(self.place.error(message));
        }
        // Without elements a geometry may be, a ring or a position may not.
        let deepest = if primitive == Primitive::Ring { level - 1 } else { level };
        let empty = self.empty.iter().skip(deepest.max(2)).flatten().next();
        if let Some(place) = empty {
            return Err(place.error("a list without elements"));
        }
        match primitive {
            Primitive::Point => features.add_points(&self.positions),
            Primitive::Line => {
                let mut lines = self.polylines();
                lines.try_for_each(|(place, positions)| features.add_line(positions, place))
            }
            Primitive::Ring => {
                let mut polygons = self.polygons.iter().peekable();
                let mut first = 0;
                for (at, (place, positions)) in self.polylines().enumerate() {
                    if polygons.next_if(|end| **end == at).is_some() {
                        first = at;
                    }
                    features.add_ring(positions, Ring { number: at - first + 1, place })?;
                }
                Ok(())
            }
        }
    }

    fn polylines(&self) -> impl Iterator<Item = (TextPosition, &[[f64; 2]])> {
        let begins = [0].into_iter().chain(self.lines.iter().map(|(_, end)| *end));
        let lines = begins.zip(&self.lines);
        lines.map(|(begin, (place, end))| (*place, &self.positions[begin..*end]))
    }
}

/// Coordinates that have been read of a position.
#[derive(Default)]
struct Position {
    coordinates: [f64; 2],
    count: usize,
}

impl Position {
    /// Adds a coordinate: two of them, and perhaps a height of zero.
    fn add(&mut self, json: &mut Json<'_>) -> Result<()> {
        let place = json.place()?;
        let value = json.number()?;
        match (self.count, value) {
            (0 | 1, _) => self.coordinates[self.count] = value,
            (2, 0.0) => {}
            (2, _) => {
                let message = format_args!(
                    "a third coordinate, {value:?}; points are read as those of the plane, where \
                     it is 0 or missing"
                );
                return Err(place.error_of_kind(ErrorKind::Dimension, message));
            }
            _ => return Err(place.error("a fourth coordinate of a position")),
        }
        self.count += 1;
        Ok(())
    }

    fn finished(self, place: TextPosition) -> Result<[f64; 2]> {
        match self.count {
            1 => Err(place.error("a position with one coordinate")),
            _ => Ok(self.coordinates),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Choice, Format, Outline, PointCloud, read_table, samples};
    use super::*;

    fn read(text: &str) -> Result<Table> {
        read_table(&mut text.as_bytes(), Format::Geojson, &Choice::default())
    }

    fn segments(text: &str) -> Vec<([u32; 2], i32)> {
        let Outline { segments, markers, .. } = read(text).unwrap().outline;
        segments.into_iter().zip(markers).collect()
    }

    fn geometry(name: &str, coordinates: &str) -> String {
        format!(r#"{{"type":"{name}","coordinates":{coordinates}}}"#)
    }

    const TRIANGLE: &str = "[[0,0],[1,0],[0,1],[0,0]]";

    #[test]
    fn every_geometry_has_its_points_and_segments() {
        let point = |point: &[f64]| PointCloud { dim: 2, coordinates: point.to_vec() };
        let points = |name, coordinates| read(&geometry(name, coordinates)).unwrap().points;
        assert_eq!(points("Point", "[1,2]"), point(&[1.0, 2.0]));
        assert_eq!(points("Point", "[1,2,-0.0]"), point(&[1.0, 2.0]));
        assert_eq!(points("MultiPoint", "[[1,2],[3,4]]"), point(&[1.0, 2.0, 3.0, 4.0]));
        assert!(segments(&geometry("MultiPoint", "[[1,2],[3,4]]")).is_empty());
        let of = |name, coordinates: &str| {
            let segments = segments(&geometry(name, coordinates));
            assert!(segments.iter().all(|(_, marker)| *marker == 1));
            segments.into_iter().map(|(ends, _)| ends).collect::<Vec<_>>()
        };
        // No segment between equal positions.
        assert_eq!(of("LineString", "[[0,0],[1,0],[1,0],[1,1]]"), [[0, 1], [2, 3]]);
        let lines = "[[[0,0],[2,0]],[],[[5,5],[6,6],[5,5]]]";
        assert_eq!(of("MultiLineString", lines), [[0, 1], [2, 3], [3, 4]]);
        let ring = [[0, 1], [1, 2], [2, 0]];
        let next = ring.map(|ends| ends.map(|end| end + 3));
        assert_eq!(of("Polygon", &format!("[{TRIANGLE}]")), ring);
        assert_eq!(points("Polygon", &format!("[{TRIANGLE}]")).count(), 3);
        let both = [ring, next].concat();
        assert_eq!(of("Polygon", &format!("[{TRIANGLE},{TRIANGLE}]")), both);
        let polygons = format!("[[],[{TRIANGLE}],[{TRIANGLE}],[]]");
        assert_eq!(of("MultiPolygon", &polygons), both);
    }

    #[test]
    fn features_number_their_segments() {
        let polygon = geometry("Polygon", &format!("[{TRIANGLE}]"));
        let line = geometry("LineString", "[[7,7],[8,8]]");
        let collection = format!(
            r#"{{"geometries":[{line},{{"type":"GeometryCollection","geometries":[{polygon}]}}],
                "type":"GeometryCollection"}}"#
        );
        let feature = |geometry: &str| {
            format!(r#"{{"type":"Feature","properties":{{"a":[{{}}]}},"geometry":{geometry}}}"#)
        };
        let features = [polygon.as_str(), "null", &collection].map(feature).join(",");
        let whole =
            format!(r#"{{"bbox":[0,0,1,1],"features":[{features}],"type":"FeatureCollection"}}"#);
        let markers = |text: &str| segments(text).into_iter().map(|s| s.1).collect::<Vec<_>>();
        assert_eq!(markers(&whole), [1, 1, 1, 3, 3, 3, 3]);
        assert_eq!(markers(&feature(&line)), [1]);
        assert_eq!(markers(&collection), [1; 4]);
    }

    #[test]
    fn members_come_in_any_order_and_names_in_any_notation() {
        let text = "\u{feff}{\r\n\"coordinates\" : [ [1.5, -2e0 ] ,[3,\t4]],\"x\":{\
            \"type\":[\"]\\\"}\",-0.5E+3,true,false,null,NaN,-Infinity,{}]},\
            \"\\u0074ype\":\"Line\\u0053tring\",\
            \"coordinates_of_another_kind\":\"\\u00e9\\ud83d\\ude00 \\/\\n\" }  \n";
        let table = read(text).unwrap();
        assert_eq!(table.points.coordinates, [1.5, -2.0, 3.0, 4.0]);
        assert_eq!(table.outline.segments, [[0, 1]]);
    }

    #[test]
    fn vertices_read_back_bit_by_bit() {
        let numbers = samples::AWKWARD.chunks_exact(2).map(|p| format!("[{:?},{:e}]", p[0], p[1]));
        let text = geometry("MultiPoint", &format!("[{}]", numbers.collect::<Vec<_>>().join(",")));
        samples::assert_same_bits(&read(&text).unwrap().points.coordinates, &samples::AWKWARD);
    }

    #[test]
    fn lists_and_objects_are_in_each_other_a_hundred_times() {
        let nested = |depth: usize| {
            let lists = "[".repeat(depth) + &"]".repeat(depth);
            read(&format!(r#"{{"a":{lists},"type":"Point","coordinates":[1,2]}}"#))
        };
        assert_eq!(nested(99).unwrap().points.count(), 1);
        let expected = "line 1, byte 105: more than 100 lists and objects in each other";
        assert_eq!(nested(100).unwrap_err().message(), expected);
        assert_eq!(nested(1_000_000).unwrap_err().message(), expected);
        let collections = r#"{"type":"GeometryCollection","geometries":["#.repeat(1000);
        assert!(read(&collections).unwrap_err().message().contains("more than 100 lists"));
    }
}
