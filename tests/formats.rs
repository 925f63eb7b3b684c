//! The file formats as a caller meets them: damaged files of points, extensions, and files that
//! cannot be written. `damaged_meshes.rs` has the formats of other programs' meshes.

use crate::directory::Directory;
use netmesh::ErrorKind::{Dimension, Format as Broken, NonFinite};
use netmesh::io::{Format, PointCloud, read, read_points, write, write_file};
use netmesh::{Error, ErrorKind, Mesh};
use proptest::prelude::*;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

fn two_points() -> Mesh {
    Mesh::new(2, 2, &[0.1, -0.0, 5e-324, 1e300], 0).unwrap()
}

fn from_bytes(bytes: &[u8], format: Format) -> Result<PointCloud, Error> {
    let mut input = bytes;
    read(&mut input, format)
}

/// Damaged files: the kind of the error, and the beginning of its message.
type Damaged = (&'static [u8], ErrorKind, &'static str);

fn assert_refused(format: Format, table: &[Damaged]) {
    for (bytes, kind, message) in table {
        let text = bytes.escape_ascii();
        let error = from_bytes(bytes, format).expect_err(&text.to_string());
        assert_eq!(error.kind(), *kind, "{format:?} {text}: {error}");
        assert!(error.message().starts_with(message), "{format:?} {text}: {error}");
    }
}

#[test]
fn every_text_format_refuses_what_is_no_text_or_number() {
    let cases: [(&[u8], ErrorKind, &str); 13] = [
        (b"abc", Broken, "\"abc\" is not a number"),
        (b"1.2.3", Broken, "\"1.2.3\" is not a number"),
        (b"1d5", Broken, "\"1d5\" is not a number"),
        (b"0x10", Broken, "\"0x10\" is not a number"),
        ("1\u{a0}".as_bytes(), Broken, "\"1\\u{a0}\" is not a number"),
        (b"1e999", Broken, "\"1e999\" is too large for a double"),
        (b"-1e309", Broken, "\"-1e309\" is too large for a double"),
        (b"1e99999999999999999999", Broken, "\"1e99999999999999999999\" is too large for a double"),
        (b"1e", Broken, "\"1e\" is not a number"),
        (b"1e1.5", Broken, "\"1e1.5\" is not a number"),
        (b"nan", NonFinite, "\"nan\"; every coordinate must be finite"),
        (b"-NaN", NonFinite, "\"-NaN\"; every coordinate must be finite"),
        (b"-Infinity", NonFinite, "\"-Infinity\"; every coordinate must be finite"),
    ];
    let gmsh = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 ";
    let medit = b"MeshVersionFormatted 2\nDimension 2\nVertices 1\n";
    let ply = b"ply\nformat ascii 1.0\nelement vertex 1\n\
                property float x\nproperty float y\nend_header\n";
    for (format, before, separator, column, after) in [
        (Format::Xyz, &b"1 2\n"[..], b' ', 2, &b"\n"[..]),
        (Format::Csv, b"1,2\n", b',', 2, b"\n"),
        (Format::TetgenNode, b"1 2\n1 ", b' ', 3, b"\n"),
        (Format::Off, b"nOFF 2 1 0\n", b' ', 2, b"\n"),
        (Format::Gmsh, gmsh, b' ', 4, b"\n$EndNodes\n"),
        (Format::Medit, medit, b' ', 2, b" 0\n"),
        (Format::Ply, ply, b' ', 2, b"\n"),
    ] {
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        let start = 1 + before.iter().rposition(|byte| *byte == b'\n').unwrap();
        for (field, kind, message) in cases {
            let bytes = [before, b"5", &[separator], field, after].concat();
            let message = format!("line {line}, column {column}: {message}");
            assert_refused_as(format, &bytes, kind, &message);
        }
        for (field, message) in [
            (&b"\xff"[..], "the line is not valid UTF-8"),
            (b"\0", "a NUL byte; this is not a text file"),
            (b"\r6", "a carriage return inside the line"),
        ] {
            let bytes = [before, b"5", &[separator], b"5", field, after].concat();
            let byte = before.len() + 4 - start;
            let message = format!("line {line}, byte {byte}: {message}");
            assert_refused_as(format, &bytes, Broken, &message);
        }
        let bytes = [before, b"5".repeat(1 << 20).as_slice(), b"\n"].concat();
        let message = format!("line {line}: the line is longer than 1 MiB");
        assert_refused_as(format, &bytes, Broken, &message);
    }
}

