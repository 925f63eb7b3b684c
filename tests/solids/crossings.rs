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

/// Meshes three triangles of a circuit in millimetres, in single precision: the second is a needle
/// 3e-8 wide, turned over onto the first.
#[test]
fn a_needle_turned_over_onto_its_neighbor_is_certified() {
    let points = [
        [-2.0, -3.1772758960723877, 2.0],
        [-1.600000023841858, -3.3071799278259277, 2.0],
        [-0.6000000238418579, -2.0, 2.0],
        [0.4000000059604645, -0.6928200125694275, 2.0],
        [0.6000000238418579, -0.8660249710083008, 2.0],
    ];
    let triangles = [[1, 4, 3], [1, 3, 2], [2, 0, 1]];
    let made = run(&points, &triangles, &split(Extent::Auto, 2.0));
    assert!(made.boundary.subfacets.len() > 100, "{}", made.boundary.subfacets.len());
}

/// Meshes a side of a part that is bent by 2e-5 at its end. A needle 3e-6 wide is turned over onto
/// it, and a triangle stands on the needle, with tiles that are nearer to the plane of the side
/// than some of the needle's are.
#[test]
fn a_triangle_that_stands_on_a_turned_needle_is_certified() {
    let points = [
        [9.0, 0.0, 6.0],
        [10.0, 0.0, 0.0],
        [17.0, 0.0, 0.0],
        [-8.0, 0.0, 0.0],
        [-8.0, 0.0, 0.0],
        [-12.0, 4.0, 0.0],
        [9.1, -0.05, 0.0],
        [-4.0, 4.0, 0.0],
        [17.0, 4.0, 0.0],
        [5.0, 0.0, 0.0],
        [0.0, -3e-6, 0.0],
        [-11.0, 3.9, 0.0],
        [-10.0, 3.0, 0.0],
        [-9.0, 3.0, 0.0],
        [-8.0, 2.0, 0.0],
        [-8.0, 1.0, 0.0],
        [-49.0, 7.9, 0.0],
        [-49.0, 8.0, 0.0],
        [-8.0, 8.0, 0.0],
        [-8.0, 8.0, 0.0],
        [-75.0, 8.0, -2e-5],
        [-53.0, 4.0, 0.0],
    ];
    let triangles = [
        [0, 6, 1],
        [10, 4, 7],
        [2, 9, 10],
        [7, 2, 10],
        [16, 17, 18],
        [16, 18, 5],
        [7, 3, 15],
        [7, 15, 14],
        [5, 19, 7],
        [11, 5, 7],
        [7, 14, 13],
        [12, 11, 7],
        [13, 12, 7],
        [8, 7, 19],
        [20, 17, 16],
        [20, 16, 21],
    ];
    let options = Options { coplanar: 0.1, ..split(Extent::Auto, f64::INFINITY) };
    run(&points, &triangles, &options);
}

/// Meshes sides of a camera, at z = -0.003, over each other: an edge of one has y = -3e-19 at an
/// end, where the other's are at 0. The corners there are no wider than roundings, and two edges of
/// one triangle lead along one line to each.
#[test]
fn corners_no_wider_than_roundings_are_spurs() {
    const Z: f64 = -0.0029700002633035183;
    const BELOW: f64 = -0.0030200001783668995;
    let points = [
        [-0.02369752712547779, -0.0001223865256179124, Z],
        [-0.02369752712547779, 0.0001223865256179124, Z],
        [-0.0169190876185894, -3.3034848459710015e-19, Z],
        [-0.023683717474341393, 0.0, Z],
        [-0.017024235799908638, 0.0, BELOW],
        [-0.016930455341935158, 0.0010106224799528718, BELOW],
        [-0.016930455341935158, -0.0010106224799528718, Z],
        [-0.023689555004239082, -0.0001223865256179124, Z],
        [-0.017024235799908638, 0.0, Z],
        [-0.023675745353102684, 0.0, Z],
        [-0.023689555004239082, 0.0001223865256179124, Z],
        [-0.016930455341935158, 0.0010106224799528718, Z],
    ];
    let triangles =
        [[1, 2, 3], [3, 2, 0], [8, 9, 7], [8, 10, 9], [8, 7, 6], [11, 10, 8], [5, 8, 4]];
    for coplanar in [0.0, 0.1] {
        run(&points, &triangles, &Options { coplanar, ..split(Extent::Box, f64::INFINITY) });
    }
}

