//! Bodies that are no thicker than roundings explain. Where nothing meets they are meshed as they
//! are, whether crossings are refused or split; and the certificate does not take them for what
//! roundings make of others.

use super::crossings::{cuboid as surface_of_box, run, split, surface};
use super::{Point, assert_holds, bounded, cuboid};
use netmesh::error::ErrorKind;
use netmesh::options::{Crossings, Extent, Options};
use netmesh::{Region, Triangulation, merge_points};

/// Returns a point whose coordinates are so many units in the last place above 1.
fn units(steps: [f64; 3]) -> Point {
    steps.map(|step| 1.0 + step * f64::EPSILON)
}

/// Returns the box that begins at `low` and has a `size`, both in units.
fn plate(low: [f64; 3], size: [f64; 3], first: u32) -> (Vec<Point>, Vec<[u32; 3]>) {
    let high = [0, 1, 2].map(|k| low[k] + size[k]);
    surface_of_box([low, high].map(units), first)
}

fn both(one: ([f64; 3], [f64; 3]), other: ([f64; 3], [f64; 3])) -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = plate(one.0, one.1, 0);
    let (more, others) = plate(other.0, other.1, 8);
    points.extend(more);
    triangles.extend(others);
    (points, triangles)
}

fn crossings(crossings: Crossings, extent: Extent) -> Options {
    Options { crossings, ..split(extent, f64::INFINITY) }
}

fn assert_is_box(made: &Triangulation, subfacets: usize) {
    assert_eq!(made.vertex_count(), 8);
    assert_eq!(made.boundary.subfacets.len(), subfacets);
    assert_eq!(made.simplex_count(), 6);
}

const BOTH: [Crossings; 2] = [Crossings::Refuse, Crossings::Split];

#[test]
fn boxes_of_some_units_are_boxes() {
    let sizes = [1.0, 2.0, 3.0, 4.0, 7.0, 12.0, 16.0, 24.0, 5000.0, 2f64.powi(51)];
    for (at, x) in sizes.into_iter().enumerate() {
        for (next, y) in sizes.into_iter().enumerate().skip(at) {
            for z in sizes.into_iter().skip(next) {
                let size = [[x, y, z], [y, z, x], [z, x, y]][(at + next) % 3];
                let (points, triangles) = plate([3.0, 2.0, 2.0], size, 0);
                let [low, high] = [points[0], points[7]];
                for rule in BOTH {
                    let options = crossings(rule, Extent::Boundary);
                    assert_is_box(&run(&points, &triangles, &options), 12);
                    assert_is_box(&cuboid(low, high).run(&options), 12);
                }
            }
        }
    }
}

/// Returns two boxes that cross, and far from them a thin one.
fn plate_beside_what_crosses(size: [f64; 3]) -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = surface_of_box([[3.0; 3], [5.0; 3]], 0);
    let others =
        [surface_of_box([[4.0, 3.5, 3.5], [6.0, 4.5, 4.5]], 8), plate([3.0, 2.0, 2.0], size, 16)];
    for (more, own) in others {
        points.extend(more);
        triangles.extend(own);
    }
    (points, triangles)
}

/// Holds that a thin body stays as it is where others cross: of these all that met is split. Where
/// all its sides are of some units each of them is in the plane of each other but for roundings.
#[test]
fn plates_beside_what_crosses_are_plates() {
    let whole = 2f64.powi(51);
    for (size, least) in
        [([whole, 16.0, whole], 16.0), ([3.0, 4.0, 3.0], 0.0), ([9.0, 4000.0, 7.0], 0.0)]
    {
        let (points, triangles) = plate_beside_what_crosses(size);
        let made = run(&points, &triangles, &split(Extent::Boundary, f64::INFINITY));
        let of_plate = made.boundary.subfacet_parents.iter().filter(|&&parent| parent >= 24);
        assert!(of_plate.count() >= 12);
        let (volume, plate) = (super::volume(&made), least * f64::EPSILON / 4.0);
        assert!((volume - 9.0 - plate).abs() < 1e-13, "{volume}");
    }
}

