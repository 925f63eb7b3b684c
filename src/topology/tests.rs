//! Faces and alpha values against brute force in exact numbers, on points that have broken others.

use super::distance::CellRadii;
use super::{Faces, Filtration, alpha, distances};
use crate::arrays::tests::{delaunay, each_mesh, meshed};
use crate::error::ErrorKind;
use crate::mesh::{Mesh, NONE, Triangulation, VertexKind};
use crate::numerics::testing::{FAMILIES, Family, Random, determinant_oracle, integer, points};
use crate::query::Index;
use crate::validate::validate;
use crate::{Options, Output};
use dashu_int::IBig;
use std::collections::{BTreeMap, BTreeSet};

/// Returns the subsets of a simplex with `size` vertices, ascending.
fn subsets(simplex: &[u32], size: usize) -> Vec<Vec<u32>> {
    let chosen = (0..1u32 << simplex.len()).filter(|set| set.count_ones() as usize == size);
    let face = |set: u32| {
        let mut face: Vec<u32> =
            (0..simplex.len()).filter(|i| set >> i & 1 == 1).map(|i| simplex[i]).collect();
        face.sort_unstable();
        face
    };
    chosen.map(face).collect()
}

fn faces_are_right<const D: usize>(count: usize) {
    each_mesh::<D>(count, |mesh, _| {
        let mesh = mesh.triangulation().unwrap();
        let faces = Faces::new(mesh, 0, 2).unwrap();
        for k in 0..=D {
            let level = faces.of_dimension(k);
            let simplices = mesh.simplices.chunks_exact(D + 1);
            let mut expected: BTreeSet<Vec<u32>> =
                simplices.flat_map(|simplex| subsets(simplex, k + 1)).collect();
            if k == 0 {
                expected.extend((0..mesh.vertex_count() as u32).map(|vertex| vec![vertex]));
            }
            assert_eq!(level.vertices, expected.iter().flatten().copied().collect::<Vec<_>>());
            assert_eq!(level.count(), expected.len());
            for at in (0..level.count()).filter(|_| k > 0) {
                for (i, &facet) in level.facets(at).iter().enumerate() {
                    let mut others = level.face(at).to_vec();
                    others.remove(i);
                    assert_eq!(faces.of_dimension(k - 1).face(facet as usize), others);
                }
            }
        }
        let some = Faces::new(mesh, D - 1, 2).unwrap();
        assert_eq!(some.of_dimension(D), faces.of_dimension(D));
        assert_eq!(some.of_dimension(D - 1).vertices, faces.of_dimension(D - 1).vertices);
        assert!(some.of_dimension(D - 1).boundary.is_empty());
    });
}

#[test]
fn faces_are_those_of_the_simplices_each_once() {
    faces_are_right::<2>(60);
    faces_are_right::<3>(40);
    faces_are_right::<4>(14);
}

/// A squared radius `sum / (4 determinant)`, and the solution `x / determinant` with it; in units
/// of 2^-1074.
#[derive(Clone)]
struct Ball {
    sum: IBig,
    determinant: IBig,
    x: Vec<IBig>,
}

fn product(a: &[IBig], b: &[IBig]) -> IBig {
    a.iter().zip(b).fold(IBig::ZERO, |sum, (a, b)| sum + a * b)
}

/// Computes the ball of a face by Cramer's rule.
fn ball(points: &[Vec<IBig>], face: &[u32]) -> Ball {
    let edges = edges(points, face[0], &face[1..]);
    let products: Vec<Vec<IBig>> =
        edges.iter().map(|a| edges.iter().map(|b| product(a, b)).collect()).collect();
    let square = |i: usize| products[i][i].clone();
    let replaced = |at: usize| {
        let mut matrix = products.clone();
        (0..edges.len()).for_each(|i| matrix[i][at] = square(i));
        determinant_oracle(&matrix)
    };
    let x: Vec<IBig> = (0..edges.len()).map(replaced).collect();
    let sum = (0..edges.len()).fold(IBig::ZERO, |sum, i| sum + square(i) * &x[i]);
    Ball { sum, determinant: determinant_oracle(&products), x }
}

