//! Facets that a mesh does not have, with crossings that are split.

use super::solids::facets_of;
use netmesh::mesh::Facets;
use netmesh::options::{Criterion, Crossings, Extent, Options};
use netmesh::validate::{Outline, Report, ViolationKind as Kind, validate_outlined};
use netmesh::{Mesh, Segments};

/// Returns the report on a mesh of a triangle that had to have another one too, of this height.
fn report_without(height: f64, crossings: Crossings) -> Report {
    let points = [
        [2.0, 2.0, 2.0],
        [3.0, 2.0, 2.0],
        [2.0, 3.0, 2.5],
        [1.0, 1.0, 1.0],
        [1.75, 1.0, 1.0],
        [1.375, 1.0 + height, 1.0],
    ];
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(&[0, 1, 2], None).unwrap();
    let options = Options {
        criterion: Criterion::RadiusEdge,
        quality_bound: f64::INFINITY,
        extent: Extent::All,
        crossings,
        ..Options::default()
    };
    mesh.run(&options, None).unwrap();
    let facets: Facets = facets_of(&[vec![vec![0, 1, 2]], vec![vec![3, 4, 5]]], true);
    let (segments, regions) = (&Segments::default(), &[][..]);
    let outline = Outline { segments, facets: &facets, regions };
    validate_outlined(mesh.inputs(), outline, mesh.result().unwrap(), 3).unwrap()
}

/// A triangle that is no wider than an edge may be bent has nothing to keep, if crossings are
/// split; any other one has.
#[test]
fn needles_alone_may_be_left_out() {
    let unit = f64::EPSILON;
    for units in [2.0, 12.0] {
        let report = report_without(units * unit, Crossings::Split);
        assert_eq!((report.level, report.violations), (3, 0), "{units}: {:?}", report.first);
    }
    let wider =
        [(20.0 * unit, Crossings::Split), (1e-9, Crossings::Split), (0.5, Crossings::Split)];
    for (height, crossings) in wider.into_iter().chain([(2.0 * unit, Crossings::Refuse)]) {
        let report = report_without(height, crossings);
        let first = report.first.expect("the other triangle is missed");
        assert_eq!((report.level, first.kind), (1, Kind::SegmentChain), "{}", first.message);
    }
}
