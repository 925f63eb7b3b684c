//! Readers refuse bytes with a documented kind, or read points that every writer gives back.

use super::bytes::Bytes;
use super::outlines::check_facets;
use super::triangulations::bits;
use netmesh::io::{Choice, Format, PointCloud, read, read_table, write};
use netmesh::{Algorithm, ErrorKind, Mesh, Options, Result};
use std::io::BufReader;

/// Formats by number. New formats come last, since the corpus has their numbers.
pub const FORMATS: [Format; 8] = [
    Format::TetgenNode,
    Format::Off,
    Format::Xyz,
    Format::Csv,
    Format::Gmsh,
    Format::Medit,
    Format::Ply,
    Format::Npy,
];

/// Kinds that bytes in memory can be refused with.
const REFUSALS: [ErrorKind; 3] = [ErrorKind::Format, ErrorKind::NonFinite, ErrorKind::Dimension];

/// Largest number of points that are triangulated, for formats that hold nothing less.
const MAX_TRIANGULATED: usize = 12;

/// Checks a file: the first byte picks the format, the rest is the file.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let format = FORMATS[bytes.below(FORMATS.len() as u8)];
    check_text(format, bytes.rest());
}

/// Checks a file; returns true if it was accepted.
pub fn check_text(format: Format, text: &[u8]) -> bool {
    let whole = read(&mut &*text, format);
    let in_pieces = read(&mut BufReader::with_capacity(3, text), format);
    assert_eq!(whole, in_pieces, "the size of the pieces matters");
    check_attributes(format, text, &whole);
    match whole {
        Ok(cloud) => {
            check_cloud(&cloud);
            true
        }
        Err(error) => {
            assert!(REFUSALS.contains(&error.kind()), "{:?}: {error}", error.kind());
            assert!(!error.message().is_empty() && error.message().len() < 400, "{error}");
            false
        }
    }
}

/// Checks that the points are the same with all other columns as attributes, and that each has its
/// values.
fn check_attributes(format: Format, text: &[u8], points: &Result<PointCloud>) {
    let attributes = "all".parse().expect("a choice");
    match read_table(&mut &*text, format, &Choice { attributes, ..Choice::default() }) {
        Ok(table) => {
            assert_eq!(points.as_ref(), Ok(&table.points));
            let count = table.points.coordinates.len() / table.points.dim;
            assert!(table.attributes.iter().all(|attribute| attribute.values.len() == count));
            check_facets(&table);
        }
        Err(error) => assert!(
            REFUSALS.contains(&error.kind()) || error.kind() == ErrorKind::InvalidArgument,
            "{:?}: {error}",
            error.kind()
        ),
    }
}

fn check_cloud(cloud: &PointCloud) {
    assert!((2..=8).contains(&cloud.dim), "dimension {}", cloud.dim);
    assert!(!cloud.coordinates.is_empty());
    assert_eq!(cloud.coordinates.len() % cloud.dim, 0);
    assert!(cloud.coordinates.iter().all(|x| x.is_finite()));
    let count = cloud.coordinates.len() / cloud.dim;
    match Mesh::new(cloud.dim, count, &cloud.coordinates, 0) {
        Ok(mesh) => check_round_trip(mesh),
        Err(error) => assert_eq!(error.kind(), ErrorKind::DegenerateInput, "{error}"),
    }
}

/// Checks that every format that can be written and read gives the points back, bit for bit.
fn check_round_trip(mut mesh: Mesh) {
    let points = mesh.inputs().distinct_points();
    let dim = mesh.inputs().dim();
    for format in [Format::Xyz, Format::Csv, Format::Npy] {
        assert_reads_back(&mesh, format, dim, &points);
    }
    let small = mesh.inputs().distinct() <= MAX_TRIANGULATED && dim <= 5;
    let plain = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    if small && mesh.run(&plain, None).is_ok() {
        check_round_trip_of_mesh(&mesh, dim, points);
    }
}

fn check_round_trip_of_mesh(mesh: &Mesh, dim: usize, points: Vec<f64>) {
    assert_reads_back(mesh, Format::TetgenNode, dim, &points);
    if dim <= 3 {
        assert_reads_back(mesh, Format::Gmsh, dim, &points);
        assert_reads_back(mesh, Format::Medit, dim, &points);
    }
    let in_space = match dim {
        2 => points.chunks_exact(2).flat_map(|p| [p[0], p[1], 0.0]).collect(),
        _ => points,
    };
    assert_reads_back(mesh, Format::Off, dim.max(3), &in_space);
    if dim <= 3 {
        assert_reads_back(mesh, Format::Ply, 3, &in_space);
    }
    for format in [Format::VoronoiJson, Format::DomainsJson] {
        let mut text = Vec::new();
        assert_eq!(write(mesh, format, &mut text), Ok(()));
        assert!(
            std::str::from_utf8(&text)
                .is_ok_and(|text| !text.contains("NaN") && !text.contains("inf"))
        );
    }
}

fn assert_reads_back(mesh: &Mesh, format: Format, dim: usize, points: &[f64]) {
    let read = written(mesh, format).and_then(|text| read(&mut &*text, format));
    let read = read.unwrap_or_else(|error| panic!("{format:?}: {error}"));
    assert_eq!(read.dim, dim, "{format:?}");
    assert!(bits(&read.coordinates) == bits(points), "{format:?}: {points:?}");
}

/// Returns a written file as it is read back: of TetGen's pair of files the first.
fn written(mesh: &Mesh, format: Format) -> Result<Vec<u8>> {
    let mut text = Vec::new();
    write(mesh, format, &mut text)?;
    if format == Format::TetgenNode {
        let lines = 1 + mesh.triangulation().expect("it was meshed").vertex_count();
        let end = text.split_inclusive(|&byte| byte == b'\n').take(lines).map(<[u8]>::len).sum();
        text.truncate(end);
    }
    Ok(text)
}
