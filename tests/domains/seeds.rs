//! Seeds: each names a region of its own, or is refused by name; and what of segments is left when
//! a domain is cut out.

use super::shapes::{Domain, square};
use super::{inside, refusal, run};
use netmesh::options::{Extent, Interior, Labels, Options, Output};
use netmesh::quality::measure;
use netmesh::validate::validate_mesh;
use netmesh::{ErrorKind, Mesh, NONE, Region};

fn hole(seed: [f64; 2]) -> Region {
    Region { is_hole: true, ..Region::in_plane(seed) }
}

fn label(seed: [f64; 2], label: i32) -> Region {
    Region { label, ..Region::in_plane(seed) }
}

fn with(extent: Extent) -> Options {
    Options { extent, ..inside(25.0, Output::WellSpaced) }
}

fn all_extents() -> [Options; 4] {
    [Extent::All, Extent::Hull, Extent::Box, Extent::Boundary].map(with)
}

/// A square of side 4 about the origin, with one of side 2 in it.
fn frame() -> Domain {
    Domain::default().around(&square(2.0)).within(&square(1.0))
}

fn sound(domain: &Domain, options: &Options) -> Mesh {
    let mesh = run(domain, options).unwrap_or_else(|error| panic!("{:?}: {error}", options.extent));
    let report = validate_mesh(&mesh, 3).unwrap();
    assert_eq!((report.level, report.violations), (3, 0), "{:?}", report.first);
    assert_edges_listed(&mesh);
    mesh
}

/// The edges of segments that the result lists are those of the whole that it has.
pub fn assert_edges_listed(mesh: &Mesh) {
    let result = mesh.result().unwrap();
    let whole = result.boundary.whole.as_deref().unwrap_or(result);
    let mut edges = std::collections::HashSet::new();
    for simplex in 0..result.simplex_count() {
        let [a, b, c] = [0, 1, 2].map(|at| result.simplex(simplex)[at]);
        edges.extend([[a, b], [b, c], [c, a], [b, a], [c, b], [a, c]]);
    }
    let all = whole.boundary.subsegments.iter().zip(&whole.boundary.parents);
    let expected: Vec<_> = all.filter(|(ends, _)| edges.contains(*ends)).collect();
    let listed: Vec<_> = result.boundary.subsegments.iter().zip(&result.boundary.parents).collect();
    assert_eq!(listed, expected);
}

