//! Facets that are bent as far as the caller allows: their vertices are on the caller's triangles.

use super::crossings::{surface, turned};
use super::{Point, assert_holds, bounded};
use crate::random::Random;
use netmesh::Extent;
use netmesh::options::Options;

/// Appends a strip of squares that bends by some degrees at every edge, at `distance` from another
/// such one.
fn add_strip(points: &mut Vec<Point>, triangles: &mut Vec<[u32; 3]>, degrees: f64, distance: f64) {
    let first = points.len() as u32;
    let (mut x, mut z) = (0.0, distance);
    for edge in 0..6 {
        points.extend([[x, 0.0, z], [x, 0.1, z]]);
        let angle = (degrees * f64::from(edge)).to_radians();
        (x, z) = (x + 0.02 * angle.cos(), z + 0.02 * angle.sin());
    }
    for square in 0..5 {
        let [a, b, c, d] = [0, 2, 3, 1].map(|corner| first + 2 * square + corner);
        triangles.extend([[a, b, c], [a, c, d]]);
    }
}

/// Holds that two strips do not cross that are nearer to each other than to their planes.
#[test]
fn strips_that_are_bent_alike_are_apart() {
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    add_strip(&mut points, &mut triangles, 1.2, 0.0);
    add_strip(&mut points, &mut triangles, 1.2, 1e-3);
    let mut mesh = surface(&points, &triangles);
    let options = Options { coplanar: 5.0, max_vertices: 100_000, ..bounded(2.0) };
    mesh.run(&options, None).unwrap_or_else(|error| panic!("{}", error.message()));
    assert_holds(&mesh);
    let made = mesh.result().unwrap();
    let mut parents = made.boundary.subfacet_parents.clone();
    parents.dedup();
    assert_eq!(parents, [0, 10], "two facets");
    // Off the chain of edges between squares by no more than a triangle of the sheet may cut off.
    let height = |x: f64| {
        let at = points[..12].windows(4).step_by(2).find(|own| x <= own[2][0]);
        let [from, _, to, _] = at
            .map_or([&points[8], &points[9], &points[10], &points[11]], |own| {
                [&own[0], &own[1], &own[2], &own[3]]
            });
        from[2] + (x - from[0]) / (to[0] - from[0]) * (to[2] - from[2])
    };
    let corners = made.boundary.subfacets.iter().flatten();
    let on_first = corners.zip(0..).filter(|(_, at)| made.boundary.subfacet_parents[at / 3] == 0);
    for (&vertex, _) in on_first {
        let x = &made.points[3 * vertex as usize..][..3];
        assert!((x[2] - height(x[0])).abs() < 1e-12, "{x:?} is off the strip");
    }
}

/// Holds that a facet which is hardly bent goes through inputs beside its highest corner.
#[test]
fn a_bent_facet_goes_through_inputs_beside_it() {
    let mut random = Random::new(5);
    for height in [1e-13, 2e-13, 4e-13] {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, height], [0.0, 1.0, 0.0]];
        let mut points = corners.to_vec();
        for _ in 0..60 {
            let part = 2e-3 * random.unit();
            let [u, v] = [part * random.unit(), part];
            let beside = 3.0 * f64::EPSILON * random.unit();
            points.push([1.0 - u, 1.0 - v, height * (1.0 - v) + beside]);
        }
        let points = turned(&points);
        let mut mesh = surface(&points, &[[0, 1, 2], [0, 2, 3]]);
        let options = Options { coplanar: 1e-3, ..bounded(2.0) };
        mesh.run(&options, None).unwrap_or_else(|error| panic!("{height}: {}", error.message()));
        assert_holds(&mesh);
    }
}

/// Holds that arcs about a vertex are on its sphere where facets are bent. Three fans lie on each
/// other there, 0.02 to 0.2 degrees apart; arcs beside the sphere were divided without an end.
#[test]
fn fans_that_are_bent_have_their_arcs_on_a_sphere() {
    let points = [
        [0.0; 3],
        [0.9997, -0.0148, -0.0214],
        [0.9823, 0.1065, 0.154],
        [0.8257, 0.3208, 0.4641],
        [0.5183, 0.4863, 0.7035],
        [0.0, 0.5688, 0.8225],
        [0.958, 0.1622, 0.2364],
        [0.8794, 0.2693, 0.3925],
        [0.7624, 0.3661, 0.5336],
        [0.6087, 0.4489, 0.6542],
        [0.4171, 0.5142, 0.7495],
        [0.1731, 0.5572, 0.8121],
        [0.3375, -0.5327, -0.7761],
    ];
    let fans: [&[u32]; 3] = [&[1, 2, 3, 4, 5], &[1, 6, 7, 8, 9, 10, 11], &[12, 11]];
    let sides = fans.iter().flat_map(|fan| fan.windows(2));
    let triangles: Vec<[u32; 3]> = sides.map(|side| [0, side[0], side[1]]).collect();
    let mut mesh = surface(&points, &triangles);
    let limit =
        Options { coplanar: 0.2, max_vertices: 20_000, extent: Extent::Box, ..bounded(2.0) };
    mesh.run(&limit, None).unwrap_or_else(|error| panic!("{}", error.message()));
    assert_holds(&mesh);
    let vertices = mesh.result().unwrap().vertex_count();
    assert!(vertices < 2500, "{vertices} vertices");
}
