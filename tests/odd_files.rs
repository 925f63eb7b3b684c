//! Files that say more than it seems, or something else: fields between quotes, points that are
//! counted, what is left out of meshes and surfaces, and what is refused for what it says.

use crate::directory::Directory;
use netmesh::io::{Choice, Format, PointCloud, Table, read_table, read_table_file};
use netmesh::{Error, ErrorKind, LeftOut};
use std::fs;

fn table(text: &str, format: Format, columns: &str, attributes: &str) -> Result<Table, Error> {
    let mut choice = Choice::default();
    if !columns.is_empty() {
        choice.coordinates = columns.parse()?;
    }
    if !attributes.is_empty() {
        choice.attributes = attributes.parse()?;
    }
    read_table(&mut text.as_bytes(), format, &choice)
}

fn cloud(dim: usize, coordinates: &[f64]) -> PointCloud {
    PointCloud { dim, coordinates: coordinates.to_vec() }
}

#[test]
fn numbers_between_quotes_are_points() {
    let expected = cloud(2, &[0.0, 0.0, 1.5, -2e3]);
    for text in [
        "\"0\",\"0\"\n\"1.5\",\"-2e3\"\n",
        "\"x\",\"y\"\n\"0\",\"0\"\n\"1.5\",\"-2e3\"\n",
        "0,\"0\"\r\n \"1.5\" , \" -2e3 \" \r\n",
        "\u{feff}\"0\",0 # \"\n1.5,\"-2e3\"",
        // A header with a number between quotes, beside the names of coordinates.
        "\"x\",\"y\",\"2024\"\n0,0,7\n1.5,-2e3,7\n",
    ] {
        let read = table(text, Format::Csv, "", "").unwrap();
        assert_eq!(read.points, expected, "{text:?}");
    }
}

#[test]
fn commas_and_comment_signs_between_quotes_are_text() {
    let text = "name,x,y,note\n\"Nowhere, A\",0,0,\"#1, or \"\"so\"\"\"\nB,\"1.5\",-2e3,\"\" # c\n";
    let expected = cloud(2, &[0.0, 0.0, 1.5, -2e3]);
    for (columns, attributes) in [("", ""), ("x,y", ""), ("2-3", "")] {
        assert_eq!(table(text, Format::Csv, columns, attributes).unwrap().points, expected);
    }
    let unnamed = text.split_once('\n').unwrap().1;
    assert_eq!(table(unnamed, Format::Csv, "2,3", "").unwrap().points, expected);
    let text = "\"a, b\",\"x\",\"y\",\"h\"\n1,0,0,\"7.5\"\n1,1.5,-2e3,\"\"\n";
    let read = table(text, Format::Csv, "", "h").unwrap();
    assert_eq!(read.points, expected);
    assert_eq!(read.attributes[0].values[0], 7.5);
    assert!(read.attributes[0].values[1].is_nan());
    let read = table(text, Format::Csv, "X,Y", "first=\"a").unwrap_err();
    assert_eq!(read.kind(), ErrorKind::InvalidArgument, "{read}");
}

/// Scanners write the number of points first, and perhaps intensity and colour after each.
#[test]
fn points_below_their_number_are_read() {
    let directory = Directory::new("scans");
    let [first, second] = [[1.5, 2.0, 3.0], [-4.0, 5e3, 6.0]];
    let in_space = cloud(3, &[first, second].concat());
    for (rows, attributes, expected, names) in [
        (["1.5 2", "-4 5e3"], "", cloud(2, &[1.5, 2.0, -4.0, 5e3]), &[][..]),
        (["1.5 2 3", "-4 5e3 6"], "", in_space.clone(), &[]),
        (["1.5,2,3", "-4,5e3,6"], "", in_space.clone(), &[]),
        (["1.5 2 3 -1200", "-4 5e3 6 7"], "", in_space.clone(), &[]),
        (["1.5 2 3 -1200", "-4 5e3 6 7"], "intensity", in_space.clone(), &["intensity"]),
        (["1.5 2 3 9 8 7", "-4 5e3 6 7 8 9"], "all", in_space.clone(), &["r", "g", "b"]),
        (["1.5 2 3 1 9 8 7", "-4 5e3 6 1 7 8 9"], "G", in_space.clone(), &["g"]),
        (["1.5 2 3 1 9 8 7", "-4 5e3 6 1 7 8 9"], "", in_space, &[]),
    ] {
        let path = directory.join("scan.PTS");
        fs::write(&path, format!("# scan\n2\n{}\n", rows.join("\r\n"))).unwrap();
        let mut choice = Choice::default();
        if !attributes.is_empty() {
            choice.attributes = attributes.parse().unwrap();
        }
        let read = read_table_file(&path, Format::Auto, &choice).unwrap();
        assert_eq!(read.points, expected, "{rows:?}");
        let found: Vec<&str> = read.attributes.iter().map(|own| own.name.as_str()).collect();
        assert_eq!(found, names, "{rows:?}");
    }
    // Without a number of points every column counts, as in any file of points.
    let path = directory.join("plain.pts");
    fs::write(&path, "1 2 3 4\n5 6 7 8\n").unwrap();
    let read = read_table_file(&path, Format::Auto, &Choice::default()).unwrap();
    assert_eq!(read.points.dim, 4);
    // Columns that are chosen are those.
    fs::write(&path, "2\n1 2 3 4 5\n6 7 8 9 0\n").unwrap();
    let choice = Choice { coordinates: "5,1".parse().unwrap(), ..Choice::default() };
    let read = read_table_file(&path, Format::Auto, &choice).unwrap();
    assert_eq!(read.points, cloud(2, &[5.0, 1.0, 0.0, 6.0]));
}