fn edges(points: &[Vec<IBig>], origin: u32, ends: &[u32]) -> Vec<Vec<IBig>> {
    let (start, point) = (&points[origin as usize], |end: &u32| &points[*end as usize]);
    ends.iter().map(|end| point(end).iter().zip(start).map(|(a, b)| a - b).collect()).collect()
}

/// Returns true if no point at all is strictly in the ball of a face.
fn is_gabriel(points: &[Vec<IBig>], face: &[u32], ball: &Ball) -> bool {
    let of_face = edges(points, face[0], &face[1..]);
    (0..points.len() as u32).filter(|other| !face.contains(other)).all(|other| {
        let to = &edges(points, face[0], &[other])[0];
        let terms = of_face.iter().zip(&ball.x);
        let twice = terms.fold(IBig::ZERO, |sum, (edge, x)| sum + product(to, edge) * x);
        product(to, to) * &ball.determinant >= twice
    })
}

fn is_less(a: &Ball, b: &Ball) -> bool {
    &a.sum * &b.determinant < &b.sum * &a.determinant
}

/// Returns true if `value` is the double nearest to a squared radius.
fn is_nearest(value: f64, ball: &Ball) -> bool {
    // Twice the value that rounds neither up nor down, in units of 2^-1074.
    let middle = |a: f64, b: f64| integer(a) + integer(b);
    let twice = &ball.sum * IBig::from(2);
    let scaled = |middle: IBig| (middle << 1074) * &ball.determinant * IBig::from(4);
    let beyond: IBig = integer(f64::MAX) * 2 + (IBig::ONE << (971 + 1074));
    let (low, high) = match value {
        f64::INFINITY => return scaled(beyond) <= twice,
        f64::MAX => (middle(value.next_down(), value), beyond),
        0.0 => (IBig::ZERO, middle(0.0, f64::from_bits(1))),
        _ => (middle(value.next_down(), value), middle(value, value.next_up())),
    };
    scaled(low) <= twice && twice <= scaled(high)
}

/// Computes the balls by their definition with all points, from the simplices down.
fn expected_balls(mesh: &Triangulation, points: &[Vec<IBig>]) -> BTreeMap<Vec<u32>, Ball> {
    let mut found = BTreeMap::<Vec<u32>, Ball>::new();
    for size in (2..=mesh.dim + 1).rev() {
        let simplices = mesh.simplices.chunks_exact(mesh.dim + 1);
        let faces: BTreeSet<Vec<u32>> = simplices.flat_map(|s| subsets(s, size)).collect();
        for face in faces {
            let own = ball(points, &face);
            let value = if is_gabriel(points, &face, &own) {
                own
            } else {
                let has = |other: &&Vec<u32>| {
                    other.len() == size + 1 && face.iter().all(|v| other.contains(v))
                };
                let above = found.iter().filter(|(other, _)| has(other)).map(|(_, ball)| ball);
                above.reduce(|a, b| if is_less(b, a) { b } else { a }).unwrap().clone()
            };
            found.insert(face, value);
        }
    }
    found
}

fn values_are_right<const D: usize>(count: usize, draws: u64) {
    let mut made = 0;
    for family in FAMILIES {
        for draw in 0..draws {
            let mut random = Random(family as u64 * 31 + D as u64 + 1000 * draw);
            let Some(mesh) = meshed(&points::<D>(family, count, &mut random), &delaunay()) else {
                continue;
            };
            made += 1;
            let mesh = mesh.triangulation().unwrap();
            let exact: Vec<Vec<IBig>> = mesh
                .points
                .chunks_exact(D)
                .map(|p| p.iter().map(|&x| integer(x)).collect())
                .collect();
            let expected = expected_balls(mesh, &exact);
            let faces = Faces::new(mesh, 0, 2).unwrap();
            let values = alpha(mesh, &faces, 2).unwrap().values;
            assert!(values[0].iter().all(|&value| value == 0.0));
            for k in 1..=D {
                let level = faces.of_dimension(k);
                for (at, &value) in values[k].iter().enumerate() {
                    let face = level.face(at);
                    assert!(is_nearest(value, &expected[face]), "{family:?} {face:?} {value:e}");
                    for &facet in level.facets(at) {
                        assert!(values[k - 1][facet as usize] <= value);
                    }
                }
            }
        }
    }
    assert!(made as u64 >= draws * FAMILIES.len() as u64 / 2, "{made}");
}

