//! Reaches against brute force: the nearest point of a Voronoi face is in it if no vertex at all is
//! nearer to it, and else in a larger face's.

use super::distance::CellRadii;
use super::{Faces, Filtration, distances};
use crate::arrays::tests::meshed;
use crate::mesh::NONE;
use crate::numerics::testing::{Family, Random, points};
use crate::query::Index;
use crate::{Options, Output};
use std::collections::HashMap;

/// Solves a small system by elimination with pivots.
fn solved(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for at in 0..n {
        let pivot = (at..n).max_by(|&a, &b| rows[a][at].abs().total_cmp(&rows[b][at].abs()));
        rows.swap(at, pivot.unwrap());
        for row in 0..n {
            if row != at {
                let factor = rows[row][at] / rows[at][at];
                (at..=n).for_each(|column| rows[row][column] -= factor * rows[at][column]);
            }
        }
    }
    (0..n).map(|at| rows[at][n] / rows[at][at]).collect()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the point nearest to `input` of those as far from the origin as from the ends of the
/// edges: `input` and a combination of the edges.
fn nearest_at_equal_distance(edges: &[Vec<f64>], input: &[f64]) -> Vec<f64> {
    let rows = edges.iter().map(|edge| {
        let mut row: Vec<f64> = edges.iter().map(|other| product(edge, other)).collect();
        row.push(product(edge, edge) / 2.0 - product(edge, input));
        row
    });
    let mut point = input.to_vec();
    for (x, edge) in solved(rows.collect()).iter().zip(edges) {
        point.iter_mut().zip(edge).for_each(|(to, from)| *to += x * from);
    }
    point
}

fn reaches_are_right<const D: usize>(count: usize) {
    let mut checked = 0;
    for family in [Family::Uniform, Family::Grid, Family::Cospherical, Family::FarCluster] {
        let mut random = Random(family as u64 + 3 * D as u64);
        let options = Options { output: Output::WellSpaced, ..Options::default() };
        let mut points = points::<D>(family, count, &mut random);
        // Squares of the test's lengths are doubles.
        let scale = points.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        points.iter_mut().flatten().for_each(|x| *x /= scale);
        let Some(mesh) = meshed(&points, &options) else {
            continue;
        };
        let mesh = mesh.triangulation().unwrap();
        let index = Index::new(mesh).unwrap();
        let group = CellRadii::new(mesh, &index, 1).unwrap().group;
        let faces = Faces::new(mesh, 0, 1).unwrap();
        let Filtration { values, .. } = distances(mesh, &faces, &index, 1).unwrap();
        // At the end all of space is there.
        let end = values.iter().flatten().fold(0.0f64, |most, &value| most.max(value));
        let mut expected = HashMap::<Vec<u32>, f64>::new();
        for k in (0..=D).rev() {
            let level = faces.of_dimension(k);
            for (at, face) in level.vertices.chunks_exact(k + 1).enumerate() {
                if face.iter().any(|&vertex| group[vertex as usize] == NONE) {
                    continue;
                }
                // From the first vertex, so that differences of near points are exact.
                let to = |vertex: u32| difference(mesh.point(vertex), mesh.point(face[0]));
                let input = to(group[face[0] as usize]);
                let point = nearest_at_equal_distance(
                    &face[1..].iter().map(|&v| to(v)).collect::<Vec<_>>(),
                    &input,
                );
                let distance = |to: &[f64]| {
                    let offset = difference(&point, to);
                    product(&offset, &offset).sqrt()
                };
                let radius = product(&point, &point).sqrt();
                let is_nearer = |vertex: u32| distance(&to(vertex)) < radius * (1.0 - 1e-9);
                let mut reach = distance(&input);
                if k < D && (0..mesh.vertex_count() as u32).any(is_nearer) {
                    let cofaces = faces.of_dimension(k + 1);
                    let above = (0..cofaces.count())
                        .filter(|&other| cofaces.facets(other).contains(&(at as u32)))
                        .map(|other| expected.get(cofaces.face(other)).copied());
                    // A coface in no group has a time, and the least may be its reach.
                    let Some(least) = above.collect::<Option<Vec<f64>>>() else { continue };
                    reach = least.into_iter().fold(f64::INFINITY, f64::min);
                }
                let error = (values[k][at] - reach.min(end)).abs();
                assert!(error <= 1e-6 * reach, "{family:?} {face:?} {} {reach}", values[k][at]);
                checked += usize::from(k < D && face.iter().all(|&v| group[v as usize] != v));
                expected.insert(face.to_vec(), reach);
            }
        }
    }
    assert!(checked > 50, "{checked}");
}

#[test]
fn reaches_are_those_of_all_vertices() {
    reaches_are_right::<2>(30);
    reaches_are_right::<3>(12);
}