fn assert_refused_as(format: Format, bytes: &[u8], kind: ErrorKind, message: &str) {
    let error = from_bytes(bytes, format).expect_err(message);
    assert_eq!(error.kind(), kind, "{format:?} {message}: {error}");
    assert!(error.message().starts_with(message), "{format:?} {message}: {error}");
}

#[test]
fn xyz_refuses_damaged_files() {
    assert_refused(
        Format::Xyz,
        &[
            (b"", Broken, "the file holds no points"),
            (b"# nothing\n\n \r\n", Broken, "the file holds no points"),
            (b"1 2\n3 4 5\n", Broken, "line 2: 3 coordinates where 2 are expected"),
            (b"1 2 3\n\n# c\n3 4\n", Broken, "line 4: 2 coordinates where 3 are expected"),
            (b"1 2\n3\n", Broken, "line 2: 1 coordinates where 2 are expected"),
            (b"1,,2\n", Broken, "line 1, column 2: the field is empty"),
            (b"1,2,\n", Broken, "line 1, column 3: the field is empty"),
            (b"1 2,\n", Broken, "line 1, column 2: commas and blanks both separate"),
            (b"0,5 1,5\n", Broken, "line 1, column 3: commas and blanks both separate"),
            (b"1 2\n0,5\t1\n", Broken, "line 2, column 3: commas and blanks both separate"),
            (b"0,5;1,5\n", Broken, "line 1, column 2: \"5;1\" is not a number"),
            (b"1;2\n", Broken, "line 1, column 1: \"1;2\" is not a number"),
            (b"x y\n1 2\n", Broken, "line 1, column 1: \"x\" is not a number"),
            (b"0.5\n2\n", Dimension, "line 1: points of dimension 1; it must be 2 to 8"),
            (b"1\n2\n", Dimension, "line 2: points of dimension 1; it must be 2 to 8"),
            (b"\n1 2 3 4 5 6 7 8 9\n", Dimension, "line 2: points of dimension 9"),
        ],
    );
}