#[test]
fn numbers_of_points_that_do_not_fit_are_refused() {
    for (text, kind, message) in [
        ("3\n1 2\n3 4\n", ErrorKind::Format, "the file ends after line 3: 2 of 3 points"),
        ("1\n1 2\n3 4\n", ErrorKind::Format, "line 3: more data after the 1 points of the first"),
        ("1\n1 2\n1\n3 4\n", ErrorKind::Format, "line 3: more data after the 1 points"),
        ("0\n", ErrorKind::Format, "the file holds no points"),
        ("2\n1 2\n3 4 5\n", ErrorKind::Format, "line 3: 3 coordinates where 2 are expected"),
        ("18446744073709551616\n1 2\n", ErrorKind::Dimension, "line 1: points of dimension 1"),
        ("18446744073709551615\n1 2\n", ErrorKind::Format, "the file ends after line 2: 1 of 1844"),
        ("-2\n1 2\n", ErrorKind::Dimension, "line 1: points of dimension 1"),
        ("2\nwater\nO 0 0 0\n", ErrorKind::Format, "line 2, column 1: \"water\" is not a number"),
        // Which of four columns are coordinates only .pts files tell.
        ("1\n1 2 3 4\n", ErrorKind::Dimension, "line 2: 4 columns below a number of points"),
        ("1;2\n", ErrorKind::Format, "line 1, column 1: \"1;2\" is not a number; semicolons"),
    ] {
        let error = table(text, Format::Xyz, "", "").unwrap_err();
        assert_eq!(error.kind(), kind, "{text:?}: {error}");
        assert!(error.message().starts_with(message), "{text:?}: {error}");
    }
    let directory = Directory::new("no_scan");
    let path = directory.join("a.pts");
    for (text, words) in [
        ("version: 1\nn_points: 2\n{\n1 2\n3 4\n}\n", "\"version: 1\" begins a file of landmarks"),
        ("point\n2\n1 2\n3 4\n", "\"point\" begins a file of points of elastix"),
        ("index\n2\n1 2\n3 4\n", "\"index\" begins a file of points of elastix"),
        ("1\n1 2 3 4 5\n", "line 2: 5 columns below a number of points; .pts files have x y z"),
        ("2\n1 2 3 4\n1 2 3\n", "line 3: 3 columns; the first line has 4"),
    ] {
        fs::write(&path, text).unwrap();
        let error = read_table_file(&path, Format::Auto, &Choice::default()).unwrap_err();
        assert!(error.message().contains(words), "{text:?}: {error}");
    }
}

const TETRAHEDRON: &str =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n";

fn left_out(text: &str, format: Format) -> LeftOut {
    let read = table(text, format, "", "").unwrap_or_else(|error| panic!("{text}: {error}"));
    assert_eq!(read.mesh(true).unwrap().left_out(), read.left_out);
    read.left_out
}

