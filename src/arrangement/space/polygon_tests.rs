//! Polygons: their triangles, and those that are refused.

use super::tests::{CUBE, Case, facet, pairs, quads};
use crate::mesh::IntersectionKind::{Cross, Overlap, Touch, ZeroArea};
use crate::mesh::{FacetTriangle, NONE};
use crate::numerics::testing::Random;

#[test]
fn triangles_of_polygons_turn_as_their_first_loops() {
    let made = Case::polygons(&CUBE, &quads()).arrangement();
    // The volume by the divergence theorem: positive as normals point outwards.
    let volume: f64 = made.triangles.iter().map(|own| signed_volume(own.vertices)).sum();
    assert_eq!(volume, 6.0);
    let mut turned = quads();
    turned.iter_mut().for_each(|polygon| polygon[0].reverse());
    let made = Case::polygons(&CUBE, &turned).arrangement();
    let volume: f64 = made.triangles.iter().map(|own| signed_volume(own.vertices)).sum();
    assert_eq!(volume, -6.0);
}

fn signed_volume(triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|vertex| CUBE[vertex as usize]);
    let minor = |k: usize| b[(k + 1) % 3] * c[(k + 2) % 3] - b[(k + 2) % 3] * c[(k + 1) % 3];
    (0..3).map(|k| a[k] * minor(k)).sum()
}