#[test]
fn csv_refuses_damaged_files() {
    assert_refused(
        Format::Csv,
        &[
            (b"", Broken, "the file holds no points"),
            (b"x,y\n", Broken, "the file holds no points"),
            (b"x,y\n1,2\n3\n", Broken, "line 3: 1 columns; the first line has 2"),
            (b"x,y,z\n1,2\n", Broken, "line 2: 2 columns; the first line has 3"),
            (b"x,y,kind\n1,2\n", Broken, "line 2: 2 columns; the first line has 3"),
            (b"1,2\n3,4,\n", Broken, "line 2: 3 columns; the first line has 2"),
            (b"x,y\n1,\n", Broken, "line 2, column 2: the field is empty"),
            (b"x,y\nx,y\n1,2\n", Broken, "line 2, column 1: \"x\" is not a number"),
            (b"1 2\n3 4\n", Broken, "line 1: blanks separate the fields of \"1 2\"; in CSV files"),
            (b"1,2 3\n", Broken, "line 1, column 2: \"2 3\" is not a number"),
            (b"0,5;1,5\n", Broken, "line 1, column 2: \"5;1\" is not a number"),
            (
                b"x;y\n0,5;1,5\n",
                Broken,
                "line 1: semicolons separate the fields of \"x;y\"; in CSV",
            ),
            (
                b"x;y\n0.5;1.5\n",
                Broken,
                "line 1: semicolons separate the fields of \"x;y\"; in CSV",
            ),
            (b"0;1\n2;3\n", Broken, "line 1: semicolons separate the fields of \"0;1\"; in CSV"),
            (b"\"a\";\"b\"\n", Broken, "line 1, column 1: \";\\\"b\\\"\" between a quote's end"),
            (b"sep=;\nx;y\n", Broken, "line 1: semicolons separate the fields of \"sep=;\""),
            (b"x\ty\n0\t1\n", Broken, "line 1: tabs separate the fields of \"x\\ty\"; in CSV"),
            (b"x|y\n0|1\n", Broken, "line 1: bars separate the fields of \"x|y\"; in CSV files"),
            (b"x y\n0 1\n", Broken, "line 1: blanks separate the fields of \"x y\"; in CSV files"),
            (b"x,y\n0;1,5\n", Broken, "line 2, column 1: \"0;1\" is not a number; semicolons"),
            // Quotes.
            (b"x,y\n\"1,2\n", Broken, "line 2, column 1: \"\\\"1,2\" has no quote at its end;"),
            (
                b"x,y,n\n1,2,\"a\n\"\n",
                Broken,
                "line 2, column 3: \"\\\"a\" has no quote at its end;",
            ),
            (b"x,y\n\"1\"2,3\n", Broken, "line 2, column 1: \"2,3\" between a quote's end and the"),
            (b"x,y\n1,\"2\" 3\n", Broken, "line 2, column 2: \"3\" between a quote's end and the"),
            (b"x,y\n1,\"\"\n", Broken, "line 2, column 2: the field is empty"),
            (b"x,y\n1,\"2\"\"\"\n", Broken, "line 2, column 2: \"2\\\"\\\"\" is not a number"),
            (b"\"1.0\",\"2.o\"\n3,4\n", Broken, "line 1, column 2: \"2.o\" is not a number"),
            (b"\"a\",1\n3,4\n", Broken, "line 1, column 1: \"a\" is not a number"),
            (b"\"x\",\"y\",1\n3,4,5\n", Broken, "line 1, column 1: \"x\" is not a number"),
            // A damaged first point is no header.
            (b"1.0,2.o\n3,4\n", Broken, "line 1, column 2: \"2.o\" is not a number"),
            (b",0,1\n0,5,6\n", Broken, "line 1, column 1: the field is empty"),
            (b"x\n1\n", Dimension, "line 2: points of dimension 1"),
            (b"x,kind\n1,0\n", Dimension, "line 2: points of dimension 1"),
            (b"1,2,3,4,5,6,7,8,9\n", Dimension, "line 1: points of dimension 9"),
        ],
    );
}