#[test]
fn what_is_left_out_of_meshes_and_surfaces_is_counted() {
    let [none, faces] = [0, 4].map(|faces| LeftOut { faces, ..LeftOut::default() });
    assert!(none.is_empty() && !faces.is_empty());
    // The faces of a surface are facets, unless the points are asked for alone.
    assert_eq!(left_out(TETRAHEDRON, Format::Off), none);
    let choice = Choice { has_points_alone: true, ..Choice::default() };
    let alone = read_table(&mut TETRAHEDRON.as_bytes(), Format::Off, &choice).unwrap();
    assert_eq!(alone.left_out, faces);
    assert_eq!(alone.mesh(true).unwrap().given_facets().count(), 0);
    assert_eq!(left_out("0 0\n1 0\n0 1\n", Format::Xyz), none);
    assert_eq!(left_out("OFF\n2 0 0\n0 0 0\n1 0 0\n", Format::Off), none);
    let all = LeftOut { edges: 1, faces: 2, cells: 1 };
    let points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    // An OFF lists polygons, an nOFF above the plane cells.
    let cells = format!("nOFF\n3\n4 5 0\n{points}2 0 1\n3 0 1 2\n3 0 1 3\n4 0 1 2 3\n1 0\n");
    assert_eq!(left_out(&cells, Format::Off), all);
    let quads = format!("OFF\n4 4 0\n{points}2 0 1\n3 0 1 2\n4 0 1 2 3\n1 0\n");
    assert_eq!(left_out(&quads, Format::Off), none);
    let flat = "nOFF\n2\n4 4 0\n0 0\n1 0\n0 1\n1 1\n2 0 1\n3 0 1 2\n4 0 1 3 2\n1 0\n";
    assert_eq!(left_out(flat, Format::Off), LeftOut { cells: 0, ..all });
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
               property float z\nelement face 2\nproperty list uchar int vertex_indices\n\
               element edge 1\nproperty int vertex1\nproperty int vertex2\nelement camera 1\n\
               property int id\nelement tetra 1\nproperty list uchar int vertices\nend_header\n";
    let ply = format!("{ply}{points}3 0 1 2\n4 0 1 3 2\n0 1\n7\n4 0 1 2 3\n");
    assert_eq!(left_out(&ply, Format::Ply), LeftOut { faces: 0, ..all });
    let ply = ply.replace("int vertex_indices", "int corners");
    assert_eq!(left_out(&ply, Format::Ply), all);
    let rows: String = points.lines().map(|line| format!("{line} 0\n")).collect();
    let medit = format!(
        "MeshVersionFormatted 2\nDimension 3\nEdges 1\n1 2 0\nVertices\n4\n{rows}Corners\n1\n1\n\
         Triangles\n1\n1 2 3 0\nQuadrilaterals 1\n1 2\n3 4 0\nTetrahedra\n1\n1 2 3 4 0\n"
    );
    assert_eq!(left_out(&(medit.clone() + "End\n"), Format::Medit), all);
    assert_eq!(left_out(&medit, Format::Medit), all);
}

#[test]
fn elements_of_gmsh_are_left_out_by_their_types() {
    let points = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
    let two = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{points}$Elements\n8\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n\
         3 8 0 1 2 3\n4 2 0 1 2 3\n5 3 0 1 2 3 4\n6 16 0 1 2 3 4 5 6 7 8\n7 4 0 1 2 3 4\n\
         8 92 0 1\n$EndElements\n"
    );
    assert_eq!(left_out(&two, Format::Gmsh), LeftOut { edges: 2, faces: 3, cells: 2 });
    let four = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
                $Nodes\n1 2 1 2\n2 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n\
                $Elements\n4 5 1 5\n0 1 15 1\n1 1\n1 -3 1 1\n2 1 2\n2 1 2 2\n3 1 2 2\n\
                4 1 2 2\n3 1 4 1\n5 1 2 2 2\n$EndElements\n";
    assert_eq!(left_out(four, Format::Gmsh), LeftOut { edges: 1, faces: 2, cells: 1 });
}

/// An `.ele` file's name leads to its `.node` file, which is read; the elements are not.
#[test]
fn elements_beside_nodes_are_left_out_by_name() {
    let directory = Directory::new("elements");
    fs::write(directory.join("a.node"), "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n").unwrap();
    let read = |name: &str| {
        read_table_file(&directory.join(name), Format::Auto, &Choice::default())
            .map(|table| table.left_out)
    };
    assert_eq!(read("a.ele"), Ok(LeftOut::default()), "there is no such file");
    for (text, cells, faces) in
        [("1 4 0\n0 0 1 2 3\n", 1, 0), ("2 3 1\n1 0 1 2 9\n2 0 1 3 9\n", 0, 2)]
    {
        fs::write(directory.join("a.ele"), text).unwrap();
        assert_eq!(read("a.ele"), Ok(LeftOut { edges: 0, faces, cells }));
        assert_eq!(read("a.node"), Ok(LeftOut::default()), "the nodes were named");
    }
    for (text, words) in [
        ("", "a.ele: the file ends after line 0: an .ele file begins with its counts"),
        ("x 4\n", "a.ele: line 1, column 1: \"x\" is no number of elements"),
        ("2 4 0\n0 0 1 2 3\n", "a.ele: the file ends after line 2: 1 of 2 elements"),
        ("1 4 0\n0 0 1 2\n", "a.ele: line 2: an element of 4 points has its id before them"),
        ("1 4 0\n0 0 1 2 3\n1 0 1 2 3\n", "a.ele: line 3: more data after the 1 elements"),
        (
            "18446744073709551615 4\n",
            "a.ele: the file ends after line 1: 0 of 18446744073709551615",
        ),
    ] {
        fs::write(directory.join("a.ele"), text).unwrap();
        let error = read("a.ele").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Format);
        assert!(error.message().contains(words), "{error}");
    }
}

