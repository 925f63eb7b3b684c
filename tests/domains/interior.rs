//! Regions that closed curves enclose, by parity and by winding number: each triangle is inside or
//! not as a ray from a point of it says, by integers.

use super::exact::{Point, turn};
use super::shapes::{Domain, circle, square};
use super::{inside, refusal, run};
use crate::random::Random;
use netmesh::options::{Crossings, Interior, Options, Output};
use netmesh::validate::validate_mesh;
use netmesh::{ErrorKind, Mesh, Region};

/// The caller's segments: how often they go round `x` counterclockwise, and how many of them a ray
/// from it to the right crosses.
fn around(domain: &Domain, x: &Point) -> (i32, i32) {
    let (mut winding, mut crossed) = (0, 0);
    for ends in &domain.segments {
        let [a, b] = ends.map(|end| &domain.points[end as usize]);
        let (low, high, sense) = if a[1] < b[1] { (a, b, 1) } else { (b, a, -1) };
        if low[1] <= x[1] && x[1] < high[1] && turn(low, high, x) == 1 {
            winding += sense;
            crossed += 1;
        }
    }
    (winding, crossed)
}

fn options(interior: Interior) -> Options {
    let crossings = Crossings::Split;
    Options { interior, crossings, ..inside(20.7, Output::WellSpaced) }
}

/// Asserts that each triangle of the whole is inside as the curves say; returns the number of those
/// inside.
fn assert_inside(domain: &Domain, mesh: &Mesh, interior: Interior) -> usize {
    let report = validate_mesh(mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    let result = mesh.result().unwrap();
    let whole = result.boundary.whole.as_deref().expect("there is an outside");
    for simplex in 0..whole.simplex_count() {
        let corners = [0, 1, 2].map(|at| whole.point(whole.simplex(simplex)[at]));
        let x = [0, 1].map(|axis| corners.iter().map(|corner| corner[axis] / 3.0).sum());
        let (winding, crossed) = around(domain, &x);
        let expected = match interior {
            Interior::Parity => crossed % 2 == 1,
            _ => winding != 0,
        };
        assert_eq!(simplex < result.simplex_count(), expected, "{interior:?} near {x:?}");
    }
    result.simplex_count()
}

fn check(domain: &Domain, interior: Interior) -> usize {
    let mesh = run(domain, &options(interior)).unwrap_or_else(|error| panic!("{error}"));
    assert_inside(domain, &mesh, interior)
}

/// Checks the domain by both rules.
fn check_both(domain: &Domain) -> [usize; 2] {
    [Interior::Parity, Interior::Winding].map(|interior| check(domain, interior))
}

fn assert_nothing(domain: &Domain, interior: Interior) {
    let (kind, message) = refusal(domain, &options(interior));
    assert_eq!(kind, ErrorKind::InvalidArgument);
    assert!(message.starts_with("segments enclose nothing"), "{message}");
}

/// Rings about one point, from the largest; those of which a bit is set turn to the right.
fn rings(depth: u32, clockwise: u32) -> Domain {
    (0..depth).fold(Domain::default(), |domain, ring| {
        let mut points = circle(12, [0.25, -0.125], 1.0 - 0.09 * f64::from(ring));
        if clockwise >> ring & 1 == 1 {
            points.reverse();
        }
        domain.around(&points)
    })
}

/// Closed curves through these points of a lattice, by their numbers.
fn curves(points: &[Point], curves: &[&[u32]]) -> Domain {
    let steps = curves
        .iter()
        .flat_map(|curve| (0..curve.len()).map(|at| [curve[at], curve[(at + 1) % curve.len()]]));
    Domain::new(points, &steps.collect::<Vec<_>>())
}

fn area(mesh: &Mesh) -> f64 {
    let result = mesh.result().unwrap();
    let doubled = |simplex: usize| {
        let [a, b, c] = [0, 1, 2].map(|at| result.point(result.simplex(simplex)[at]));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    (0..result.simplex_count()).map(doubled).sum::<f64>() / 2.0
}

fn area_of(domain: &Domain, interior: Interior) -> f64 {
    let mesh = run(domain, &options(interior)).unwrap();
    assert_inside(domain, &mesh, interior);
    area(&mesh)
}

#[test]
fn rings_in_rings() {
    for depth in 1..=10 {
        let same = rings(depth, 0);
        let in_turn = rings(depth, 0x2aa);
        let disc = area_of(&rings(1, 0), Interior::Winding);
        assert!((area_of(&same, Interior::Winding) - disc).abs() < 1e-12);
        let striped = area_of(&same, Interior::Parity);
        assert!((area_of(&in_turn, Interior::Winding) - striped).abs() < 1e-12);
        assert!((area_of(&in_turn, Interior::Parity) - striped).abs() < 1e-12);
        assert_eq!(depth == 1, (striped - disc).abs() < 1e-12);
        // Two and two: winding numbers 1, 2, 1, 0, 1, 2, 1, 0, 1, 2.
        check_both(&rings(depth, 0xcc));
    }
}

/// It crosses itself where no input is, nor a double.
#[test]
fn a_figure_eight() {
    let points = [[0.0, 0.0], [3.0, 1.1], [3.0, 0.0], [0.0, 0.7]];
    let [parity, winding] = check_both(&curves(&points, &[&[0, 1, 2, 3]]));
    assert_eq!(parity, winding);
}

#[test]
fn squares_that_overlap() {
    let moved = |points: [Point; 4]| points.map(|[x, y]| [x + 0.75, y + 0.5]);
    let mut turned = moved(square(1.0));
    turned.reverse();
    let both = Domain::default().around(&square(1.0)).around(&moved(square(1.0)));
    let against = Domain::default().around(&square(1.0)).around(&turned);
    // They have 1.25 times 1.5 in common.
    let areas = [(&both, Interior::Parity, 4.25), (&both, Interior::Winding, 6.125)];
    for (domain, interior, area) in areas {
        assert_eq!(area_of(domain, interior), area);
    }
    assert_eq!(area_of(&against, Interior::Parity), 4.25);
    assert_eq!(area_of(&against, Interior::Winding), 4.25);
}

/// Both are in the same direction there, or in opposite ones.
#[test]
fn rings_that_share_an_edge() {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [0.0, 1.0]];
    let left: &[u32] = &[0, 1, 4, 5];
    for right in [&[1, 2, 3, 4][..], &[4, 3, 2, 1]] {
        let domain = curves(&points, &[left, right]);
        assert_eq!(area_of(&domain, Interior::Parity), 2.0);
        assert_eq!(area_of(&domain, Interior::Winding), 2.0);
    }
}

/// Sides on one line, each with ends within the other, once in each direction.
#[test]
fn sides_that_overlap_in_part() {
    let points = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [0.0, 1.0],
        [1.0, 1.0],
        [3.0, 1.0],
        [3.0, 2.0],
        [1.0, 2.0],
        [3.0, 0.25],
        [1.0, 0.25],
    ];
    for second in [&[4, 5, 6, 7][..], &[7, 6, 5, 4], &[4, 5, 8, 9], &[9, 8, 5, 4]] {
        check_both(&curves(&points, &[&[0, 1, 2, 3], second]));
    }
}

