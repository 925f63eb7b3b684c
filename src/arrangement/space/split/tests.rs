//! Facets and segments that cross, as vertices and lines of both.

use super::super::tests::Case;
use crate::error::Result;
use crate::mesh::{ArrangedFacet, Arrangement, FacetTriangle, Intersection, IntersectionKind};
use crate::numerics::coordinates;
use crate::numerics::testing::Random;
use crate::options::Crossings;

type Point = [f64; 3];

/// Points and triangles of an arrangement, with the caller's facet of each triangle.
struct Made {
    points: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    parents: Vec<u32>,
    arrangement: Arrangement,
}

fn split(case: &Case) -> Result<Made> {
    let arrangement = case.arranged_with(0.0, Crossings::Split)?;
    let inputs = &case.inputs;
    let mut points: Vec<Point> =
        (0..inputs.distinct()).map(|v| *coordinates::<3>(inputs.distinct_point(v), 0)).collect();
    points.extend(&arrangement.corners);
    let triangles = arrangement.triangles.iter().map(|one| one.vertices).collect();
    let parent = |facet: u32| arrangement.facets[facet as usize].parent;
    let parents = arrangement.triangles.iter().map(|one| parent(one.facet)).collect();
    Ok(Made { points, triangles, parents, arrangement })
}

fn cross([u, v]: [Point; 2]) -> Point {
    [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3])
}

fn normal(points: &[Point], [a, b, c]: [u32; 3]) -> Point {
    let way = |to: u32| [0, 1, 2].map(|k| points[to as usize][k] - points[a as usize][k]);
    cross([way(b), way(c)])
}

fn size(x: Point) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Returns the vertices of the caller's triangles.
fn given(case: &Case) -> Vec<[u32; 3]> {
    let corners = case.facets.inputs.chunks(3);
    corners
        .map(|own| [own[0], own[1], own[2]].map(|at| case.inputs.vertices()[at as usize]))
        .collect()
}

/// Checks that nothing meets any more but in what it has in common, that the triangles cover what
/// the caller's did, and that vertices are on the planes of their facets up to roundings.
fn check(case: &Case, made: &Made) {
    let mut known = made.points.clone();
    known.sort_by(|a, b| a.partial_cmp(b).unwrap());
    known.dedup();
    assert_eq!(known.len(), made.points.len());
    let whole = Case::surface(&made.points, &made.triangles);
    assert_eq!(whole.intersections(), []);
    let given = given(case);
    let area = |triangles: &[[u32; 3]]| -> f64 {
        triangles.iter().map(|&own| size(normal(&made.points, own))).sum()
    };
    let (before, after) = (area(&given), area(&made.triangles));
    let largest = made.points.iter().map(|&x| size(x)).fold(1.0, f64::max);
    assert!((after - before).abs() <= 1e-11 * largest * before, "{before} {after}");
    for (own, &parent) in made.triangles.iter().zip(&made.parents) {
        let plane = given[parent as usize];
        let normal = normal(&made.points, plane);
        let [origin, ..] = plane.map(|vertex| made.points[vertex as usize]);
        for &vertex in own {
            let x = made.points[vertex as usize];
            let height: f64 = (0..3).map(|k| normal[k] * (x[k] - origin[k])).sum();
            assert!(height.abs() <= 1e-13 * size(normal) * (1.0 + size(x)), "{height}");
        }
    }
}

/// Returns true if two of the facets lie on each other.
fn overlap(found: &[Intersection]) -> bool {
    found.iter().any(|found| found.kind == IntersectionKind::Overlap)
}

#[test]
fn two_triangles_that_cross_share_a_line() {
    let points = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 1.0, -1.0],
        [1.0, 1.0, 1.0],
        [3.0, 3.0, 0.5],
    ];
    let case = Case::surface(&points, &[[0, 1, 2], [3, 4, 5]]);
    let made = split(&case).unwrap();
    check(&case, &made);
    assert_eq!(made.arrangement.corners, [[2.0, 2.0, 0.0], [1.0, 1.0, 0.0]]);
    assert!(made.arrangement.subsegments.iter().any(|line| line.ends == [6, 7]));
    // Two facets still, of the caller's.
    let parents: Vec<u32> = made.arrangement.facets.iter().map(|facet| facet.parent).collect();
    assert_eq!(parents, [0, 1]);
}