#[test]
fn alpha_values_are_the_doubles_nearest_to_the_exact_ones() {
    values_are_right::<2>(12, 8);
    values_are_right::<3>(9, 6);
    values_are_right::<4>(8, 2);
    values_are_right::<5>(7, 1);
}

fn mesh_index(mesh: &Triangulation) -> Index {
    Index::new(mesh).unwrap()
}

/// Holds that the cells are where the definition says: each point of the box is in the cell of the
/// vertex nearest to it, whose time and whose distance from the inputs differ by no more than the
/// factor.
fn times_bound_distances<const D: usize>(count: usize, options: &Options) {
    let (mut checked, mut grouped) = (0, 0);
    for family in [Family::Uniform, Family::Grid, Family::FarCluster, Family::Cospherical] {
        let mut random = Random(family as u64 + 7 * D as u64);
        let Some(mesh) = meshed(&points::<D>(family, count, &mut random), options) else {
            continue;
        };
        let mesh = mesh.triangulation().unwrap();
        let faces = Faces::new(mesh, 0, 2).unwrap();
        let Filtration { values, factor, .. } =
            distances(mesh, &faces, &mesh_index(mesh), 1).unwrap();
        let group = CellRadii::new(mesh, &mesh_index(mesh), 1).unwrap().group;
        assert!((1.0..f64::INFINITY).contains(&factor), "{family:?} {factor}");
        let is_input = |vertex: usize| mesh.kinds[vertex] == VertexKind::Input;
        let times = &values[0];
        let end = times.iter().fold(0.0f64, |a, &b| a.max(b));
        let nearest = |x: &[f64; D], inputs: bool| {
            let vertices = (0..times.len()).filter(|&vertex| !inputs || is_input(vertex));
            let distance = |vertex: usize| {
                let point = mesh.point(vertex as u32);
                x.iter().zip(point).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
            };
            let with_distance = vertices.map(|vertex| (distance(vertex), vertex));
            with_distance.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
        };
        let scale = mesh.points.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        for _ in 0..300 {
            // Half of them near a vertex.
            let vertex = random.integer(0, times.len() as i64 - 1) as u32;
            let reach = scale * 2f64.powi(-(random.integer(0, 30) as i32));
            let x: [f64; D] =
                std::array::from_fn(|i| mesh.point(vertex)[i] + reach * random.unit());
            let ((_, cell), (distance, input)) = (nearest(&x, false), nearest(&x, true));
            if is_input(cell) {
                assert_eq!(times[cell], 0.0);
                continue;
            }
            if group[cell] != NONE {
                grouped += 1;
                assert_eq!(group[cell], input as u32, "{family:?}");
                assert!(times[cell] <= distance * (1.0 + 1e-6), "{family:?}");
                continue;
            }
            checked += 1;
            assert!(times[cell] <= factor * distance, "{family:?} {} {distance}", times[cell]);
            if times[cell] < end {
                assert!(distance <= factor * times[cell], "{family:?} {} {distance}", times[cell]);
            }
        }
        for k in 1..=D {
            let level = faces.of_dimension(k);
            for (at, &value) in values[k].iter().enumerate() {
                let facets = level.facets(at).iter().map(|&facet| values[k - 1][facet as usize]);
                assert!(facets.fold(0.0, f64::max) <= value);
                if level.face(at).iter().all(|&vertex| group[vertex as usize] == NONE) {
                    let of_vertices = level.face(at).iter().map(|&vertex| times[vertex as usize]);
                    assert_eq!(value, of_vertices.fold(0.0, f64::max));
                }
            }
        }
    }
    assert!(checked > 100 && grouped > 20, "{checked} {grouped}");
}

#[test]
fn times_of_cells_and_distances_in_them_differ_by_the_factor() {
    let well_spaced = Options { output: Output::WellSpaced, ..Options::default() };
    times_bound_distances::<2>(40, &well_spaced);
    times_bound_distances::<3>(15, &well_spaced);
    times_bound_distances::<2>(40, &Options::default());
}

