use super::*;
use crate::mesh::Mesh;
use crate::numerics::SplitMix;
use crate::options::{Algorithm, Options};
use std::f64::consts::{PI, TAU};

/// Returns the surface through points, which the certificate has found to be one.
fn surface_through(dim: usize, points: &[f64]) -> (Mesh, Surface) {
    surface_of(dim, points, SurfaceKind::Closed)
}

pub fn surface_of(dim: usize, points: &[f64], kind: SurfaceKind) -> (Mesh, Surface) {
    surface_by_seed(dim, points, kind, 0)
}

fn surface_by_seed(dim: usize, points: &[f64], kind: SurfaceKind, seed: u64) -> (Mesh, Surface) {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, dim).unwrap();
    let options = Options { algorithm: Algorithm::Delaunay, seed, ..Options::default() };
    mesh.run(&options, None).unwrap();
    let triangulation = mesh.result().unwrap();
    let surface = Surface::through(triangulation, kind).unwrap();
    let report = surface.validate(mesh.inputs(), triangulation).unwrap();
    assert_eq!((report.violations, &report.first), (0, &None));
    (mesh, surface)
}

fn genera(surface: &Surface) -> Vec<u64> {
    surface.shells.iter().map(|shell| shell.genus).collect()
}

/// Returns the triangles of a surface with the least vertex first, sorted.
pub fn turned(surface: &Surface) -> Vec<[u32; 3]> {
    let turn = |facet: &[u32]| {
        let least = (0..3).min_by_key(|&k| facet[k]).unwrap();
        [0, 1, 2].map(|k| facet[(least + k) % 3])
    };
    let mut triangles: Vec<[u32; 3]> = surface.facets.chunks_exact(3).map(turn).collect();
    triangles.sort_unstable();
    triangles
}

/// Returns points spread evenly over a sphere (a Fibonacci lattice).
pub fn sphere(count: usize, radius: f64) -> Vec<f64> {
    let golden = PI * (3.0 - 5f64.sqrt());
    let point = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cos, r * sin, z].map(|x| x * radius)
    };
    (0..count).flat_map(point).collect()
}

/// Returns random points of a torus of radii 1 and 0.4.
fn torus(count: usize) -> Vec<f64> {
    let mut random = SplitMix(7);
    let mut points = Vec::new();
    while points.len() < 3 * count {
        let [u, v, w] = [0; 3].map(|_| random.unit());
        let (sin, cos) = (PI * v).sin_cos();
        let reach = 1.0 + 0.4 * cos;
        // As many points as there is area.
        if w.abs() * 1.4 < reach {
            let (s, c) = (PI * u).sin_cos();
            points.extend([reach * c, reach * s, 0.4 * sin]);
        }
    }
    points
}

#[test]
pub fn spheres_and_tori_have_their_topology() {
    let (mesh, surface) = surface_through(3, &sphere(500, 1.0));
    assert_eq!((genera(&surface), surface.left_out.len()), (vec![0], 0));
    let volume = surface.volume(mesh.result().unwrap()).unwrap();
    assert!((volume / (4.0 / 3.0 * PI) - 1.0).abs() < 0.02, "{volume}");
    let (_, surface) = surface_through(3, &torus(3000));
    assert_eq!((genera(&surface), surface.left_out.len()), (vec![1], 0));
}

#[test]
fn what_is_inside_a_shell_may_be_a_void() {
    let points = [sphere(500, 1.0), sphere(300, 0.7)].concat();
    let (mesh, surface) = surface_through(3, &points);
    assert_eq!((genera(&surface), surface.left_out.len()), (vec![0, 0], 0));
    let volume = surface.volume(mesh.result().unwrap()).unwrap();
    let expected = 4.0 / 3.0 * PI * (1.0 - 0.7f64.powi(3));
    assert!((volume / expected - 1.0).abs() < 0.03, "{volume}");
}

