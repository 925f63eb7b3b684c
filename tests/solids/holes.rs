//! Holes of surfaces, closed by triangles: what was closed is a solid again.

use super::{Point, assert_holds, bounded, cuboid, volume};
use crate::random::Random;
use netmesh::{EdgeFault, Mesh};

/// Returns a mesh with the triangles of a surface, each with a marker.
fn surface(points: &[Point], triangles: &[[u32; 3]], markers: &[i32]) -> Mesh {
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_triangles(triangles.as_flattened(), Some(markers)).unwrap();
    mesh
}

fn open_edges(mesh: &Mesh) -> usize {
    mesh.diagnosis().unwrap().edges_with(EdgeFault::Open)
}

/// Returns a prism over a polygon, open above, and the area of the polygon. Each of its walls has a
/// vertex in the middle of its upper edge.
fn open_prism(polygon: &[[f64; 2]], place: impl Fn(Point) -> Point) -> (Vec<Point>, Vec<Vec<u32>>) {
    let count = polygon.len() as u32;
    let at = |number: u32| polygon[(number % count) as usize];
    let middle = |number: u32| {
        let [a, b] = [at(number), at(number + 1)];
        [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 1.0]
    };
    let lower = (0..count).map(|number| [at(number)[0], at(number)[1], 0.0]);
    let upper = (0..count).flat_map(|number| [[at(number)[0], at(number)[1], 1.0], middle(number)]);
    let points = lower.chain(upper).map(place).collect();
    let wall = |number: u32| {
        let next = (number + 1) % count;
        vec![number, next, count + 2 * next, count + 2 * number + 1, count + 2 * number]
    };
    let floor = (0..count).rev().collect();
    (points, (0..count).map(wall).chain([floor]).collect())
}

/// Holds that a flat lid is closed within its plane, also where it is not convex and has vertices
/// in the middle of its edges.
#[test]
fn lids_are_flat() {
    let horseshoe = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 4.0],
        [3.0, 4.0],
        [3.5, 1.0],
        [1.5, 1.0],
        [2.0, 4.0],
        [0.0, 4.0],
    ];
    let shoelace = |own: &[[f64; 2]]| -> f64 {
        let next = own.iter().cycle().skip(1);
        own.iter().zip(next).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
    };
    for is_tilted in [false, true] {
        let place = |x| if is_tilted { super::tilted(x) } else { x };
        let (points, polygons) = open_prism(&horseshoe, place);
        let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
        let loops: Vec<u64> = (0..=polygons.len() as u64).collect();
        let lengths = polygons.iter().scan(0, |sum, own| {
            *sum += own.len() as u64;
            Some(*sum)
        });
        let starts: Vec<u64> = [0].into_iter().chain(lengths).collect();
        mesh.set_facets(&loops, &starts, &polygons.concat(), Some(&[4; 9])).unwrap();
        assert_eq!(open_edges(&mesh), 16);
        let filling = mesh.close_holes(16).unwrap();
        assert_eq!((filling.holes, filling.triangles.len(), filling.open_edges), (1, 14, 0));
        assert_eq!((open_edges(&mesh), filling.markers), (0, vec![4; 14]));
        assert!(mesh.diagnosis().unwrap().edges.is_empty(), "the lid looks outwards");
        mesh.run(&bounded(2.0), None).unwrap_or_else(|error| panic!("{error}"));
        assert_holds(&mesh);
        let expected = shoelace(&horseshoe);
        assert!((volume(mesh.result().unwrap()) - expected).abs() < 1e-12 * expected);
    }
}

