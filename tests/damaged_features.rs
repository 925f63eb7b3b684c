//! Damaged files of GeoJSON and well-known text: each is refused, with a message that names the
//! place.

use netmesh::ErrorKind::{Dimension, Format as Broken, NonFinite};
use netmesh::io::{Choice, Format, Table, read_table};
use netmesh::{Error, ErrorKind};

fn from_bytes(bytes: &[u8], format: Format) -> Result<Table, Error> {
    let mut input = bytes;
    read_table(&mut input, format, &Choice::default())
}

/// Damaged files: the kind of the error, and the beginning of its message.
type Damaged = (&'static str, ErrorKind, &'static str);

fn assert_refused(format: Format, table: &[Damaged]) {
    for (text, kind, message) in table {
        let error = from_bytes(text.as_bytes(), format).expect_err(text);
        assert_eq!(error.kind(), *kind, "{text}: {error}");
        assert!(error.message().starts_with(message), "{text}: {error}");
    }
}

#[test]
fn geojson_refuses_what_is_no_json() {
    assert_refused(
        Format::Geojson,
        &[
            ("", Broken, "the file ends at line 1, byte 1, where an object of GeoJSON is"),
            ("\n \n", Broken, "the file ends at line 3, byte 1, where an object of GeoJSON is"),
            ("[]", Broken, "line 1, byte 1: \"[\" where an object of GeoJSON is expected"),
            ("{\n a", Broken, "line 2, byte 2: \"a\" where the name of a member is expected"),
            ("{\"a\" 1}", Broken, "line 1, byte 6: \"1\" where \":\" is expected"),
            ("{\"a\":}", Broken, "line 1, byte 6: \"}\" where a value is expected"),
            ("{\"a\":tru}", Broken, "line 1, byte 6: \"tru\" is not a value of JSON"),
            ("{\"a\":01}", Broken, "line 1, byte 6: \"01\" is not a value of JSON"),
            ("{\"a\":1 2}", Broken, "line 1, byte 8: \"2\" where \",\" or \"}\" is expected"),
            ("{\"a\":[1}", Broken, "line 1, byte 8: \"}\" where \",\" or \"]\" is expected"),
            ("{\"a\":[1,]}", Broken, "line 1, byte 9: \"]\" where a value is expected"),
            ("{\"a\":1,}", Broken, "line 1, byte 8: \"}\" where the name of a member is expected"),
            ("{\"a\\x\":1}", Broken, "line 1, byte 5: \"x\" where one of \"\\/bfnrtu after"),
            ("{\"\\u00g0\":1}", Broken, "line 1, byte 7: \"g\" where a hexadecimal digit"),
            ("{\"a\n\":1}", Broken, "line 1, byte 4: \"\\n\" where a character or the end"),
            ("{\"a", Broken, "the file ends at line 1, byte 4, where a character or the end"),
            ("\u{feff}{", Broken, "the file ends at line 1, byte 5, where the name of a member"),
            ("{\"a\":1\0}", Broken, "line 1, byte 7: a NUL byte; this is not a text file"),
            (
                "{\"type\":\"Point\",\"coordinates\":[1,2]}\n{}",
                Broken,
                "line 2, byte 1: \"{\" where",
            ),
        ],
    );
    let error = from_bytes(b"\xef\xbb{}", Format::Geojson).unwrap_err();
    assert_eq!(error.message(), "line 1, byte 3: \"{\" where text is expected");
}

