//! Meshes of any points with any options: the certificate holds, or a documented refusal changes
//! nothing.

use super::bytes::Bytes;
use super::families;
use super::settings::Settings;
use super::triangulations::{assert_same, bits};
use netmesh::quality::measure;
use netmesh::validate::validate_mesh;
use netmesh::{Algorithm, ErrorKind, Mesh, Options};
use std::collections::HashSet;

/// Largest number of points, by dimension from 2.
const MAX_POINTS: [u8; 3] = [24, 20, 14];

/// Checks a mesh. The bytes pick the dimension, the options, a family of points, and the points.
pub fn check(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let dim = 2 + bytes.below(3);
    let settings = Settings::new(&mut bytes, dim);
    let count = 1 + bytes.below(MAX_POINTS[dim - 2]);
    let points = match bytes.once_in(64) {
        true => (0..count * dim).map(|_| bytes.double()).collect(),
        false => families::points(&mut bytes, dim, count),
    };
    check_points(dim, &points, &settings);
}

/// Makes and runs a mesh, twice and within one vertex less; returns true if it was meshed.
pub fn check_points(dim: usize, points: &[f64], settings: &Settings) -> bool {
    let made = Mesh::new(dim, points.len() / dim, points, 0);
    let expected = refusal_of_points(dim, points);
    assert_eq!(made.as_ref().err().map(|error| error.kind()), expected);
    let Ok(mut mesh) = made else { return false };
    let meshed = check_run(&mut mesh, settings);
    if meshed {
        check_certificate(&mesh);
        check_repetition(&mesh, &settings.options);
        check_limit(&mut mesh, &settings.options);
    }
    meshed
}

/// Returns the kind of the error for points that cannot be meshed.
pub fn refusal_of_points(dim: usize, points: &[f64]) -> Option<ErrorKind> {
    if points.iter().any(|x| !x.is_finite()) {
        return Some(ErrorKind::NonFinite);
    }
    // Zeros of either sign are equal.
    let distinct: HashSet<Vec<u64>> = points
        .chunks_exact(dim)
        .map(|point| point.iter().map(|x| (x + 0.0).to_bits()).collect())
        .collect();
    (distinct.len() < 2).then_some(ErrorKind::DegenerateInput)
}

/// Runs; a refusal must be one that the options allow.
fn check_run(mesh: &mut Mesh, settings: &Settings) -> bool {
    let Settings { options, valid } = settings;
    match mesh.run(options, None) {
        Ok(()) => {
            assert!(valid, "accepted {options:?}");
            true
        }
        Err(error) => {
            let expected = match error.kind() {
                ErrorKind::InvalidArgument => !valid,
                ErrorKind::DegenerateInput => options.algorithm == Algorithm::Delaunay,
                ErrorKind::Limit => true,
                _ => false,
            };
            assert!(expected && (*valid || error.kind() == ErrorKind::InvalidArgument), "{error}");
            assert!(mesh.triangulation().is_none(), "a failed run left a result");
            false
        }
    }
}

fn check_certificate(mesh: &Mesh) {
    let result = mesh.triangulation().expect("it was meshed");
    let report = validate_mesh(mesh, 3).expect("the level is right");
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    let limited = result.precision_limited.iter().filter(|&&marked| marked).count();
    let quality = measure(result).expect("there is memory");
    assert_eq!(quality.precision_limited, limited as u64);
    let stats = &result.stats;
    assert_eq!(stats.precision_limited, limited as u64);
    let made = stats.cage_points + stats.far_corners + stats.off_centers;
    assert_eq!(stats.input_vertices + made, result.vertex_count() as u64);
    let inputs = bits(&mesh.inputs().distinct_points());
    assert!(bits(&result.points)[..inputs.len()] == inputs, "inputs changed");
}

/// Checks that equal points and options give equal meshes, for any number of threads.
pub fn check_repetition(mesh: &Mesh, options: &Options) {
    let mut again = mesh.clone();
    let options = Options { threads: options.threads + 1, ..options.clone() };
    again.run(&options, None).expect("it was meshed before");
    let results = [mesh, &again].map(|mesh| mesh.triangulation().expect("it was meshed"));
    assert_same(results[0], results[1]);
}

/// Checks that a run which may not make as many vertices answers `Limit` and leaves the result.
pub fn check_limit(mesh: &mut Mesh, options: &Options) {
    let before = mesh.triangulation().expect("it was meshed").clone();
    let max_vertices = before.vertex_count() as u64 - 1;
    let refused = mesh.run(&Options { max_vertices, ..options.clone() }, None);
    assert_eq!(refused.err().map(|error| error.kind()), Some(ErrorKind::Limit));
    assert_same(mesh.triangulation().expect("it was meshed"), &before);
}
