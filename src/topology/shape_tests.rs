//! Alpha shapes against brute force: classes by definition, Betti numbers by elimination modulo 2,
//! the values that connect by trying all; and shapes whose topology is known.

use super::{AlphaShape, FaceClass, Faces, Filtration, alpha, connecting_alpha, optimal_alpha};
use crate::arrays::tests::{delaunay, meshed};
use crate::error::ErrorKind;
use crate::mesh::Triangulation;
use crate::numerics::testing::{FAMILIES, Random, points};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

fn made(mesh: &Triangulation) -> (Faces, Filtration) {
    let faces = Faces::new(mesh, 0, 2).unwrap();
    let values = alpha(mesh, &faces, 2).unwrap();
    (faces, values)
}

/// Calls `act` with Delaunay triangulations of points of all families.
fn each_delaunay<const D: usize>(
    count: usize,
    act: impl Fn(&Triangulation, &Faces, &Filtration, &mut Random),
) {
    for family in FAMILIES {
        let mut random = Random(family as u64 * 17 + D as u64);
        let Some(mesh) = meshed(&points::<D>(family, count, &mut random), &delaunay()) else {
            continue;
        };
        let mesh = mesh.triangulation().unwrap();
        let (faces, values) = made(mesh);
        act(mesh, &faces, &values, &mut random);
    }
}

/// Returns some of the values that a filtration has, the least and the largest among them.
fn some_values(values: &Filtration, count: usize, random: &mut Random) -> Vec<f64> {
    let mut all: Vec<f64> = values.values.concat();
    all.sort_unstable_by(f64::total_cmp);
    let last = all.len() - 1;
    let mut picked = vec![all[0], all[last]];
    picked.extend((0..count).map(|_| all[random.integer(0, last as i64) as usize]));
    picked
}

/// Returns the rank of a matrix over the field of two elements, given for each row the columns of
/// its ones.
fn rank(rows: Vec<BTreeSet<u32>>) -> usize {
    let mut reduced: Vec<BTreeSet<u32>> = Vec::new();
    for mut row in rows {
        for other in &reduced {
            if other.last().is_some_and(|last| row.contains(last)) {
                row = row.symmetric_difference(other).copied().collect();
            }
        }
        if !row.is_empty() {
            reduced.push(row);
            // A row is reduced by larger last columns first.
            reduced.sort_unstable_by_key(|row| std::cmp::Reverse(row.last().copied()));
        }
    }
    reduced.len()
}

fn betti_by_elimination(faces: &Faces, shape: &AlphaShape<'_>) -> Vec<u64> {
    let of =
        |k: usize| (0..faces.of_dimension(k).count()).filter(move |&face| shape.contains(k, face));
    let boundary = |face, k| faces.of_dimension(k).facets(face).iter().copied().collect();
    let ranks: Vec<usize> = (0..=faces.dim())
        .map(|k| if k == 0 { 0 } else { rank(of(k).map(|face| boundary(face, k)).collect()) })
        .collect();
    (0..faces.dim()).map(|k| (of(k).count() - ranks[k] - ranks[k + 1]) as u64).collect()
}

fn betti_numbers_are_right<const D: usize>(count: usize, tries: usize) {
    each_delaunay::<D>(count, |_, faces, values, random| {
        for alpha in some_values(values, tries, random) {
            let shape = AlphaShape::new(faces, values, alpha).unwrap();
            let (found, expected) =
                (shape.topology().unwrap(), betti_by_elimination(faces, &shape));
            assert_eq!(found.components, expected[0]);
            assert_eq!(found.voids, expected[D - 1]);
            assert_eq!(found.betti, (D <= 3).then(|| expected.clone()));
            let signed = |(k, &number): (usize, &u64)| (1 - 2 * (k as i64 % 2)) * number as i64;
            let alternating: i64 = expected.iter().enumerate().map(signed).sum();
            assert_eq!(found.euler_characteristic, alternating);
        }
    });
}

#[test]
fn betti_numbers_are_those_of_elimination() {
    betti_numbers_are_right::<2>(40, 6);
    betti_numbers_are_right::<3>(16, 4);
    betti_numbers_are_right::<4>(9, 2);
}

/// Returns the vertices of all faces of dimension `k`.
fn sets(faces: &Faces, k: usize) -> Vec<BTreeSet<u32>> {
    let level = faces.of_dimension(k);
    (0..level.count()).map(|face| level.face(face).iter().copied().collect()).collect()
}

