use super::super::testing::{
    assert_certified, assert_hard_points_are_certified, assert_rank_is_refused, assert_watched,
    inputs, options, plain, uniform,
};
use crate::mesh::{NONE, Triangulation};
use crate::netmesh::run;
use crate::options::{NetOrdering, Options};

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

#[test]
fn hard_points_are_certified() {
    assert_hard_points_are_certified::<2>(280);
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
    let points = uniform::<2>(5000, 7);
    let made = assert_certified(&points, 0);
    let hull = made.neighbors.iter().filter(|&&neighbor| neighbor == NONE).count();
    assert_eq!(made.simplex_count(), 2 * points.len() - 2 - hull);
    assert_eq!(made.stats.input_vertices, 5000);
    assert!(made.stats.touches < 5000 * 40 && made.stats.max_touches < 500, "{:?}", made.stats);
}

/// Without four points on a circle there is one triangulation, whatever the order.
#[test]
fn orders_agree_where_there_is_no_choice() {
    let inputs = inputs(&uniform::<2>(3000, 11));
    let expected = triangles(&plain(&inputs, 0, 1));
    assert!((1..4).all(|seed| triangles(&plain(&inputs, seed, 1)) == expected));
    let ordering = NetOrdering::DeterministicNet;
    let measured = Options { instruments: true, ordering, ..options(0, 1) };
    let measured = run(&inputs, None, &measured, None).unwrap();
    assert_eq!(triangles(&measured), expected);
    assert!(measured.stats.max_ply > 0);
}

#[test]
fn instruments_leave_the_triangulation_as_it_is() {
    let grid: Vec<[f64; 2]> = (0..400).map(|at| [f64::from(at % 20), f64::from(at / 20)]).collect();
    let inputs = inputs(&grid);
    let measured = Options { instruments: true, ..options(0, 1) };
    let measured = run(&inputs, None, &measured, None).unwrap();
    assert_eq!(measured.simplices, plain(&inputs, 0, 1).simplices);
}

#[test]
fn points_on_a_line_are_refused() {
    let points: Vec<[f64; 2]> = (0..9).map(|x| [f64::from(x), f64::from(2 * x)]).collect();
    assert_rank_is_refused(&points);
}

#[test]
fn a_run_is_watched_and_cancelled() {
    assert_watched::<2>(200_000, 1);
}
