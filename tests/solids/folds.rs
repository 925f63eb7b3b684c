//! Surfaces that are folded over themselves in one plane, split where they meet: no facet has an
//! area twice, and each mesh holds its certificate.

use super::crossings::{cuboid, run, split, surface, turned};
use super::{Point, bounded, volume};
use crate::random::Random;
use netmesh::error::ErrorKind;
use netmesh::options::{Extent, Interior, Options};

/// Returns a cube of edge 4 whose last side has further vertices at `places`: each divides the
/// triangle of the side that `chosen` draws of so many, wherever it is.
fn cube_with(
    places: &[[f64; 2]],
    mut chosen: impl FnMut(usize) -> usize,
) -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [4.0; 3]], 0);
    let others = triangles.len() - 2;
    for &[y, z] in places {
        let vertex = points.len() as u32;
        points.push([4.0, y, z]);
        let at = others + chosen(triangles.len() - others);
        let [a, b, c] = triangles[at];
        triangles[at] = [a, b, vertex];
        triangles.extend([[b, c, vertex], [c, a, vertex]]);
    }
    (points, triangles)
}

/// Returns a cube of edge 4 with three vertices on a line in its last side, of which the middle one
/// is joined to the others by the last triangle alone: that has no area.
fn cube_with_needle() -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = cuboid([[0.0; 3], [4.0; 3]], 0);
    points.extend([[4.0, 1.0, 2.0], [4.0, 2.0, 2.0], [4.0, 3.0, 2.0]]);
    triangles.truncate(10);
    triangles.extend([[1, 3, 8], [3, 10, 8], [3, 7, 10], [7, 9, 10], [7, 5, 9], [5, 8, 9]]);
    triangles.extend([[5, 1, 8], [8, 10, 9]]);
    (points, triangles)
}

/// Holds that edges at which facets end only at a triangle without an area are subsegments: two
/// triangles of one side meet in an edge that the others there divide, and are one facet by a way
/// round it.
#[test]
fn sides_may_meet_at_triangles_without_an_area() {
    let (points, triangles) = cube_with_needle();
    for points in [turned(&points), points] {
        for bound in [f64::INFINITY, 2.0] {
            let made = run(&points, &triangles, &split(Extent::Boundary, bound));
            assert!((volume(&made) - 64.0).abs() < 1e-12 * 64.0);
            let of_side = made.boundary.subfacet_parents.iter().filter(|&&parent| parent >= 10);
            assert!(of_side.clone().all(|&parent| parent == 10), "the side is one facet");
            assert!(of_side.count() > 0);
        }
    }
}

/// Holds that sides which are folded in their plane bound what the others do.
#[test]
fn sides_that_are_folded_are_walls_once() {
    let mut random = Random::new(11);
    for trial in 0..40 {
        let count = 1 + trial % 4;
        let places: Vec<[f64; 2]> =
            (0..count).map(|_| [0; 2].map(|_: i32| 4.0 * random.unit())).collect();
        let (points, triangles) =
            cube_with(&places, |count| (random.unit() * count as f64) as usize);
        for (points, interior) in [(turned(&points), Interior::Auto), (points, Interior::Winding)] {
            let options = Options { interior, ..split(Extent::Boundary, f64::INFINITY) };
            let volume = volume(&run(&points, &triangles, &options));
            assert!((volume - 64.0).abs() < 1e-12 * 64.0, "{trial}: {volume}");
        }
    }
}

/// Holds that two triangles which run through their edge in one direction, and so lie on each other
/// there, are two facets.
#[test]
fn triangles_that_lie_on_each_other_at_their_edge_are_two() {
    let points = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 0.125]];
    for points in [turned(&points), points.to_vec()] {
        for bound in [f64::INFINITY, 2.0] {
            let made = run(&points, &[[0, 1, 2], [1, 2, 3]], &split(Extent::All, bound));
            let parents = &made.boundary.subfacet_parents;
            assert!(parents.contains(&0) && parents.contains(&1), "{parents:?}");
        }
    }
}