/// Returns a sphere of triangles: points on rings, and two poles.
fn sphere(rings: u32, sides: u32) -> (Vec<Point>, Vec<[u32; 3]>) {
    let mut points = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    for ring in 1..=rings {
        let (s, c) = (f64::from(ring) * std::f64::consts::PI / f64::from(rings + 1)).sin_cos();
        points.extend((0..sides).map(|side| {
            let (t, u) = (f64::from(side) * std::f64::consts::TAU / f64::from(sides)).sin_cos();
            [s * u, s * t, c]
        }));
    }
    let at = |ring: u32, side: u32| 2 + ring * sides + side % sides;
    let mut triangles = Vec::new();
    for side in 0..sides {
        triangles.push([0, at(0, side), at(0, side + 1)]);
        triangles.push([1, at(rings - 1, side + 1), at(rings - 1, side)]);
        for ring in 0..rings - 1 {
            let [a, b] = [side, side + 1].map(|side| at(ring, side));
            let [c, d] = [side, side + 1].map(|side| at(ring + 1, side));
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    (points, triangles)
}

/// Holds of spheres without some of their triangles that what is closed has no open edges, and that
/// what stays open is told; holes may share vertices.
#[test]
fn random_holes_are_closed() {
    let mut random = Random::new(29);
    let mut below = |count: usize| (random.unit() * count as f64) as usize;
    let (points, triangles) = sphere(7, 12);
    let (mut closed, mut meshed) = (0, 0);
    for _ in 0..60 {
        let missing = below(12);
        let mut left = triangles.clone();
        for _ in 0..missing {
            left.swap_remove(below(left.len()));
        }
        let mut mesh = surface(&points, &left, &vec![7; left.len()]);
        let most = 3 + below(8);
        let open = open_edges(&mesh);
        let filling = mesh.close_holes(most).unwrap();
        assert_eq!(filling.open_edges, open_edges(&mesh));
        assert_eq!(open - filling.open_edges, filling.triangles.len() + 2 * filling.holes);
        assert!(filling.markers.iter().all(|&marker| marker == 7));
        assert!(filling.open_edges == 0 || most < 12);
        closed += filling.holes;
        let diagnosis = mesh.diagnosis().unwrap();
        assert_eq!(diagnosis.edges.len(), filling.open_edges, "{:?}", diagnosis.edges);
        if filling.open_edges == 0 && missing > 0 && diagnosis.intersections.is_empty() {
            mesh.run(&bounded(f64::INFINITY), None).unwrap_or_else(|error| panic!("{error}"));
            assert_holds(&mesh);
            assert!(volume(mesh.result().unwrap()) > 3.0);
            meshed += 1;
        }
    }
    assert!(closed > 150 && meshed > 24, "{closed} holes, {meshed} meshes");
}

#[test]
fn what_cannot_be_closed_stays_open() {
    let solid = cuboid([0.0; 3], [1.0; 3]);
    // A triangle alone: all that could close it is there.
    let mut mesh = surface(&solid.points, &[[0, 1, 2]], &[0]);
    let filling = mesh.close_holes(100).unwrap();
    assert_eq!((filling.holes, filling.open_edges), (0, 3));
    assert_eq!(mesh.given_facets().count(), 1);
    // Points of a hole on one line, of which every triangle is without an area.
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 5.0, 2.0]];
    let fan = [[0, 1, 3], [1, 2, 4], [2, 0, 3]];
    let mut mesh = surface(&points, &fan, &[1, 2, 3]);
    let filling = mesh.close_holes(3).unwrap();
    assert_eq!((filling.holes, filling.triangles.len()), (0, 0));
    // Markers of a hole that has several.
    let halves: Vec<[u32; 3]> =
        solid.polygons[1..].iter().flat_map(|p| [[p[0], p[1], p[2]], [p[0], p[2], p[3]]]).collect();
    let markers: Vec<i32> = (0..10).collect();
    let mut mesh = surface(&solid.points, &halves, &markers);
    let filling = mesh.close_holes(4).unwrap();
    assert_eq!((filling.markers, filling.open_edges), (vec![0, 0], 0));
    // One triangle beside the hole is turned round: most of them tell the direction.
    let mut turned = halves.clone();
    turned[2].reverse();
    let mut mesh = surface(&solid.points, &turned, &markers);
    let filling = mesh.close_holes(4).unwrap();
    let looks_down = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|input| solid.points[input as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0.0
    };
    assert!(filling.triangles.len() == 2 && filling.triangles.iter().all(looks_down));
}

/// Returns the triangles of a box whose sides are grids of `cells` squares along an edge, without
/// the squares of the top for which `is_missing`.
fn grid_box(cells: u32, is_missing: impl Fn(u32, u32) -> bool) -> (Vec<Point>, Vec<[u32; 3]>) {
    let mut points: Vec<Point> = Vec::new();
    let mut triangles = Vec::new();
    let mut number = |x: [u32; 3]| {
        let point = x.map(f64::from);
        let at = points.iter().position(|other| *other == point).unwrap_or(points.len());
        if at == points.len() {
            points.push(point);
        }
        at as u32
    };
    for (axis, is_far) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            if axis == 2 && is_far && is_missing(i, j) {
                continue;
            }
            let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|[u, v]| {
                let mut x = [0; 3];
                x[axis] = if is_far { cells } else { 0 };
                (x[(axis + 1) % 3], x[(axis + 2) % 3]) = (u, v);
                number(x)
            });
            let own = if is_far { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
            triangles.extend(own);
        }
    }
    (points, triangles)
}

/// Holds of all sets of squares that may be missing in a side that the side is whole again, with
/// nothing there twice, where holes touch and where they go round a square but for a corner.
#[test]
fn holes_that_touch_are_closed_each_by_itself() {
    let is_ring = |set: u32| set == 0b1_1110_1111;
    let is_missing = |set: u32| move |i: u32, j: u32| set >> (3 * i + j) & 1 == 1;
    for set in (1..512).filter(|&set| !is_ring(set)) {
        let (points, triangles) = grid_box(3, is_missing(set));
        let mut mesh = surface(&points, &triangles, &vec![0; triangles.len()]);
        let filling = mesh.close_holes(100).unwrap();
        let found = mesh.diagnosis().unwrap();
        assert!(filling.open_edges == 0 && found.edges.is_empty(), "{set:b}: {:?}", found.edges);
        assert!(found.intersections.is_empty(), "{set:b}: {:?}", found.intersections);
    }
    // Four holes round a square, and half of all squares.
    for (cells, is_missing) in [
        (4, (|i, j| [(1, 1), (2, 0), (2, 2), (3, 1)].contains(&(i, j))) as fn(u32, u32) -> bool),
        (6, |i, j| (i + j) % 2 == 0),
    ] {
        let (points, triangles) = grid_box(cells, is_missing);
        let mut mesh = surface(&points, &triangles, &vec![0; triangles.len()]);
        let filling = mesh.close_holes(4).unwrap();
        assert_eq!(filling.triangles.len(), 2 * filling.holes);
        let found = mesh.diagnosis().unwrap();
        assert!(found.edges.is_empty() && found.intersections.is_empty(), "{cells}");
    }
}