fn area(mesh: &Mesh) -> f64 {
    let result = mesh.result().unwrap();
    let doubled = |simplex: usize| {
        let [a, b, c] = [0, 1, 2].map(|at| result.point(result.simplex(simplex)[at]));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    (0..result.simplex_count()).map(doubled).sum::<f64>() / 2.0
}

fn assert_refused(domain: &Domain, options: &Options, start: &str) {
    let (kind, message) = refusal(domain, options);
    assert_eq!(kind, ErrorKind::InvalidArgument, "{message}");
    assert!(message.starts_with(start), "{message}, not {start}");
}

/// A hole that is typed wrong would fill the one that was meant.
#[test]
fn a_seed_outside_is_refused() {
    for (options, place) in [
        (with(Extent::Boundary), "outside of all that segments enclose;"),
        (with(Extent::Hull), "beyond the boundary, with options.extent = Extent::Hull;"),
        (with(Extent::Box), "beyond the boundary, with options.extent = Extent::Box;"),
    ] {
        for (at, seed) in [[2.5, 0.25], [-1e300, 0.0], [0.0, 6.0]].into_iter().enumerate() {
            let mut domain = frame();
            domain.regions = vec![label([0.0, 1.5], 3); at.min(1)];
            domain.regions.push(hole(seed));
            let name =
                format!("regions[{}].seed is ({:?}, {:?}), {place}", at.min(1), seed[0], seed[1]);
            assert_refused(&domain, &options, &name);
            domain.regions.last_mut().unwrap().is_hole = false;
            assert_refused(&domain, &options, &name);
        }
    }
}

/// All of the plane has regions: what surrounds the segments is one, beyond the outer cage, too.
#[test]
fn with_the_extent_all_what_is_outside_is_a_region() {
    for seed in [[2.5, 0.25], [1e9, -3e8], [-f64::MAX, f64::MAX]] {
        let mut domain = frame();
        domain.regions = vec![label([0.0, 0.0], 1), label(seed, 2), label([0.0, 1.5], 3)];
        let mesh = sound(&domain, &with(Extent::All));
        let result = mesh.result().unwrap();
        for simplex in 0..result.simplex_count() {
            let corners = [0, 1, 2].map(|at| result.point(result.simplex(simplex)[at]));
            let [x, y] =
                [0, 1].map(|axis| corners.map(|c| c[axis] / 3.0).iter().sum::<f64>().abs());
            let expected = match x.max(y) {
                far if far > 2.0 => 2,
                far if far > 1.0 => 3,
                _ => 1,
            };
            assert_eq!(result.boundary.simplex_regions[simplex], expected);
        }
    }
}

/// Regions without a seed are numbered by the first segment that they are on the left of, or else
/// on the right of.
#[test]
fn regions_are_numbered_by_their_segments() {
    let numbered = |extent| Options { labels: Labels::Regions, ..with(extent) };
    for (regions, [ring, inner]) in [
        (vec![], [1, 2]),
        (vec![label([0.0, 1.5], 5)], [5, 1]),
        (vec![label([0.0, 1.5], 1)], [1, 2]),
        (vec![label([0.0, 0.0], 1)], [2, 1]),
    ] {
        for extent in [Extent::All, Extent::Hull, Extent::Boundary] {
            let mut domain = frame();
            domain.regions = regions.clone();
            let mesh = sound(&domain, &numbered(extent));
            let result = mesh.result().unwrap();
            for simplex in 0..result.simplex_count() {
                let corners = [0, 1, 2].map(|at| result.point(result.simplex(simplex)[at]));
                let [x, y] =
                    [0, 1].map(|axis| corners.map(|c| c[axis] / 3.0).iter().sum::<f64>().abs());
                let expected = match x.max(y) {
                    far if far > 2.0 => 0,
                    far if far > 1.0 => ring,
                    _ => inner,
                };
                assert_eq!(result.boundary.simplex_regions[simplex], expected, "{extent:?}");
            }
        }
    }
}

#[test]
fn two_seeds_in_a_region_are_refused() {
    for options in all_extents() {
        for others in [[true, true], [true, false], [false, true], [false, false]] {
            let mut domain = frame();
            let [first, last] = others.map(|is_hole| Region { is_hole, ..label([0.0; 2], 4) });
            let (first, last) = (
                Region { seed: [0.1, 0.2, 0.0], ..first },
                Region { seed: [-0.3, 0.9, 0.0], ..last },
            );
            domain.regions = vec![first, label([0.0, 1.5], 3), last];
            let message = "regions[2].seed is in the same region as regions[0].seed; no segment is";
            assert_refused(&domain, &options, message);
            // With a segment between them each has its own.
            domain = domain.within(&square(0.5));
            sound(&domain, &options);
        }
    }
}

/// The inner square is out already by parity. A hole says the same, a label would be lost.
#[test]
fn seeds_where_curves_leave_the_domain_out() {
    for (interior, word) in [(Interior::Parity, "Parity"), (Interior::Winding, "Winding")] {
        let mut inner = square(1.0);
        inner.reverse();
        let mut domain = Domain::default().around(&square(2.0)).within(&inner);
        let options = Options { interior, ..with(Extent::Boundary) };
        let alone = sound(&domain, &options);
        domain.regions = vec![hole([0.0, 0.0])];
        let same = sound(&domain, &options);
        assert_eq!(same.result().unwrap().simplices, alone.result().unwrap().simplices);
        domain.regions = vec![label([0.0, 1.5], 1), label([0.25, 0.5], 2)];
        let place = format!("which options.interior = Interior::{word} leaves out");
        let message = format!("regions[1].seed is (0.25, 0.5), {place}");
        assert_refused(&domain, &options, &message);
        domain.regions = vec![hole([0.0, 3.0])];
        assert_refused(&domain, &options, "regions[0].seed is (0.0, 3.0), outside of all");
    }
}

#[test]
fn seeds_without_regions_are_refused() {
    let mut domain = Domain::new(&square(1.0), &[]);
    domain.regions = vec![label([0.0, 0.0], 5)];
    let message = "regions[0].seed is in no region: the mesh has no segments";
    assert_refused(&domain, &with(Extent::All), message);
    for extent in [Extent::Hull, Extent::Box] {
        let mesh = sound(&domain, &with(extent));
        assert!(mesh.result().unwrap().boundary.simplex_regions.iter().all(|&label| label == 5));
    }
}

/// A hole is no part of the result, whatever the extent; and measures are of what is left.
#[test]
fn holes_count_with_every_extent() {
    for options in all_extents() {
        let whole = area(&sound(&frame(), &options));
        for (seed, lost) in [([0.0, 0.0], 4.0), ([1.5, 0.0], 12.0)] {
            let mut domain = frame();
            domain.regions = vec![hole(seed)];
            let mesh = sound(&domain, &options);
            assert!((area(&mesh) - (whole - lost)).abs() < 1e-9, "{:?}", options.extent);
            assert!(measure(mesh.result().unwrap()).unwrap().min_angle_degrees > 25.0 - 1e-6);
            let mut found = [0];
            let index = netmesh::query::Index::new(mesh.result().unwrap()).unwrap();
            index.locate(mesh.result().unwrap(), &seed, 1, &mut found).unwrap();
            assert_eq!(found, [NONE]);
        }
    }
    let mut domain = frame();
    domain.regions = vec![hole([9.0, 0.0])];
    let alone = frame();
    let hierarchical = |extent| Options { output: Output::Hierarchical, ..with(extent) };
    for [all, boundary] in [
        [Extent::All, Extent::Boundary].map(with),
        [Extent::All, Extent::Boundary].map(hierarchical),
    ] {
        let [all, boundary] = [sound(&domain, &all), sound(&alone, &boundary)];
        assert!((area(&all) - area(&boundary)).abs() < 1e-9);
    }
    domain.regions = [[0.0, 0.0], [1.5, 0.0], [9.0, 0.0]].map(hole).to_vec();
    assert_refused(&domain, &with(Extent::All), "all that is inside is a hole");
}

/// With a low bound triangles at the outer cage have 13 degrees, and others more than 40. They
/// are not measured; those at a hole are.
#[test]
fn holes_leave_the_measures_of_a_mesh_to_its_cage() {
    let options = Options { min_angle: 5.0, ..with(Extent::All) };
    let least = |regions: Vec<Region>| {
        let mesh = sound(&Domain { regions, ..frame() }, &options);
        let result = mesh.result().unwrap();
        (result.simplex_count(), measure(result).unwrap().min_angle_degrees)
    };
    let [(all, angle), (cut, angle_of_cut)] = [Vec::new(), vec![hole([0.0; 2])]].map(least);
    assert!(cut < all && angle > 40.0 && angle_of_cut > 40.0, "{angle} {angle_of_cut}");
}

/// The segment is outside of the domain. Its ends are neighbours, or an input is between them.
#[test]
fn segments_outside_have_no_edges() {
    for between in [&[][..], &[[5.0, 2.0]]] {
        let mut domain = Domain::default().around(&square(2.0)).segment([4.0, -2.0], [4.0, 2.0]);
        domain.points.extend(between);
        let mesh = sound(&domain, &with(Extent::Boundary));
        let boundary = &mesh.result().unwrap().boundary;
        assert_eq!(boundary.parents, [0, 1, 2, 3]);
        let all = &sound(&domain, &with(Extent::All));
        assert!(all.result().unwrap().boundary.parents.contains(&4));
        let boxed = &sound(&domain, &with(Extent::Box));
        assert!(boxed.result().unwrap().boundary.parents.contains(&4));
    }
}

/// Nothing is on either side of an outer side that a hole lies along.
#[test]
fn sides_of_holes_outside_have_no_edges() {
    let points = [
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [1.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
    ];
    let segments = [[0, 4], [4, 5], [5, 1], [1, 2], [2, 3], [3, 0], [5, 6], [6, 7], [7, 4]];
    let mut domain = Domain::new(&points, &segments);
    domain.regions = vec![hole([2.0, 0.5])];
    let mesh = sound(&domain, &with(Extent::Boundary));
    let boundary = &mesh.result().unwrap().boundary;
    assert!(!boundary.parents.contains(&1));
    for parent in [0, 2, 3, 4, 5, 6, 7, 8] {
        assert!(boundary.parents.contains(&parent), "segment {parent}");
    }
    domain.regions.clear();
    let mesh = sound(&domain, &with(Extent::Boundary));
    assert!(mesh.result().unwrap().boundary.parents.contains(&1));
}
