//! Options that go with facets, and those that do not.

use super::{bounded, cuboid};
use netmesh::Region;
use netmesh::error::ErrorKind;
use netmesh::options::{Algorithm, Extent, Interior, Options, Output};

fn refusal(options: &Options) -> String {
    let error = cuboid([0.0; 3], [1.0; 3]).mesh().run(options, None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
    error.message().to_owned()
}

#[test]
fn what_does_not_go_with_facets_is_refused_by_name() {
    let plain = Options::default();
    let distance = refusal(&Options { distance_ratio: 0.5, ..plain.clone() });
    assert_eq!(distance, "options.distance_ratio is 0.5; it must be 0 with facets");
    for algorithm in [Algorithm::Delaunay, Algorithm::Svr] {
        for extent in [Extent::Auto, Extent::Box] {
            let message = refusal(&Options { algorithm, extent, ..plain.clone() });
            assert!(
                message.contains(" goes neither with facets nor with a hull or box"),
                "{message}"
            );
        }
    }
    for quality_bound in [4.0, f64::INFINITY] {
        let message = refusal(&Options { quality_bound, ..plain.clone() });
        let words = format!("is {quality_bound}; with facets it must be 0, or go with ");
        assert!(message.contains(&words), "{message}");
    }
    for extent in [Extent::All, Extent::Box, Extent::Hull] {
        let message = refusal(&Options { extent, interior: Interior::Parity, ..plain.clone() });
        assert!(message.contains("does not go with"), "{message}");
    }
}

/// A mesh in space without facets lacks them, not segments.
#[test]
fn facets_are_needed_for_what_they_bound() {
    let points = cuboid([0.0; 3], [1.0; 3]).points;
    let mut mesh = netmesh::Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    let mut refusal = |options: &Options| {
        let error = mesh.run(options, None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
        error.message().to_owned()
    };
    let plain = Options::default();
    let boundary = refusal(&Options { extent: Extent::Boundary, ..plain.clone() });
    assert_eq!(boundary, "options.extent = Extent::Boundary needs facets; the mesh has none");
    let parity = refusal(&Options { interior: Interior::Parity, ..plain.clone() });
    assert_eq!(parity, "options.interior = Interior::Parity needs facets; the mesh has none");
    mesh.set_regions(&[Region { seed: [0.5; 3], ..Region::default() }]).unwrap();
    let seed = mesh.run(&plain, None).unwrap_err();
    let words = "regions[0].seed is in no region: the mesh has no facets; set them first";
    assert!(seed.message().starts_with(words), "{seed}");
}

#[test]
fn segments_in_space_refuse_what_facets_do() {
    let points = cuboid([0.0; 3], [1.0; 3]).points;
    let mut mesh = netmesh::Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 7], None).unwrap();
    let options = Options { distance_ratio: 0.5, ..Options::default() };
    let error = mesh.run(&options, None).unwrap_err();
    assert_eq!(error.message(), "options.distance_ratio is 0.5; it must be 0 with segments");
    mesh.run(&Options::default(), None).unwrap();
    super::assert_holds(&mesh);
}

#[test]
fn an_infinite_bound_is_for_facets() {
    let mut cube = cuboid([0.0; 3], [1.0; 3]).mesh();
    cube.set_facets(&[], &[], &[], None).unwrap();
    let message = cube.run(&bounded(f64::INFINITY), None).unwrap_err().message().to_owned();
    assert!(message.starts_with("options.quality_bound is inf; it must be 0"), "{message}");
}

#[test]
fn open_surfaces_enclose_nothing() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]);
    solid.polygons.pop();
    let mesh = solid.run(&Options::default());
    assert_eq!(mesh.parameters.extent, Extent::All);
    assert!(mesh.vertex_count() > 8);
    let inside = Options { extent: Extent::Boundary, ..Options::default() };
    for interior in [Interior::Auto, Interior::Parity, Interior::Winding] {
        let options = Options { interior, ..inside.clone() };
        let error = solid.mesh().run(&options, None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
        let says = match interior {
            Interior::Auto => error.message().starts_with("facets enclose nothing, with "),
            _ => error.message().ends_with("so that all surfaces are closed"),
        };
        assert!(says, "{error}");
    }
}

#[test]
fn messages_on_seeds_in_space_speak_of_facets() {
    let refused = |seeds: &[[f64; 3]]| {
        let mut solid = cuboid([0.0; 3], [1.0; 3]);
        solid.regions = seeds.iter().map(|&seed| Region { seed, ..Region::default() }).collect();
        let error = solid.mesh().run(&Options::default(), None).unwrap_err();
        error.message().to_owned()
    };
    let outside = refused(&[[9.0; 3]]);
    assert!(outside.contains("outside of all that facets enclose"), "{outside}");
    let same = refused(&[[0.25, 0.5, 0.5], [0.75, 0.5, 0.5]]);
    assert!(same.contains("; no facet is between them"), "{same}");
}

#[test]
fn a_domain_is_well_spaced_unless_asked_otherwise() {
    let mesh = cuboid([0.0; 3], [1.0; 3]).run(&Options::default());
    assert_eq!(mesh.parameters.output, Output::WellSpaced);
}