#[test]
fn holes_that_touch_at_a_vertex() {
    let points = [
        [-2.0, -2.0],
        [2.0, -2.0],
        [2.0, 2.0],
        [-2.0, 2.0],
        [0.0, 0.0],
        [1.0, 0.5],
        [1.0, -0.5],
        [-1.0, -0.5],
        [-1.0, 0.5],
        [0.0, -2.0],
    ];
    let outer: &[u32] = &[0, 1, 2, 3];
    // Two holes at the origin, and one at an input on a side of the square.
    let touching = curves(&points, &[outer, &[4, 5, 6], &[4, 7, 8], &[9, 7, 6]]);
    assert_eq!(area_of(&touching, Interior::Winding), 13.5);
    check(&touching, Interior::Parity);
    let same = curves(&points, &[outer, &[6, 5, 4], &[8, 7, 4]]);
    assert_eq!(area_of(&same, Interior::Winding), 16.0);
    assert_eq!(area_of(&same, Interior::Parity), 15.0);
}

#[test]
fn segments_that_are_there_twice() {
    let ring = |curve: &[u32]| curves(&square(1.0), &[curve]);
    let forth: &[u32] = &[0, 1, 2, 3];
    let back: &[u32] = &[3, 2, 1, 0];
    for (curves_of, parity, winding) in [
        (&[forth, forth][..], None, Some(4.0)),
        (&[forth, back], None, None),
        (&[forth, forth, forth], Some(4.0), Some(4.0)),
        (&[forth, back, back], Some(4.0), Some(4.0)),
    ] {
        let domain = curves(&square(1.0), curves_of);
        for (interior, expected) in [(Interior::Parity, parity), (Interior::Winding, winding)] {
            match expected {
                Some(area) => assert_eq!(area_of(&domain, interior), area),
                None => assert_nothing(&domain, interior),
            }
        }
    }
    // Curves twice by equal inputs, and in pieces.
    let points = [square(1.0).to_vec(), vec![[0.5, -1.0]], square(1.0).to_vec()].concat();
    let twice = curves(&points, &[forth, &[5, 4, 6, 7, 8]]);
    assert_nothing(&twice, Interior::Parity);
    assert_eq!(area_of(&twice, Interior::Winding), 4.0);
    assert_eq!(area_of(&ring(back), Interior::Winding), 4.0);
}