#[test]
fn geojson_refuses_objects_that_are_none_of_its_own() {
    assert_refused(
        Format::Geojson,
        &[
            ("{}", Broken, "line 1, byte 1: an object without the member \"type\""),
            ("{\"type\":7}", Broken, "line 1, byte 9: \"7\" where the name of a type is expected"),
            (
                "{\"type\":\"Topology\",\"arcs\":[]}",
                Broken,
                "line 1, byte 1: the type \"Topology\", which is none of GeoJSON's",
            ),
            (
                "{\"type\":\"Point\",\"type\":\"Point\",\"coordinates\":[1,2]}",
                Broken,
                "line 1, byte 24: a second member \"type\" of one object",
            ),
            (
                "{\"type\":\"Point\",\"coordinates\":[1,2],\n\"coordinates\":[1,2]}",
                Broken,
                "line 2, byte 15: a second member \"coordinates\" of one object",
            ),
            (
                "{\"type\":\"Point\"}",
                Broken,
                "line 1, byte 1: the type \"Point\" without the member \"coordinates\"",
            ),
            (
                "{\"type\":\"Feature\",\"properties\":null}",
                Broken,
                "line 1, byte 1: the type \"Feature\" without the member \"geometry\"",
            ),
            (
                "{\"type\":\"Point\",\"geometry\":null,\"coordinates\":[1,2]}",
                Broken,
                "line 1, byte 1: the type \"Point\" with a member \"geometry\"",
            ),
            (
                "{\"type\":\"FeatureCollection\",\"features\":\
                 [\n{\"type\":\"Point\",\"coordinates\":[1,2]}]}",
                Broken,
                "line 2, byte 1: the type \"Point\" where a Feature is expected",
            ),
            (
                "{\"type\":\"Feature\",\"geometry\":{\"type\":\"Feature\",\"geometry\":null}}",
                Broken,
                "line 1, byte 30: the type \"Feature\" where a geometry is expected",
            ),
            (
                "{\"type\":\"FeatureCollection\",\"features\":{}}",
                Broken,
                "line 1, byte 40: \"{\" where a list of features is expected",
            ),
            (
                "{\"type\":\"FeatureCollection\",\"features\":[]}",
                Broken,
                "the file holds no points",
            ),
            ("{\"type\":\"Polygon\",\"coordinates\":[]}", Broken, "the file holds no points"),
        ],
    );
}

#[test]
fn geojson_refuses_damaged_coordinates() {
    for (name, coordinates, kind, message) in [
        ("Point", "null", Broken, "0: \"n\" where a list of coordinates is expected"),
        ("Point", "[1]", Broken, "0: a position with one coordinate"),
        ("Point", "[1,null]", Broken, "3: \"null\" is not a number"),
        ("Point", "[1,\"2\"]", Broken, "3: \"\\\"\" where a number is expected"),
        ("Point", "[1,{}]", Broken, "3: \"{\" where a number is expected"),
        ("Point", "[1,+2]", Broken, "3: \"+2\" is not a number of JSON"),
        ("Point", "[1,.5]", Broken, "3: \".5\" is not a number of JSON"),
        ("Point", "[1,5.]", Broken, "3: \"5.\" is not a number of JSON"),
        ("Point", "[1,-05]", Broken, "3: \"-05\" is not a number of JSON"),
        ("Point", "[1,2e]", Broken, "3: \"2e\" is not a number"),
        ("Point", "[1,2e+]", Broken, "3: \"2e+\" is not a number"),
        ("Point", "[1,1e999]", Broken, "3: \"1e999\" is too large for a double"),
        ("Point", "[1,-]", Broken, "3: \"-\" is not a number"),
        ("Point", "[1,NaN]", NonFinite, "3: \"NaN\"; every coordinate must be finite"),
        ("Point", "[1,-Infinity]", NonFinite, "3: \"-Infinity\"; every coordinate must be finite"),
        ("Point", "[1,2,3]", Dimension, "5: a third coordinate, 3.0; points are read as those"),
        ("Point", "[1,2,0,0]", Broken, "7: a fourth coordinate of a position"),
        ("Point", "[[1,2]]", Broken, "0: positions in 1 lists; those of a \"Point\" are in 0"),
        (
            "MultiPoint",
            "[1,2]",
            Broken,
            "0: positions in 0 lists; those of a \"MultiPoint\" are in 1",
        ),
        ("MultiPoint", "[[1,2],[]]", Broken, "7: a list without elements"),
        ("MultiPoint", "[[1,2],3]", Broken, "7: \"3\" where a list is expected"),
        ("MultiPoint", "[[1,[2]]]", Broken, "4: \"[\" where a number is expected"),
        ("MultiPoint", "[[1,2],[[3,4]]]", Broken, "8: a position in more or fewer lists than"),
        ("MultiPolygon", "[[[[[1,2]]]]]", Broken, "4: coordinates in more lists than those of"),
        ("LineString", "[[1,2]]", Broken, "0: feature 1: a line with fewer than 2 positions"),
        (
            "Polygon",
            "[[[1,2],[3,4],[5,0],[1,3]]]",
            Broken,
            "1: feature 1: ring 1 begins at 1.0 2.0 and \
          ends at 1.0 3.0; its last position must be its first",
        ),
        (
            "Polygon",
            "[[[1,2],[3,4],[1,2]]]",
            Broken,
            "1: feature 1: ring 1 has fewer than 4 positions",
        ),
        ("Polygon", "[[]]", Broken, "1: a list without elements"),
        (
            "MultiPolygon",
            "[[[[0,0],[1,0],[0,1],[0,0]]],[[[0,0],[1,0],[0,1],[0,0]],[[1,2],[3,4]]]]",
            Broken,
            "56: feature 1: ring 2 has fewer than 4 positions",
        ),
        ("MultiPolygon", "[[[]]]", Broken, "2: a list without elements"),
    ] {
        let before = format!("{{\"type\":\"{name}\",\"coordinates\":");
        let (offset, message) = message.split_once(": ").unwrap();
        let byte = before.len() + 1 + offset.parse::<usize>().unwrap();
        let text = format!("{before}{coordinates}}}");
        let error = from_bytes(text.as_bytes(), Format::Geojson).expect_err(&text);
        assert_eq!(error.kind(), kind, "{text}: {error}");
        let message = format!("line 1, byte {byte}: {message}");
        assert!(error.message().starts_with(&message), "{text}: {error}");
    }
}

