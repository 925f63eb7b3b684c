//! Corruptions of the subsegments that segments have become.

use super::meshes::run;
use super::segments::{Domain, before_split, lake, star};
use netmesh::Mesh;
use netmesh::options::{Algorithm, Options};
use netmesh::validate::ViolationKind as Kind;

#[test]
fn a_subsegment_that_is_no_edge() {
    for mut domain in [lake(), star()] {
        let at = before_split(&domain);
        domain.corrupt(|whole| {
            let boundary = &mut whole.boundary;
            boundary.subsegments[at][1] = boundary.subsegments[at + 1][1];
            boundary.subsegments.remove(at + 1);
            boundary.parents.remove(at + 1);
        });
        domain.assert_violates(Kind::SubsegmentEdge);
    }
}

#[test]
fn a_subsegment_twice() {
    let mut domain = lake();
    domain.corrupt(|whole| {
        let boundary = &mut whole.boundary;
        let parent = boundary.parents[0];
        boundary.subsegments.insert(1, boundary.subsegments[0]);
        boundary.parents.insert(1, parent);
    });
    domain.assert_violates(Kind::SubsegmentEdge);
}

/// Plain triangulations with subsegments: up to level 2.
fn by_hand(
    points: &[[f64; 2]],
    inputs: usize,
    segments: &[[u32; 2]],
    parts: &[[u32; 3]],
) -> Domain {
    let options = Options { algorithm: Algorithm::Delaunay, ..Options::default() };
    let mut case = run(points, &options);
    case.inputs = run(&points[..inputs], &Options::default()).inputs;
    let mut mesh = Mesh::new(2, inputs, points[..inputs].as_flattened(), 0).unwrap();
    mesh.set_segments(segments.as_flattened(), None).unwrap();
    let boundary = &mut case.mesh.boundary;
    boundary.subsegments = parts.iter().map(|part| [part[0], part[1]]).collect();
    boundary.parents = parts.iter().map(|part| part[2]).collect();
    boundary.simplex_regions = vec![0; case.mesh.simplices.len() / 3];
    Domain { case, segments: mesh.segments().clone(), regions: Vec::new() }
}

fn kind_by_hand(domain: &Domain) -> Option<Kind> {
    domain.report(2).first.map(|first| first.kind)
}

#[test]
fn a_subsegment_that_is_not_gabriel() {
    let domain = |y: f64| {
        let points = [[0.0, 0.0], [4.0, 0.0], [1.0, y]];
        by_hand(&points, 3, &[[0, 1]], &[[0, 1, 0]])
    };
    assert_eq!(kind_by_hand(&domain(3f64.sqrt().next_up())), None);
    assert_eq!(kind_by_hand(&domain(3f64.sqrt().next_down())), Some(Kind::SubsegmentGabriel));
}

/// Doubles have no room for a vertex on an edge of some units in the last place, or where another
/// vertex is as near to it. Marks alone excuse nothing, and neither does one marked end.
#[test]
fn a_subsegment_without_room_need_not_be_gabriel() {
    let kind = |width: f64, y: f64, limited: usize| {
        let points = [[1.0, 1.0], [1.0 + width, 1.0], [1.0 + 0.5 * width, 1.0 + y]];
        let mut domain = by_hand(&points, 3, &[[0, 1]], &[[0, 1, 0]]);
        domain.case.mesh.precision_limited[..limited].fill(true);
        kind_by_hand(&domain)
    };
    let (broken, unit) = (Some(Kind::SubsegmentGabriel), f64::EPSILON);
    for (width, y) in [(0.5, 0.125), (4096.0 * unit, 256.0 * unit)] {
        assert_eq!([0, 1, 2].map(|limited| kind(width, y, limited)), [broken; 3], "{width}");
    }
    for (width, y) in [(8.0 * unit, 2.0 * unit), (0.5, 4.0 * unit)] {
        let kinds = [0, 1, 2].map(|limited| kind(width, y, limited));
        assert_eq!(kinds, [broken, broken, None], "{width}");
    }
    // The units are those of the coarser axis, here x, also along the other one.
    let upright = |length: f64| {
        let unit = 64.0 * unit;
        let (half, apex) = (0.5 * length * unit, 100.0 - 0.4 * length * unit);
        let points = [[100.0, 1.0], [100.0, 1.0 + 2.0 * half], [apex, 1.0 + half]];
        let mut domain = by_hand(&points, 3, &[[0, 1]], &[[0, 1, 0]]);
        domain.case.mesh.precision_limited[..2].fill(true);
        kind_by_hand(&domain)
    };
    assert_eq!([60.0, 80.0].map(upright), [None, broken]);
}

