//! Corruptions of hulls and boxes, and of sizes in domains of segments.

use super::meshes::{Case, random_points};
use super::segments::Domain;
use netmesh::options::{Extent, Options, Output, SizeFn};
use netmesh::validate::ViolationKind as Kind;
use netmesh::{Inputs, Mesh, NONE, Region};

/// A square in a square, the inner one with a label, and a few points.
fn squares(options: &Options, size: Option<&SizeFn<'_>>, inner: f64) -> Domain {
    let square = |half: f64| [[-half, -half], [half, -half], [half, half], [-half, half]];
    let points = [square(1.0), square(0.5)].concat();
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(&[0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4], None).unwrap();
    let region = Region { seed: [0.1, 0.2, 0.0], label: 3, is_hole: false, max_edge: inner };
    let whole = Region { seed: [0.1, 0.7, 0.0], label: 4, ..Region::default() };
    mesh.set_regions(&[region, whole]).unwrap();
    mesh.run_sized(&Options { output: Output::WellSpaced, ..options.clone() }, size, None).unwrap();
    let case = Case { inputs: mesh.inputs().clone(), mesh: mesh.result().unwrap().clone() };
    let segments = mesh.segments().clone();
    Domain { case, segments, regions: mesh.regions().to_vec() }
}

fn within_segments() -> Options {
    Options { extent: Extent::Boundary, min_angle: 25.0, ..Options::default() }
}

#[test]
fn edges_longer_than_those_of_a_region() {
    for options in [within_segments(), Options::default()] {
        let domain = squares(&options, None, 0.1);
        domain.assert_sound();
        let mut finer = domain.clone();
        finer.regions[0].max_edge *= 0.5;
        finer.assert_violates(Kind::SimplexSize);
        // The other region is coarse.
        let mut finer = domain.clone();
        finer.regions[1].max_edge = 0.1;
        finer.assert_violates(Kind::SimplexSize);
    }
}

#[test]
fn edges_longer_than_the_largest_in_a_domain() {
    let domain = squares(&Options { max_edge: 0.2, ..within_segments() }, None, 0.0);
    domain.assert_sound();
    let mut finer = domain;
    finer.corrupt(|whole| whole.parameters.max_edge *= 0.5);
    finer.assert_violates(Kind::SimplexSize);
}

#[test]
fn sizes_in_a_domain() {
    let size: &SizeFn<'_> = &|x| 0.1 + 0.2 * x[0].abs();
    let domain = squares(&within_segments(), Some(size), 0.0);
    domain.assert_sound();
    let count = domain.case.mesh.vertex_count();
    for vertex in (0..count).step_by(5) {
        let mut finer = domain.clone();
        finer.corrupt(|whole| whole.sizes[vertex] *= 0.01);
        finer.assert_violates(Kind::SimplexSize);
    }
    // Nothing is promised of what is cut away.
    let mut outside = domain;
    outside.corrupt(|whole| whole.sizes[count..].fill(1e-3));
    outside.assert_sound();
}

/// Random points cut to their hull or box, some of them on it.
fn framed(extent: Extent, segments: &[[u32; 2]]) -> Domain {
    let mut points = random_points::<2>(30, 5);
    points.extend([[-0.5, -0.25], [1.5, -0.25], [0.5, -0.25], [0.25, -0.25]]);
    let mut mesh = Mesh::new(2, points.len(), points.as_flattened(), 0).unwrap();
    mesh.set_segments(segments.as_flattened(), None).unwrap();
    mesh.run(&Options { extent, output: Output::WellSpaced, ..Options::default() }, None).unwrap();
    let case = Case { inputs: mesh.inputs().clone(), mesh: mesh.result().unwrap().clone() };
    Domain { case, segments: mesh.segments().clone(), regions: Vec::new() }
}

#[test]
fn frames_hold() {
    for extent in [Extent::Hull, Extent::Box] {
        framed(extent, &[]).assert_sound();
        // A segment that lies on the frame has the subsegments there.
        let domain = framed(extent, &[[32, 33], [30, 32]]);
        domain.assert_sound();
        assert!(domain.whole().boundary.parents.contains(&1));
    }
}

#[test]
fn a_frame_with_a_gap() {
    for extent in [Extent::Hull, Extent::Box] {
        let domain = framed(extent, &[]);
        for at in 0..domain.whole().boundary.subsegments.len() {
            let mut domain = domain.clone();
            domain.corrupt(|whole| {
                whole.boundary.subsegments.remove(at);
                whole.boundary.parents.remove(at);
            });
            domain.assert_violates(Kind::SegmentChain);
        }
        let mut bare = domain.clone();
        bare.case.mesh = domain.whole().clone();
        bare.case.mesh.boundary = Default::default();
        bare.assert_violates(Kind::SegmentChain);
    }
}

/// Closed curves, but not those of the extent.
#[test]
fn a_frame_of_another_extent() {
    let mut domain = framed(Extent::Hull, &[]);
    domain.corrupt(|whole| whole.parameters.extent = Extent::Box);
    domain.assert_violates(Kind::SegmentChain);
    let mut domain = framed(Extent::Box, &[]);
    domain.corrupt(|whole| whole.parameters.extent = Extent::Hull);
    domain.assert_violates(Kind::SegmentChain);
}

#[test]
fn a_piece_of_no_segment_off_the_frame() {
    for extent in [Extent::Hull, Extent::Box] {
        let domain = framed(extent, &[]);
        let inner = gabriel_edge(&domain);
        let mut other = domain.clone();
        other.corrupt(|whole| {
            whole.boundary.subsegments.push(inner);
            whole.boundary.parents.push(NONE);
        });
        other.assert_violates(Kind::SegmentLine);
    }
}

/// An edge between inputs within the domain that no vertex encroaches.
fn gabriel_edge(domain: &Domain) -> [u32; 2] {
    let mesh = &domain.case.mesh;
    let inputs = domain.case.inputs.distinct() as u32;
    let way = |from: u32, to: u32| [0, 1].map(|k| mesh.point(to)[k] - mesh.point(from)[k]);
    let dot = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| ax * bx + ay * by;
    for simplex in 0..mesh.simplex_count() {
        for slot in 0..3 {
            let [a, b] = [1, 2].map(|step| mesh.simplex(simplex)[(slot + step) % 3]);
            let is_free = |v: u32| v == a || v == b || dot(way(v, a), way(v, b)) > 1e-9;
            if mesh.neighbors[3 * simplex + slot] != NONE
                && a.max(b) < inputs
                && (0..mesh.vertex_count() as u32).all(is_free)
            {
                return [a, b];
            }
        }
    }
    panic!("no such edge");
}

/// An input beyond the frame: the inputs are others than those of the mesh.
#[test]
fn a_frame_that_leaves_an_input_out() {
    for extent in [Extent::Hull, Extent::Box] {
        let mut domain = framed(extent, &[]);
        let mut points = domain.case.inputs.distinct_points();
        (points[0], points[1]) = (0.5, 5.0);
        domain.case.inputs = Inputs::new(2, points.len() / 2, &points, 0).unwrap();
        domain.assert_violates(Kind::SegmentChain);
    }
}
