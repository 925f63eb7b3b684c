//! Files of polygons: holes are outside unless the caller says otherwise, and lines between
//! polygons enclose nothing.

use netmesh::io::{Choice, Format, read_table};
use netmesh::validate::validate_mesh;
use netmesh::{Crossings, ErrorKind, Extent, Interior, Mesh, Options, Output, Region, Result};

/// A square of area 200 with a lake of area 4.
const WKT: &str = "POLYGON((0 0,20 0,20 10,0 10,0 0),(5 5,7 5,7 7,5 7,5 5))";
const GEOJSON: &str = r#"{"type":"Polygon","coordinates":
    [[[0,0],[20,0],[20,10],[0,10],[0,0]],[[5,5],[7,5],[7,7],[5,7],[5,5]]]}"#;

fn mesh_of(text: &str, format: Format) -> Mesh {
    let table = read_table(&mut text.as_bytes(), format, &Choice::default()).unwrap();
    table.mesh(true).unwrap()
}

fn options(interior: Interior) -> Options {
    let (extent, output) = (Extent::Boundary, Output::WellSpaced);
    Options { interior, extent, output, ..Options::default() }
}

/// The area that a run covers, with a clean certificate, and the rule that it went by.
fn run(mesh: &mut Mesh, interior: Interior) -> Result<(f64, Interior)> {
    run_by(mesh, &options(interior)).map(|(area, parameters)| (area, parameters.interior))
}

