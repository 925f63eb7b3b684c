//! A reader of points, segments, facets and seeds refuses bytes with a documented kind, or reads
//! what a mesh takes or refuses by name.

use netmesh::io::{Choice, Format, Table, read_table};
use netmesh::{ErrorKind, Mesh, Result};
use std::io::{BufRead, BufReader};

/// Checks a file of a surface: refused with a documented kind, or facets of points that are there.
pub fn check_surface(format: Format, text: &[u8]) {
    let read = |input: &mut dyn BufRead| read_table(input, format, &Choice::default());
    let whole = read(&mut &*text);
    assert_eq!(whole, read(&mut BufReader::with_capacity(3, text)), "the size of pieces matters");
    match whole {
        Ok(table) => check_facets(&table),
        Err(error) => {
            let kinds = [ErrorKind::Format, ErrorKind::NonFinite];
            assert!(kinds.contains(&error.kind()), "{:?}: {error}", error.kind());
        }
    }
}

/// Checks a file; returns true if it was accepted.
pub fn check_text(format: Format, text: &[u8]) -> bool {
    let read = |input: &mut dyn BufRead| -> Result<Table> {
        read_table(input, format, &Choice::default())
    };
    let whole = read(&mut &*text);
    let in_pieces = read(&mut BufReader::with_capacity(3, text));
    assert_eq!(whole, in_pieces, "the size of the pieces matters");
    match whole {
        Ok(table) => {
            check_table(&table);
            true
        }
        Err(error) => {
            let is_beside = error.message().starts_with("the points are in a .node file beside");
            let is_documented = match error.kind() {
                ErrorKind::Format | ErrorKind::NonFinite | ErrorKind::Dimension => true,
                kind => kind == ErrorKind::InvalidArgument && is_beside,
            };
            assert!(is_documented, "{:?}: {error}", error.kind());
            assert!(!error.message().is_empty() && error.message().len() < 400, "{error}");
            false
        }
    }
}

fn check_table(table: &Table) {
    let dim = table.points.dim;
    assert!(dim == 2 || dim == 3, "dimension {dim}");
    let count = table.points.coordinates.len() / dim;
    let outline = &table.outline;
    check_facets(table);
    assert_eq!(outline.markers.len(), outline.segments.len());
    for &[from, to] in &outline.segments {
        assert!(from != to && (from.max(to) as usize) < count, "{from} {to} of {count}");
    }
    let Ok(mut mesh) = Mesh::new(dim, count, &table.points.coordinates, 0) else { return };
    if let Err(error) = mesh.set_segments(outline.segments.as_flattened(), Some(&outline.markers)) {
        // Two numbers of one point.
        assert!(error.message().contains("which are the same point"), "{error}");
    }
    mesh.set_regions(&outline.regions).expect("seeds are finite, and edges have lengths");
    if let Err(error) = table.mesh(true) {
        let is_of_equal_points = error.message().contains("which are the same point");
        // A face of a surface may have a point twice.
        let has_point_twice = outline.facets.are_triangles || dim == 3;
        assert!(
            is_of_equal_points || (has_point_twice && error.message().contains(" twice")),
            "{error}"
        );
    }
}

/// Checks that facets have loops of points that are there.
pub fn check_facets(table: &Table) {
    let facets = &table.outline.facets;
    let count = table.points.coordinates.len() / table.points.dim;
    assert!(facets.count() == 0 || table.points.dim == 3);
    for facet in 0..facets.count() {
        assert!(facets.loops(facet).any(|corners| corners.len() > 2), "facet {facet}");
        for corners in facets.loops(facet) {
            assert!(!corners.is_empty() && corners.iter().all(|&corner| (corner as usize) < count));
        }
        let is_triangle = facets.loops(facet).map(<[u32]>::len).eq([3]);
        assert!(is_triangle || !facets.are_triangles, "facet {facet}");
    }
}