#[test]
fn corners_of_boxes_are_enough() {
    let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2].map(|x| x as f64);
    let cube: Vec<f64> = (0..8).flat_map(corner).collect();
    let (mesh, surface) = surface_through(3, &cube);
    assert_eq!((surface.facets.len(), genera(&surface)), (36, vec![0]));
    let volume = surface.volume(mesh.result().unwrap()).unwrap();
    assert!((volume - 1.0).abs() < 1e-15, "{volume}");
    // The lattice points of the faces of a cube of 10 units, nearly all cospherical with others.
    let lattice = (0..1331).map(|i| [i % 11, i / 11 % 11, i / 121]);
    let is_on_face = |p: &[i32; 3]| p.iter().any(|&x| x == 0 || x == 10);
    let faces: Vec<f64> = lattice.filter(is_on_face).flat_map(|p| p.map(f64::from)).collect();
    let (mesh, surface) = surface_through(3, &faces);
    assert_eq!((genera(&surface), surface.left_out.len()), (vec![0], 0));
    let volume = surface.volume(mesh.result().unwrap()).unwrap();
    assert!((volume - 1000.0).abs() < 1e-9, "{volume}");
}

#[test]
fn outliers_and_noise_are_left_out() {
    let mut random = SplitMix(3);
    let outliers: Vec<f64> = (0..30).map(|_| 3.0 * random.unit()).collect();
    let is_far = |p: &&[f64]| (p.iter().map(|x| x * x).sum::<f64>().sqrt() - 1.0).abs() > 0.2;
    let outliers: Vec<f64> = outliers.chunks(3).filter(is_far).flatten().copied().collect();
    let points = [sphere(1000, 1.0), outliers.clone()].concat();
    let (_, surface) = surface_through(3, &points);
    let expected: Vec<u32> = (1000..1000 + outliers.len() as u32 / 3).collect();
    assert_eq!((genera(&surface), surface.left_out), (vec![0], expected));
    // Noise of a tenth of the distance between points.
    let mut noisy = sphere(3000, 1.0);
    let distance = (4.0 * PI / 3000.0).sqrt();
    noisy.iter_mut().for_each(|x| *x += 0.1 * distance * random.unit());
    let (_, surface) = surface_through(3, &noisy);
    assert_eq!(genera(&surface), [0]);
    assert!(surface.left_out.len() < 60, "{}", surface.left_out.len());
}

#[test]
fn curves_close_in_the_plane() {
    let circle = |count: usize, radius: f64, x: f64| {
        (0..count).flat_map(move |i| {
            let (sin, cos) = (TAU * i as f64 / count as f64).sin_cos();
            [x + radius * cos, radius * sin]
        })
    };
    let points: Vec<f64> =
        circle(100, 1.0, 0.0).chain(circle(50, 0.5, 0.1)).chain(circle(7, 0.3, 5.0)).collect();
    let (_, surface) = surface_through(2, &points);
    let lengths: Vec<u64> = surface.shells.iter().map(|shell| shell.facets).collect();
    assert_eq!((lengths, surface.left_out.len()), (vec![100, 50, 7], 0));
    for edge in surface.facets.chunks_exact(2) {
        let apart = edge[0].abs_diff(edge[1]);
        assert!([1, 99, 49, 6].contains(&apart), "{edge:?}");
    }
}

#[test]
fn lengths_may_be_any() {
    let points = sphere(200, 1.0);
    let (_, expected) = surface_through(3, &points);
    for exponent in [-1060, -600, 600, 1020] {
        let factor = |x: &f64| x * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        let scaled: Vec<f64> = points.iter().map(factor).collect();
        let (_, surface) = surface_through(3, &scaled);
        assert_eq!(genera(&surface), [0]);
        if exponent > -1000 {
            assert_eq!(turned(&surface), turned(&expected));
        }
    }
}