#[test]
fn surfaces_are_refused_for_what_they_are() {
    let directory = Directory::new("surfaces");
    for (name, words) in [
        ("part.3mf", "a 3MF file is a surface in a format that is not read yet"),
        ("part.3MF", "a 3MF file is a surface"),
        ("part.gltf", "a glTF file is a surface"),
        ("part.glb", "a glTF file is a surface"),
    ] {
        let path = directory.join(name);
        fs::write(&path, "v 0 0 0\nv 1 0 0\n").unwrap();
        let error = read_table_file(&path, Format::Auto, &Choice::default()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.is_of_content(), "{error}");
        assert!(error.message().contains(words), "{error}");
        assert!(error.message().ends_with("convert it to .stl, .off or .ply"), "{error}");
    }
    // Whoever names a format knows better.
    let path = directory.join("part.glb");
    fs::write(&path, "0 0\n1 0\n0 1\n").unwrap();
    assert!(read_table_file(&path, Format::Xyz, &Choice::default()).is_ok());
    let error = read_table_file(&directory.join("a.what"), Format::Auto, &Choice::default());
    assert!(!error.unwrap_err().is_of_content());
}

/// Files of surfaces make the mesh that `set_triangles` and `set_facets` make.
#[test]
fn surfaces_and_complexes_are_facets_of_the_mesh() {
    let mesh = table(TETRAHEDRON, Format::Off, "", "").unwrap().mesh(true).unwrap();
    assert!(mesh.given_facets().are_triangles);
    assert_eq!(mesh.given_facets().inputs, [0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3]);
    assert_eq!(mesh.given_facets().markers, [0; 4]);
    let poly = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n3 1\n1 0 -3\n3 0 1 2\n2 0 4\n3 0 1 3\n\
                2 1 2\n1 0 5\n2 2 3\n0\n1\n1 0.1 0.1 0.1 6 -1\n";
    let mesh = table(poly, Format::Poly, "", "").unwrap().mesh(true).unwrap();
    let facets = mesh.given_facets();
    assert_eq!((facets.count(), facets.are_triangles), (2, false));
    assert_eq!(facets.markers, [-3, 4]);
    assert_eq!(facets.loops(1).collect::<Vec<_>>(), [&[0, 1, 3][..], &[1, 2]]);
    assert_eq!(
        (&mesh.segments().inputs[..], &mesh.segments().markers[..]),
        (&[[2, 3]][..], &[5][..])
    );
    assert_eq!((mesh.regions()[0].seed, mesh.regions()[0].label), ([0.1, 0.1, 0.1], 6));
    // Two numbers of one point, which only a mesh can tell, and of a triangle only the run.
    let off = "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n3 0 1 3\n";
    let mesh = table(off, Format::Off, "", "").unwrap().mesh(true).unwrap();
    assert_eq!(mesh.given_facets().inputs, [0, 1, 3]);
    let off = off.replace("3 0 1 3", "4 0 1 2 3");
    let error = table(&off, Format::Off, "", "").unwrap().mesh(true).unwrap_err();
    assert!(error.is_of_content() && error.kind() == ErrorKind::InvalidArgument, "{error}");
    assert!(error.message().starts_with("facets[0] has the inputs 3 and 0"), "{error}");
}

