//! The values that `auto` stands for, and that the angle which is asked for is there.

use crate::random::Random;
use netmesh::options::{Crossings, Extent, Interior, Options, Output};
use netmesh::quality::measure;
use netmesh::{Criterion, Mesh, Region, Triangulation};

/// A square with corners at 0 and `side`, and a hole round its centre with 24 corners.
fn square_with_hole(side: f64, radius: f64) -> (Vec<[f64; 2]>, Vec<[u32; 2]>) {
    let mut points = vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
    points.extend((0..24).map(|corner| {
        let angle = std::f64::consts::TAU * f64::from(corner) / 24.0;
        [side / 2.0 + radius * angle.cos(), side / 2.0 + radius * angle.sin()]
    }));
    let ring = |first: u32, count: u32| {
        (0..count).map(move |at| [at, (at + 1) % count].map(|v| v + first))
    };
    (points, ring(0, 4).chain(ring(4, 24)).collect())
}

fn mesh_of(points: &[[f64; 2]], segments: &[[u32; 2]]) -> Mesh {
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(segments.as_flattened(), None).unwrap();
    mesh
}

fn run(mesh: &mut Mesh, options: &Options) -> Triangulation {
    mesh.run(options, None).unwrap();
    mesh.result().unwrap().clone()
}

/// The smallest angle of each triangle in degrees, from nothing but coordinates and ids.
fn smallest_angles(mesh: &Triangulation) -> Vec<f64> {
    let point = |vertex: u32| [0, 1].map(|axis| mesh.points[2 * vertex as usize + axis]);
    let angle_at = |apex: [f64; 2], others: [[f64; 2]; 2]| {
        let [[a, b], [c, d]] = others.map(|x| [x[0] - apex[0], x[1] - apex[1]]);
        (a * d - b * c).abs().atan2(a * c + b * d).to_degrees()
    };
    let least = |corners: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|at| point(corners[at]));
        angle_at(a, [b, c]).min(angle_at(b, [c, a])).min(angle_at(c, [a, b]))
    };
    mesh.simplices.chunks_exact(3).map(least).collect()
}

#[test]
fn an_angle_that_is_asked_for_is_there() {
    for (radius, min_angle) in [(10.0, 25.0), (1.0, 30.0), (0.01, 30.0)] {
        let (points, segments) = square_with_hole(1000.0, radius);
        for extent in [Extent::Auto, Extent::Boundary] {
            let options =
                Options { extent, interior: Interior::Parity, min_angle, ..Options::default() };
            let mesh = run(&mut mesh_of(&points, &segments), &options);
            let least = smallest_angles(&mesh).into_iter().fold(180.0, f64::min);
            assert!(least >= min_angle * (1.0 - 1e-9), "radius {radius}: {least} degrees");
            let parameters = &mesh.parameters;
            assert_eq!(
                (parameters.output, parameters.extent),
                (Output::WellSpaced, Extent::Boundary)
            );
            let quality = measure(&mesh).unwrap();
            assert_eq!((quality.below_min_angle, quality.forced), (0, 0));
        }
    }
}

#[test]
fn a_hierarchical_mesh_by_name_counts_what_misses_the_angle() {
    let (points, segments) = square_with_hole(1000.0, 0.1);
    let (output, interior) = (Output::Hierarchical, Interior::Parity);
    let by_angle = Options { output, interior, min_angle: 25.0, ..Options::default() };
    let all = Options { extent: Extent::All, interior: Interior::Seeds, ..by_angle.clone() };
    let criterion = Criterion::RadiusEdge;
    let by_ratio = Options { output, criterion, quality_bound: 1.0, ..Options::default() };
    let mut of_points = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    for (mesh, options) in [
        (&mut mesh_of(&points, &segments), by_angle),
        (&mut mesh_of(&points, &segments), all),
        (&mut of_points, by_ratio),
    ] {
        let mesh = run(mesh, &options);
        assert!(mesh.parameters.output == Output::Hierarchical && mesh.domains.len() > 1);
        let limit = mesh.parameters.min_angle * (1.0 - 1e-6);
        let below =
            smallest_angles(&mesh).into_iter().filter(|&angle| angle < limit).count() as u64;
        let quality = measure(&mesh).unwrap();
        assert_eq!((quality.below_min_angle, quality.forced), (below, 0), "{options:?}");
        assert!(below > 0, "{options:?}");
    }
}

