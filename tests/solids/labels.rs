//! Numbers of regions: shells that stand side by side, share walls or are nested have the numbers
//! of their order, and the certificate knows them.

use super::{Solid, assert_holds, bounded, cuboid};
use netmesh::options::{Crossings, Extent, Interior, Labels, Options};
use netmesh::validate::{Outline, ViolationKind as Kind, validate_outlined};
use netmesh::{Mesh, NONE, Region, Triangulation};
use std::collections::BTreeMap;

/// Returns a mesh of the triangles of boxes between two corners each.
fn surface(boxes: &[[[f64; 3]; 2]]) -> Mesh {
    let boxes = boxes.iter().map(|&[low, high]| cuboid(low, high));
    let solid = boxes.fold(Solid::default(), |all, next| all.with(&next));
    let mut mesh = Mesh::new(3, solid.points.len(), solid.points.as_flattened(), 0).unwrap();
    let halves = solid.polygons.iter().flat_map(|p| [[p[0], p[1], p[2]], [p[0], p[2], p[3]]]);
    let triangles: Vec<[u32; 3]> = halves.collect();
    mesh.set_triangles(triangles.as_flattened(), None).unwrap();
    mesh
}

/// Returns the volume of each label of a result whose certificate holds.
fn volumes(mesh: &mut Mesh, options: &Options) -> BTreeMap<i32, f64> {
    mesh.run(options, None).unwrap_or_else(|error| panic!("{error}"));
    assert_holds(mesh);
    let made = mesh.result().unwrap();
    let mut volumes = BTreeMap::new();
    for (simplex, &label) in made.boundary.simplex_regions.iter().enumerate() {
        let ends = [0, 1, 2, 3].map(|at| made.point(made.simplex(simplex)[at]));
        let [u, v, w] = [1, 2, 3].map(|at| [0, 1, 2].map(|k| ends[at][k] - ends[0][k]));
        let own = u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0]);
        *volumes.entry(label).or_insert(0.0) += own / 6.0;
    }
    volumes
}

fn assert_volumes(found: &BTreeMap<i32, f64>, expected: &[(i32, f64)]) {
    let labels: Vec<i32> = expected.iter().map(|one| one.0).collect();
    assert_eq!(found.keys().copied().collect::<Vec<_>>(), labels, "{found:?}");
    for &(label, volume) in expected {
        assert!((found[&label] - volume).abs() < 1e-12 * volume, "{label}: {found:?}");
    }
}

fn numbered(bound: f64) -> Options {
    Options { labels: Labels::Regions, ..bounded(bound) }
}

/// Boxes of which the third shares walls with the first and the second, which touch nothing else,
/// and one in the second.
const SHELLS: [[[f64; 3]; 2]; 4] = [
    [[0.0; 3], [1.0, 1.0, 1.0]],
    [[2.0, 0.0, 0.0], [5.0, 1.0, 1.0]],
    [[1.0, 0.0, 0.0], [2.0, 1.0, 1.0]],
    [[3.0, 0.25, 0.25], [3.5, 0.75, 0.75]],
];

#[test]
fn shells_number_what_they_enclose() {
    let expected = [(1, 1.0), (2, 2.875), (3, 1.0), (4, 0.125)];
    for interior in [Interior::Auto, Interior::Seeds, Interior::Winding] {
        for bound in [f64::INFINITY, 2.0] {
            let crossings = Crossings::Split;
            let options = Options { interior, crossings, ..numbered(bound) };
            assert_volumes(&volumes(&mut surface(&SHELLS), &options), &expected);
        }
    }
    // Without the option all of it has one label.
    let options = Options { crossings: Crossings::Split, ..bounded(2.0) };
    assert_volumes(&volumes(&mut surface(&SHELLS), &options), &[(0, 5.0)]);
}

#[test]
fn labels_of_seeds_are_left_out() {
    let mut mesh = surface(&[SHELLS[0], SHELLS[1], SHELLS[3]]);
    let seed = |x: f64, label, is_hole| Region {
        seed: [x, 0.5, 0.5],
        label,
        is_hole,
        ..Region::default()
    };
    mesh.set_regions(&[seed(2.5, 1, false)]).unwrap();
    assert_volumes(&volumes(&mut mesh, &numbered(2.0)), &[(1, 2.875), (2, 1.0), (3, 0.125)]);
    mesh.set_regions(&[seed(0.5, 0, false), seed(3.25, 1, true)]).unwrap();
    assert_volumes(&volumes(&mut mesh, &numbered(2.0)), &[(0, 1.0), (1, 2.875)]);
}

/// Holds that what is outside has the label 0 with the extent all, and a number in a box.
#[test]
fn outside_is_no_region_but_in_a_box() {
    let mut mesh = surface(&[SHELLS[0], [[2.0; 3], [3.0; 3]]]);
    let all = Options { extent: Extent::All, ..numbered(2.0) };
    let mut found = volumes(&mut mesh, &all);
    assert!(found.remove(&0).unwrap() > 25.0);
    assert_volumes(&found, &[(1, 1.0), (2, 1.0)]);
    let boxed = Options { extent: Extent::Box, ..numbered(2.0) };
    assert_volumes(&volumes(&mut mesh, &boxed), &[(1, 1.0), (2, 1.0), (3, 25.0)]);
}

/// Polygons are turned as they happen to be: regions that are behind none come last.
#[test]
fn regions_behind_no_facet_come_last() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]).with(&cuboid([3.0; 3], [4.0; 3]));
    solid.polygons[..6].iter_mut().for_each(|polygon| polygon.reverse());
    let mut mesh = solid.mesh();
    assert_volumes(&volumes(&mut mesh, &numbered(2.0)), &[(1, 1.0), (2, 1.0)]);
    let made = mesh.result().unwrap();
    let far = (0..made.simplex_count()).find(|&at| made.point(made.simplex(at)[0])[0] >= 3.0);
    assert_eq!(made.boundary.simplex_regions[far.unwrap()], 1);
}

#[test]
fn the_certificate_finds_labels_that_are_exchanged() {
    let mut mesh = surface(&[SHELLS[0], SHELLS[1], SHELLS[3]]);
    mesh.run(&numbered(2.0), None).unwrap();
    let first = |change: &dyn Fn(i32) -> i32| {
        let (facets, segments) = (mesh.given_facets(), mesh.segments());
        let outline = Outline { segments, facets, regions: &[] };
        let mut changed: Triangulation = mesh.result().unwrap().clone();
        let whole = changed.boundary.whole.as_deref_mut().unwrap();
        let labels = changed.boundary.simplex_regions.iter_mut();
        labels
            .chain(whole.boundary.simplex_regions.iter_mut())
            .for_each(|label| *label = change(*label));
        let report = validate_outlined(mesh.inputs(), outline, &changed, 3).unwrap();
        report.first.map(|found| found.kind)
    };
    assert_eq!(first(&|label| label), None);
    for (a, b) in [(1, 2), (2, 3), (1, 3)] {
        let exchanged = |label| match label {
            label if label == a => b,
            label if label == b => a,
            label => label,
        };
        assert_eq!(first(&exchanged), Some(Kind::RegionLabel));
    }
    // One number for two regions, and a number that is too high.
    assert_eq!(first(&|label| label.min(2)), Some(Kind::RegionLabel));
    assert_eq!(first(&|label| if label == 3 { 4 } else { label }), Some(Kind::RegionLabel));
    assert!(mesh.result().unwrap().boundary.subfacet_parents.iter().all(|&parent| parent != NONE));
}
