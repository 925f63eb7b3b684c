use super::super::testing::{
    assert_certified, assert_hard_points_are_certified, assert_neighbors_are_opposite,
    assert_order_does_not_count, assert_rank_is_refused, assert_same_bytes, assert_watched, inputs,
    options, plain, uniform,
};
use crate::netmesh::run;
use crate::options::Options;

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

#[test]
fn hard_points_are_certified() {
    assert_hard_points_are_certified::<3>(150);
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
        assert_same_bytes(&points);
    }
}

#[test]
fn neighbors_are_opposite_their_corners() {
    assert_neighbors_are_opposite::<3>();
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
    assert_rank_is_refused(&points);
}

#[test]
fn a_run_is_watched_and_cancelled() {
    assert_watched::<3>(60_000, 1);
    assert_watched::<3>(60_000, 2);
}

#[test]
fn the_order_of_inputs_does_not_count() {
    for points in [grid(7, 1.0), cospherical(), uniform(500, 9)] {
        assert_order_does_not_count(points);
    }
}
