//! Corruptions of what closed curves enclose.

use super::segments::{Domain, circle, closed};
use netmesh::options::Interior;
use netmesh::validate::ViolationKind as Kind;

/// A ring, and two within it of which the second has the other direction.
fn rings(interior: Interior) -> Domain {
    let mut points = circle(11, [0.0, 0.1], 1.0);
    points.extend(circle(9, [0.5, 0.0], 0.3));
    points.extend(circle(7, [-0.4, 0.1], 0.4));
    let mut segments = [closed(0, 11), closed(11, 9), closed(20, 7)].concat();
    segments[20..].iter_mut().for_each(|ends| ends.reverse());
    Domain::with(&points, &segments, &[], interior).1
}

#[test]
fn insides_that_curves_do_not_have() {
    let [parity, winding] = [Interior::Parity, Interior::Winding].map(rings);
    // The first ring within the large one is no part of it by parity.
    assert!(parity.case.mesh.simplex_count() < winding.case.mesh.simplex_count());
    for (domain, other) in [(&parity, Interior::Winding), (&winding, Interior::Parity)] {
        domain.assert_sound();
        let mut domain = domain.clone();
        domain.corrupt(|whole| whole.parameters.interior = other);
        domain.assert_violates(Kind::DomainPlace);
        domain.corrupt(|whole| whole.parameters.interior = Interior::Seeds);
        domain.assert_violates(Kind::DomainPlace);
    }
    let mut turned = winding.clone();
    turned.segments.inputs[11..20].iter_mut().for_each(|ends| ends.reverse());
    let report = turned.report(3);
    // The subsegments no longer have the directions of their segments.
    assert_eq!(report.first.unwrap().kind, Kind::SegmentChain);
    let mut open = winding.clone();
    open.corrupt(|whole| {
        let last = whole.boundary.parents.partition_point(|&parent| parent < 26);
        whole.boundary.parents[last..].fill(25);
    });
    assert!(open.report(3).violations > 0);
}