#[test]
fn wkt_refuses_damaged_files() {
    assert_refused(
        Format::Wkt,
        &[
            ("", Broken, "the file holds no points"),
            ("# c\nPOINT EMPTY", Broken, "the file holds no points"),
            ("(1 2)", Broken, "line 1, byte 1: \"(\" where the name of a geometry is expected"),
            ("\n POINTS(1 2)", Broken, "line 2, byte 2: \"POINTS\"; POINT, LINESTRING, POLYGON"),
            ("SURFACE(1 2)", Broken, "line 1, byte 1: \"SURFACE\"; POINT, LINESTRING, POLYGON"),
            ("SRID:1;POINT(1 2)", Broken, "line 1, byte 5: \":\" where \"=\" is expected"),
            ("SRID=-1;POINT(1 2)", Broken, "line 1, byte 6: \"-1\" is no number of an SRID"),
            ("SRID=1 POINT(1 2)", Broken, "line 1, byte 8: \"P\" where \";\" is expected"),
            ("POINT 1 2", Broken, "line 1, byte 7: \"1\" where \"(\" is expected"),
            ("POINT", Broken, "the file ends at line 1, byte 6, where \"(\" is expected"),
            ("POINT MANY(1 2)", Broken, "line 1, byte 7: \"MANY\" where \"(\" or EMPTY is"),
            ("POINT NONE", Broken, "line 1, byte 7: \"NONE\" where \"(\" or EMPTY is expected"),
            ("POINT(1)", Broken, "line 1, byte 8: \")\" where a number is expected"),
            ("POINT()", Broken, "line 1, byte 7: \")\" where a number is expected"),
            ("POINT(1 x)", Broken, "line 1, byte 9: \"x\" is not a number"),
            ("POINT(1 1e999)", Broken, "line 1, byte 9: \"1e999\" is too large for a double"),
            ("POINT(1 nan)", NonFinite, "line 1, byte 9: \"nan\"; every coordinate must be finite"),
            ("POINT(-inf 1)", NonFinite, "line 1, byte 7: \"-inf\"; every coordinate must"),
            ("POINT(1 2,3 4)", Broken, "line 1, byte 1: a POINT with several positions"),
            ("POINT(1 2", Broken, "the file ends at line 1, byte 10, where \")\" is expected"),
            ("POINT(1 2))", Broken, "line 1, byte 11: \")\" where the name of a geometry"),
            ("POINT(1 2\0)", Broken, "line 1, byte 10: a NUL byte; this is not a text file"),
            ("POINT(1 2 3)", Dimension, "line 1, byte 11: a position with more than 2 coord"),
            ("POINT z(1 2 3)", Dimension, "line 1, byte 1: POINT with more than 2 coordinates"),
            ("PointZM(1 2 3 4)", Dimension, "line 1, byte 1: POINT with more than 2 coordinates"),
            ("MULTIPOINT M EMPTY", Dimension, "line 1, byte 1: MULTIPOINT with more than 2"),
            (
                "MULTIPOINT((1 2,3 4))",
                Broken,
                "line 1, byte 12: a point of a MULTIPOINT with several positions",
            ),
            (
                "POINT(1 2)\nLINESTRING(1 2)",
                Broken,
                "line 2, byte 1: geometry 2: a line with fewer than 2 positions",
            ),
            (
                "MULTILINESTRING((0 0,1 1),\n(1 2))",
                Broken,
                "line 2, byte 1: geometry 1: a line with fewer than 2 positions",
            ),
            (
                "POLYGON((0 0,1 0,0 1,0 0),\n(1 2,3 4,6 7,5 0))",
                Broken,
                "line 2, byte 1: geometry 1: ring 2 begins at 1.0 2.0 and ends at 5.0 0.0; its \
                 last position must be its first",
            ),
            (
                "POLYGON((0 0,1 0,0 0))",
                Broken,
                "line 1, byte 9: geometry 1: ring 1 has fewer than 4 positions",
            ),
            (
                "POLYGON(EMPTY)",
                Broken,
                "line 1, byte 9: geometry 1: ring 1 has fewer than 4 positions",
            ),
        ],
    );
}