#[test]
fn tetgen_refuses_damaged_files() {
    assert_refused(
        Format::TetgenNode,
        &[
            (b"", Broken, "the file ends after line 0: a .node file begins with its counts"),
            (b"0 2 0 0\n", Broken, "the file holds no points"),
            (b"2\n", Broken, "line 1: 1 columns; a .node file begins with"),
            (b"1 2 0 0 0\n0 1 2\n", Broken, "line 1: 5 columns; a .node file begins with"),
            (b"-1 2\n", Broken, "line 1, column 1: \"-1\" is no number of points"),
            (b"1e3 2\n", Broken, "line 1, column 1: \"1e3\" is no number of points"),
            (b"1 2 0 2\n0 1 2 0 0\n", Broken, "line 1: 2 markers per point"),
            (b"2 2 0 0\n0 1 2\n", Broken, "the file ends after line 2: 1 of 2 points"),
            (b"18446744073709551615 2\n0 1 2\n", Broken, "the file ends after line 2: 1 of"),
            (
                b"18446744073709551616 2\n0 1 2\n",
                Broken,
                "line 1, column 1: \"18446744073709551616\"",
            ),
            (b"1 2 18446744073709551615 1\n0 1 2\n", Broken, "line 2: 3 columns where"),
            (b"1 2\n0 1 2\n1 3 4\n", Broken, "line 3: more data after the 1 points"),
            (b"2 2\n0 1 2\n2 3 4\n", Broken, "line 3: point id 2; ids count up, 1 comes next"),
            (b"2 2\n1 1 2\n1 3 4\n", Broken, "line 3: point id 1; ids count up, 2 comes next"),
            (b"1 2\n2 1 2\n", Broken, "line 2: point id 2; ids count up, the first is 0 or 1"),
            (b"1 2\n18446744073709551615 1 2\n", Broken, "line 2: point id 18446744073709551615"),
            (b"1 2\n-1 1 2\n", Broken, "line 2, column 1: \"-1\" is no point id"),
            (b"1 2 1 1\n0 1 2 0\n", Broken, "line 2: 4 columns where the header promises 5"),
            (b"1 2\n0 1 2 0\n", Broken, "line 2: 4 columns where the header promises 3"),
            (b"1 2 1 1\n0 1 2 x 0\n", Broken, "line 2, column 4: \"x\" is not a number"),
            (b"1 1\n0 1\n", Dimension, "line 1: points of dimension 1"),
            (b"# c\n1 9\n0 1\n", Dimension, "line 2: points of dimension 9"),
            (
                b"1 18446744073709551615\n",
                Dimension,
                "line 1: points of dimension 18446744073709551615",
            ),
        ],
    );
}

#[test]
fn off_refuses_damaged_files() {
    assert_refused(
        Format::Off,
        &[
            (b"", Broken, "the file ends after line 0: the header of an OFF file"),
            (b"OFF\n", Broken, "the file ends after line 1: the header of an OFF file"),
            (b"1 0 0\n0 0 0\n", Broken, "line 1: the file begins with neither OFF nor nOFF"),
            (b"COFF\n1 0 0\n", Broken, "line 1: the file begins with neither OFF nor nOFF"),
            (b"OFF BINARY\n", Broken, "line 1, column 2: \"BINARY\" is no number of vertices"),
            (b"OFF\n1 0 0 0\n", Broken, "line 2: the header goes on after"),
            (b"OFF\n-1 0 0\n", Broken, "line 2, column 1: \"-1\" is no number of vertices"),
            (b"OFF\n0 0 0\n", Broken, "the file holds no points"),
            (b"OFF\n2 0 0\n1 2 3\n", Broken, "the file ends after line 3: 1 of 2 vertices"),
            (b"OFF\n18446744073709551615 0 0\n1 2 3\n", Broken, "the file ends after line 3: 1 of"),
            (b"OFF\n1 2 0\n1 2 3\n1 0\n", Broken, "the file ends after line 4: 1 of 2 faces"),
            (
                b"OFF\n1 0 0\n1 2 3\n1 0\n",
                Broken,
                "line 4: more data after the 1 vertices and 0 faces",
            ),
            (b"OFF\n1 0 0\n1 2\n", Broken, "line 3: 2 coordinates where 3 are expected"),
            (b"nOFF 4\n1 0 0\n1 2 3\n", Broken, "line 3: 3 coordinates where 4 are expected"),
            (b"OFF\n1 1 0\n1 2 3\n2 0 1\n", Broken, "line 4, column 3: vertex id 1 of 1 vertices"),
            (
                b"OFF\n1 1 0\n1 2 3\n3 0 0\n",
                Broken,
                "line 4: the face ends before its last 1 vertices",
            ),
            (
                b"OFF\n1 1 0\n1 2 3\n18446744073709551615 0\n",
                Broken,
                "line 4: the face ends before",
            ),
            (b"OFF\n1 1 0\n1 2 3\n1 -1\n", Broken, "line 4, column 2: \"-1\" is no vertex id"),
            (b"OFF\n1 1 0\n1 2 3\n1 0 red\n", Broken, "line 4, column 3: \"red\" is not a number"),
            (b"nOFF\n9\n1 0 0\n", Dimension, "line 2: points of dimension 9"),
            (b"nOFF 1 1 0\n1\n", Dimension, "line 1: points of dimension 1"),
        ],
    );
}

