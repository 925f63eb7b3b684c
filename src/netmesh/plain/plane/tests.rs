use super::super::testing::{
    assert_certified, assert_hard_points_are_certified, assert_neighbors_are_opposite,
    assert_order_does_not_count, assert_rank_is_refused, assert_same_bytes, assert_watched, inputs,
    options, plain, uniform,
};
use crate::mesh::NONE;
use crate::netmesh::run;
use crate::options::Options;

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

/// Returns all 324 whole points of a circle.
fn circle() -> Vec<[f64; 2]> {
    const RADIUS: i32 = 5 * 13 * 17 * 29;
    let at = |x: f64| {
        let y = (f64::from(RADIUS).powi(2) - x * x).sqrt();
        let both = if y == 0.0 { vec![[x, y]] } else { vec![[x, y], [x, -y]] };
        if y.fract() == 0.0 { both } else { Vec::new() }
    };
    (-RADIUS..=RADIUS).map(f64::from).flat_map(at).collect()
}

/// Points on circles and grids have one triangulation, too.
#[test]
fn neither_seed_nor_order_change_the_triangulation() {
    assert_eq!(circle().len(), 324);
    let grid = |n: i32| (0..n * n).map(move |at| [f64::from(at % n), f64::from(at / n)]);
    for points in [grid(23).collect(), circle(), uniform(3000, 11)] {
        assert_same_bytes(&points);
        assert_order_does_not_count(points);
    }
}

#[test]
fn neighbors_are_opposite_their_corners() {
    assert_neighbors_are_opposite::<2>();
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
