//! Surfaces that cross themselves, split at their crossings: each mesh holds its certificate, and
//! regions are those of the rule.

use super::{Point, assert_holds, bounded, volume};
use crate::random::Random;
use netmesh::error::ErrorKind;
use netmesh::options::{Crossings, Extent, Interior, Options};
use netmesh::validate::{Outline, ViolationKind as Kind, validate_outlined};
use netmesh::{Mesh, Triangulation};

pub fn split(extent: Extent, bound: f64) -> Options {
    Options { extent, crossings: Crossings::Split, max_vertices: 100_000, ..bounded(bound) }
}

pub fn surface(points: &[Point], triangles: &[[u32; 3]]) -> Mesh {
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(triangles.as_flattened(), None).unwrap();
    mesh
}

/// Returns the mesh of a run, whose certificate holds.
pub fn run(points: &[Point], triangles: &[[u32; 3]], options: &Options) -> Triangulation {
    let mut mesh = surface(points, triangles);
    mesh.run(options, None).unwrap_or_else(|error| panic!("{}", error.message()));
    assert_holds(&mesh);
    mesh.result().unwrap().clone()
}

/// Returns a box between two corners, oriented outwards.
pub fn cuboid([a, b]: [Point; 2], first: u32) -> (Vec<Point>, Vec<[u32; 3]>) {
    let corner = |at: u32| [0, 1, 2].map(|k| if at >> k & 1 == 0 { a[k] } else { b[k] });
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| {
        [[a, b, c], [a, c, d]].map(|own| own.map(|vertex: u32| vertex + first))
    });
    ((0..8).map(corner).collect(), triangles.collect())
}

fn crossing_boxes() -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [4.0; 3]], 0);
    let (more, others) = cuboid([[2.5, 1.25, 1.5], [6.0, 3.5, 2.75]], 8);
    points.extend(more);
    triangles.extend(others);
    (points, triangles)
}

#[test]
fn shells_that_cross_enclose_what_the_rule_says() {
    let (points, triangles) = crossing_boxes();
    let (whole, other) = (64.0, 3.5 * 2.25 * 1.25);
    let common = 1.5 * 2.25 * 1.25;
    for (interior, expected) in [
        (Interior::Auto, whole + other - common),
        (Interior::Winding, whole + other - common),
        (Interior::Parity, whole + other - 2.0 * common),
        (Interior::Seeds, whole + other - common),
    ] {
        for bound in [f64::INFINITY, 2.0] {
            let options = Options { interior, ..split(Extent::Boundary, bound) };
            let made = run(&points, &triangles, &options);
            assert!((volume(&made) - expected).abs() < 1e-12 * expected, "{interior:?}");
        }
    }
    let mut mesh = surface(&points, &triangles);
    let error = mesh.run(&bounded(2.0), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(
        error.message().ends_with("with options.crossings = Crossings::Split they are split there")
    );
}

/// Holds that a shell within a shell is a hole in it if it is turned round, and none otherwise.
#[test]
fn hollow_shells_are_hollow() {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [4.0; 3]], 0);
    let (more, mut inner) = cuboid([[1.0; 3], [2.0; 3]], 8);
    points.extend(more);
    for is_turned in [false, true] {
        inner.iter_mut().for_each(|own| own.reverse());
        let all = [&triangles[..], &inner].concat();
        let made = run(&points, &all, &bounded(2.0));
        assert_eq!(made.parameters.interior, Interior::Winding);
        // Turned an odd number of times they are hollow.
        let expected = if is_turned { 64.0 } else { 63.0 };
        assert!((volume(&made) - expected).abs() < 1e-12, "{is_turned}");
    }
    // One triangle turned round: no rule is sure, and all that is shut off is inside.
    triangles[0].reverse();
    let made = run(&points, &[&triangles[..], &inner].concat(), &bounded(2.0));
    assert_eq!(made.parameters.interior, Interior::Seeds);
    assert!((volume(&made) - 64.0).abs() < 1e-12);
}