#[test]
fn vertices_and_edges_that_touch_facets_are_theirs() {
    let square = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let floor = [[0, 1, 2], [0, 2, 3]];
    let tips: [(&[Point], usize); 4] = [
        // A vertex in a triangle, on the edge between two, an edge in both, and edges that cross.
        (&[[3.0, 1.0, 0.0], [3.0, 1.0, 1.0], [3.5, 1.0, 1.0]], 0),
        (&[[2.0, 2.0, 0.0], [3.0, 1.0, 1.0], [3.5, 1.0, 1.0]], 0),
        (&[[3.0, 1.0, 0.0], [1.0, 3.0, 0.0], [3.5, 1.0, 1.0]], 1),
        (&[[2.0, -1.0, 0.0], [2.0, 1.0, 0.0], [2.0, -1.0, 1.0]], 1),
    ];
    for (tip, new) in tips {
        let points: Vec<Point> = square.iter().chain(tip).copied().collect();
        let case = Case::surface(&points, &[floor[0], floor[1], [4, 5, 6]]);
        let made = split(&case).unwrap();
        check(&case, &made);
        assert_eq!(made.arrangement.corners.len(), new, "{tip:?}");
    }
}

#[test]
fn segments_are_split_at_facets() {
    let points = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 1.0, -1.0],
        [1.0, 1.0, 2.0],
        [0.5, 0.5, 0.0],
        [1.0, 2.0, 0.0],
    ];
    let case = Case::surface(&points, &[[0, 1, 2]]).with_segments(&[[3, 4], [5, 6]]);
    let made = split(&case).unwrap();
    check(&case, &made);
    assert_eq!(made.arrangement.corners, [[1.0, 1.0, 0.0]]);
    let of = |segment: u32| {
        let own = made.arrangement.subsegments.iter().filter(|line| line.segment == segment);
        own.map(|line| line.ends).collect::<Vec<_>>()
    };
    assert_eq!((of(0), of(1)), (vec![[3, 7], [7, 4]], vec![[5, 6]]));
}

/// Draws triangles with short decimal coordinates, as people write them, so that many nearly touch.
fn soup(count: usize, random: &mut Random) -> Case {
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    while triangles.len() < count {
        let first = points.len() as u32;
        let corner = |random: &mut Random| [0; 3].map(|_: i32| random.integer(0, 40) as f64 / 10.0);
        points.extend([corner(random), corner(random), corner(random)]);
        let own = [first, first + 1, first + 2];
        match size(normal(&points, own)) > 1e-3 {
            true => triangles.push(own),
            false => points.truncate(first as usize),
        }
    }
    Case::surface(&points, &triangles)
}

#[test]
fn soups_are_split() {
    let mut random = Random(77);
    // One has a line beside an edge of its facet, outside, and is refused.
    let (mut made, mut refused) = (0, 0);
    for trial in 0..160 {
        let case = soup(2 + trial % 24, &mut random);
        if overlap(&case.intersections()) {
            continue;
        }
        match split(&case) {
            Ok(split) => {
                check(&case, &split);
                made += 1;
            }
            Err(error) => {
                assert!(error.message().contains("still meet"), "{trial}: {}", error.message());
                refused += 1;
            }
        }
    }
    assert!(made > 140 && refused <= 1, "{made} {refused}");
}

/// Splits sheaves of triangles through nearly one line, and through nearly one point.
#[test]
fn sheaves_are_split() {
    let mut random = Random(5);
    for trial in 0..60 {
        let mut points: Vec<Point> = Vec::new();
        let mut triangles = Vec::new();
        let is_pencil = trial % 2 == 0;
        for at in 0..3 + trial % 7 {
            let angle = f64::from(at) * 0.7 + 0.1;
            let [c, s] = [angle.cos(), angle.sin()];
            let tilt = if is_pencil { 0.0 } else { random.unit() - 0.5 };
            let x = |u: f64, v: f64| [0.1 + u * c, 0.2 + u * s, 0.3 + v + tilt * u];
            let first = points.len() as u32;
            points.extend([x(-1.0, -1.0), x(1.0, -0.9), x(0.1, 1.5)]);
            triangles.push([first, first + 1, first + 2]);
        }
        let case = Case::surface(&points, &triangles);
        check(&case, &split(&case).unwrap_or_else(|error| panic!("{trial}: {}", error.message())));
    }
}