fn classes_are_right<const D: usize>(count: usize) {
    each_delaunay::<D>(count, |_, faces, values, random| {
        let (simplices, facets) = (sets(faces, D), sets(faces, D - 1));
        let on_hull: Vec<&BTreeSet<u32>> = facets
            .iter()
            .filter(|facet| simplices.iter().filter(|s| facet.is_subset(s)).count() == 1)
            .collect();
        for alpha in some_values(values, 2, random) {
            let shape = AlphaShape::new(faces, values, alpha).unwrap();
            for k in 0..=D {
                let expected: Vec<FaceClass> = sets(faces, k)
                    .iter()
                    .enumerate()
                    .map(|(at, face)| {
                        let is_in_larger = (k + 1..=D).any(|above| {
                            let mut larger = sets(faces, above).into_iter().enumerate();
                            larger.any(|(i, set)| face.is_subset(&set) && shape.contains(above, i))
                        });
                        let mut round =
                            simplices.iter().zip(0..).filter(|(s, _)| face.is_subset(s));
                        let is_interior = round.all(|(_, simplex)| shape.contains(D, simplex))
                            && (k == D || !on_hull.iter().any(|facet| face.is_subset(facet)));
                        match shape.contains(k, at) {
                            false => FaceClass::Exterior,
                            true if is_interior => FaceClass::Interior,
                            true if is_in_larger => FaceClass::Regular,
                            true => FaceClass::Singular,
                        }
                    })
                    .collect();
                assert_eq!(shape.classes(k).unwrap(), expected);
            }
        }
    });
}

#[test]
fn classes_are_those_of_the_definition() {
    classes_are_right::<2>(25);
    classes_are_right::<3>(12);
    classes_are_right::<4>(8);
}

/// Counts the pieces of the simplices of a shape, by spreading across facets.
fn pieces(faces: &Faces, shape: &AlphaShape<'_>) -> usize {
    let simplices = faces.of_dimension(faces.dim());
    let share =
        |a: usize, b: usize| simplices.facets(a).iter().any(|f| simplices.facets(b).contains(f));
    let mut left: Vec<usize> =
        (0..simplices.count()).filter(|&simplex| shape.contains(faces.dim(), simplex)).collect();
    let mut pieces = 0;
    while let Some(first) = left.pop() {
        pieces += 1;
        let mut reached = vec![first];
        while let Some(simplex) = reached.pop() {
            let (next, others) = left.iter().partition(|&&other| share(simplex, other));
            reached.extend::<Vec<usize>>(next);
            left = others;
        }
    }
    pieces
}

fn values_that_connect_are_right<const D: usize>(count: usize) {
    each_delaunay::<D>(count, |_, faces, values, _| {
        let mut tried: Vec<f64> = values.values.concat();
        tried.sort_unstable_by(f64::total_cmp);
        tried.dedup();
        let shape = |alpha: f64| AlphaShape::new(faces, values, alpha).unwrap();
        let is_connected = |alpha: &f64| shape(*alpha).topology().unwrap().components == 1;
        let expected = tried.iter().copied().find(is_connected).unwrap();
        assert_eq!(connecting_alpha(faces, values).unwrap(), expected);
        for components in [1, 2, 5] {
            let is_optimal = |alpha: &f64| {
                let classes = shape(*alpha).classes(0).unwrap();
                let shape = shape(*alpha);
                let solids = (0..faces.of_dimension(D).count()).filter(|&s| shape.contains(D, s));
                let reached: BTreeSet<u32> = solids
                    .flat_map(|solid| faces.of_dimension(D).face(solid).iter().copied())
                    .collect();
                reached.len() == classes.len() && pieces(faces, &shape) <= components
            };
            let expected = tried.iter().copied().find(is_optimal).unwrap();
            assert_eq!(optimal_alpha(faces, values, components as u64).unwrap(), expected);
        }
    });
}

#[test]
fn values_that_connect_are_the_least() {
    values_that_connect_are_right::<2>(25);
    values_that_connect_are_right::<3>(10);
}

/// Returns the Betti numbers of a sampled shape for a radius.
fn betti_of<const D: usize>(points: &[[f64; D]], radius: f64) -> Vec<u64> {
    let mesh = meshed(points, &delaunay()).unwrap();
    let (faces, values) = made(mesh.triangulation().unwrap());
    let shape = AlphaShape::new(&faces, &values, radius * radius).unwrap();
    shape.topology().unwrap().betti.unwrap()
}

