use crate::error::ErrorKind;
use crate::mesh::{Inputs, Triangulation};
use crate::netmesh::run;
use crate::numerics::testing::{FAMILIES, Random, points};
use crate::options::{Algorithm, NetOrdering, Options};
use crate::validate::validate;

fn inputs(points: &[[f64; 2]]) -> Inputs {
    Inputs::new(2, points.len(), points.as_flattened(), 0).unwrap()
}

fn plain(inputs: &Inputs, seed: u64) -> Triangulation {
    let options = Options { algorithm: Algorithm::Delaunay, seed, ..Options::default() };
    run(inputs, None, &options, None).unwrap()
}

/// Returns the triangles by their vertices, each with the least vertex first.
fn triangles(of: &Triangulation) -> Vec<[u32; 3]> {
    let mut found: Vec<[u32; 3]> = of
        .simplices
        .chunks_exact(3)
        .map(|corners| {
            let least = (0..3).min_by_key(|&at| corners[at]).unwrap();
            [0, 1, 2].map(|after| corners[(least + after) % 3])
        })
        .collect();
    found.sort_unstable();
    found
}

#[track_caller]
fn assert_certified(points: &[[f64; 2]], seed: u64) -> Triangulation {
    let inputs = inputs(points);
    let made = plain(&inputs, seed);
    let report = validate(&inputs, &made, 3).unwrap();
    assert_eq!((report.violations, report.level), (0, 3), "{:?}", report.first);
    made
}

#[test]
fn hard_points_are_certified() {
    for family in FAMILIES {
        for trial in 0..40 {
            let mut random = Random(1000 * family as u64 + trial);
            let given = points::<2>(family, 3 + 7 * trial as usize, &mut random);
            let distinct = inputs(&given);
            let options =
                Options { algorithm: Algorithm::Delaunay, seed: trial, ..Options::default() };
            match run(&distinct, None, &options, None) {
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
fn grids_circles_and_lines_are_certified() {
    let grid = |n: i32, scale: f64| -> Vec<[f64; 2]> {
        (0..n * n).map(|at| [f64::from(at % n) * scale, f64::from(at / n) * scale]).collect()
    };
    let pythagorean = [(3, 4), (4, 3), (0, 5), (5, 0)].into_iter().flat_map(|(x, y)| {
        [(x, y), (-x, y), (x, -y), (-x, -y)].map(|(x, y)| [f64::from(x), f64::from(y)])
    });
    let circle: Vec<[f64; 2]> = pythagorean.collect();
    let mut comb = vec![[0.5, 1.0]];
    comb.extend((0..100).map(|x| [f64::from(x), 0.0]));
    let far: Vec<[f64; 2]> = (0..60)
        .flat_map(|k| [[2f64.powi(17 * k - 500), 0.0], [0.0, 2f64.powi(17 * k - 500)]])
        .chain([[-1e-320, -1e-320], [1e308, 1e308], [-1e308, 1e308]])
        .collect();
    for seed in 0..4 {
        for points in [
            grid(23, 1.0),
            grid(9, 1e-320),
            grid(9, 1e300),
            circle.clone(),
            comb.clone(),
            far.clone(),
        ] {
            assert_certified(&points, seed);
        }
    }
}

#[test]
fn numbers_of_triangles_are_those_of_the_hull() {
    let mut random = Random(7);
    let points: Vec<[f64; 2]> = (0..5000).map(|_| [random.unit(), random.unit()]).collect();
    let made = assert_certified(&points, 0);
    let hull = made.neighbors.iter().filter(|&&neighbor| neighbor == crate::mesh::NONE).count();
    assert_eq!(made.simplex_count(), 2 * points.len() - 2 - hull);
    assert_eq!(made.stats.input_vertices, 5000);
    assert!(made.stats.touches < 5000 * 40 && made.stats.max_touches < 500, "{:?}", made.stats);
}

/// Without four points on a circle there is one triangulation, whatever the order.
#[test]
fn orders_agree_where_there_is_no_choice() {
    let mut random = Random(11);
    let points: Vec<[f64; 2]> = (0..3000).map(|_| [random.unit(), random.unit()]).collect();
    let inputs = inputs(&points);
    let expected = triangles(&plain(&inputs, 0));
    assert!((1..4).all(|seed| triangles(&plain(&inputs, seed)) == expected));
    let measured = Options {
        algorithm: Algorithm::Delaunay,
        instruments: true,
        ordering: NetOrdering::DeterministicNet,
        ..Options::default()
    };
    let measured = run(&inputs, None, &measured, None).unwrap();
    assert_eq!(triangles(&measured), expected);
    assert!(measured.stats.max_ply > 0);
}

#[test]
fn instruments_leave_the_triangulation_as_it_is() {
    let grid: Vec<[f64; 2]> = (0..400).map(|at| [f64::from(at % 20), f64::from(at / 20)]).collect();
    let inputs = inputs(&grid);
    let options =
        Options { algorithm: Algorithm::Delaunay, instruments: true, ..Options::default() };
    let measured = run(&inputs, None, &options, None).unwrap();
    assert_eq!(measured.simplices, plain(&inputs, 0).simplices);
}

#[test]
fn points_on_a_line_are_refused() {
    let points: Vec<[f64; 2]> = (0..9).map(|x| [f64::from(x), f64::from(2 * x)]).collect();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let error = run(&inputs(&points), None, &options, None).unwrap_err();
    let expected =
        "the points have affine rank 1; a Delaunay triangulation in dimension 2 needs rank 2";
    assert_eq!((error.kind(), error.message()), (ErrorKind::DegenerateInput, expected));
}

#[test]
fn a_run_is_watched_and_cancelled() {
    let mut random = Random(3);
    let points: Vec<[f64; 2]> = (0..200_000).map(|_| [random.unit(), random.unit()]).collect();
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let mut last = 0.0;
    let mut told = |progress: &crate::options::Progress| {
        assert!(progress.fraction >= last);
        last = progress.fraction;
        last < 0.3
    };
    let error = run(&inputs(&points), None, &options, Some(&mut told)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    assert!(last < 0.9, "{last}");
}