/// Cut off after any byte, a file is refused.
#[test]
fn files_cut_off_anywhere_are_refused() {
    let json = r#"{"type":"FeatureCollection","features":[{"type":"Feature",
        "properties":{"a":["\u0041",1e5]},"geometry":{"type":"MultiPolygon",
        "coordinates":[[[[0,0],[1.5,0],[0,1],[0,0]]]]}}]}"#;
    let wkt = "MULTIPOLYGON(((0 0,1.5 0,0 1,0 0),(1 1,1 2,2 1,1 1)))";
    for (format, text) in [(Format::Geojson, json), (Format::Wkt, wkt)] {
        from_bytes(text.as_bytes(), format).unwrap();
        for end in 0..text.len() {
            let error = from_bytes(&text.as_bytes()[..end], format).expect_err(&text[..end]);
            assert_eq!(error.kind(), Broken, "{}: {error}", &text[..end]);
        }
    }
}

/// A number of more digits than any double needs, and none that is cut off.
#[test]
fn long_numbers_are_read_or_refused() {
    let zeros = "0".repeat(2000);
    for (format, before, after) in [
        (Format::Geojson, "{\"type\":\"Point\",\"coordinates\":[1,", "]}"),
        (Format::Wkt, "POINT(1 ", ")"),
    ] {
        let read = |number: &str| {
            let table = from_bytes(format!("{before}{number}{after}").as_bytes(), format);
            table.map(|table| table.points.coordinates[1])
        };
        assert_eq!(read(&format!("0.{zeros}1e2001")), Ok(1.0));
        assert_eq!(read(&format!("9007199254740993.{zeros}1")), Ok(9007199254740994.0));
        let error = read(&format!("1.{zeros}{zeros}")).unwrap_err();
        let byte = before.len() + 1;
        let message = format!("line 1, byte {byte}: a word of more than 2048 bytes");
        assert_eq!(error.message(), message);
    }
}