/// Holds that rods are what they were beside a plate from which they are apart by roundings: a wall
/// of both would leave of a rod what it is thick.
#[test]
fn rods_beside_plates_are_rods() {
    let long = 2f64.powi(20);
    let plate = ([0.0, 2.0, 3.0], [long, 24.0, 2f64.powi(40)]);
    let rod = ([22.0, 29.0, 0.0], [8.0, 8.0, long]);
    let (points, triangles) = both(plate, rod);
    for rule in BOTH {
        let made = run(&points, &triangles, &crossings(rule, Extent::Boundary));
        let parents = &made.boundary.subfacet_parents;
        assert!((0..24).all(|own| parents.contains(&own) || parents.contains(&(own - own % 2))));
    }
}

/// Holds that plates are refused where they cross others and an edge could be taken for one that is
/// bent through a corner: of 15 units and less by what edges are bent, of 16 by what the
/// certificate lets them be.
#[test]
fn plates_that_cross_are_wider_than_bends() {
    let far = 2f64.powi(51);
    for (thickness, is_split) in [(8.0, false), (16.0, false), (24.0, true)] {
        let one = ([1.0, 1.0, 524_288.0], [thickness, 2f64.powi(40), far]);
        let (points, triangles) =
            both(one, ([0.0, 524_288.0, 524_288.0], [far, 5000.0, 1_048_576.0]));
        let mut mesh = surface(&points, &triangles);
        let made = mesh.run(&split(Extent::Boundary, f64::INFINITY), None);
        match made {
            Ok(()) => assert_holds(&mesh),
            Err(ref error) => assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}"),
        }
        assert_eq!(made.is_ok(), is_split, "{thickness}");
    }
}

/// Holds that a box which is there twice, some units from itself, is refused where edges of one may
/// seem to end at corners of the other, and is one if points are merged.
#[test]
fn bodies_beside_themselves_are_to_be_merged() {
    let options = split(Extent::Boundary, f64::INFINITY);
    for size in [2f64.powi(20), 2f64.powi(51)] {
        for off in [[1.0, 4.0, 1.0], [5.0, 1.0, 1.0], [4.0, 4.0, 13.0], [8.0; 3]] {
            let (mut points, triangles) = both(([4.0; 3], [size; 3]), (off, [size; 3]));
            let mut mesh = surface(&points, &triangles);
            match mesh.run(&options, None) {
                Ok(()) => assert_holds(&mesh),
                Err(error) => {
                    assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
                    let expected = "some still meet after they were split";
                    assert!(error.message().contains(expected), "{error}");
                }
            }
            merge_points(3, points.as_flattened_mut(), 1e-4).unwrap();
            assert_eq!(run(&points, &triangles, &options).boundary.subfacets.len(), 12);
        }
    }
}

/// Returns the sides of boxes with their other diagonals.
fn with_other_diagonals(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let other = |side: &[[u32; 3]]| {
        let ([a, b, c], [_, _, d]) = (side[0], side[1]);
        [[b, c, d], [b, d, a]]
    };
    triangles.chunks(2).flat_map(other).collect()
}

