//! Lattices of every dimension, tilted in spaces of every dimension that hold them: inputs without
//! any interior, on which all signs are zero or, where the tilt rounds, nearly so.

use super::for_all;
use netmesh::validate::validate;
use netmesh::{Mesh, Options};
use proptest::collection::vec;
use proptest::prelude::*;

/// The most points of a lattice, by the dimension of the space from 2.
const MAX_POINTS: [usize; 4] = [49, 36, 20, 12];

/// Lattices of `rank` directions in dimension `dim`, at any power of two's scale. Integer
/// directions make exactly flat points; others are rounded off the subspace.
fn lattices(dim: usize, rank: usize) -> impl Strategy<Value = Vec<f64>> {
    let exact = vec((-5..=5i32).prop_map(f64::from), rank * dim);
    let rounded = vec(-5.0..5.0, rank * dim);
    let directions = prop_oneof![exact, rounded];
    let start = vec((-9..=9i32).prop_map(f64::from), dim);
    (directions, start, -900..900i32)
        .prop_map(move |(directions, start, exponent)| {
            lattice(dim, rank, &directions, &start, 2f64.powi(exponent))
        })
        .prop_filter("two points must be distinct", move |points| {
            points.chunks_exact(dim).any(|point| point != &points[..dim])
        })
}

fn lattice(dim: usize, rank: usize, directions: &[f64], start: &[f64], scale: f64) -> Vec<f64> {
    let most = MAX_POINTS[dim - 2];
    let side = (2..).take_while(|side: &usize| side.pow(rank as u32) <= most).last().unwrap_or(2);
    let mut points = Vec::new();
    for index in 0..side.pow(rank as u32) {
        for axis in 0..dim {
            let along: f64 = (0..rank)
                .map(|k| (index / side.pow(k as u32) % side) as f64 * directions[k * dim + axis])
                .sum();
            points.push((start[axis] + along) * scale);
        }
    }
    points
}

fn lattices_hold(dim: usize, cases: u32) {
    for rank in 1..=dim {
        for_all(cases, lattices(dim, rank), |points| certify(dim, &points));
    }
}

fn certify(dim: usize, points: &[f64]) {
    let mut mesh = Mesh::new(dim, points.len() / dim, points, 0).unwrap();
    mesh.run(&Options { max_vertices: 100_000, ..Options::default() }, None).unwrap();
    let report = validate(mesh.inputs(), mesh.triangulation().unwrap(), 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
}

#[test]
fn flat_lattices_in_the_plane() {
    lattices_hold(2, 40);
}

#[test]
fn flat_lattices_in_space() {
    lattices_hold(3, 15);
}

#[test]
fn flat_lattices_in_four_dimensions() {
    lattices_hold(4, 6);
}

#[test]
fn flat_lattices_in_five_dimensions() {
    lattices_hold(5, 1);
}
