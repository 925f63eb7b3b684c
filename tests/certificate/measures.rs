//! Measures of meshes whose figures are known or can be had by trying everything.

use super::meshes::{BY_HAND, Case, by_hand, pairs, plain, random_points, run};
use netmesh::numerics::{Circumball, distance};
use netmesh::options::{Algorithm, Options};
use netmesh::quality::{Quality, measure};
use netmesh::{Domain, NONE};

#[test]
fn a_lattice_of_regular_triangles() {
    let row = |j: i32| (0..9 - j % 2).map(move |i| (i, j));
    let height = 3f64.sqrt() / 2.0;
    let place = |(i, j): (i32, i32)| [f64::from(2 * i + j % 2) / 2.0, f64::from(j) * height];
    let points: Vec<[f64; 2]> = (0..9).flat_map(row).map(place).collect();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let quality = measure(&run(&points, &options).mesh).unwrap();
    let near = |found: f64, known: f64| assert!((found - known).abs() < 1e-9, "{quality:?}");
    near(quality.worst_radius_edge, 1.0 / 3f64.sqrt());
    near(quality.min_angle_degrees, 60.0);
    assert_eq!(quality.worst_aspect, quality.worst_aspect_anywhere);
    assert_eq!(quality.worst_cage_aspect, 0.0);
    assert_eq!(quality.max_degree, 6);
}

#[test]
fn a_grid_of_cubes() {
    let points: Vec<[f64; 3]> =
        (0..125).map(|i| [i % 5, i / 5 % 5, i / 25].map(f64::from)).collect();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let quality = measure(&run(&points, &options).mesh).unwrap();
    assert!((quality.worst_aspect - 3f64.sqrt()).abs() < 1e-12);
    assert!((quality.mean_aspect - 3f64.sqrt()).abs() < 1e-12);
    assert!((quality.worst_radius_edge - 3f64.sqrt() / 2.0).abs() < 1e-12);
}

/// Returns the aspects of the cells off the hull, of vertices and of cages, by the numerics'
/// circumballs and all distances.
pub fn aspects_by_trying<const D: usize>(case: &Case) -> Vec<f64> {
    let mesh = &case.mesh;
    let point = |v: u32| <&[f64; D]>::try_from(mesh.point(v)).unwrap();
    let vertices = 0..mesh.kinds.len() as u32;
    let corners: Vec<(&[u32], [f64; D], f64)> = (0..mesh.simplex_count())
        .map(|s| {
            let points: Vec<&[f64; D]> = mesh.simplex(s).iter().map(|&v| point(v)).collect();
            let ball = Circumball::<D>::new(&points);
            (mesh.simplex(s), ball.center_point(points[ball.anchor]), ball.radius())
        })
        .collect();
    let cell = |v: u32| {
        let others = vertices.clone().filter(|&w| w != v);
        let nearest = others.map(|w| distance(point(v), point(w))).fold(f64::INFINITY, f64::min);
        let own = corners.iter().filter(|(simplex, ..)| simplex.contains(&v));
        2.0 * own.map(|&(_, _, radius)| radius).fold(0.0, f64::max) / nearest
    };
    let cage = |domain: &Domain| {
        let gap = |x: &[f64; D]| distance(x, point(domain.center));
        let is_outside = |v: &u32| gap(point(*v)) >= domain.radius;
        let outside = vertices.clone().filter(is_outside);
        let nearest = outside.map(|v| gap(point(v))).fold(f64::INFINITY, f64::min);
        let spanning = corners.iter().filter(|(simplex, ..)| {
            simplex.iter().any(is_outside) && !simplex.iter().all(is_outside)
        });
        2.0 * spanning.map(|(_, corner, _)| gap(corner)).fold(0.0, f64::max)
            / (nearest + domain.radius)
    };
    let cells = vertices.clone().filter(|&v| mesh.cage_of[v as usize] == NONE).map(cell);
    cells.chain(mesh.domains[1..].iter().map(cage)).collect()
}

fn worst_aspect_by_trying<const D: usize>(case: &Case) -> f64 {
    aspects_by_trying::<D>(case).into_iter().fold(0.0, f64::max)
}

#[test]
fn aspects_by_trying_all_vertices() {
    let options = Options::default();
    let check = |found: f64, tried: f64| assert!((found / tried - 1.0).abs() < 1e-9);
    let case = run(&random_points::<2>(60, 1), &options);
    check(measure(&case.mesh).unwrap().worst_aspect_anywhere, worst_aspect_by_trying::<2>(&case));
    let case = run(&pairs::<3>(3, 1e-9, 2), &options);
    check(measure(&case.mesh).unwrap().worst_aspect_anywhere, worst_aspect_by_trying::<3>(&case));
}

#[test]
fn a_union_cell_by_hand() {
    let case = by_hand(&BY_HAND, &[]);
    let mesh = &case.mesh;
    let norm = |p: &[f64]| p[0].hypot(p[1]);
    let outside = |&v: &u32| mesh.vertex_domains[v as usize] == 0;
    let vertices = 0..mesh.kinds.len() as u32;
    let gap = vertices.filter(outside).map(|v| norm(mesh.point(v))).fold(f64::INFINITY, f64::min);
    let root = mesh.point(mesh.domains[0].center);
    let mut reach = 0.0f64;
    for simplex in mesh.simplices.chunks(3) {
        if simplex.iter().any(outside) && !simplex.iter().all(outside) {
            let points = [0, 1, 2].map(|i| <&[f64; 2]>::try_from(mesh.point(simplex[i])).unwrap());
            let ball = Circumball::<2>::new(&points);
            let center = ball.center_point(points[ball.anchor]);
            if (center[0] - root[0]).hypot(center[1] - root[1]) < 0.85 * 0.8 * 2.5 {
                reach = reach.max(norm(&center));
            }
        }
    }
    let known = 2.0 * reach / (gap + 0.1);
    assert!((measure(mesh).unwrap().worst_cage_aspect / known - 1.0).abs() < 1e-9);
}

#[test]
fn meshes_that_do_not_fit_together_measure_nothing() {
    let mut case = plain(&random_points::<2>(3, 1), &[vec![0, 1, 2]]);
    case.mesh.simplices[0] = 3;
    assert_eq!(measure(&case.mesh).unwrap(), Quality::default());
}