/// A plate with a hole, an inner segment and an inner vertex, in a plane that no axis is parallel
/// to, where the hole holds an island.
#[test]
fn polygons_have_holes_islands_segments_and_vertices() {
    let plane: [[f64; 2]; 15] = [
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 8.0],
        [0.0, 8.0],
        [2.0, 2.0],
        [6.0, 2.0],
        [6.0, 6.0],
        [2.0, 6.0],
        [3.0, 3.0],
        [5.0, 3.0],
        [5.0, 5.0],
        [3.0, 5.0],
        [1.0, 1.0],
        [7.0, 1.0],
        [7.0, 7.0],
    ];
    let tilts: [fn(f64, f64) -> [f64; 3]; 3] = [
        |x, y| [x, y, 2.0 * x - 3.0 * y],
        |x, y| [x + 4.0 * y, 8.0 * x - y, x],
        |x, y| [1.0 - x, 5.0, y],
    ];
    for tilt in tilts {
        let points = plane.map(|[x, y]| tilt(x, y));
        let plate =
            vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7], vec![11, 10, 9, 8], vec![12, 13], vec![14]];
        let made = Case::polygons(&points, &[plate]).arrangement();
        let area = |own: &FacetTriangle| {
            let [a, b, c] = own.vertices.map(|vertex| plane[vertex as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        assert!(made.triangles.iter().all(|own| area(own) > 0.0));
        assert_eq!(made.triangles.iter().map(area).sum::<f64>(), 2.0 * (64.0 - 16.0 + 4.0));
        assert!(made.triangles.iter().any(|own| own.vertices.contains(&14)));
        let mut lines: Vec<[u32; 2]> = made.subsegments.iter().map(|line| line.ends).collect();
        let mut expected: Vec<[u32; 2]> = (0..3u32)
            .flat_map(|at| (0..4).map(move |k| [4 * at + k, 4 * at + (k + 1) % 4]))
            .chain([[12, 13]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        lines.sort_unstable();
        expected.sort_unstable();
        assert_eq!(lines, expected);
        assert!(made.subsegments.iter().all(|line| line.segment == NONE));
    }
}

/// Random polygons that are stars about a point: the area of their triangles is that of the loop,
/// all edges of the loop are there, and no vertex is inside a triangle.
#[test]
fn triangles_tile_polygons() {
    let mut random = Random(11);
    for trial in 0..200 {
        let count = 3 + trial % 40;
        let mut angles: Vec<f64> =
            (0..count).map(|_| random.unit() * std::f64::consts::PI).collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        let widest = angles
            .windows(2)
            .map(|two| two[1] - two[0])
            .fold(2.0 * std::f64::consts::PI + angles[0] - angles[angles.len() - 1], f64::max);
        if angles.len() < 3 || widest > 3.0 {
            continue;
        }
        let scale = (1u64 << 40) as f64;
        let points: Vec<[f64; 3]> = angles
            .iter()
            .map(|angle| {
                let radius = 2.0 + random.unit();
                let [x, y] = [angle.cos(), angle.sin()].map(|x| (radius * x * scale).round());
                [x, x - y, y]
            })
            .collect();
        let own: Vec<u32> = (0..points.len() as u32).collect();
        let made = Case::polygons(&points, &[vec![own.clone()]]).arrangement();
        let area = |a: u32, b: u32, c: u32| {
            let [a, b, c] = [a, b, c].map(|v| points[v as usize].map(|x| x as i128));
            (b[0] - a[0]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[0] - a[0])
        };
        let mut total = 0;
        for FacetTriangle { vertices: [a, b, c], .. } in &made.triangles {
            assert!(area(*a, *b, *c) > 0);
            total += area(*a, *b, *c);
            let is_in =
                |v: &u32| area(*a, *b, *v) > 0 && area(*b, *c, *v) > 0 && area(*c, *a, *v) > 0;
            assert!(!own.iter().any(is_in));
        }
        let last = own.len() as u32 - 1;
        let expected: i128 = (1..last).map(|v| area(0, v, v + 1)).sum();
        assert_eq!(total, expected);
        assert_eq!(made.triangles.len(), own.len() - 2);
        assert_eq!(made.subsegments.len(), own.len());
    }
}

#[test]
fn loops_that_meet_are_refused() {
    let square = [[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [0.0, 4.0, 1.0]];
    let with = |more: &[[f64; 3]]| [&square[..], more].concat();
    let bow = Case::polygons(&square, &[vec![vec![0, 2, 1, 3]]]);
    assert_eq!(pairs(&bow.intersections()), [(facet(0), facet(0), Cross)]);
    assert_eq!(bow.intersections()[0].point, [2.0, 2.0, 1.0]);
    assert_eq!(
        bow.refusal(),
        "facets[0] crosses itself near (2.0, 2.0, 1.0); facets and segments may meet only in \
         vertices and edges of both"
    );
    let touching = with(&[[2.0, 0.0, 1.0], [3.0, 1.0, 1.0], [1.0, 1.0, 1.0]]);
    let touching = Case::polygons(&touching, &[vec![vec![0, 1, 2, 3], vec![4, 5, 6]]]);
    assert_eq!(pairs(&touching.intersections()), [(facet(0), facet(0), Touch)]);
    assert_eq!(touching.intersections()[0].point, [2.0, 0.0, 1.0]);
    let along = with(&[[1.0, 0.0, 1.0], [3.0, 0.0, 1.0], [2.0, 1.0, 1.0]]);
    let along = Case::polygons(&along, &[vec![vec![0, 1, 2, 3], vec![4, 5, 6]]]);
    assert_eq!(pairs(&along.intersections()), [(facet(0), facet(0), Overlap)]);
    let vertex = with(&[[2.0, 0.0, 1.0]]);
    let vertex = Case::polygons(&vertex, &[vec![vec![0, 1, 2, 3], vec![4]]]);
    assert_eq!(pairs(&vertex.intersections()), [(facet(0), facet(0), Touch)]);
    assert_eq!(vertex.intersections()[0].point, [2.0, 0.0, 1.0]);
    // A vertex beyond edges that are crossed first, in both directions of an axis.
    let inner = with(&[[1.5, 2.5, 1.0], [2.0, 2.0, 1.0], [2.5, 1.5, 1.0], [1.0, 0.5, 1.0]]);
    type Map = fn(&[f64; 3]) -> [f64; 3];
    let images: [Map; 3] = [|x| *x, |x| [x[1], x[0], x[2]], |x| [-x[0], x[1], x[2]]];
    for image in images {
        let points: Vec<[f64; 3]> = inner.iter().map(image).collect();
        let plate = vec![vec![0, 1, 2, 3], vec![0, 2], vec![4], vec![5], vec![6], vec![7]];
        let found = Case::polygons(&points, &[plate]).intersections();
        assert_eq!(pairs(&found), [(facet(0), facet(0), Touch)]);
        assert_eq!(found[0].point, points[5]);
    }
    // The worst is told: a crossing rather than a touch.
    let both = with(&[[1.0, 1.0, 1.0], [1.0, 3.0, 1.0]]);
    let both = Case::polygons(&both, &[vec![vec![0, 2, 1, 3], vec![4, 5]]]);
    assert_eq!(pairs(&both.intersections()), [(facet(0), facet(0), Cross)]);
    let line = [[0.0; 3], [1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [-1.0, -2.0, -3.0]];
    let line = Case::polygons(&line, &[vec![vec![0, 1, 2, 3]]]);
    assert_eq!(pairs(&line.intersections()), [(facet(0), facet(0), ZeroArea)]);
    assert!(line.refusal().starts_with("facets[0] has no area near (0.0, 0.0, 0.0);"));
}

/// A wall on the diagonal by which a side of the cube is split is a fault of the facets, whatever
/// the triangles of the side are, unless the side has the wall's edge.
#[test]
fn diagonals_of_a_facet_are_its_interior() {
    let mut points = CUBE.to_vec();
    points.extend([[0.0, 0.0, -1.0], [1.0, 1.0, -1.0], [0.5, 0.5, 2.0]]);
    for first in 0..4 {
        let mut polygons = quads();
        polygons[0][0].rotate_left(first);
        let mut case = polygons.clone();
        // Through the plate, along a part of its diagonal.
        case.push(vec![vec![8, 9, 10]]);
        let found = pairs(&Case::polygons(&points, &case).intersections());
        assert!(found.contains(&(facet(0), facet(6), Cross)), "{found:?}");
        // Standing on the plate's diagonal, by number: the plate gets it as an edge.
        polygons.push(vec![vec![0, 2, 9, 8]]);
        let made = Case::polygons(&points, &polygons).arrangement();
        assert_eq!((made.triangles.len(), made.subsegments.len()), (14, 12 + 4));
    }
}

/// A facet of two inputs is a segment.
#[test]
fn facets_of_two_inputs_are_lines() {
    let mut points = CUBE.to_vec();
    points.extend([[0.25, 0.5, 0.5], [0.75, 0.5, 0.5], [0.5, 0.5, 0.25], [0.5, 0.5, 0.75]]);
    let mut polygons = quads();
    polygons.push(vec![vec![8, 9]]);
    let made = Case::polygons(&points, &polygons).arrangement();
    assert!(made.subsegments.iter().any(|line| (line.ends, line.segment) == ([8, 9], NONE)));
    polygons[6].push(vec![10, 11]);
    let found = Case::polygons(&points, &polygons).intersections();
    assert_eq!(pairs(&found), [(facet(6), facet(6), Cross)]);
}

#[test]
fn polygons_off_a_plane_are_refused_by_name() {
    let mut points = CUBE;
    points[2][2] = 0.25;
    let case = Case::polygons(&points, &quads());
    let message = case.refusal();
    assert!(message.starts_with("facets[0] is not plane: its input "), "{message}");
    // The plane bends by more than 10 degrees and less than 40 there.
    assert!(case.arranged(10.0).is_err());
    assert_eq!(case.arranged(40.0).unwrap().facets.len(), 6);
    // Roundings are no fault.
    for ulps in [-3i64, -1, 1, 3] {
        let mut points = CUBE.map(|x| x.map(|x| x + 1.0));
        points[2][2] = f64::from_bits(points[2][2].to_bits().wrapping_add_signed(ulps));
        assert_eq!(Case::polygons(&points, &quads()).arrangement().facets.len(), 6);
    }
    let mut points = CUBE.map(|x| x.map(|x| x + 1.0));
    points[2][2] = f64::from_bits(points[2][2].to_bits() + 40);
    assert!(Case::polygons(&points, &quads()).refusal().contains("is not plane"));
}

/// Nothing fails or hangs on random polygons of any loops, most of which are off a plane or meet
/// themselves; what is accepted is tiled by as many triangles as its edges tell.
#[test]
fn random_polygons_are_told_or_arranged() {
    let mut random = Random(5);
    let (mut refused, mut arranged) = (0, 0);
    for trial in 0..3000 {
        let [width, height] = [1 + trial % 4, if trial % 3 == 0 { 2 } else { 0 }];
        let points: Vec<[f64; 3]> = (0..10)
            .map(|_| [width, width, height].map(|width| random.integer(0, width) as f64))
            .map(|[x, y, z]| [x, y, z + 2.0 * x - y])
            .collect();
        if points.iter().all(|x| *x == points[0]) {
            continue;
        }
        let mut some = |most: i64| -> Vec<u32> {
            (0..random.integer(1, most)).map(|_| random.integer(0, 9) as u32).collect()
        };
        let polygon = vec![[some(4), some(4), some(4)].concat(), some(3), some(2)];
        let polygons = if trial % 2 == 0 { vec![polygon] } else { vec![polygon, vec![some(5)]] };
        let case = Case::polygons(&points, &polygons);
        let found = case.intersections();
        match case.arranged(0.0) {
            Ok(made) => {
                arranged += 1;
                assert_eq!(found, []);
                let sides = 3 * made.triangles.len();
                let edges = case.facets.inputs.len();
                assert!(made.subsegments.len() <= sides + edges);
            }
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 1000 && arranged > 30, "{refused} {arranged}");
}

/// Vertices of a polygon that differ in the coordinate that its projection drops.
#[test]
fn vertices_with_one_image_are_refused() {
    let points = [[0.0; 3], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [4.0, 4.0, 5e-324]];
    let case = Case::polygons(&points, &[vec![vec![0, 1, 2, 3]]]);
    assert_eq!(pairs(&case.intersections()), [(facet(0), facet(0), Touch)]);
    let points = [[0.0; 3], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [4.0, 4.0, 1.0]];
    let case = Case::polygons(&points, &[vec![vec![0, 1, 2, 3]]]);
    assert!(case.refusal().starts_with("facets[0] is not plane: its input "));
}

/// A hole that a bridge of two sides on one edge joins to the outer loop.
#[test]
fn loops_may_have_bridges() {
    let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
    let points: Vec<[f64; 3]> =
        [square(0.0, 8.0), square(2.0, 6.0)].concat().iter().map(|&[x, y]| [x, y, x]).collect();
    let plate = vec![vec![0, 1, 2, 3, 0, 4, 7, 6, 5, 4]];
    let made = Case::polygons(&points, &[plate]).arrangement();
    let area = |own: &FacetTriangle| {
        let [a, b, c] = own.vertices.map(|vertex| points[vertex as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    assert_eq!(made.triangles.iter().map(area).sum::<f64>(), 2.0 * (64.0 - 16.0));
    assert!(made.subsegments.iter().any(|line| line.ends == [0, 4]));
    assert_eq!(made.subsegments.len(), 9);
}
