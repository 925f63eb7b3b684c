//! Corruptions of the geometry.

use super::meshes::{brute_force, neighbors, pairs, plain, random_points, run};
use super::{assert_sound, assert_violates, report};
use netmesh::NONE;
use netmesh::numerics::{Sign, orientation};
use netmesh::options::Options;
use netmesh::validate::ViolationKind as Kind;

#[test]
fn a_flipped_simplex() {
    for mut case in [
        brute_force(&random_points::<2>(14, 1)),
        brute_force(&random_points::<4>(10, 1)),
        run(&pairs::<2>(3, 1e-9, 1), &Options::default()),
    ] {
        let row = 2 * (case.mesh.dim + 1);
        case.mesh.simplices.swap(row, row + 1);
        case.mesh.neighbors.swap(row, row + 1);
        assert_violates(&case, Kind::Orientation);
        assert_eq!(report(&case).first.unwrap().simplex, 2);
    }
}

#[test]
fn a_moved_vertex() {
    for mut case in [
        brute_force(&random_points::<3>(12, 1)),
        run(&random_points::<3>(20, 1), &Options::default()),
    ] {
        case.mesh.points[0] += 10.0;
        assert_violates(&case, Kind::Orientation);
    }
}

#[test]
fn a_flat_simplex() {
    let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 0.0]];
    assert_violates(&plain(&points, &[vec![0, 2, 1], vec![0, 3, 2]]), Kind::Orientation);
}

#[test]
fn two_simplices_on_one_side_of_their_facet() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.4, 2.0]];
    assert_violates(&plain(&points, &[vec![0, 1, 2], vec![0, 1, 3]]), Kind::FoldedFacet);
}

#[test]
fn an_edge_flipped_to_the_wrong_diagonal() {
    let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [0.0, 1.1]];
    assert_sound(&brute_force(&points));
    let right = brute_force(&points).mesh.simplices;
    let wrong = if right.chunks(3).all(|t| t.contains(&0)) {
        [vec![0, 1, 3], vec![1, 2, 3]]
    } else {
        [vec![0, 1, 2], vec![0, 2, 3]]
    };
    assert_violates(&plain(&points, &wrong), Kind::Delaunay);
}

#[test]
fn every_edge_of_a_real_run_is_needed() {
    let case = run(&pairs::<2>(3, 1e-9, 1), &Options::default());
    let mut flips = 0;
    for s in 0..case.mesh.simplex_count() {
        for slot in 0..3 {
            let neighbor = case.mesh.neighbors_of(s)[slot];
            if neighbor != NONE && (neighbor as usize) > s {
                flips += u32::from(check_flip(&case, s, slot, neighbor as usize));
            }
        }
    }
    assert!(flips > 20);
}

/// Flips one edge of a convex quadrilateral and asserts that it is seen; false if not convex.
fn check_flip(case: &super::Case, s: usize, slot: usize, t: usize) -> bool {
    let (a, b) = (case.mesh.simplex(s), case.mesh.simplex(t));
    let apex = a[slot];
    let (left, right) = (a[(slot + 1) % 3], a[(slot + 2) % 3]);
    let other = *b.iter().find(|v| !a.contains(v)).unwrap();
    let flipped = [vec![apex, left, other], vec![apex, other, right]];
    let point = |v: u32| <&[f64; 2]>::try_from(case.mesh.point(v)).unwrap();
    let is_convex =
        |t: &Vec<u32>| orientation(&[point(t[0]), point(t[1]), point(t[2])]) == Sign::Positive;
    if !flipped.iter().all(is_convex) {
        return false;
    }
    let mut simplices: Vec<Vec<u32>> = case.mesh.simplices.chunks(3).map(<[u32]>::to_vec).collect();
    [simplices[s], simplices[t]] = flipped;
    let mut broken = case.clone();
    broken.mesh.neighbors = neighbors(&simplices);
    broken.mesh.simplices = simplices.concat();
    assert_violates(&broken, Kind::Delaunay);
    true
}

#[test]
fn a_dent_in_the_hull() {
    let points = [[0.0, 0.0], [4.0, 0.0], [2.0, 3.0], [2.1, 1.0]];
    assert_sound(&brute_force(&points));
    let dented = [vec![0, 3, 2], vec![3, 1, 2]];
    assert_violates(&plain(&points, &dented), Kind::NonConvexHull);
}

#[test]
fn a_dent_in_a_polytope() {
    // A tetrahedron split at an inner point, without one of the four parts.
    let points =
        [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [0.9, 0.8, 0.7]];
    let sound = brute_force(&points);
    assert_sound(&sound);
    let kept: Vec<Vec<u32>> = sound.mesh.simplices.chunks(4).map(<[u32]>::to_vec).skip(1).collect();
    assert_violates(&plain(&points, &kept), Kind::NonConvexHull);
}

#[test]
fn coplanar_hull_facets_are_convex() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0], [0.9, 1.1]];
    let fan: Vec<Vec<u32>> =
        [[0, 4], [4, 1], [1, 2], [2, 3], [3, 0]].iter().map(|e| vec![e[0], e[1], 5]).collect();
    assert_sound(&plain(&square, &fan));
}

#[test]
fn a_pentagram_is_covered_twice() {
    let mut points = vec![[0.01, 0.02]];
    for i in 0..5 {
        let angle = f64::from(i) * 0.8 * std::f64::consts::PI;
        points.push([angle.cos(), angle.sin()]);
    }
    let fan: Vec<Vec<u32>> = (0..5).map(|i| vec![0, i + 1, (i + 1) % 5 + 1]).collect();
    assert_violates(&plain(&points, &fan), Kind::Winding);
}