/// Holds that the edges of a box that is 16 units high are led along themselves, not along those
/// above or below; and that lines where a side ends on a facet that it is bent to are its own.
#[test]
fn boxes_about_plates_have_their_own_edges() {
    let sheared = |z: [f64; 2], lines: [[f64; 2]; 8]| -> Vec<Point> {
        lines.into_iter().enumerate().map(|(at, [x, y])| [x, y, z[at / 4]]).collect()
    };
    let (_, of_one) = plate([0.0; 3], [1.0; 3], 0);
    let low_plate = sheared(
        [1.000000000000005, 1.0000000000000087],
        [
            [0.2999999999999984, 1.2000000000000033],
            [0.3000000001862628, 1.2000000001397015],
            [0.29999999999998983, 1.2000000000000144],
            [0.3000000001862543, 1.2000000001397129],
            [0.2999999999999987, 1.2000000000000026],
            [0.30000000018626316, 1.2000000001397009],
            [0.29999999999999016, 1.2000000000000137],
            [0.3000000001862546, 1.2000000001397122],
        ],
    );
    let rod = sheared(
        [1.0000000001164153, 1.0002441407414153],
        [
            [0.3000000000116385, 1.1999999999767235],
            [0.3000000000116395, 1.1999999999767241],
            [0.3000000000116382, 1.1999999999767237],
            [0.3000000000116392, 1.1999999999767244],
            [0.3000244140741385, 1.1999511718517235],
            [0.3000244140741395, 1.1999511718517242],
            [0.30002441407413816, 1.1999511718517237],
            [0.30002441407413916, 1.1999511718517244],
        ],
    );
    let (low, wide, far) = (524_288.0, 1_048_576.0, 2f64.powi(51));
    let with_first_turned = |(points, triangles): (Vec<Point>, Vec<[u32; 3]>)| {
        (points, [&with_other_diagonals(&triangles[..12]), &triangles[12..]].concat())
    };
    for (points, triangles) in [
        (low_plate, of_one.clone()),
        (rod, of_one),
        with_first_turned(both(
            ([21.0, 38.0, 36.0], [24.0, 8.0, 5.0]),
            ([low, low, 19.0], [far, wide, 24.0]),
        )),
        with_first_turned(both(
            ([low, 25.0, 3.0], [5000.0, 24.0, 2f64.powi(40)]),
            ([2f64.powi(50), low, 0.0], [5000.0, far, 5000.0]),
        )),
    ] {
        run(&points, &triangles, &Options { extent: Extent::Box, ..bounded(f64::INFINITY) });
    }
}

/// Holds that a seed on the diagonal of a side is refused, whichever simplex about that it is found
/// in.
#[test]
fn seeds_on_edges_of_facets_are_refused() {
    let (points, triangles) = plate([0.0, 0.0, 1.0], [4.0, 3.0, 2.0], 0);
    let seed = |seed: Point| Region { seed, label: 1, is_hole: false, max_edge: 0.0 };
    for (x, facet) in [([2.0, 3.0, 2.0], 6), ([0.0, 0.0, 2.0], 4), ([0.0, 3.0, 3.0], 2)] {
        for rule in BOTH {
            let mut mesh = surface(&points, &triangles);
            mesh.set_regions(&[seed(units(x)), seed([0.5; 3])]).unwrap();
            for number in 0..32 {
                let options = Options { seed: number, ..crossings(rule, Extent::All) };
                let error = mesh.run(&options, None).unwrap_err();
                let expected = format!("regions[0].seed is on facets[{facet}];");
                assert!(error.message().starts_with(&expected), "{error}");
            }
        }
    }
}

/// Holds that sides of a box between the least doubles stay apart: halves of these are nothing.
#[test]
fn boxes_of_the_least_doubles_have_sides() {
    const LEAST: f64 = 5e-324;
    let corners = [[0.0, 0.0], [LEAST, LEAST], [-LEAST, LEAST], [0.0, LEAST]];
    let points = [0.0, LEAST].map(|z| corners.map(|[x, y]| [x, y, z]));
    let (_, triangles) = plate([0.0; 3], [1.0; 3], 0);
    for rule in BOTH {
        let made = run(points.as_flattened(), &triangles, &crossings(rule, Extent::Boundary));
        assert_eq!(made.boundary.subfacets.len(), 12);
        // Two sides are in one plane.
        assert_eq!(made.boundary.subsegments.len(), 11);
    }
}

/// Holds that of a body which is there twice one is left, however small it is.
#[test]
fn small_boxes_that_are_there_twice_are_one() {
    let steps = [[10.0, 0.0], [13.0, 0.0], [8.0, 0.0], [11.0, 1.0]];
    let points = [0.0, 1.0].map(|z| steps.map(|[x, y]| units([x, y, z])));
    let (_, triangles) = plate([0.0; 3], [1.0; 3], 0);
    let twice = [&triangles[..], &triangles].concat();
    for extent in [Extent::All, Extent::Boundary] {
        let made = run(points.as_flattened(), &twice, &split(extent, f64::INFINITY));
        assert_eq!(made.boundary.subfacets.len(), 12);
    }
}