/// Holds that of triangles that are there twice one stays: between two boxes it is a wall.
#[test]
fn walls_that_are_there_twice_are_one() {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [1.0; 3]], 0);
    let (more, others) = cuboid([[1.0, 0.0, 0.0], [2.0, 1.0, 1.0]], 8);
    points.extend(more);
    triangles.extend(others);
    for interior in [Interior::Auto, Interior::Parity] {
        let options = Options { interior, ..split(Extent::Boundary, 2.0) };
        let made = run(&points, &triangles, &options);
        assert_eq!(volume(&made), 2.0, "{interior:?}");
        // The wall has two triangles, with a simplex on both sides.
        let sides = made.boundary.subfacet_simplices.iter();
        assert!(sides.filter(|sides| sides.iter().all(|&one| one != netmesh::NONE)).count() >= 2);
    }
}

/// Holds that triangles without an area, in a line or with an input twice, are refused by name or
/// left out.
#[test]
fn triangles_without_an_area_are_left_out() {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [1.0; 3]], 0);
    points.push([0.5, 0.0, 0.0]);
    for own in [[0, 8, 1], [3, 3, 5], [6, 6, 6]] {
        triangles.push(own);
        let made = run(&points, &triangles, &split(Extent::Boundary, 2.0));
        assert_eq!(volume(&made), 1.0, "{own:?}");
        let error = surface(&points, &triangles).run(&bounded(2.0), None).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert!(error.message().starts_with("triangles[12] has no area near"), "{error}");
        assert!(error.message().ends_with("facets without an area are left out"), "{error}");
    }
}

/// Returns boxes of which the sides of three lie in one plane and share areas, two of them twice.
fn touching_boxes() -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [4.0; 3]], 0);
    for [a, b] in [[[4.0, 1.0, 1.0], [6.0, 5.0, 2.0]], [[4.0, 2.0, -1.0], [5.0, 3.0, 1.0]]] {
        let (more, others) = cuboid([a, b], points.len() as u32);
        points.extend(more);
        triangles.extend(others);
    }
    (points, triangles)
}

/// Turns points about the origin.
pub fn turned(points: &[Point]) -> Vec<Point> {
    let ([c, s], [d, t]) = ([0.8, 0.6], [5.0 / 13.0, 12.0 / 13.0]);
    let turn = |&[x, y, z]: &Point| {
        let (x, y) = (c * x - s * y, s * x + c * y);
        [x, d * y - t * z, t * y + d * z]
    };
    points.iter().map(turn).collect()
}

/// Holds that an edge may lie on the line of another of its facet.
#[test]
fn corners_on_the_line_of_an_edge_are_not_beside_it() {
    let [x, y, z] = [|x: f64| [x, 0.0, 0.0], |y: f64| [0.0, y, 0.0], |z: f64| [1.5, 0.25, z]];
    let mut points = vec![x(0.0), x(1.0), [1.0, 1.0, 0.0], [2.0, 1.0, 0.0], x(2.0), x(3.0)];
    points.extend([[3.0, 2.0, 0.0], y(2.0), z(-1.0), [0.5, 0.0, 1.0], [0.5, -1.0, 0.0]]);
    points.extend([[2.5, 0.0, 1.0], [2.5, 0.0, -1.0], [2.5, 1.0, 0.0]]);
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    let inputs = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13];
    mesh.set_facets(&[0, 1, 2, 3], &[0, 8, 11, 14], &inputs, None).unwrap();
    mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap();
    assert_holds(&mesh);
}

/// Holds that polygons which are bent as far as the caller allows are split as plane ones are.
#[test]
fn bent_polygons_are_split() {
    let mut random = Random::new(11);
    for (bend, bound) in [(0.0, 2.0), (1e-6, 2.0), (0.002, f64::INFINITY), (0.01, 2.0)] {
        // Squares whose corners are above and below a plane, and two walls through them.
        let places = (0..5).flat_map(|i| (0..5).map(move |j| [f64::from(i), f64::from(j)]));
        let mut points: Vec<Point> = places.map(|[x, y]| [x, y, bend * random.unit()]).collect();
        let squares = (0..4).flat_map(|i| (0..4).map(move |j| 5 * i + j));
        let mut corners: Vec<u32> = squares.flat_map(|at| [at, at + 5, at + 6, at + 1]).collect();
        for [[x, y], [z, w]] in [[[0.3, -1.0], [3.8, 5.0]], [[-1.0, 2.6], [5.0, 1.7]]] {
            let first = points.len() as u32;
            points.extend([[x, y, -1.0], [z, w, -1.0], [z, w, 1.0], [x, y, 1.0]]);
            corners.extend([first, first + 1, first + 2, first + 3]);
        }
        let points = turned(&points);
        let ends: Vec<u64> = (0..=corners.len() as u64 / 4).map(|facet| 4 * facet).collect();
        let loops: Vec<u64> = (0..ends.len() as u64).collect();
        let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
        mesh.set_facets(&loops, &ends, &corners, None).unwrap();
        let options = Options { coplanar: 2.0, ..split(Extent::All, bound) };
        mesh.run(&options, None).unwrap_or_else(|e| panic!("{bend}: {}", e.message()));
        assert_holds(&mesh);
        // The squares and walls have 48 edges.
        let subsegments = mesh.result().unwrap().boundary.subsegments.len();
        assert!(subsegments > 60, "{bend}: {subsegments} subsegments");
    }
}