#[test]
fn any_points_give_a_manifold() {
    let mut random = SplitMix(11);
    for trial in 0..40 {
        let count = 10 + 5 * trial;
        let point = |i: usize| -> [f64; 3] {
            let [x, y, z] = [0; 3].map(|_| random.unit());
            match trial % 5 {
                0 => [x, y, z],
                1 => [x, y, z].map(|x| (4.0 * x).round()),
                // Two skew lines.
                2 if i % 2 == 0 => [x, 0.0, 0.0],
                2 => [0.0, y, 1.0],
                3 => [x, y, 1e-9 * z],
                _ => [x, y, (x + y).abs()],
            }
        };
        let points: Vec<f64> = (0..count).flat_map(point).collect();
        surface_through(3, &points);
        surface_of(3, &points, SurfaceKind::Open);
        let plane: Vec<f64> = points.chunks(3).flat_map(|p| [p[0], p[1]]).collect();
        if trial % 5 != 2 {
            surface_through(2, &plane);
            surface_of(2, &plane, SurfaceKind::Open);
        }
    }
}

/// Not even with a far outlier, beside which all points share a few cells, and lattices, in which
/// many points are on one sphere or circle.
#[test]
fn neither_the_order_of_points_nor_the_seed_counts() {
    let mut random = SplitMix(12);
    let mut noisy = sphere(600, 1.0);
    noisy.iter_mut().for_each(|x| *x += 0.15 * (random.unit() - 0.5));
    let lattice = (0..343).map(|i| [i % 7, i / 7 % 7, i / 49]);
    let is_on_face = |p: &[i32; 3]| p.iter().any(|&x| x == 0 || x == 6);
    let faces = lattice.filter(is_on_face).flat_map(|p| p.map(f64::from)).collect();
    let outlier = [noisy.clone(), vec![1e7, 5e5, 9e6]].concat();
    // Whole points in a ring: many on each circle, and no curve through them is plain.
    let is_in_ring = |[x, y]: &[i32; 2]| (49..=81).contains(&(x * x + y * y));
    let ring = (0..361).map(|i| [i % 19 - 9, i / 19 - 9]).filter(is_in_ring);
    let ring: Vec<f64> = ring.flat_map(|p| p.map(f64::from)).collect();
    for (dim, points, kind) in [
        (3, noisy, SurfaceKind::Closed),
        (3, outlier, SurfaceKind::Open),
        (3, faces, SurfaceKind::Closed),
        (2, ring.clone(), SurfaceKind::Closed),
        (2, ring, SurfaceKind::Open),
    ] {
        let facets = |points: &[f64], seed: u64| {
            let (_, surface) = surface_by_seed(dim, points, kind, seed);
            let at = |vertex: &u32| points[dim * *vertex as usize..][..dim].to_vec();
            let mut facets: Vec<Vec<Vec<f64>>> = (surface.facets.chunks_exact(dim))
                .map(|facet| {
                    let mut corners: Vec<_> = facet.iter().map(at).collect();
                    // Shells with one side have no direction.
                    corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
                    corners
                })
                .collect();
            facets.sort_by(|a, b| a.partial_cmp(b).unwrap());
            facets
        };
        let expected = facets(&points, 0);
        for seed in 1..5 {
            let mut order: Vec<usize> = (0..points.len() / dim).collect();
            for at in (1..order.len()).rev() {
                order.swap(at, random.next_word() as usize % (at + 1));
            }
            let permuted: Vec<f64> =
                order.iter().flat_map(|&at| points[dim * at..][..dim].to_vec()).collect();
            assert!(facets(&permuted, seed) == expected, "{dim} {kind:?} {seed}");
        }
    }
}

#[test]
fn other_dimensions_are_refused() {
    let points: Vec<f64> = (0..24).map(|i| f64::from(i * i % 17)).collect();
    let mut mesh = Mesh::new(4, 6, &points, 4).unwrap();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    mesh.run(&options, None).unwrap();
    let error = Surface::through(mesh.result().unwrap(), SurfaceKind::Open).unwrap_err();
    assert!(error.message().contains("the mesh has 4 dimensions"), "{error:?}");
}