#[test]
fn points_alone_are_meshed_as_before() {
    let mut random = Random::new(1);
    for dim in [2, 3, 4] {
        let points: Vec<f64> = (0..dim * 300).map(|_| random.unit()).collect();
        let mut mesh = Mesh::new(dim, 300, &points, 0).unwrap();
        let plain = run(&mut mesh, &Options::default());
        let (output, extent) = (Output::Hierarchical, Extent::All);
        let named = run(&mut mesh, &Options { output, extent, ..Options::default() });
        assert_eq!((plain.points, plain.simplices), (named.points, named.simplices));
        assert_eq!((plain.parameters.output, plain.parameters.extent), (output, extent));
        assert_eq!(plain.parameters, named.parameters);
    }
}

#[test]
fn the_extent_is_the_boundary_where_segments_enclose_something() {
    let (points, closed) = square_with_hole(10.0, 2.0);
    let open = &closed[..3];
    let crossing = [[0, 2], [1, 3], [0, 1]];
    let (all, boundary) = (Extent::All, Extent::Boundary);
    let (seeds, parity) = (Interior::Seeds, Interior::Parity);
    for (name, segments, interior, expected) in [
        ("closed", &closed[..], seeds, (boundary, seeds)),
        ("closed", &closed, parity, (boundary, parity)),
        ("closed", &closed, Interior::Winding, (boundary, Interior::Winding)),
        ("open", open, seeds, (all, seeds)),
        ("open where curves should close", open, parity, (all, seeds)),
        ("closed by crossings", &crossing, seeds, (boundary, seeds)),
        ("none", &[], seeds, (all, seeds)),
    ] {
        let options = Options { interior, crossings: Crossings::Split, ..Options::default() };
        let mut mesh = mesh_of(&points, segments);
        let found = run(&mut mesh, &options);
        let parameters = &found.parameters;
        assert_eq!((parameters.extent, parameters.interior), expected, "{name}");
        let output = if expected.0 == all { Output::Hierarchical } else { Output::WellSpaced };
        assert_eq!(parameters.output, output, "{name}");
        assert_eq!(found.boundary.whole.is_some(), expected.0 == boundary, "{name}");
        let named = Options { extent: expected.0, interior: expected.1, output, ..options };
        let named = run(&mut mesh, &named);
        assert_eq!((found.points, found.simplices), (named.points, named.simplices), "{name}");
    }
}

#[test]
fn whatever_tells_sizes_asks_for_a_well_spaced_mesh() {
    let (points, segments) = square_with_hole(10.0, 2.0);
    let of_points = || Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    let is_well_spaced = |mesh: &Mesh| {
        let parameters = &mesh.result().unwrap().parameters;
        assert_eq!(parameters.extent, Extent::All);
        parameters.output == Output::WellSpaced
    };
    let plain = Options { extent: Extent::All, ..Options::default() };
    let mut mesh = of_points();
    mesh.run(&plain, None).unwrap();
    assert!(!is_well_spaced(&mesh));
    let background = mesh.result().unwrap().clone();
    mesh.run_sized(&plain, Some(&|_| 2.0), None).unwrap();
    assert!(is_well_spaced(&mesh));
    mesh.run(&Options { max_edge: 2.0, ..plain.clone() }, None).unwrap();
    assert!(is_well_spaced(&mesh));
    mesh.set_sizes(&vec![2.0; points.len()]).unwrap();
    mesh.run(&plain, None).unwrap();
    assert!(is_well_spaced(&mesh));
    mesh.set_sizes(&[]).unwrap();
    mesh.set_background(Some((&background, &vec![2.0; background.vertex_count()]))).unwrap();
    mesh.run(&plain, None).unwrap();
    assert!(is_well_spaced(&mesh));
    let mut mesh = mesh_of(&points, &segments);
    mesh.run(&plain, None).unwrap();
    assert!(!is_well_spaced(&mesh));
    let ring = Region { seed: [1.0, 1.0, 0.0], max_edge: 1.0, ..Region::default() };
    mesh.set_regions(&[ring]).unwrap();
    mesh.run(&plain, None).unwrap();
    assert!(is_well_spaced(&mesh));
}