/// A file that was cut off after a line is told from a complete one where its header counts.
#[test]
fn truncated_files_are_refused() {
    let node = "# c\n3 2 1 1\n\n0 1 2 9 0\n1 3 4 9 0\n2 5 6 9 0\n";
    let off = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n";
    let nd_off = "nOFF\n2\n3 1 0\n0 0\n1 0\n0 1\n3 0 1 2\n";
    for (format, text) in [(Format::TetgenNode, node), (Format::Off, off), (Format::Off, nd_off)] {
        assert!(from_bytes(text.as_bytes(), format).is_ok(), "{text}");
        for (end, _) in text.trim_end().match_indices('\n') {
            let error = from_bytes(&text.as_bytes()[..=end], format).unwrap_err();
            assert_eq!(error.kind(), Broken);
            let line = text[..=end].matches('\n').count();
            let expected = format!("the file ends after line {line}: ");
            assert!(error.message().starts_with(&expected), "{error}");
        }
    }
}

const READABLE: [Format; 8] = [
    Format::Xyz,
    Format::Csv,
    Format::TetgenNode,
    Format::Off,
    Format::Gmsh,
    Format::Medit,
    Format::Ply,
    Format::Npy,
];

proptest! {
    /// Whatever the bytes: an answer, and one that keeps its promises.
    #[test]
    fn readers_answer_to_any_bytes(
        pieces in prop::collection::vec(
            prop::sample::select(vec![
                "OFF", "nOFF", "x", "kind", "ply\n", "format ascii 1.0\n", "element vertex 1\n",
                "property double x\n", "property float y\n", "end_header\n",
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "$Nodes\n", "$EndNodes\n",
                "MeshVersionFormatted 2\n", "Dimension 2\n", "Vertices\n", "End\n", "0", "1", "2",
                "3", "-1", "0.5", "1e308", "1e309", "nan",
                "18446744073709551615", ",", " ", "\n", "\n", "\r\n", "\r", "#", "\0", "\u{feff}",
            ]),
            0..40,
        ),
        stray in prop::option::of(any::<u8>()),
    ) {
        let mut bytes = pieces.concat().into_bytes();
        bytes.extend(stray);
        for format in READABLE {
            if let Ok(points) = from_bytes(&bytes, format) {
                prop_assert!((2..=8).contains(&points.dim));
                prop_assert!(!points.coordinates.is_empty());
                prop_assert_eq!(points.coordinates.len() % points.dim, 0);
                prop_assert!(points.coordinates.iter().all(|x| x.is_finite()));
            }
        }
    }
}

#[test]
fn formats_that_cannot_be_written_say_so() {
    for name in ["a.poly", "a.smesh", "a.geojson", "a.wkt", "a.obj", "a", "a.json"] {
        let path = Path::new(name);
        let errors = [
            write_file(&two_points(), path, Format::Auto).unwrap_err(),
            netmesh::io::output_paths(path, Format::Auto).unwrap_err(),
            Format::Auto.resolve_output(path).unwrap_err(),
        ];
        for error in errors {
            assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
            assert!(error.message().starts_with(&format!("{name}: ")), "{error}");
            let offered = [".poly,", ".smesh,", ".geojson,", ".wkt,", ".obj,", ".wkt or"];
            assert!(offered.iter().all(|offered| !error.message().contains(offered)), "{error}");
        }
        assert!(!path.exists());
    }
    assert_eq!(Format::Off.resolve_output(Path::new("a.poly")), Ok(Format::Off));
    let read_only = [Format::Smesh, Format::Obj, Format::Geojson, Format::Wkt];
    for format in read_only.into_iter().chain([Format::Poly]) {
        let error = write(&two_points(), format, &mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        let expected =
            format!("{} cannot be written, only read; write TetGen or Gmsh", format.name());
        assert_eq!(error.message(), expected);
    }
}

#[test]
fn messages_name_the_file() {
    let directory = Directory::new("names");
    let path = directory.join("a.csv");
    fs::write(&path, "1,2\n3,x\n").unwrap();
    let error = read_points(&path, Format::Auto).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Format);
    let expected = format!("{}: line 2, column 2: \"x\" is not a number", path.display());
    assert_eq!(error.message(), expected);
}

