//! Solids to check and to corrupt.

use super::solids::{Plan, Solid, facets_of};
use netmesh::Region;

pub type Point = [f64; 3];

/// Returns the points of a grid of whole numbers.
pub fn grid([x, y, z]: [usize; 3]) -> Vec<Point> {
    let point = |i: usize| [i % x, i / x % y, i / x / y].map(|k| k as f64);
    (0..x * y * z).map(point).collect()
}

/// Returns the vertex of a point.
pub fn at(points: &[Point], point: Point) -> u32 {
    points.iter().position(|p| *p == point).unwrap_or_else(|| panic!("{point:?}")) as u32
}

/// Returns the six sides of a box, with normals that point out of it.
pub fn sides(points: &[Point], low: Point, high: Point) -> Vec<Vec<Vec<u32>>> {
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

pub fn within(low: Point, high: Point, p: Point) -> bool {
    (0..3).all(|k| low[k] < p[k] && p[k] < high[k])
}

pub fn cube() -> Solid {
    let points = grid([2, 2, 2]);
    let facets = sides(&points, [0.0; 3], [1.0; 3]);
    Plan { inputs: 8, points, facets, ..Plan::default() }.build(everywhere)
}

/// Makes a cube of whose surface the caller gave twelve triangles.
pub fn triangulated_cube() -> Solid {
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
    solid.facets = facets_of(&facets, true);
    for parent in &mut solid.case.mesh.boundary.subfacet_parents {
        *parent *= 2;
    }
    solid
}

/// Makes a grid of 5 x 4 x 4 cubes, of which 3 x 2 x 2 in the middle are the domain: two boxes that
/// share a facet, with labels, a facet with a hole, another that hangs from a side, and a segment.
pub fn boxes() -> Solid {
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

/// Makes a square at the height 1 with vertices in it and on its edges that are no inputs, and
/// vertices off it in pairs that mirror each other.
pub fn sheet() -> Solid {
    let mut random = crate::random::Random::new(5);
    let mut points = vec![[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [0.0, 4.0, 1.0]];
    for _ in 0..20 {
        let [x, y, h] =
            [random.unit() * 10.0 - 3.0, random.unit() * 10.0 - 3.0, 2.0 + random.unit()];
        points.extend([[x, y, 1.0 + h], [x, y, 1.0 - h]]);
    }
    let inputs = points.len();
    for i in [1.0, 2.0, 3.0] {
        points.extend([[i, 0.0, 1.0], [4.0, i, 1.0], [i, 4.0, 1.0], [0.0, i, 1.0]]);
        for j in [1.0, 2.0, 3.0] {
            points.push([i + 0.3 * random.unit(), j + 0.3 * random.unit(), 1.0]);
        }
    }
    let facets = vec![vec![vec![0, 1, 2, 3]]];
    Plan { points, inputs, facets, ..Plan::default() }.build(everywhere)
}

/// Makes a box in a box, of a grid; the domain is between them, as surfaces count.
pub fn shell(is_inner_reversed: bool) -> Solid {
    let points = grid([6, 6, 6]);
    let mut facets = sides(&points, [0.0; 3], [5.0; 3]);
    let mut inner = sides(&points, [2.0; 3], [3.0; 3]);
    if is_inner_reversed {
        inner.iter_mut().for_each(|facet| facet[0].reverse());
    }
    facets.extend(inner);
    let plan = Plan { inputs: points.len(), points, facets, ..Plan::default() };
    let is_inside = |p| is_inner_reversed && within([2.0; 3], [3.0; 3], p);
    plan.build(|p| (!is_inside(p)).then_some(0))
}

/// Makes a prism over a triangle with an angle of some degrees, and simplices that are forced.
pub fn wedge(degrees: f64, forced: &[u32]) -> Solid {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let base = [[0.0, 0.0], [1.0, 0.0], [cosine, sine]];
    let points: Vec<Point> =
        [0.0, 1.0].iter().flat_map(|&z| base.map(|[x, y]| [x, y, z])).collect();
    let facets = vec![
        vec![vec![0, 2, 1]],
        vec![vec![3, 4, 5]],
        vec![vec![0, 1, 4, 3]],
        vec![vec![1, 2, 5, 4]],
        vec![vec![2, 0, 3, 5]],
    ];
    let mut solid = Plan { inputs: 6, points, facets, ..Plan::default() }.build(everywhere);
    solid.corrupt(|mesh| mesh.boundary.forced = forced.to_vec());
    solid.corrupt(|mesh| mesh.parameters.quality_bound = 0.62);
    solid
}

/// Makes a grid of `count` points a side on the surface of a cube, turned, so that its sides are
/// plane up to rounding only, and flat simplices are on some of them. The domain is what is not
/// flat.
pub fn turned_cube(count: usize) -> Solid {
    let last = count - 1;
    let lattice: Vec<[usize; 3]> = (0..count.pow(3))
        .map(|i| [i % count, i / count % count, i / count / count])
        .filter(|place| place.iter().any(|&k| k == 0 || k == last))
        .collect();
    let rows = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let turned = |place: &[usize; 3]| -> Point {
        rows.map(|row| (0..3).map(|k| row[k] * place[k] as f64 / 3.0).sum::<f64>() + 0.7)
    };
    let points: Vec<Point> = lattice.iter().map(turned).collect();
    let vertex = |place: [usize; 3]| lattice.iter().position(|p| *p == place).unwrap() as u32;
    let mut facets = Vec::new();
    let is_on =
        |place: &[usize; 3], side: usize| place[side / 2] == if side % 2 == 1 { last } else { 0 };
    for side in 0..6 {
        let place = |a: usize, b: usize| {
            let axis = side / 2;
            let mut place = [if side % 2 == 1 { last } else { 0 }; 3];
            (place[(axis + 1) % 3], place[(axis + 2) % 3]) =
                if side % 2 == 1 { (a, b) } else { (b, a) };
            vertex(place)
        };
        let rim = (0..last).map(|k| place(k, 0)).chain((0..last).map(|k| place(last, k)));
        let back =
            (0..last).map(|k| place(last - k, last)).chain((0..last).map(|k| place(0, last - k)));
        let mut facet = vec![rim.chain(back).collect::<Vec<u32>>()];
        for a in 1..last {
            facet.extend((1..last).map(|b| vec![place(a, b)]));
        }
        facets.push(facet);
    }
    let facets_at = lattice
        .iter()
        .map(|place| (0..6).filter(|&side| is_on(place, side as usize)).collect())
        .collect();
    let inputs = points.len();
    let plan = Plan { points, inputs, facets, facets_at, ..Plan::default() };
    // The middle of a flat simplex is on a side.
    let depth = |p: Point| {
        let back = |k: usize| (0..3).map(|row| rows[row][k] * (p[row] - 0.7)).sum::<f64>() * 3.0;
        (0..3).map(|k| back(k).min(last as f64 - back(k))).fold(f64::INFINITY, f64::min)
    };
    let mut solid = plan.build(|p| (depth(p) > 1e-9).then_some(0));
    let first = solid.case.mesh.simplex_count() as u32;
    let count = solid.whole().simplex_count() as u32;
    solid.corrupt(|mesh| mesh.boundary.flat = (first..count).collect());
    solid
}