/// Splits facets whose lines part at roundings: in the gap both have one triangle. Of objects of
/// pybullet's, six digits of a coordinate.
#[test]
fn facets_may_share_a_triangle_no_wider_than_roundings() {
    let cases: [&[Point]; 2] = [
        &[
            [-1.027410, -3.697293, -0.834740],
            [-1.048510, -3.634856, 0.726376],
            [-1.027410, -3.614041, -0.210545],
            [-1.048510, -1.739799, 0.663925],
            [-1.027689, -3.634449, 0.663925],
            [-1.048510, -3.634449, 0.663925],
            [-1.048502, -3.634850, 0.663933],
            [-1.027669, -3.634850, 0.663933],
            [-0.548945, -1.054072, 0.643107],
        ],
        &[
            [-0.966692, -2.756292, -1.095661],
            [-0.966677, -2.756292, 2.858378],
            [-0.941166, -2.781827, -1.095661],
            [-0.966663, -2.756307, 2.526437],
            [-0.966663, -2.781825, 2.858151],
            [-0.456415, -2.756307, 2.832683],
            [-0.966663, -2.909344, 0.741166],
            [-0.966663, -2.756307, 2.526437],
            [-0.966663, -2.883844, 0.996478],
        ],
    ];
    for points in cases {
        let case = Case::surface(points, &[[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
        check(&case, &split(&case).unwrap());
    }
}

/// Splits triangles that cross one whose coordinates along an axis are far smaller than theirs, or
/// all the same: it has no room for roundings of theirs.
#[test]
fn corners_have_the_finest_coordinates() {
    let mut random = Random(3);
    let mut in_plane = 0;
    for trial in 0..80 {
        let corner = |random: &mut Random| [0; 3].map(|_: i32| random.unit() - 0.5);
        let mut points = [[0.0; 3]; 24].map(|_: Point| corner(&mut random));
        let height = |y: f64| [-0.000467, -0.3, 1e-4 * y, 1e-9 * y][trial % 4];
        points[..3].iter_mut().for_each(|x| x[1] = height(x[1]));
        let triangles = [0, 1, 2, 3, 4, 5, 6, 7].map(|at| [3 * at, 3 * at + 1, 3 * at + 2]);
        let case = Case::surface(&points, &triangles);
        let made = split(&case).unwrap_or_else(|error| panic!("{trial}: {}", error.message()));
        check(&case, &made);
        if trial % 4 < 2 {
            let own = made.triangles.iter().zip(&made.parents).filter(|own| *own.1 == 0);
            for &vertex in own.flat_map(|own| own.0) {
                assert_eq!(made.points[vertex as usize][1], height(0.0), "{trial}");
                in_plane += usize::from(vertex >= 24);
            }
        }
    }
    assert!(in_plane > 100, "{in_plane}");
}

/// Splits triangles far away along one axis, as maps of a country have them: its roundings are far
/// coarser than those along the others, which their crossings have too.
#[test]
fn facets_far_away_along_an_axis_are_split() {
    let mut random = Random(3);
    for trial in 0..60 {
        let shift = [1e3, 1e6, 1e9][trial % 3];
        let corner = |random: &mut Random| [0; 3].map(|_: i32| random.unit() - 0.5);
        let mut points = [[0.0; 3]; 30].map(|_: Point| corner(&mut random));
        points.iter_mut().for_each(|x| x[trial / 3 % 3] += shift);
        let triangles: Vec<_> = (0..10).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
        let case = Case::surface(&points, &triangles);
        check(&case, &split(&case).unwrap_or_else(|error| panic!("{trial}: {}", error.message())));
    }
}

/// Splits triangles of which one corner is at y = 0 up to what trigonometry leaves of zeros: what
/// crosses there has the roundings of x and z.
#[test]
fn edges_are_at_zero_up_to_roundings_of_other_axes() {
    let mut random = Random(5);
    for trial in 0..20 {
        let corner = |random: &mut Random| [0; 3].map(|_: i32| random.unit() - 0.5);
        let mut points = [[0.0; 3]; 24].map(|_: Point| corner(&mut random));
        for (at, x) in points.iter_mut().enumerate() {
            match at % 3 {
                0 => x[1] = [0.0, 3e-17, -1e-18][random.integer(0, 2) as usize],
                1 => x[1] = [0.0, 2e-17, 1e-33][random.integer(0, 2) as usize],
                _ => (),
            }
            x[2] = if at % 3 < 2 { 0.25 } else { x[2] };
        }
        let triangles: Vec<_> = (0..8).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
        let case = Case::surface(&points, &triangles);
        check(&case, &split(&case).unwrap_or_else(|error| panic!("{trial}: {}", error.message())));
    }
}

/// Draws triangles with whole coordinates in one plane.
fn layers(count: usize, random: &mut Random) -> Case {
    let mut points: Vec<Point> = Vec::new();
    while points.len() < 3 * count {
        let corner = |random: &mut Random| {
            let [x, y] = [0; 2].map(|_: i32| random.integer(0, 8) as f64);
            [x, y, 2.0 * x - y]
        };
        let own = [corner(random), corner(random), corner(random)];
        points.extend(own);
        if normal(&own, [0, 1, 2])[2] == 0.0 {
            points.truncate(points.len() - 3);
        }
    }
    let triangle = |at: u32| [3 * at, 3 * at + 1, 3 * at + 2];
    Case::surface(&points, &(0..count as u32).map(triangle).collect::<Vec<_>>())
}

/// Returns 1 or -1 if the image of a triangle holds a point, by its direction; otherwise 0.
fn layer_at(points: &[Point], [a, b, c]: [u32; 3], x: [f64; 2]) -> i64 {
    let [a, b, c] = [a, b, c].map(|vertex| points[vertex as usize]);
    let turn = |p: Point, q: Point| (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]);
    match [turn(a, b), turn(b, c), turn(c, a)] {
        all if all.iter().all(|&turn| turn > 0.0) => 1,
        all if all.iter().all(|&turn| turn < 0.0) => -1,
        _ => 0,
    }
}

/// Holds that of triangles on each other one is left everywhere, of the first that is there, with
/// the sum of their directions.
#[test]
fn layers_are_left_to_the_first() {
    let mut random = Random(12);
    let mut shared = 0;
    for trial in 0..200 {
        let case = layers(2 + trial % 7, &mut random);
        let made = split(&case).unwrap_or_else(|error| panic!("{trial}: {}", error.message()));
        assert_eq!(Case::surface(&made.points, &made.triangles).intersections(), [], "{trial}");
        let given = given(&case);
        for _ in 0..100 {
            let x = [8.0 * random.unit(), 8.0 * random.unit()];
            let before: Vec<i64> =
                given.iter().map(|&own| layer_at(&made.points, own, x)).collect();
            let there = |own: &(&[u32; 3], &ArrangedFacet)| layer_at(&made.points, *own.0, x) != 0;
            let facet = |one: &FacetTriangle| &made.arrangement.facets[one.facet as usize];
            let facets = made.arrangement.triangles.iter().map(facet);
            let found: Vec<_> = made.triangles.iter().zip(facets).filter(there).collect();
            let Some(first) = before.iter().position(|&turn| turn != 0) else {
                assert!(found.is_empty(), "{trial} {x:?}");
                continue;
            };
            let [(triangle, facet)] = found[..] else { panic!("{trial} {x:?} {found:?}") };
            let turn = layer_at(&made.points, *triangle, x);
            assert_eq!(turn, before[first], "{trial} {x:?}");
            assert_eq!(turn * facet.balance, before.iter().sum::<i64>(), "{trial} {x:?}");
            assert!(facet.parent <= first as u32, "{trial} {x:?}");
            shared += usize::from(before.iter().filter(|&&turn| turn != 0).count() > 1);
        }
    }
    assert!(shared > 400, "{shared}");
}
