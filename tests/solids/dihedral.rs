//! Slivers inside a domain are mended, and all that it conforms to stays.

use super::{Point, Solid, bounded, cuboid, tilted, volume};
use crate::random::Random;
use crate::slivers::least_dihedral;
use netmesh::options::{Extent, Interior, Options};
use netmesh::{Mesh, NONE, Region, Triangulation, VertexKind};

fn asked(degrees: f64) -> Options {
    Options { min_dihedral: degrees, ..bounded(2.0) }
}

fn random(count: usize, seed: u64) -> Vec<Point> {
    let coordinates = Random::new(seed).uniform(3, count);
    coordinates.chunks_exact(3).map(|x| [x[0], x[1], x[2]]).collect()
}

/// Returns the simplices that have a smaller angle and are not flat in a facet.
fn below(mesh: &Triangulation, degrees: f64) -> Vec<u32> {
    let is_flat = |simplex: &u32| mesh.boundary.flat.binary_search(simplex).is_ok();
    let is_below = |simplex: &u32| least_dihedral(mesh, *simplex as usize) < degrees;
    (0..mesh.simplex_count() as u32).filter(|own| is_below(own) && !is_flat(own)).collect()
}

/// Returns true for each vertex that is an input or on the boundary.
fn cannot_move(mesh: &Triangulation) -> Vec<bool> {
    let mut stays: Vec<bool> = mesh.kinds.iter().map(|kind| *kind == VertexKind::Input).collect();
    let subsegments = mesh.boundary.subsegments.iter().flatten();
    for &vertex in mesh.boundary.subfacets.iter().flatten().chain(subsegments) {
        stays[vertex as usize] = true;
    }
    stays
}

/// Returns the points of the vertices that cannot move, sorted.
fn fixed(mesh: &Triangulation) -> Vec<Vec<u64>> {
    let bits = |vertex: usize| mesh.point(vertex as u32).iter().map(|x| x.to_bits()).collect();
    let stays = cannot_move(mesh);
    let mut points: Vec<_> = (0..stays.len()).filter(|&v| stays[v]).map(bits).collect();
    points.sort();
    points
}

#[test]
fn slivers_are_mended_but_those_of_the_boundary() {
    // A hull has many small angles, which the simplices beside them have, too.
    for (extent, most_left, most_free) in [(Extent::Box, 2, 0), (Extent::Hull, 120, 30)] {
        let solid = Solid { points: random(300, 11), ..Solid::default() };
        let within = |degrees| Options { extent, ..asked(degrees) };
        let [plain, mended] = [0.0, 12.0].map(|degrees| solid.run(&within(degrees)));
        let left = below(&mended, 12.0);
        assert_eq!(left, mended.below_min_dihedral);
        let before = below(&plain, 12.0).len();
        assert!(before > left.len() + 100 && left.len() <= most_left, "{before}, {}", left.len());
        let stays = cannot_move(&mended);
        let has_free = |&&simplex: &&u32| {
            mended.simplex(simplex as usize).iter().any(|&vertex| !stays[vertex as usize])
        };
        let free = left.iter().filter(has_free).count();
        assert!(free <= most_free, "{free} of {}", left.len());
        assert_eq!(fixed(&plain), fixed(&mended));
        assert!((volume(&plain) - volume(&mended)).abs() < 1e-14);
    }
}

#[test]
fn regions_keep_their_labels_and_sizes() {
    let mut solid = cuboid([0.0; 3], [1.0; 3]).with(&cuboid([0.25; 3], [0.75; 3]));
    let region = |x: f64, label, max_edge| Region {
        seed: [x, 0.5, 0.5],
        label,
        max_edge,
        ..Region::default()
    };
    solid.regions = vec![region(0.1, 7, 0.3), region(0.5, -3, 0.125)];
    solid.points.extend(random(60, 7).iter().map(|x| x.map(|x| 0.3 + 0.4 * x)));
    let mesh = solid.run(&Options { interior: Interior::Seeds, ..asked(18.0) });
    assert!(mesh.below_min_dihedral.is_empty(), "{}", mesh.below_min_dihedral.len());
    let mut counts = [0; 2];
    for (simplex, &label) in mesh.boundary.simplex_regions.iter().enumerate() {
        let ends = [0, 1, 2, 3].map(|at| mesh.point(mesh.simplex(simplex)[at]));
        let middle = [0, 1, 2].map(|k| ends.iter().map(|x| x[k]).sum::<f64>() / 4.0);
        let is_inner = middle.iter().all(|x| (0.25..0.75).contains(x));
        assert_eq!(label, if is_inner { -3 } else { 7 }, "{middle:?}");
        let longest = if is_inner { 0.125 } else { 0.3 };
        for (a, b) in (0..4).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let square: f64 = (0..3).map(|k| (ends[a][k] - ends[b][k]).powi(2)).sum();
            assert!(square.sqrt() <= longest, "{} of {longest}", square.sqrt());
        }
        counts[usize::from(is_inner)] += 1;
    }
    assert!(counts[0] > 100 && counts[1] > 100, "{counts:?}");
}

/// The outside of the domain is no part of the result: nothing is done for it.
#[test]
fn nothing_outside_is_mended() {
    let cube = cuboid([0.0; 3], [1.0; 3]);
    let whole = |degrees: f64| {
        let mesh = cube.run(&asked(degrees));
        let whole = mesh.boundary.whole.expect("the domain is cropped from it");
        (whole.points.clone(), whole.simplices.clone())
    };
    assert_eq!(whole(0.0), whole(20.0));
}

/// Cells that roundings leave in an oblique facet have no say: they are counted apart.
#[test]
fn flat_cells_are_no_slivers() {
    let sides = |n: i32, at: i32| (0..=n).map(move |i| (i, at));
    let mut points = Vec::new();
    for (x, y) in (0..=6).flat_map(|x| sides(6, x)) {
        points.push(tilted([f64::from(x), f64::from(y), 0.0]));
    }
    let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
    points.extend(corners.map(|[x, y]| tilted([x, y, 4.0])));
    let mesh =
        Solid { points, ..Solid::default() }.run(&Options { extent: Extent::Hull, ..asked(15.0) });
    assert!(!mesh.boundary.flat.is_empty());
    assert_eq!(mesh.below_min_dihedral, below(&mesh, 15.0));
    assert!(mesh.below_min_dihedral.is_empty(), "{}", mesh.below_min_dihedral.len());
}

#[test]
fn segments_in_space_stay() {
    let mut points = random(200, 5);
    points.extend([[0.1; 3], [0.9, 0.8, 0.7], [0.9, 0.1, 0.4]]);
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[200, 201, 201, 202], None).unwrap();
    mesh.run(&asked(15.0), None).unwrap();
    super::assert_holds(&mesh);
    let result = mesh.result().unwrap();
    assert!(result.boundary.subsegments.len() > 2 && result.stats.off_centers > 0);
    assert!(result.boundary.parents.iter().all(|&parent| parent != NONE));
}
