//! Threads of small stacks make, check, measure and ask meshes, whatever the coordinates. A stack
//! that does not suffice ends the process.

use crate::random::Random;
use netmesh::arrays::Selection;
use netmesh::prepared::Prepared;
use netmesh::query::Among;
use netmesh::validate::validate_mesh;
use netmesh::{Algorithm, Mesh, Options, quality};

/// Bytes of stack that docs/limitations.md asks for, and that musl gives to every thread.
const STACK: usize = 128 << 10;

fn on_a_small_stack(work: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(work);
    thread.expect("a thread").join().expect("the work succeeds");
}

/// Makes a mesh and does with it what takes exact numbers.
fn work(name: &str, dim: usize, points: &[f64], options: &Options) {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(options, None).unwrap_or_else(|error| panic!("{name} in {dim}D: {error}"));
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{name}: {:?}", report.first);
    let result = mesh.triangulation().unwrap();
    quality::measure(result).unwrap();
    let prepared = Prepared::default();
    let index = prepared.index(&mesh).unwrap();
    let count = points.len() / dim;
    let (mut ids, mut distances) = (vec![0; count], vec![0.0; count]);
    index.locate(result, points, 1, &mut ids).unwrap();
    index.nearest(result, Among::Vertices, points, 1, &mut ids, &mut distances).unwrap();
    prepared.part(&mesh, &Selection::default()).unwrap().circumcenters().unwrap();
}

fn options(algorithm: Algorithm) -> Options {
    Options { algorithm, ..Options::default() }
}

/// Coordinates of all exponents, some of them subnormal.
fn of_any_size(dim: usize, count: usize) -> Vec<f64> {
    let mut random = Random::new(dim as u64);
    let mut coordinate = || {
        let exponent = (random.unit() * 2000.0) as u64;
        f64::from_bits(exponent << 52 | (random.unit() * 2f64.powi(52)) as u64)
    };
    (0..dim * count).map(|_| coordinate()).collect()
}

fn lattice(dim: usize, steps: &[f64]) -> Vec<f64> {
    let step = |i: usize, axis: usize| steps[i / steps.len().pow(axis as u32) % steps.len()];
    let point = |i: usize| (0..dim).map(move |axis| step(i, axis));
    (0..steps.len().pow(dim as u32)).flat_map(point).collect()
}

#[test]
fn lattices_need_little_stack() {
    on_a_small_stack(|| {
        for (dim, count) in [(2, 12), (3, 5), (4, 3)] {
            let steps: Vec<f64> = (0..count).map(|i| i as f64 * 0.1).collect();
            let points = lattice(dim, &steps);
            work("a lattice", dim, &points, &options(Algorithm::Netmesh));
            work("a lattice", dim, &points, &options(Algorithm::Delaunay));
        }
    });
}

/// The corners of each box are on a sphere, and no double tells it: differences of coordinates so
/// far apart are inexact.
#[test]
fn boxes_of_any_shape_need_little_stack() {
    on_a_small_stack(|| {
        let mut random = Random::new(3);
        let sizes = [1e-9, 1e-4, 0.1, 1.0, 300.0].map(|size| size * (1.0 + random.unit()));
        for (dim, count) in [(2, 5), (3, 5), (4, 3), (5, 2)] {
            let points = lattice(dim, &sizes[..count]);
            work("boxes", dim, &points, &options(Algorithm::Delaunay));
        }
    });
}

#[test]
fn coordinates_of_any_size_need_little_stack() {
    on_a_small_stack(|| {
        for (dim, count) in [(2, 40), (3, 30), (4, 12)] {
            let points = of_any_size(dim, count);
            work("any exponents", dim, &points, &options(Algorithm::Delaunay));
        }
        for dim in 5..=8 {
            let points = of_any_size(dim, dim + 4);
            work("any exponents", dim, &points, &options(Algorithm::Delaunay));
        }
    });
}