#[test]
fn curves_that_do_not_close() {
    let mut domain = Domain::default().around(&square(1.0));
    domain.points.push([0.25, 0.5]);
    domain.segments.push([2, 4]);
    for (interior, start) in [
        (
            Interior::Parity,
            "input 2 is an end of 3 segments; with options.interior = Interior::Parity",
        ),
        (Interior::Winding, "input 2 is the first end of 2 segments and the second end of 1;"),
    ] {
        let (kind, message) = refusal(&domain, &options(interior));
        assert_eq!(kind, ErrorKind::InvalidArgument);
        assert!(message.starts_with(start), "{message}");
    }
    // A segment in the domain does no harm to seeds.
    run(&domain, &options(Interior::Seeds)).unwrap();
}

#[test]
fn curves_are_for_domains_that_they_bound() {
    let domain = Domain::default().around(&square(1.0));
    for extent in [netmesh::options::Extent::All, netmesh::options::Extent::Hull] {
        let (kind, message) = refusal(&domain, &Options { extent, ..options(Interior::Parity) });
        assert_eq!(kind, ErrorKind::InvalidArgument);
        assert!(
            message.starts_with(
                "options.interior = Interior::Parity does not go with options.extent ="
            ),
            "{message}"
        );
    }
}

/// Seeds label regions and make holes beside the rule.
#[test]
fn seeds_in_curves() {
    let mut domain = rings(5, 0);
    let center = [0.25, -0.125];
    let hole = Region { is_hole: true, ..Region::in_plane(center) };
    let label = Region { seed: [center[0] + 0.77, center[1], 0.0], label: 7, ..Region::default() };
    let striped = area_of(&domain, Interior::Parity);
    let disc = area_of(&Domain::new(&domain.points, &domain.segments[48..]), Interior::Parity);
    domain.regions = vec![hole, label];
    let mesh = run(&domain, &options(Interior::Parity)).unwrap();
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    assert!((area(&mesh) - (striped - disc)).abs() < 1e-12);
    assert!(mesh.result().unwrap().boundary.simplex_regions.contains(&7));
    let all = [0.955, 0.775, 0.55].map(|x| [center[0] + x, center[1]]);
    domain.regions = all.map(|seed| Region { is_hole: true, ..Region::in_plane(seed) }).to_vec();
    let (kind, message) = refusal(&domain, &options(Interior::Parity));
    assert_eq!(kind, ErrorKind::InvalidArgument);
    assert!(message.starts_with("all that is inside is a hole"), "{message}");
}

#[test]
fn curves_of_all_scales() {
    for exponent in [-1000, -500, -40, 900] {
        let scaled = |points: &[Point]| -> Vec<Point> {
            points.iter().map(|p| p.map(|x| x * 2f64.powi(exponent))).collect()
        };
        let eight = [[0.0, 0.0], [3.0, 1.1], [3.0, 0.0], [0.0, 0.7]];
        check_both(&curves(&scaled(&eight), &[&[0, 1, 2, 3]]));
        if exponent < 0 {
            // In a large square, and beside it.
            let small = scaled(&square(1.0));
            check_both(&Domain::default().around(&square(1.0)).around(&small));
        }
    }
}

/// Closed ways on a small lattice: they overlap, cross and touch in all ways.
#[test]
fn curves_at_random() {
    let mut random = Random::new(24);
    let mut draw = |count: f64| (random.unit() * count) as u32;
    let mut meshes = 0;
    for trial in 0..60 {
        let side = 3 + trial % 4;
        let points: Vec<Point> =
            (0..side * side).map(|i| [f64::from(i % side), f64::from(i / side)]).collect();
        let ways: Vec<Vec<u32>> = (0..1 + trial % 3)
            .map(|_| {
                let mut way: Vec<u32> = Vec::new();
                while way.len() < 4 + trial as usize % 5 || way.first() == way.last() {
                    let next = draw(f64::from(side * side));
                    if way.last() != Some(&next) {
                        way.push(next);
                    }
                }
                way
            })
            .collect();
        let ways: Vec<&[u32]> = ways.iter().map(|way| &way[..]).collect();
        let domain = curves(&points, &ways);
        for interior in [Interior::Parity, Interior::Winding] {
            match run(&domain, &options(interior)) {
                Ok(mesh) => {
                    assert_inside(&domain, &mesh, interior);
                    meshes += 1;
                }
                Err(error) => {
                    let message = error.message();
                    assert!(message.starts_with("segments enclose nothing"), "{message}");
                }
            }
        }
    }
    assert!(meshes > 100, "{meshes}");
}