#[test]
fn missing_files_and_directories_are_io_errors() {
    let directory = Directory::new("missing");
    for path in [directory.join("a.xyz"), directory.join("d/a.xyz"), directory.0.clone()] {
        let error = read_points(&path, Format::Xyz).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io, "{error}");
        assert!(error.message().starts_with(&path.display().to_string()), "{error}");
    }
}

#[test]
fn a_mesh_is_found_by_the_name_of_its_ele_file() {
    let directory = Directory::new("ele");
    fs::write(directory.join("a.node"), "1 2\n0 3 4\n").unwrap();
    let read = read_points(&directory.join("a.ele"), Format::Auto).unwrap();
    assert_eq!(read, PointCloud { dim: 2, coordinates: vec![3.0, 4.0] });
}

#[test]
fn extensions_stand_for_formats() {
    for (extensions, format) in [
        (&["vtu", "VTU"][..], Format::Vtu),
        (&["node", "ele"], Format::TetgenNode),
        (&["msh"], Format::Gmsh),
        (&["mesh"], Format::Medit),
        (&["off"], Format::Off),
        (&["ply"], Format::Ply),
        (&["xyz", "txt", "xy", "pts", "Txt"], Format::Xyz),
        (&["csv"], Format::Csv),
        (&["npy"], Format::Npy),
        (&["voronoi.json", "Voronoi.JSON"], Format::VoronoiJson),
        (&["domains.json"], Format::DomainsJson),
        (&["poly", "POLY"], Format::Poly),
        (&["smesh"], Format::Smesh),
        (&["stl", "STL"], Format::Stl),
        (&["obj"], Format::Obj),
        (&["geojson", "GeoJSON"], Format::Geojson),
        (&["wkt"], Format::Wkt),
        (&["svg", "SVG"], Format::Svg),
        (&["html", "HTML"], Format::Html),
    ] {
        for extension in extensions {
            let path = PathBuf::from(format!("a.b.{extension}"));
            assert_eq!(Format::from_path(&path).unwrap(), format, "{extension}");
        }
    }
    for path in ["a", "a.gltf", ".csv", "csv", "a.csv.gz", "a.json", "voronoi.json", "a.xyz.json"] {
        let error = Format::from_path(Path::new(path)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{path}");
        let known = ".vtu, .node, .ele, .msh, .mesh, .off, .ply, .xyz, .txt, .xy, .pts, .csv, \
                     .npy, .poly, .smesh, .stl, .obj, .geojson, .wkt, .voronoi.json, \
                     .domains.json, .svg or .html";
        assert!(error.message().ends_with(known), "{error}");
    }
}

#[test]
fn formats_that_cannot_be_read_say_so() {
    let written =
        [Format::Vtu, Format::VoronoiJson, Format::DomainsJson, Format::Svg, Format::Html];
    for format in written {
        let error = from_bytes(b"{}", format).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        let expected =
            format!("{} cannot be read, only written; points are read from", format.name());
        assert!(error.message().starts_with(&expected), "{error}");
    }
    // Without a path there is no extension.
    for error in [
        from_bytes(b"1 2\n", Format::Auto).unwrap_err(),
        write(&two_points(), Format::Auto, &mut Vec::new()).unwrap_err(),
    ] {
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    }
}

#[test]
fn before_a_run_mesh_formats_are_refused_and_nothing_is_created() {
    let directory = Directory::new("state");
    let mesh_formats = [
        "a.vtu",
        "a.node",
        "a.ele",
        "a.msh",
        "a.mesh",
        "a.off",
        "a.ply",
        "a.voronoi.json",
        "a.domains.json",
    ];
    for name in mesh_formats {
        let error = write_file(&two_points(), &directory.join(name), Format::Auto).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::State, "{error}");
        assert!(error.message().ends_with("run first, or write XYZ, CSV or NumPy"), "{error}");
    }
    let solid = Mesh::new(3, 4, &[0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.], 0).unwrap();
    let error = write_file(&solid, &directory.join("a.stl"), Format::Auto).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::State, "{error}");
    // The dimension is wrong before and after a run.
    let mesh = Mesh::new(4, 2, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], 0).unwrap();
    for name in ["a.vtu", "a.msh", "a.mesh", "a.ply", "a.stl"] {
        let error = write_file(&mesh, &directory.join(name), Format::Auto).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
        assert!(error.message().contains("not 4; use OFF (nOFF) or TetGen"), "{error}");
    }
    assert!(directory.names().is_empty());
}