fn ratios_bound_the_factor<const D: usize>(count: usize, ratio: f64) {
    let finished = Options { output: Output::WellSpaced, ..Options::default() };
    for family in [Family::Uniform, Family::Grid, Family::FarCluster, Family::Cospherical] {
        let mut random = Random(family as u64 + 11 * D as u64);
        let points = points::<D>(family, count, &mut random);
        let options = Options { distance_ratio: ratio, ..finished.clone() };
        let Some(mesh) = meshed(&points, &options) else { continue };
        let report = validate(mesh.inputs(), mesh.triangulation().unwrap(), 3).unwrap();
        assert_eq!((report.level, report.violations), (3, 0), "{family:?} {:?}", report.first);
        let mesh = mesh.triangulation().unwrap();
        let faces = Faces::new(mesh, 1, 2).unwrap();
        let near = distances(mesh, &faces, &mesh_index(mesh), 1).unwrap();
        let bound = ((1.0 + ratio) / (1.0 - ratio)).sqrt() * (1.0 + 1e-5);
        assert!(near.factor <= bound, "{family:?} {} {bound}", near.factor);
        if family != Family::Uniform {
            continue;
        }
        let count = mesh.vertex_count() as u64;
        let again = meshed(&points, &Options { threads: 2, ..options.clone() }).unwrap();
        assert_eq!(again.triangulation().unwrap().points, mesh.points);
        let mut limited = Mesh::new(D, points.len(), &points.concat(), 0).unwrap();
        let error = limited.run(&Options { max_vertices: count - 1, ..options }, None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Limit);
    }
}

#[test]
fn a_distance_ratio_bounds_the_factor() {
    ratios_bound_the_factor::<2>(60, 0.1);
    ratios_bound_the_factor::<2>(60, 0.5);
    ratios_bound_the_factor::<3>(20, 0.3);
}

#[test]
fn without_other_vertices_distances_are_roots_of_alpha_values() {
    let mut random = Random(5);
    for family in [Family::Uniform, Family::Grid, Family::Cospherical] {
        let mesh = meshed(&points::<3>(family, 30, &mut random), &delaunay()).unwrap();
        let mesh = mesh.triangulation().unwrap();
        let faces = Faces::new(mesh, 0, 2).unwrap();
        let found = distances(mesh, &faces, &mesh_index(mesh), 1).unwrap();
        assert_eq!(found.factor, 1.0);
        for (roots, squares) in found.values.iter().zip(alpha(mesh, &faces, 2).unwrap().values) {
            let difference = |(a, b): (&f64, &f64)| (a - b.sqrt()).abs() / b.sqrt().max(1e-300);
            assert!(roots.iter().zip(&squares).map(difference).fold(0.0, f64::max) < 1e-15);
        }
    }
}

/// Lengths have no square that overflows or underflows.
#[test]
fn lengths_do_not_depend_on_the_scale() {
    let mut random = Random(11);
    let near = points::<3>(Family::Uniform, 20, &mut random);
    let values = |scale: f64| {
        let scaled: Vec<[f64; 3]> = near.iter().map(|p| p.map(|x| x * scale)).collect();
        let mesh = meshed(&scaled, &delaunay()).unwrap();
        let mesh = mesh.triangulation().unwrap();
        let faces = Faces::new(mesh, 1, 2).unwrap();
        distances(mesh, &faces, &mesh_index(mesh), 1).unwrap().values.concat()
    };
    let expected = values(1.0);
    for exponent in [-900, -300, 300, 900] {
        let scale = 2f64.powi(exponent);
        assert_eq!(values(scale), expected.iter().map(|x| x * scale).collect::<Vec<_>>());
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let mut mesh = Mesh::new(2, 4, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 2.0], 0).unwrap();
    mesh.run(&delaunay(), None).unwrap();
    let mut flat = mesh.triangulation().unwrap().clone();
    let faces = Faces::new(&flat, 0, 2).unwrap();
    flat.points = vec![0.0; 8];
    assert_eq!(alpha(&flat, &faces, 2).unwrap_err().kind(), ErrorKind::InvalidArgument);
    flat.kinds[3] = VertexKind::Steiner;
    assert_eq!(alpha(&flat, &faces, 1).unwrap_err().kind(), ErrorKind::InvalidArgument);
    let mut other = flat.clone();
    other.simplices[0] = 99;
    assert_eq!(Faces::new(&other, 0, 2).unwrap_err().kind(), ErrorKind::InvalidArgument);
}