/// Every complex and surface of the data directory is read, with nothing left out.
#[test]
fn complexes_that_others_wrote_are_read() {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
    let data = std::env::var_os("NETMESH_DATA").unwrap_or_else(|| beside.into());
    let directory = std::path::Path::new(&data).join("surfaces/made");
    let Ok(entries) = fs::read_dir(&directory) else {
        println!("skipped: surfaces/made is not in the data directory (set NETMESH_DATA to it)");
        return;
    };
    for path in entries.map(|entry| entry.unwrap().path()) {
        if !["poly", "off"].iter().any(|known| path.extension().is_some_and(|own| own == *known)) {
            continue;
        }
        let table = read_table_file(&path, Format::Auto, &Choice::default());
        let table = table.unwrap_or_else(|error| panic!("{error}"));
        assert!(table.left_out.is_empty(), "{}", path.display());
        let facets = table.mesh(true).unwrap().given_facets().clone();
        assert_eq!(facets.are_triangles, path.extension().unwrap() == "off", "{}", path.display());
        // Bottom and top, a wall round the first at least.
        assert!(facets.count() >= 5, "{}", path.display());
    }
    let table = |name: &str| {
        let path = directory.join(name);
        read_table_file(&path, Format::Auto, &Choice::default()).unwrap_or_else(|e| panic!("{e}"))
    };
    // A facet with a hole, a facet that is a segment, and an input on nothing.
    let dangling = table("dangling.poly").outline;
    assert_eq!(dangling.facets.loops(6).collect::<Vec<_>>(), [[8, 9, 10, 11], [12, 13, 14, 15]]);
    assert_eq!((dangling.segments, dangling.markers), (vec![[16, 17]], vec![900]));
    // Segments in facets.
    let crack = table("crack.poly").outline.facets;
    assert_eq!(crack.loops(0).collect::<Vec<_>>(), [&[0, 3, 2, 1, 8][..], &[8, 11]]);
    let labels: Vec<i32> =
        table("two_cubes.poly").outline.regions.iter().map(|region| region.label).collect();
    assert_eq!(labels, [1, 2]);
}

/// Content that cannot be meshed is told from a file that is none of its format.
#[test]
fn what_files_say_is_told_from_how_they_say_it() {
    let points = "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n";
    let poly = |rest: &str| format!("{points}{rest}");
    for (format, text, is_of_content) in [
        (Format::Poly, poly("1 0\n1 1 9\n0\n"), true),
        (Format::Poly, poly("1 0\n1 2 2\n0\n"), true),
        (Format::Poly, poly("1 1\n1 1 2 0.5\n0\n"), true),
        (Format::Poly, poly("0\n0\n1\n1 0.5 0.5 1.5 -1\n"), true),
        (Format::Poly, poly("1 0\n1 1 x\n0\n"), false),
        (Format::Poly, poly("1 0\n1 1\n0\n"), false),
        (Format::Poly, poly("2 0\n1 1 2\n"), false),
        (Format::Smesh, "2 3\n1 0 0 0\n2 1 0 0\n1\n3 1 2 3\n".into(), true),
        (Format::Smesh, "2 3\n1 0 0 0\n2 1 0 0\n1\n3 1 2\n".into(), false),
        (Format::Wkt, "POLYGON((0 0,1 0,1 1,0 1))".into(), true),
        (Format::Wkt, "POLYGON((0 0,1 0,0 0))".into(), true),
        (Format::Wkt, "LINESTRING(0 0)".into(), true),
        (Format::Wkt, "POLYGON((0 0,1 0,1 1,0 0)".into(), false),
        (Format::Geojson, r#"{"type":"LineString","coordinates":[[0,0]]}"#.into(), true),
        (Format::Geojson, r#"{"type":"LineString","coordinates":[[0,0],[1]]}"#.into(), false),
        (Format::Off, "OFF\n2 1 0\n0 0 0\n1 0 0\n2 0 2\n".into(), true),
        (Format::Off, "OFF\n2 1 0\n0 0 0\n1 0 0\n2 0\n".into(), false),
    ] {
        let error = table(&text, format, "", "").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Format, "{text}: {error}");
        assert_eq!(error.is_of_content(), is_of_content, "{text}: {error}");
    }
    // Ends that are different numbers of one point, which only a mesh can tell.
    let same = "3 2\n1 0 0\n2 0 0\n3 1 1\n1 0\n1 1 2\n0\n";
    let error = table(same, Format::Poly, "", "").unwrap().mesh(true).unwrap_err();
    assert!(error.is_of_content() && error.kind() == ErrorKind::InvalidArgument, "{error}");
    let seed = "3 2\n1 0 0\n2 1 0\n3 1 1\n0\n0\n1\n1 0.5 0.25 3 -1\n";
    assert!(table(seed, Format::Poly, "", "").unwrap().mesh(true).is_ok());
}
