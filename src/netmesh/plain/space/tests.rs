use crate::error::ErrorKind;
use crate::mesh::{Inputs, NONE, Triangulation};
use crate::netmesh::run;
use crate::numerics::testing::{FAMILIES, Random, points};
use crate::options::{Algorithm, NetOrdering, Options, Progress};
use crate::validate::validate;

fn inputs(points: &[[f64; 3]]) -> Inputs {
    Inputs::new(3, points.len(), points.as_flattened(), 0).unwrap()
}

fn options(seed: u64, threads: u32) -> Options {
    Options { algorithm: Algorithm::Delaunay, seed, threads, ..Options::default() }
}

fn plain(inputs: &Inputs, seed: u64, threads: u32) -> Triangulation {
    run(inputs, None, &options(seed, threads), None).unwrap()
}

fn uniform(count: usize, seed: u64) -> Vec<[f64; 3]> {
    let mut random = Random(seed);
    (0..count).map(|_| [0, 1, 2].map(|_| random.unit())).collect()
}

fn grid(side: i32, scale: f64) -> Vec<[f64; 3]> {
    (0..side * side * side)
        .map(|at| [at % side, at / side % side, at / side / side].map(|x| f64::from(x) * scale))
        .collect()
}

/// Returns points of small integers on one sphere.
fn cospherical() -> Vec<[f64; 3]> {
    let mut found = Vec::new();
    for at in 0..31 * 31 * 31 {
        let point = [at % 31, at / 31 % 31, at / 961].map(|x| x - 15);
        if point.iter().map(|x| x * x).sum::<i32>() == 225 {
            found.push(point.map(f64::from));
        }
    }
    assert!(found.len() > 100);
    found
}

#[track_caller]
fn assert_certified(points: &[[f64; 3]], seed: u64) -> Triangulation {
    let inputs = inputs(points);
    let made = plain(&inputs, seed, 1);
    let report = validate(&inputs, &made, 3).unwrap();
    assert_eq!((report.violations, report.level), (0, 3), "{:?}", report.first);
    made
}

#[test]
fn hard_points_are_certified() {
    for family in FAMILIES {
        for trial in 0..30 {
            let mut random = Random(1000 * family as u64 + trial);
            let given = points::<3>(family, 4 + 5 * trial as usize, &mut random);
            let distinct = inputs(&given);
            match run(&distinct, None, &options(trial, 1), None) {
                Ok(made) => {
                    let report = validate(&distinct, &made, 3).unwrap();
                    assert_eq!((report.violations, report.level), (0, 3), "{family:?} {trial}");
                }
                Err(error) => assert_eq!(error.kind(), ErrorKind::DegenerateInput, "{error:?}"),
            }
        }
    }
}

#[test]
fn grids_spheres_and_lines_are_certified() {
    let mut skew: Vec<[f64; 3]> = (0..40).map(|x| [f64::from(x), 0.0, 0.0]).collect();
    skew.extend((0..40).map(|y| [0.5, f64::from(y), 1.0]));
    let mut comb = vec![[0.5, 1.0, 0.0], [0.5, 0.0, 1.0]];
    comb.extend((0..100).map(|x| [f64::from(x), 0.0, 0.0]));
    let far: Vec<[f64; 3]> = (0..40)
        .map(|k| 2f64.powi(25 * k - 500))
        .flat_map(|x| [[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]])
        .chain([[-1e-320; 3], [1e308; 3], [-1e308, 1e308, 0.0]])
        .collect();
    for seed in 0..3 {
        for points in [
            grid(7, 1.0),
            grid(5, 1e-320),
            grid(5, 1e300),
            cospherical(),
            skew.clone(),
            comb.clone(),
            far.clone(),
        ] {
            assert_certified(&points, seed);
        }
    }
}

/// Also where points are on one sphere nothing depends on the rounds or the threads.
#[test]
fn neither_seed_nor_threads_change_a_byte() {
    let mut many = uniform(25_000, 1);
    many.extend(grid(18, 1.0 / 17.0));
    many.extend(cospherical().iter().map(|x| x.map(|x| 0.5 + x / 64.0)));
    for points in [many, uniform(300, 2), grid(9, 1.0), cospherical()] {
        let inputs = inputs(&points);
        let expected = plain(&inputs, 0, 1);
        let ordering = NetOrdering::DeterministicNet;
        let ordered = run(&inputs, None, &Options { ordering, ..options(5, 1) }, None).unwrap();
        for other in [plain(&inputs, 1, 1), plain(&inputs, 0, 2), plain(&inputs, 7, 5), ordered] {
            assert_eq!(other.simplices, expected.simplices);
            assert_eq!(other.neighbors, expected.neighbors);
        }
    }
}

#[test]
fn simplices_are_sorted_and_neighbors_are_opposite() {
    let made = assert_certified(&uniform(2000, 3), 0);
    let neighbors = made.neighbors.chunks_exact(4);
    for (simplex, (corners, neighbors)) in made.simplices.chunks_exact(4).zip(neighbors).enumerate()
    {
        for (corner, &neighbor) in corners.iter().zip(neighbors).filter(|(_, n)| **n != NONE) {
            let others = &made.simplices[4 * neighbor as usize..][..4];
            assert!(!others.contains(corner));
            assert_eq!(corners.iter().filter(|corner| others.contains(corner)).count(), 3);
            assert_ne!(neighbor as usize, simplex);
        }
    }
}

#[test]
fn instruments_measure_and_leave_the_triangulation_as_it_is() {
    let inputs = inputs(&grid(6, 1.0));
    let measured = Options { instruments: true, ..options(0, 1) };
    let measured = run(&inputs, None, &measured, None).unwrap();
    assert_eq!(measured.simplices, plain(&inputs, 0, 1).simplices);
    assert!(measured.stats.max_ply > 0);
}

#[test]
fn points_on_a_plane_are_refused() {
    let points: Vec<[f64; 3]> = (0..9).map(|x| [x, x * x, 2 * x].map(f64::from)).collect();
    let error = run(&inputs(&points), None, &options(0, 1), None).unwrap_err();
    let expected =
        "the points have affine rank 2; a Delaunay triangulation in dimension 3 needs rank 3";
    assert_eq!((error.kind(), error.message()), (ErrorKind::DegenerateInput, expected));
}

#[test]
fn a_run_is_watched_and_cancelled() {
    for threads in [1, 2] {
        let mut last = 0.0;
        let mut told = |progress: &Progress| {
            assert!(progress.fraction >= last);
            last = progress.fraction;
            last < 0.3
        };
        let inputs = inputs(&uniform(60_000, 4));
        let error = run(&inputs, None, &options(0, threads), Some(&mut told)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cancelled);
        assert!(last < 1.0, "{last}");
    }
}

/// Returns the simplices by the coordinates of their corners, and those sorted.
fn by_coordinates(points: &[[f64; 3]]) -> Vec<[[f64; 3]; 4]> {
    let made = plain(&inputs(points), 0, 1);
    let corners = |simplex: &[u32]| {
        let mut corners = [0, 1, 2, 3].map(|at| points[simplex[at] as usize]);
        corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
        corners
    };
    let mut simplices: Vec<_> = made.simplices.chunks_exact(4).map(corners).collect();
    simplices.sort_by(|a, b| a.partial_cmp(b).unwrap());
    simplices
}

#[test]
fn the_order_of_inputs_does_not_count() {
    for mut points in [grid(7, 1.0), cospherical(), uniform(500, 9)] {
        let expected = by_coordinates(&points);
        points.reverse();
        points.rotate_left(17);
        assert!(by_coordinates(&points) == expected);
    }
}