fn torus(at: usize) -> [f64; 3] {
    let (around, across) = ((at / 24) as f64 * TAU / 60.0, (at % 24) as f64 * TAU / 24.0);
    let distance = 3.0 + across.cos();
    [distance * around.cos(), distance * around.sin(), across.sin()]
}

fn sphere(at: usize) -> [f64; 3] {
    // A spiral of golden angles.
    let (height, angle) =
        (1.0 - 2.0 * (at as f64 + 0.5) / 400.0, at as f64 * 2.399_963_229_728_653);
    let radius = (1.0 - height * height).sqrt();
    [radius * angle.cos(), radius * angle.sin(), height]
}

#[test]
fn known_shapes_have_their_betti_numbers() {
    let torus: Vec<[f64; 3]> = (0..24 * 60).map(torus).collect();
    assert_eq!(betti_of(&torus, 0.5), [1, 2, 1]);
    let sphere: Vec<[f64; 3]> = (0..400).map(sphere).collect();
    assert_eq!(betti_of(&sphere, 0.4), [1, 0, 1]);
    assert_eq!(betti_of(&sphere, 1.1), [1, 0, 0]);
    let apart: Vec<[f64; 3]> =
        sphere.iter().copied().chain(torus.iter().map(|p| [p[0] + 9.0, p[1], p[2]])).collect();
    assert_eq!(betti_of(&apart, 0.5), [2, 2, 2]);
    let circle = |center: f64| {
        let angles = (0..50).map(|at| f64::from(at) * TAU / 50.0);
        angles.map(move |angle| [center + angle.cos(), angle.sin()])
    };
    let two: Vec<[f64; 2]> = circle(0.0).chain(circle(2.5)).collect();
    assert_eq!(betti_of(&two, 0.1), [2, 2]);
    assert_eq!(betti_of(&two, 0.3), [1, 2]);
}

#[test]
fn a_solid_has_a_volume_and_a_boundary() {
    // The cube with a cavity: its simplices have all eight corners of the lattice about it.
    let lattice = (0..125).map(|at| [at / 25, at / 5 % 5, at % 5].map(f64::from));
    let cube: Vec<[f64; 3]> = lattice.filter(|point| *point != [2.0; 3]).collect();
    let mesh = meshed(&cube, &delaunay()).unwrap();
    let mesh = mesh.triangulation().unwrap();
    let (faces, values) = made(mesh);
    let shape = AlphaShape::new(&faces, &values, 0.75).unwrap();
    // Unit cubes; the octahedron about the missing point is larger.
    assert_eq!(shape.volume(mesh).unwrap(), 64.0 - 4.0 / 3.0);
    assert_eq!(shape.topology().unwrap().betti.unwrap(), [1, 0, 1]);
    let hull = shape.solid(mesh).unwrap().hull().unwrap();
    let regular = |class: &&FaceClass| **class == FaceClass::Regular;
    assert_eq!(hull.vertices.len() / 3, shape.classes(2).unwrap().iter().filter(regular).count());
    // The divergence theorem on the oriented boundary.
    let point = |vertex: u32| mesh.point(vertex);
    let six_volumes = hull.vertices.chunks_exact(3).map(|facet| {
        let [a, b, c] = [0, 1, 2].map(|i| point(facet[i]));
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    });
    assert!((six_volumes.sum::<f64>() / 6.0 - (64.0 - 4.0 / 3.0)).abs() < 1e-12);
}

#[test]
fn the_largest_shape_is_the_hull() {
    each_delaunay::<3>(20, |_, faces, values, _| {
        let shape = AlphaShape::new(faces, values, f64::INFINITY).unwrap();
        assert_eq!(shape.topology().unwrap().betti.unwrap(), [1, 0, 0]);
    });
}

#[test]
fn what_is_no_alpha_is_refused() {
    let mesh = meshed(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &delaunay()).unwrap();
    let (faces, values) = made(mesh.triangulation().unwrap());
    for wrong in [-1.0, -f64::INFINITY, f64::NAN] {
        let error = AlphaShape::new(&faces, &values, wrong).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().contains(&format!("alpha is {wrong}")), "{}", error.message());
    }
    let error = optimal_alpha(&faces, &values, 0).unwrap_err();
    assert!(error.message().contains("components is 0"));
    assert_eq!(AlphaShape::new(&faces, &values, -0.0).unwrap().topology().unwrap().components, 3);
}