/// Returns the area of the subfacets with simplices on both sides.
fn area_of_walls(made: &Triangulation) -> f64 {
    let boundary = &made.boundary;
    let walls = boundary.subfacets.iter().zip(&boundary.subfacet_simplices);
    let walls = walls.filter(|(_, sides)| !sides.contains(&netmesh::NONE));
    let area = |(own, _): (&[u32; 3], _)| {
        let [a, b, c] = own.map(|vertex| &made.points[3 * vertex as usize..][..3]);
        let [u, v] = [b, c].map(|x| [0, 1, 2].map(|k| x[k] - a[k]));
        let cross = [0, 1, 2].map(|k| {
            let [i, j] = [(k + 1) % 3, (k + 2) % 3];
            u[i] * v[j] - u[j] * v[i]
        });
        0.5 * cross.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    walls.map(area).sum()
}

/// Holds that sides which share areas are walls there, for triangles and for polygons, and where
/// roundings leave them beside each other.
#[test]
fn sides_that_share_areas_are_walls() {
    let (straight, triangles) = touching_boxes();
    let expected = 64.0 + 8.0 + 2.0;
    for points in [turned(&straight), straight] {
        for interior in [Interior::Auto, Interior::Winding, Interior::Parity, Interior::Seeds] {
            for bound in [f64::INFINITY, 2.0] {
                let options = Options { interior, ..split(Extent::Boundary, bound) };
                let made = run(&points, &triangles, &options);
                assert!((volume(&made) - expected).abs() < 1e-12 * expected, "{interior:?}");
                assert!((area_of_walls(&made) - 5.0).abs() < 1e-12, "{interior:?}");
            }
        }
        let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
        let quads: Vec<[u32; 4]> =
            triangles.chunks(2).map(|two| [two[0][0], two[0][1], two[0][2], two[1][2]]).collect();
        let starts: Vec<u64> = (0..=quads.len() as u64).collect();
        let inputs: Vec<u64> = starts.iter().map(|at| 4 * at).collect();
        mesh.set_facets(&starts, &inputs, quads.as_flattened(), None).unwrap();
        let options = Options { interior: Interior::Winding, ..split(Extent::Boundary, 2.0) };
        mesh.run(&options, None).unwrap_or_else(|error| panic!("{}", error.message()));
        assert_holds(&mesh);
        let made = mesh.result().unwrap();
        assert!((volume(made) - expected).abs() < 1e-12 * expected);
    }
}

/// Holds that a facet which lies on others is found in these, and that nothing else is.
#[test]
fn the_certificate_finds_what_is_borrowed() {
    let (points, triangles) = touching_boxes();
    let mut mesh = surface(&points, &triangles);
    let options = Options { interior: Interior::Winding, ..split(Extent::Boundary, 2.0) };
    mesh.run(&options, None).unwrap();
    let made = mesh.result().unwrap();
    let check = |changed: &Triangulation| {
        let (facets, segments) = (mesh.given_facets(), mesh.segments());
        let outline = Outline { segments, facets, regions: &[] };
        validate_outlined(mesh.inputs(), outline, changed, 3).unwrap()
    };
    assert_eq!(check(made).violations, 0);
    // A wall between two boxes is of the first, so that none is of the third.
    let walls = made.boundary.subfacet_simplices.iter().map(|one| !one.contains(&netmesh::NONE));
    let wall = walls.clone().position(|is_wall| is_wall).unwrap();
    assert!(walls.zip(&made.boundary.subfacet_parents).all(|(wall, &parent)| !wall || parent < 24));
    // A wall that is missing is missed by both of its facets.
    let mut changed = made.clone();
    changed.boundary.subfacets.remove(wall);
    changed.boundary.subfacet_parents.remove(wall);
    changed.boundary.subfacet_simplices.remove(wall);
    assert!(check(&changed).violations > 0);
    // Nothing is borrowed where crossings are refused.
    let mut changed = made.clone();
    changed.parameters.crossings = Crossings::Refuse;
    assert!(check(&changed).violations > 0);
}

/// Returns the first violation of a mesh of the crossing boxes that is changed.
fn violation(change: impl FnOnce(&mut Triangulation)) -> (Kind, usize) {
    let (points, triangles) = crossing_boxes();
    let mut mesh = surface(&points, &triangles);
    mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap();
    let mut changed = mesh.result().unwrap().clone();
    // The chains of the caller's edges bend at crossings: one of these is the corner of a line.
    let at = changed.points.chunks(3).position(|x| x == [4.0, 1.25, 1.5]).unwrap();
    change(&mut changed);
    let (facets, segments) = (mesh.given_facets(), mesh.segments());
    let outline = Outline { segments, facets, regions: &[] };
    let report = validate_outlined(mesh.inputs(), outline, &changed, 2).unwrap();
    (report.first.map(|first| first.kind).unwrap(), at)
}

/// Holds that the certificate admits lines between facets and bent chains only where crossings are
/// to be split, and no bend beyond roundings.
#[test]
fn the_certificate_knows_what_may_be_split() {
    let (kind, at) = violation(|made| made.parameters.crossings = Crossings::Refuse);
    assert_eq!(kind, Kind::SegmentLine);
    // A line of no two facets.
    let (kind, _) = violation(|made| {
        let edge = |ends: &[u32; 2], parents: &[u32]| {
            let faces = made.boundary.subfacets.iter().zip(parents);
            let beside = faces.filter(|(face, _)| ends.iter().all(|end| face.contains(end)));
            beside.map(|(_, &parent)| parent).collect::<Vec<u32>>()
        };
        let parents = &made.boundary.subfacet_parents;
        let sides = made.boundary.subfacets.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let is_inner = |ends: &[u32; 2]| {
            let of = edge(ends, parents);
            let is_new = !made
                .boundary
                .subsegments
                .iter()
                .any(|own| own.contains(&ends[0]) && own.contains(&ends[1]));
            of.len() == 2 && of[0] == of[1] && is_new
        };
        let inner = sides.filter(is_inner).min().unwrap();
        made.boundary.subsegments.push(inner);
        made.boundary.parents.push(netmesh::NONE);
    });
    assert_eq!(kind, Kind::SegmentLine);
    let (kind, _) = violation(|made| made.points[3 * at + 1] += 64.0 * f64::EPSILON);
    assert!(kind.level() == 2, "{kind:?}");
}

/// Holds that soups end in a mesh with its certificate, or in a limit where doubles have no room.
#[test]
fn soups_hold_their_certificate() {
    let mut random = Random::new(31);
    let (mut made, mut left) = (0, 0);
    for trial in 0..36 {
        let count = 2 + trial % 6;
        let mut corner = || [0; 3].map(|_: i32| (random.unit() * 40.0).round() / 10.0);
        let points: Vec<Point> = std::iter::repeat_with(&mut corner).take(3 * count).collect();
        let triangles: Vec<[u32; 3]> =
            (0..count as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
        for (extent, bound) in [(Extent::All, f64::INFINITY), (Extent::Box, 2.0)] {
            let mut mesh = surface(&points, &triangles);
            match mesh.run(&split(extent, bound), None) {
                Ok(()) => {
                    assert_holds(&mesh);
                    made += 1;
                }
                Err(error) => {
                    assert_eq!(error.kind(), ErrorKind::Limit, "{trial}: {}", error.message());
                    left += 1;
                }
            }
        }
    }
    assert!(made >= 68 && left <= 4, "{made} {left}");
}
