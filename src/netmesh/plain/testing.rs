//! Plain triangulations of the plane and of space, for tests of both.

use crate::error::ErrorKind;
use crate::mesh::{Inputs, NONE, Triangulation};
use crate::netmesh::run;
use crate::numerics::testing::{FAMILIES, Random, points};
use crate::options::{Algorithm, NetOrdering, Options, Progress};
use crate::validate::validate;

pub fn inputs<const D: usize>(points: &[[f64; D]]) -> Inputs {
    Inputs::new(D, points.len(), points.as_flattened(), 0).unwrap()
}

pub fn options(seed: u64, threads: u32) -> Options {
    Options { algorithm: Algorithm::Delaunay, seed, threads, ..Options::default() }
}

pub fn plain(inputs: &Inputs, seed: u64, threads: u32) -> Triangulation {
    run(inputs, None, &options(seed, threads), None).unwrap()
}

/// Returns points that are uniform in a cube.
pub fn uniform<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut random = Random(seed);
    (0..count).map(|_| std::array::from_fn(|_| random.unit())).collect()
}

#[track_caller]
fn certify(inputs: &Inputs, made: &Triangulation) {
    let report = validate(inputs, made, 3).unwrap();
    assert_eq!((report.violations, report.level), (0, 3), "{:?}", report.first);
}

#[track_caller]
pub fn assert_certified<const D: usize>(points: &[[f64; D]], seed: u64) -> Triangulation {
    let inputs = inputs(points);
    let made = plain(&inputs, seed, 1);
    certify(&inputs, &made);
    made
}

/// Certifies triangulations of up to some `most` points of all families.
pub fn assert_hard_points_are_certified<const D: usize>(most: usize) {
    const TRIALS: usize = 30;
    for family in FAMILIES {
        for trial in 0..TRIALS {
            let mut random = Random((1000 * family as usize + trial) as u64);
            let given = points::<D>(family, D + 1 + most * trial / TRIALS, &mut random);
            let inputs = inputs(&given);
            match run(&inputs, None, &options(trial as u64, 1), None) {
                Ok(made) => certify(&inputs, &made),
                Err(error) => assert_eq!(error.kind(), ErrorKind::DegenerateInput, "{error:?}"),
            }
        }
    }
}

/// Asserts that each neighbour of a simplex has all corners but the one that it is opposite to.
pub fn assert_neighbors_are_opposite<const D: usize>() {
    let made = assert_certified(&uniform::<D>(2000, 3), 0);
    let rows = made.simplices.chunks_exact(D + 1).zip(made.neighbors.chunks_exact(D + 1));
    for (simplex, (corners, neighbors)) in rows.enumerate() {
        for (corner, &neighbor) in corners.iter().zip(neighbors).filter(|(_, n)| **n != NONE) {
            let others = &made.simplices[(D + 1) * neighbor as usize..][..D + 1];
            assert!(!others.contains(corner));
            assert_eq!(corners.iter().filter(|corner| others.contains(corner)).count(), D);
            assert_ne!(neighbor as usize, simplex);
        }
    }
}

/// Asserts that neither the seed nor the ordering nor threads change the result.
#[track_caller]
pub fn assert_same_bytes<const D: usize>(points: &[[f64; D]]) {
    let inputs = inputs(points);
    let expected = plain(&inputs, 0, 1);
    let ordering = NetOrdering::DeterministicNet;
    let ordered = run(&inputs, None, &Options { ordering, ..options(5, 1) }, None).unwrap();
    for other in [plain(&inputs, 1, 1), plain(&inputs, 0, 2), plain(&inputs, 7, 5), ordered] {
        assert_eq!(other.simplices, expected.simplices);
        assert_eq!(other.neighbors, expected.neighbors);
    }
}

/// Returns the simplices by the coordinates of their corners, and those sorted.
fn by_coordinates<const D: usize>(points: &[[f64; D]]) -> Vec<Vec<[f64; D]>> {
    let made = plain(&inputs(points), 0, 1);
    let corners = |simplex: &[u32]| {
        let mut corners: Vec<_> = simplex.iter().map(|&corner| points[corner as usize]).collect();
        corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
        corners
    };
    let mut simplices: Vec<_> = made.simplices.chunks_exact(D + 1).map(corners).collect();
    simplices.sort_by(|a, b| a.partial_cmp(b).unwrap());
    simplices
}

/// Asserts that points make the same simplices in whatever order they are given.
#[track_caller]
pub fn assert_order_does_not_count<const D: usize>(mut points: Vec<[f64; D]>) {
    let expected = by_coordinates(&points);
    points.reverse();
    assert_eq!(by_coordinates(&points), expected);
    let mut random = Random(5);
    for at in (1..points.len()).rev() {
        points.swap(at, random.integer(0, at as i64) as usize);
    }
    assert_eq!(by_coordinates(&points), expected);
}

/// Asserts that points of a lower affine rank are refused.
pub fn assert_rank_is_refused<const D: usize>(points: &[[f64; D]]) {
    let error = run(&inputs(points), None, &options(0, 1), None).unwrap_err();
    let expected = format!(
        "the points have affine rank {}; a Delaunay triangulation in dimension {D} needs rank {D}",
        D - 1
    );
    assert_eq!((error.kind(), error.message()), (ErrorKind::DegenerateInput, &*expected));
}

/// Asserts that a run of uniform points tells its progress, and ends where it is cancelled.
pub fn assert_watched<const D: usize>(count: usize, threads: u32) {
    let mut last = 0.0;
    let mut told = |progress: &Progress| {
        assert!(progress.fraction >= last);
        last = progress.fraction;
        last < 0.3
    };
    let inputs = inputs(&uniform::<D>(count, 3));
    let error = run(&inputs, None, &options(0, threads), Some(&mut told)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    assert!(last < 1.0, "{last}");
}
