//! Corruptions of facets in space, of regions between them and of the domain that they enclose.

use super::solids::{Plan, Solid};
use netmesh::mesh::Boxed;
use netmesh::options::{Extent, Interior};
use netmesh::validate::{ViolationKind as Kind, validate};
use netmesh::{NONE, Region, Triangulation};

type Point = [f64; 3];

/// Returns the points of a grid of whole numbers.
fn grid([x, y, z]: [usize; 3]) -> Vec<Point> {
    let point = |i: usize| [i % x, i / x % y, i / x / y].map(|k| k as f64);
    (0..x * y * z).map(point).collect()
}

/// Returns the vertex of a point.
fn at(points: &[Point], point: Point) -> u32 {
    points.iter().position(|p| *p == point).unwrap_or_else(|| panic!("{point:?}")) as u32
}

/// Returns the six sides of a box, with normals that point out of it.
fn sides(points: &[Point], low: Point, high: Point) -> Vec<Vec<Vec<u32>>> {
    let corner = |i: usize| {
        at(points, std::array::from_fn(|k| if i >> k & 1 == 1 { high[k] } else { low[k] }))
    };
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.iter().map(|side| vec![side.map(corner).to_vec()]).collect()
}

fn everywhere(_: Point) -> Option<i32> {
    Some(0)
}

fn within(low: Point, high: Point, p: Point) -> bool {
    (0..3).all(|k| low[k] < p[k] && p[k] < high[k])
}

fn cube() -> Solid {
    let points = grid([2, 2, 2]);
    let facets = sides(&points, [0.0; 3], [1.0; 3]);
    Plan { inputs: 8, points, facets, ..Plan::default() }.build(everywhere)
}

/// The surface of a cube as twelve triangles.
fn triangulated_cube() -> Solid {
    let points = grid([2, 2, 2]);
    let quads = sides(&points, [0.0; 3], [1.0; 3]);
    let halves = |side: &Vec<Vec<u32>>| {
        let [a, b, c, d]: [u32; 4] = side[0][..].try_into().unwrap();
        [vec![vec![a, b, c]], vec![vec![a, c, d]]]
    };
    // The diagonals that the mesh does not have, as likely as not.
    let facets: Vec<Vec<Vec<u32>>> = quads.iter().flat_map(halves).collect();
    let plan = Plan { inputs: 8, points, facets: quads, ..Plan::default() };
    let mut solid = plan.build(everywhere);
    solid.facets = super::solids::facets_of(&facets, true);
    for parent in &mut solid.case.mesh.boundary.subfacet_parents {
        *parent *= 2;
    }
    solid
}

/// A grid of 5 x 4 x 4 cubes, of which 3 x 2 x 2 in the middle are the domain: two boxes that share
/// a facet, with labels, a facet with a hole, another that hangs from a side, and a segment.
fn boxes() -> Solid {
    let points = grid([6, 5, 5]);
    let v = |x: f64, y: f64, z: f64| at(&points, [x, y, z]);
    let (low, high) = ([1.0; 3], [4.0, 3.0, 3.0]);
    let mut facets = sides(&points, low, high);
    let square = |x: f64, a: f64, b: f64| vec![v(x, a, a), v(x, b, a), v(x, b, b), v(x, a, b)];
    // Where both boxes meet, with edges on the sides.
    facets.push(vec![square(2.0, 1.0, 3.0)]);
    facets.push(vec![vec![v(3.0, 1.0, 1.0), v(3.0, 2.0, 1.0), v(3.0, 2.0, 2.0), v(3.0, 1.0, 2.0)]]);
    // Outside, with a hole; and with a vertex and a segment within.
    facets.push(vec![
        square(5.0, 0.0, 4.0),
        square(5.0, 1.0, 3.0),
        vec![v(5.0, 0.0, 2.0), v(5.0, 1.0, 2.0)],
    ]);
    facets[8].push(vec![v(5.0, 4.0, 2.0)]);
    split_sides(&points, &mut facets);
    let segments = vec![[v(2.0, 2.0, 3.0), v(4.0, 2.0, 3.0)], [v(3.0, 2.0, 2.0), v(4.0, 2.0, 2.0)]];
    facets[1].push(vec![v(2.0, 2.0, 3.0), v(4.0, 2.0, 3.0)]);
    let seed = |x: f64, label: i32| Region { seed: [x, 1.5, 2.5], label, ..Region::default() };
    let regions = vec![seed(1.5, 7), seed(3.5, -2)];
    let inputs = points.len();
    let plan = Plan { points, inputs, facets, segments, regions, ..Plan::default() };
    plan.build(|p| within(low, high, p).then_some(if p[0] < 2.0 { 7 } else { -2 }))
}

/// Adds what other facets have of the sides to them: segments within.
fn split_sides(points: &[Point], facets: &mut [Vec<Vec<u32>>]) {
    let v = |x: f64, y: f64, z: f64| at(points, [x, y, z]);
    // z = 1, z = 3, y = 1, y = 3 for the plane x = 2; then z = 1 and y = 1 for x = 3.
    facets[0].push(vec![v(2.0, 1.0, 1.0), v(2.0, 3.0, 1.0)]);
    facets[1].push(vec![v(2.0, 1.0, 3.0), v(2.0, 3.0, 3.0)]);
    facets[2].push(vec![v(2.0, 1.0, 1.0), v(2.0, 1.0, 3.0)]);
    facets[3].push(vec![v(2.0, 3.0, 1.0), v(2.0, 3.0, 3.0)]);
    facets[0].push(vec![v(3.0, 1.0, 1.0), v(3.0, 2.0, 1.0)]);
    facets[2].push(vec![v(3.0, 1.0, 1.0), v(3.0, 1.0, 2.0)]);
}

#[test]
fn solids_hold() {
    cube().assert_sound(3);
    boxes().assert_sound(3);
    triangulated_cube().assert_sound(3);
}