fn run_by(mesh: &mut Mesh, options: &Options) -> Result<(f64, Options)> {
    mesh.run(options, None)?;
    let report = validate_mesh(mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    let result = mesh.result().unwrap();
    let area = |simplex: usize| {
        let [a, b, c] = [0, 1, 2].map(|at| result.point(result.simplex(simplex)[at]));
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
    };
    let area: f64 = (0..result.simplex_count()).map(area).sum();
    Ok(((area * 1e6).round() / 1e6, result.parameters.options()))
}

#[test]
fn lakes_are_outside() {
    for (text, format) in [(WKT, Format::Wkt), (GEOJSON, Format::Geojson)] {
        let mut mesh = mesh_of(text, format);
        assert_eq!(run(&mut mesh, Interior::Auto), Ok((196.0, Interior::Parity)));
        assert_eq!(run(&mut mesh, Interior::Seeds), Ok((200.0, Interior::Seeds)));
        // Both rings go counterclockwise.
        assert_eq!(run(&mut mesh, Interior::Winding), Ok((200.0, Interior::Winding)));
        assert_eq!(run(&mut mesh, Interior::Parity), Ok((196.0, Interior::Parity)));
    }
}

/// A river from shore to shore through the lake, and a road that ends in the land.
#[test]
fn lines_beside_polygons_enclose_nothing() {
    let lines = ["LINESTRING(0 3,6 6,20 8)", "LINESTRING(10 0,10 4)", "POINT(3 1)"].join(" ");
    for text in [format!("{WKT} {lines}"), format!("{lines} {WKT}")] {
        let mut mesh = mesh_of(&text, Format::Wkt);
        let crossings = netmesh::Crossings::Split;
        let split = |interior| Options { crossings, ..options(interior) };
        for (interior, simplices_in_lake) in
            [(Interior::Auto, false), (Interior::Winding, true), (Interior::Seeds, true)]
        {
            mesh.run(&split(interior), None).unwrap();
            let report = validate_mesh(&mesh, 3).unwrap();
            assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
            let result = mesh.result().unwrap();
            let in_lake = |simplex: usize| {
                let at = |axis: usize| -> f64 {
                    let vertices = result.simplex(simplex).iter();
                    vertices.map(|&vertex| result.point(vertex)[axis] / 3.0).sum()
                };
                (5.0..7.0).contains(&at(0)) && (5.0..7.0).contains(&at(1))
            };
            assert_eq!((0..result.simplex_count()).any(in_lake), simplices_in_lake);
            // The road is there, and its end is a vertex of the result.
            let ends = |ends: &[u32; 2]| ends.iter().any(|&end| result.point(end) == [10.0, 4.0]);
            assert!(result.boundary.subsegments.iter().any(ends));
        }
    }
}

/// Shared borders are there twice and cancel each other; both parcels are inside.
#[test]
fn neighbours_share_a_border() {
    let parcels = "MULTIPOLYGON(((0 0,2 0,2 2,0 2,0 0)),((2 0,5 0,5 2,2 2,2 0)))";
    let mut mesh = mesh_of(parcels, Format::Wkt);
    assert_eq!(run(&mut mesh, Interior::Auto), Ok((10.0, Interior::Parity)));
    let hole = Region { seed: [1.0, 1.0, 0.0], is_hole: true, ..Region::default() };
    mesh.set_regions(&[hole]).unwrap();
    assert_eq!(run(&mut mesh, Interior::Auto), Ok((6.0, Interior::Parity)));
}

#[test]
fn what_has_no_polygons_goes_by_seeds() {
    let closed = "LINESTRING(0 0,4 0,4 4,0 4,0 0),LINESTRING(1 1,2 1,2 2,1 2,1 1)";
    let mut lines = mesh_of(&closed.replace("),", ") "), Format::Wkt);
    assert_eq!(run(&mut lines, Interior::Auto), Ok((16.0, Interior::Seeds)));
    // All segments count where there are no polygons.
    assert_eq!(run(&mut lines, Interior::Parity), Ok((15.0, Interior::Parity)));
    let poly = "4 2\n1 0 0\n2 3 0\n3 3 3\n4 0 3\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";
    assert_eq!(run(&mut mesh_of(poly, Format::Poly), Interior::Auto), Ok((9.0, Interior::Seeds)));
}

/// Segments that replace those of a file are the caller's own: all may enclose something.
#[test]
fn segments_of_the_callers_are_no_polygons() {
    let mut mesh = mesh_of(WKT, Format::Wkt);
    let ends = mesh.segments().inputs.clone();
    mesh.set_segments(ends.as_flattened(), None).unwrap();
    assert_eq!(run(&mut mesh, Interior::Auto), Ok((200.0, Interior::Seeds)));
    let mut open = mesh_of(&format!("{WKT} LINESTRING(0 0,3 3)"), Format::Wkt);
    assert_eq!(run(&mut open, Interior::Auto), Ok((196.0, Interior::Parity)));
    let ends = open.segments().inputs.clone();
    open.set_segments(ends.as_flattened(), None).unwrap();
    let error = run(&mut open, Interior::Parity).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(error.message().contains("is an end of 3 segments"), "{error}");
}

/// With another extent there is no inside to tell.
#[test]
fn other_extents_have_no_inside() {
    let mut mesh = mesh_of(WKT, Format::Wkt);
    for extent in [Extent::All, Extent::Hull, Extent::Box] {
        mesh.run(&Options { extent, ..options(Interior::Auto) }, None).unwrap();
        assert_eq!(mesh.result().unwrap().parameters.interior, Interior::Seeds);
        let error = mesh.run(&Options { extent, ..options(Interior::Parity) }, None).unwrap_err();
        assert!(error.message().starts_with("options.interior = Interior::Parity does"), "{error}");
    }
}

/// The input tells extent and interior where neither is named, and the result says what they
/// are: a file of polygons is cut to these, without their lakes.
#[test]
fn extent_and_interior_follow_the_file() {
    let line = "LINESTRING(-1 -1,8 8)";
    let ring = "LINESTRING(0 0,20 0,20 10,0 10,0 0)";
    let (all, boundary) = (Extent::All, Extent::Boundary);
    let (seeds, parity) = (Interior::Seeds, Interior::Parity);
    for (text, extent, interior, area) in [
        (WKT.to_owned(), boundary, parity, Some(196.0)),
        (format!("{WKT} {line}"), boundary, parity, Some(196.0)),
        (ring.to_owned(), boundary, seeds, Some(200.0)),
        (line.to_owned(), all, seeds, None),
        // The even-odd rule leaves nothing of a polygon that is there twice.
        (format!("{WKT} {WKT}"), all, seeds, None),
    ] {
        let mut mesh = mesh_of(&text, Format::Wkt);
        let options = Options { crossings: Crossings::Split, ..Options::default() };
        let (found, parameters) = run_by(&mut mesh, &options).unwrap();
        assert_eq!((parameters.extent, parameters.interior), (extent, interior), "{text}");
        assert!(area.is_none_or(|area| area == found), "{text}: {found}");
    }
}