#[test]
fn points_survive_a_file_bit_by_bit() {
    let directory = Directory::new("points");
    for name in ["a.xyz", "a.csv", "a.npy"] {
        let mesh = two_points();
        let path = directory.join(name);
        write_file(&mesh, &path, Format::Auto).unwrap();
        let read = read_points(&path, Format::Auto).unwrap();
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(read.dim, 2);
        assert_eq!(bits(&read.coordinates), bits(&mesh.inputs().distinct_points()));
    }
    assert_eq!(directory.names(), ["a.csv", "a.npy", "a.xyz"]);
}

#[test]
fn a_failing_writer_is_an_io_error_and_is_not_called_again() {
    struct Failing {
        calls: usize,
    }
    impl Write for Failing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            self.calls += 1;
            Err(io::Error::other("the pipe is closed"))
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    // Enough points to fill the buffer, and few enough to fail at its end only.
    let many: Vec<f64> = (0..40_000).map(f64::from).collect();
    for mesh in [two_points(), Mesh::new(2, 20_000, &many, 0).unwrap()] {
        for format in [Format::Xyz, Format::Csv, Format::Npy] {
            let mut out = Failing { calls: 0 };
            let error = write(&mesh, format, &mut out).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Io);
            assert_eq!(error.message(), "cannot write: the pipe is closed");
            assert_eq!(out.calls, 1);
        }
    }
}

#[test]
fn files_that_cannot_be_written_are_io_errors() {
    let directory = Directory::new("unwritable");
    let read_only = directory.join("r.xyz");
    fs::write(&read_only, "1 2\n").unwrap();
    let mut permissions = fs::metadata(&read_only).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&read_only, permissions).unwrap();
    for path in [directory.join("missing/a.xyz"), directory.0.clone(), read_only.clone()] {
        let error = write_file(&two_points(), &path, Format::Xyz).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io, "{error}");
        assert!(error.message().starts_with(&path.display().to_string()), "{error}");
    }
    assert_eq!(fs::read_to_string(&read_only).unwrap(), "1 2\n");
    assert_eq!(directory.names(), ["r.xyz"]);
}

#[cfg(target_os = "linux")]
#[test]
fn devices_are_written_to_and_not_replaced() {
    use std::os::unix::fs::FileTypeExt;
    write_file(&two_points(), Path::new("/dev/null"), Format::Xyz).unwrap();
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    let error = write_file(&two_points(), Path::new("/dev/full"), Format::Xyz).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Io, "{error}");
}