/// Holds that what is left of a facet that is bent a little, and shares most of its area with
/// another, is in the plane of the whole.
#[test]
fn parts_of_a_bent_facet_are_in_its_plane() {
    // Strips between lines, of which the last is bent up; a square is on the second.
    let bend = 0.5 * 0.05f64.to_radians().tan();
    let lines = [(0.0, 0.0), (1.0, 0.0), (5.0, 0.0), (5.5, 0.0), (6.0, bend)];
    let ends = lines.iter().flat_map(|&(x, z)| [[x, 0.0, z], [x, 2.0, z]]);
    let mut points: Vec<Point> = ends.chain([[3.0, 1.0, 4.0], [3.0, 1.0, -4.0]]).collect();
    points.extend([[1.0, -1.0, 0.0], [5.0, -1.0, 0.0], [5.0, 3.0, 0.0], [1.0, 3.0, 0.0]]);
    let strips = [0, 2, 4, 6].map(|a| [[a, a + 2, a + 3], [a, a + 3, a + 1]]);
    let triangles = [&[[12, 13, 14], [12, 14, 15]][..], strips.as_flattened()].concat();
    for coplanar in [0.0, 0.1] {
        let options = Options { coplanar, max_edge: 0.4, ..split(Extent::All, 2.0) };
        run(&points, &triangles, &options);
    }
}

/// Holds that a triangle which turning leaves some roundings wide is what it was before: nothing.
#[test]
fn needles_no_wider_than_roundings_are_left_out() {
    let (points, triangles) = cube_with_needle();
    let points = turned(&points);
    let made = run(&points, &triangles, &split(Extent::Boundary, f64::INFINITY));
    assert_eq!(made.vertex_count(), points.len());
    assert!(!made.boundary.subfacet_parents.contains(&17), "the needle has no subfacet");
}

/// Holds that such a triangle has nothing to keep where no other has its edges, be it there once or
/// several times: as one without an area.
#[test]
fn needles_that_nobody_shares_have_nothing_to_keep() {
    let unit = 2f64.powi(-48);
    let steps = [[0, 0, 0], [0, 0, 896], [112, 80, 16_777_216], [49_152, -335_544_320, 4_096]];
    let points = steps.map(|steps| steps.map(|step| 1.0 + f64::from(step) * unit));
    let (needle, turned, other) = ([1, 0, 2], [0, 2, 1], [2, 1, 3]);
    for extent in [Extent::All, Extent::Box] {
        for triangles in [&[needle][..], &[needle, turned], &[needle, other], &[other, needle]] {
            let made = run(&points, triangles, &split(extent, f64::INFINITY));
            let parents = &made.boundary.subfacet_parents;
            let kept = (0..).zip(triangles).filter(|(_, own)| **own == other);
            let missing = kept.filter(|(number, _)| !parents.contains(number)).count();
            assert_eq!(missing, 0, "a triangle that is wider");
        }
    }
}

/// Holds that such a triangle is not between others that are one plane without it: no chain leads
/// along the edges that it has in common with two of them.
#[test]
fn needles_are_not_between_triangles_of_a_plane() {
    // A line of three vertices, and one on each side of it.
    let flat = [[100.1, 50.3, 0.0], [102.3, 51.1, 0.0], [102.9, 51.3, 0.0]];
    let mut points = turned(&[flat[0], flat[2], [101.9, 52.2, 0.0], [102.2, 49.7, 0.0]]);
    let plane = [[0, 4, 2], [4, 1, 2], [4, 0, 3], [1, 4, 3]];
    let (needle, opposite) = ([0, 4, 1], [4, 0, 1]);
    let mut narrow = 0;
    for share in 1..40 {
        let share = f64::from(share) / 40.0;
        let [from, to] = [points[0], points[1]];
        points.truncate(4);
        points.push([0, 1, 2].map(|k| from[k] + share * (to[k] - from[k])));
        for needles in [&[needle, opposite][..], &[opposite, needle], &[needle]] {
            for extent in [Extent::All, Extent::Box] {
                let triangles = [needles, &plane].concat();
                let made = run(&points, &triangles, &split(extent, f64::INFINITY));
                let has_line = made.boundary.subsegments.iter().any(|own| own.contains(&4));
                narrow += u32::from(!has_line);
            }
        }
    }
    assert!(narrow > 30, "{narrow} meshes without an edge to the vertex between");
}