/// Meshes two triangles that have a corner 10 units in the last place from each other: the edges of
/// one lead to its corner along a line that no other triangle has.
#[test]
fn spurs_that_nobody_else_has_are_lines() {
    let points = [
        [100.0000000000009, 1.5000000000009206, 0.5],
        [100.5, 1.5, 0.75],
        [100.75000000000014, 1.5, 0.75],
        [100.75, 1.0, 0.0],
        [100.75, 1.5, 0.75],
        [100.25, 1.5, 0.7500000000008598],
    ];
    run(&points, &[[0, 1, 2], [3, 4, 5]], &split(Extent::Box, f64::INFINITY));
}

/// Meshes two triangles of a robot's trunk at y = 42.5 and z = 560. One goes through a vertex of
/// the other as nearly as z is rounded, and not as y is.
#[test]
fn facets_go_through_vertices_within_roundings_of_their_coarsest_axis() {
    let points = [
        [45.63075256347656, 42.500301361083984, 554.7059326171875],
        [43.5981559753418, 42.50029754638672, 559.784912109375],
        [42.73825454711914, 42.50029754638672, 560.3169555664062],
        [43.528350830078125, 46.71749496459961, 559.626953125],
        [43.168155670166016, 42.50029754638672, 560.0509643554688],
    ];
    run(&points, &[[0, 1, 2], [2, 4, 3]], &split(Extent::Box, f64::INFINITY));
}

/// Holds that two fins at an end on a facet's edge, at angles of less than a millionth from the
/// facet, end in a limit with a place, or in a mesh. A subfacet between opposite points of a sphere
/// about the end is flat but for roundings: the way to the middle of its arc is no number, and
/// vertices of its sheet would be at 1e307.
#[test]
fn fins_on_an_edge_end() {
    let cases = [
        [
            [-18.076514745853878, -5.758948218421862, 1.5627701748802671],
            [-14.52703524892689, 5.053351236163664, -13.343523170709073],
            [16.7504750615823, -11.331917897075154, -11.583237159213088],
            [-16.314052522388742, -0.39019785544669805, -5.838816152420987],
            [-2.885191851960222, -0.43207676898772224, -11.944434286678208],
            [-4.006314997630335, 1.0166645827518819, -13.525961902818517],
            [-8.08828036055679, -0.4477358333912683, -11.391458306813236],
            [-6.056121034236519, 1.9109809016008104, -14.715523476382332],
        ],
        [
            [19.034156753738714, 16.449382345340183, -2.4529761549274767],
            [8.124272578501142, -1.9165619771591516, -14.257415756098126],
            [19.745492787353598, -4.720348807496171, -16.284231688848134],
            [15.222529129370447, 10.032802700421671, -6.577138002230405],
            [13.892750147662444, 1.574708842587813, -13.600457829227638],
            [12.877635973993922, 0.6646013733840597, -12.720754592622857],
            [16.20129464315308, 3.4917292414483057, -10.811496043232156],
            [14.471712668495222, 0.7334661407775859, -11.061586688274653],
        ],
    ];
    for points in cases {
        let mut mesh = surface(&points, &[[0, 1, 2], [3, 4, 5], [3, 6, 7]]);
        match mesh.run(&split(Extent::Box, f64::INFINITY), None) {
            Ok(()) => assert_holds(&mesh),
            Err(error) => {
                assert_eq!(error.kind(), ErrorKind::Limit, "{}", error.message());
                assert!(error.message().contains("doubles have no room"), "{}", error.message());
            }
        }
    }
}
