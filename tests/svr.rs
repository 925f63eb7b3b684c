//! Sparse Voronoi Refinement, the baseline: sound meshes whose size follows the logarithm of the
//! spread, where NETMESH's does not.

use crate::random::Random;
use netmesh::validate::validate;
use netmesh::{Algorithm, Criterion, Mesh, Options, Output, Triangulation};

/// Eight points each in concentric shells, from 1 down to 2^-`doublings`.
fn nested_clusters(dim: usize, doublings: i32) -> Vec<f64> {
    const SHELLS: i32 = 16;
    let mut random = Random::new(5);
    let mut points = Vec::new();
    for shell in 0..SHELLS {
        let scale = 2f64.powi(-doublings * shell / SHELLS);
        points.extend((0..8 * dim).map(|_| scale * (2.0 * random.unit() - 1.0)));
    }
    points
}

fn mesh(dim: usize, points: &[f64], options: &Options) -> Triangulation {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(options, None).unwrap();
    let result = mesh.triangulation().unwrap();
    let report = validate(mesh.inputs(), result, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    assert_eq!(result.stats.input_vertices as usize, mesh.inputs().distinct());
    assert_eq!(result.stats.precision_limited, 0);
    result.clone()
}

fn sparse() -> Options {
    Options { algorithm: Algorithm::Svr, ..Options::default() }
}

#[test]
fn meshes_are_sound_and_have_one_domain() {
    let mut random = Random::new(9);
    for dim in 2..=4 {
        let points: Vec<f64> = (0..200 * dim).map(|_| random.unit()).collect();
        for criterion in [Criterion::VoronoiAspect, Criterion::RadiusEdge] {
            for output in [Output::Hierarchical, Output::WellSpaced] {
                let result = mesh(dim, &points, &Options { criterion, output, ..sparse() });
                assert_eq!((result.domains.len(), result.stats.cages_created), (1, 1));
            }
        }
    }
}

#[test]
fn lattices_and_flat_inputs_are_meshed() {
    for dim in 2..=4 {
        let line: Vec<f64> = (0..40 * dim).map(|i| (i / dim) as f64).collect();
        mesh(dim, &line, &sparse());
        let lattice: Vec<f64> = (0..3usize.pow(dim as u32))
            .flat_map(|i| (0..dim as u32).map(move |k| (i / 3usize.pow(k) % 3) as f64))
            .collect();
        mesh(dim, &lattice, &sparse());
    }
}

#[test]
fn the_size_follows_the_logarithm_of_the_spread() {
    for dim in 2..=3 {
        let size = |doublings: i32, options: &Options| {
            mesh(dim, &nested_clusters(dim, doublings), options).vertex_count() as f64
        };
        let sparse_growth = size(512, &sparse()) / size(256, &sparse());
        assert!((1.8..2.2).contains(&sparse_growth), "{dim}D: {sparse_growth}");
        let growth = size(512, &Options::default()) / size(256, &Options::default());
        assert!((0.85..1.15).contains(&growth), "{dim}D: {growth}");
    }
}

/// Among a few units of the smallest double a corner may fall on an input, and the distance within
/// which it yields becomes zero.
#[test]
fn a_corner_at_an_input_is_that_input() {
    let unit = f64::from_bits(1);
    let named = [2.0, 5.0, 5.0, -2.0, 4.0, 0.0].map(|x| x * unit);
    let yields = [0.05, 0.289, 0.7, 1.0];
    let certify = |dim: usize, points: &[f64], options: &Options| {
        let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
        mesh.run(options, None).unwrap_or_else(|error| panic!("{points:?} {options:?}: {error}"));
        let report = validate(mesh.inputs(), mesh.triangulation().unwrap(), 3).unwrap();
        assert_eq!(report.level, 3, "{points:?} {options:?}: {:?}", report.first);
    };
    let mut random = Random::new(11);
    for yield_radius in yields {
        for algorithm in [Algorithm::Svr, Algorithm::Netmesh] {
            let options = Options { algorithm, yield_radius, ..Options::default() };
            certify(2, &named, &options);
            for dim in [2, 2, 2, 3] {
                let points: Vec<f64> =
                    (0..4 * dim).map(|_| unit * (random.unit() * 12.0 - 6.0).round()).collect();
                if points.chunks(dim).any(|point| point != &points[..dim]) {
                    certify(dim, &points, &options);
                }
            }
        }
    }
}