/// Holds that a triangle which is somewhat wider is what joins the triangles at its edges.
#[test]
fn triangles_wider_than_roundings_join_others() {
    for units in [6.0, 9.0, 12.0] {
        let between = [1.375, 1.25 + units * f64::EPSILON, 0.0];
        let line = [[1.0, 1.0, 0.0], [1.75, 1.5, 0.0], between];
        let points = [&line[..], &[[1.25, 1.75, 0.0], [1.5, 1.0, 0.0]]].concat();
        let triangles = [[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 4]];
        let made = run(&points, &triangles, &split(Extent::All, f64::INFINITY));
        let parents = &made.boundary.subfacet_parents;
        assert!(parents.iter().all(|&parent| parent == 0), "{units} units: {parents:?}");
        let has_line = made.boundary.subsegments.iter().any(|own| own.contains(&2));
        assert!(!has_line, "{units} units: an edge to the vertex between");
    }
}

/// Holds that parts of one triangle are one facet, though one of them is no wider than roundings
/// and may be turned anyhow.
#[test]
fn parts_of_a_triangle_are_one_facet() {
    let (subnormal, far) = ([5_889_285.0, 5_889_287.0, 5_889_287.0], 2f64.powi(52));
    let top = 15_032_385_536.0;
    for (unit, origin, near, upper, side) in [
        (f64::from_bits(1), subnormal, [2.0, -4.0, 0.0], [2.0, 0.0], [33_554_434.0, -1024.0]),
        (f64::from_bits(1), subnormal, [2.0, -4.0, -1.0], [3.0, 0.0], [1e6, -1e6]),
        (1.0, [far; 3], [2.0, -2.0, -1.0], [3.0, -1.0], [1e6, -1024.0]),
    ] {
        let steps = [
            [upper[0], upper[1], top],
            [top; 3],
            [33_554_432.0; 3],
            [side[0], top, side[1]],
            // A corner beside an edge of the first triangle, near the end of that.
            [0.0; 3],
            near,
        ];
        let points = steps.map(|own| [0, 1, 2].map(|k: usize| (origin[k] + own[k]) * unit));
        let triangles = [[5, 3, 0], [4, 3, 2], [3, 2, 1]];
        let made = run(&points, &triangles, &split(Extent::All, f64::INFINITY));
        assert!(made.boundary.subfacet_parents.contains(&0));
    }
}

/// Holds that facets which run for a long way nearer to each other than the roundings of their
/// vertices are refused, with a place: there is no end of vertices on top of each other.
#[test]
fn facets_within_roundings_of_each_other_have_no_room() {
    let (origin, top) = (2f64.powi(52), 15_032_385_536.0);
    let steps = [
        [3.0, 1.0, top],
        [top; 3],
        [33_554_432.0; 3],
        [1e9, top, -1e6],
        [0.0; 3],
        [0.0, -6.0, 1.0],
    ];
    let points = steps.map(|steps| steps.map(|step| origin + step));
    let mut mesh = surface(&points, &[[5, 3, 0], [4, 3, 2], [3, 2, 1]]);
    let error = mesh.run(&split(Extent::All, f64::INFINITY), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    assert!(error.message().starts_with("doubles have no room between facets near ("), "{error}");
    assert!(mesh.result().is_err());
}

/// Holds that such a triangle is refused, with its place, where it has to stay: between vertices
/// that are rounded to its edges it has no area.
#[test]
fn needles_no_wider_than_roundings_have_no_room() {
    let (points, triangles) = cube_with_needle();
    let mut mesh = surface(&turned(&points), &triangles);
    let error = mesh.run(&bounded(2.0), None).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Limit);
    assert!(error.message().starts_with("doubles have no room for a triangle of facets near ("));
    assert!(mesh.result().is_err());
}