#[test]
fn segments_that_overlap_share_subsegments() {
    let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [1.6, 1.7], [1.3, -1.8]];
    let segments = [[0, 2], [1, 3], [3, 0], [2, 0]];
    let kind = |parts: &[[u32; 3]]| kind_by_hand(&by_hand(&points, 6, &segments, parts));
    assert_eq!(kind(&[[0, 1, 0], [1, 2, 0], [2, 3, 1]]), None);
    for wrong in [
        &[[0, 1, 0], [1, 2, 1], [2, 3, 1]][..],
        &[[0, 1, 0], [1, 2, 0], [2, 3, 2]],
        &[[0, 1, 0], [2, 1, 0], [2, 3, 1]],
        &[[0, 1, 0], [1, 2, 0]],
        &[[0, 1, 0], [1, 2, 0], [2, 3, 1], [4, 2, 3]],
        &[[0, 4, 0], [4, 2, 0], [2, 3, 1]],
    ] {
        let kind = kind(wrong).unwrap_or_else(|| panic!("{wrong:?} went unseen"));
        let kinds = [Kind::SegmentChain, Kind::SegmentLine, Kind::SubsegmentGabriel];
        assert!(kinds.contains(&kind), "{wrong:?}: {kind:?}");
    }
}

/// Other segments lead from end to end, by a detour.
#[test]
fn a_segment_without_subsegments() {
    let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.5]];
    let kind = |segments: &[[u32; 2]]| {
        kind_by_hand(&by_hand(&points, 3, segments, &[[0, 2, 0], [2, 1, 1]]))
    };
    assert_eq!(kind(&[[0, 2], [2, 1]]), None);
    assert_eq!(kind(&[[0, 2], [2, 1], [0, 1]]), Some(Kind::SegmentChain));
}

#[test]
fn segments_cross_at_the_nearest_double() {
    let kind = |y: f64| {
        let points = [[0.0, 0.0], [3.0, 1.0], [1.0, -1.0], [1.0, 2.0], [1.0, y]];
        let parts = [[0, 4, 0], [4, 1, 0], [2, 4, 1], [4, 3, 1]];
        kind_by_hand(&by_hand(&points, 4, &[[0, 1], [2, 3]], &parts))
    };
    let third: f64 = 1.0 / 3.0;
    assert_eq!(kind(third), None);
    assert_eq!(kind(third + 3.0 * f64::EPSILON), None);
    assert_eq!(kind(third + 15.0 * f64::EPSILON), None);
    assert_eq!(kind(third + 40.0 * f64::EPSILON), Some(Kind::SegmentLine));
}

#[test]
fn a_vertex_off_its_segment() {
    for mut domain in [lake(), star()] {
        let at = before_split(&domain);
        let vertex = domain.whole().boundary.subsegments[at][1] as usize;
        domain.corrupt(|whole| {
            let x = &mut whole.points[2 * vertex + 1];
            *x = x.next_up().next_up();
        });
        domain.assert_violates(Kind::SegmentLine);
    }
}

#[test]
fn an_input_off_a_segment() {
    let points = |y: f64| [[-1.0, 0.5], [3.0, 0.5], [1.0, y], [1.1, 3.0], [0.9, -2.0]];
    let kind = |y: f64| {
        let parts = [[0, 2, 0], [2, 1, 0]];
        kind_by_hand(&by_hand(&points(y), 5, &[[0, 1]], &parts))
    };
    // A unit in the last place of the segment is one of 0.5.
    let beside = |units: u32| (0..units).fold(0.5f64, |y, _| y.next_up());
    assert_eq!([0, 1, 16].map(|units| kind(beside(units))), [None; 3]);
    assert_eq!(kind(beside(17)), Some(Kind::SegmentLine));
}

#[test]
fn a_chain_with_a_gap() {
    for domain in [lake(), star()] {
        for at in 0..domain.whole().boundary.subsegments.len() {
            let mut domain = domain.clone();
            domain.corrupt(|whole| {
                whole.boundary.subsegments.remove(at);
                whole.boundary.parents.remove(at);
            });
            domain.assert_violates(Kind::SegmentChain);
        }
    }
}

#[test]
fn a_subsegment_of_another_segment() {
    let mut domain = lake();
    let parents = &domain.whole().boundary.parents;
    let at = parents.iter().rposition(|&parent| parent == 2).unwrap();
    domain.corrupt(|whole| whole.boundary.parents[at] = 3);
    domain.assert_violates(Kind::SegmentChain);
}

#[test]
fn a_subsegment_turned_round() {
    let mut domain = lake();
    domain.corrupt(|whole| whole.boundary.subsegments[0].reverse());
    domain.assert_violates(Kind::SegmentChain);
}
