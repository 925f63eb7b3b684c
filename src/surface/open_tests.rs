//! Open surfaces and curves, and how sparse their points are.

use super::tests::{sphere, surface_of};
use super::*;
use crate::numerics::SplitMix;
use std::collections::HashSet;
use std::f64::consts::{PI, TAU};

/// Returns the parts of a surface as (facets, genus, ends, has one side).
fn shells(surface: &Surface) -> Vec<(u64, u64, u64, bool)> {
    let told = |shell: &Shell| (shell.facets, shell.genus, shell.ends, shell.is_one_sided);
    surface.shells.iter().map(told).collect()
}

/// Returns random points of a strip, a parameter round it and one across, each from 0 to 1.
fn strip(count: usize, point: impl Fn(f64, f64) -> [f64; 3]) -> Vec<f64> {
    let mut random = SplitMix(5);
    (0..count).flat_map(|_| point(random.unit(), random.unit())).collect()
}

/// Returns the edges of one triangle alone, as it has them.
fn edges_alone(surface: &Surface) -> Vec<[u32; 2]> {
    let edges = surface.facets.chunks(3).flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
    let all: HashSet<[u32; 2]> = edges.collect();
    all.iter().filter(|[a, b]| !all.contains(&[*b, *a])).copied().collect()
}

#[test]
fn a_bowl_ends_once_and_keeps_all_its_points() {
    let points: Vec<f64> =
        sphere(3000, 2.0).chunks(3).filter(|p| p[2] < 0.5).flatten().copied().collect();
    let (_, surface) = surface_of(3, &points, SurfaceKind::Open);
    let vertices = points.len() / 3;
    let [(facets, 0, 1, false)] = shells(&surface)[..] else { panic!("{:?}", surface.shells) };
    assert!(surface.left_out.is_empty() && surface.is_inside.iter().all(|is| !is));
    // Triangles of a disk: twice the vertices less two, less the edges of its end.
    let ends = edges_alone(&surface).len();
    assert!((20..200).contains(&ends) && facets as usize == 2 * vertices - 2 - ends, "{ends}");
    // Closed, the bowl has a lid of long triangles.
    let (_, closed) = surface_of(3, &points, SurfaceKind::Closed);
    assert_eq!(shells(&closed), [(2 * vertices as u64 - 4, 0, 0, false)]);
}

#[test]
fn a_tube_ends_twice_and_a_moebius_strip_once_with_one_side() {
    let tube = strip(2000, |u, v| [(TAU * u).cos(), (TAU * u).sin(), 2.0 * v]);
    let (_, surface) = surface_of(3, &tube, SurfaceKind::Open);
    assert!(matches!(shells(&surface)[..], [(_, 0, 2, false)]), "{:?}", surface.shells);
    let moebius = strip(3000, |u, v| {
        let (across, turn) = (0.6 * (v - 0.5), PI * u);
        let reach = 1.0 + across * turn.cos();
        [reach * (TAU * u).cos(), reach * (TAU * u).sin(), across * turn.sin()]
    });
    let (_, surface) = surface_of(3, &moebius, SurfaceKind::Open);
    assert!(matches!(shells(&surface)[..], [(_, 1, 1, true)]), "{:?}", surface.shells);
}

#[test]
fn a_hole_stays_and_facets_go_on_in_one_direction() {
    let sheet = strip(4000, |x, y| [x, y, 0.1 * (5.0 * x).sin() * (4.0 * y).cos()]);
    let far = |p: &&[f64]| (p[0] - 0.5).hypot(p[1] - 0.5) > 0.2;
    let points: Vec<f64> = sheet.chunks(3).filter(far).flatten().copied().collect();
    let (mesh, surface) = surface_of(3, &points, SurfaceKind::Open);
    assert!(matches!(shells(&surface)[..], [(_, 0, 2, false)]), "{:?}", surface.shells);
    let triangulation = mesh.result().unwrap();
    let upwards = |facet: &&[u32]| {
        let [a, b, c] = [0, 1, 2].map(|k| triangulation.point(facet[k]));
        (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
    };
    let count = surface.facets.chunks(3).filter(upwards).count();
    assert_eq!(count, surface.facets.len() / 3);
}

#[test]
fn a_closed_surface_is_the_same_if_it_may_be_open() {
    let points = sphere(500, 3.0);
    let (_, closed) = surface_of(3, &points, SurfaceKind::Closed);
    let (_, open) = surface_of(3, &points, SurfaceKind::Open);
    assert_eq!(super::tests::turned(&closed), super::tests::turned(&open));
    assert_eq!(shells(&open), [(996, 0, 0, false)]);
}

#[test]
fn curves_end_or_close() {
    let turns = |turns: f64, count: usize, x: f64| {
        (0..count).flat_map(move |i| {
            let (sin, cos) = (turns * TAU * i as f64 / count as f64).sin_cos();
            let reach = 1.0 + 0.4 * turns * (turns - 1.0) * i as f64 / count as f64;
            [x + reach * cos, reach * sin]
        })
    };
    // A spiral, a circle, and three quarters of a circle.
    let points: Vec<f64> =
        turns(3.0, 300, 0.0).chain(turns(1.0, 60, 20.0)).chain(turns(0.75, 40, 30.0)).collect();
    let (_, surface) = surface_of(2, &points, SurfaceKind::Open);
    let expected = [(299, 0, 2, false), (60, 0, 0, false), (39, 0, 2, false)];
    assert_eq!(shells(&surface), expected);
    assert!(surface.left_out.is_empty());
}

#[test]
fn sampling_is_the_radius_over_the_distance_to_the_poles() {
    // Of a circle of radius 2 the only poles inside are its middle.
    let circle: Vec<f64> = (0..40)
        .map(|i| TAU * i as f64 / 40.0)
        .flat_map(|t| [2.0 * t.cos(), 2.0 * t.sin()])
        .collect();
    let expected = (PI / 40.0).sin();
    for kind in [SurfaceKind::Closed, SurfaceKind::Open] {
        let (_, surface) = surface_of(2, &circle, kind);
        assert!(surface.sampling.iter().all(|ratio| (ratio - expected).abs() < 1e-9));
        assert_eq!(surface.sparse(), 0);
    }
    // A square of one point a corner is as sparse as a curve can be: half a side over half a
    // diagonal; two far lines of points are denser.
    let (_, square) = surface_of(2, &[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0], SurfaceKind::Closed);
    assert!(square.sampling.iter().all(|ratio| (ratio - 0.5f64.sqrt()).abs() < 1e-12));
    // A point far above a sphere is no vertex of the surface.
    let mut points = vec![0.0, 0.0, 9.0];
    points.extend(sphere(200, 1.0));
    let (_, surface) = surface_of(3, &points, SurfaceKind::Closed);
    assert!(surface.left_out == [0] && surface.sampling[0].is_nan());
    assert!(surface.sampling[1..].iter().all(|ratio| (0.02..0.3).contains(ratio)));
}
