//! Rules of which the arrays must be broken in ways that other rules see first.

use super::anchors::Anchors;
use super::edges::Edges;
use super::lines::{self, Lines};
use super::{Promised, areas, forced, regions};
use crate::mesh::{Mesh, Triangulation};
use crate::options::{Algorithm, Extent, Options, Output};
use crate::quality::view::View;
use crate::validate::report::{Findings, ViolationKind};

/// Makes a square in a square, cropped to the larger. No edge is on a line with the origin.
fn squares() -> Triangulation {
    let square = |half: f64| {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        corners.map(|[x, y]| [x + 5.0, y + 7.0]).concat()
    };
    let points = [square(1.0), square(0.3)].concat();
    let mut mesh = Mesh::new(2, 8, &points, 0).unwrap();
    mesh.set_segments(&[0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4], None).unwrap();
    let options =
        Options { extent: Extent::Boundary, output: Output::WellSpaced, ..Options::default() };
    mesh.run(&options, None).unwrap();
    mesh.result().unwrap().clone()
}

fn findings(
    result: &Triangulation,
    check: impl Fn(View<'_, 2>, &Edges, Promised<'_>, &mut Findings),
) -> Option<ViolationKind> {
    let view = View::<2> { mesh: result.boundary.whole.as_deref().unwrap_or(result) };
    let mut findings = Findings::default();
    check(view, &Edges::new(view).unwrap(), Promised::of(result), &mut findings);
    findings.first.map(|first| first.kind)
}

#[test]
fn areas_are_those_of_polygons() {
    let check = |result: &Triangulation| {
        findings(result, |view, edges, promised, found| {
            areas::check(view, &edges.walls, promised.count, found).unwrap();
        })
    };
    let result = squares();
    assert_eq!(check(&result), None);
    for simplex in 0..result.simplex_count() {
        let mut relabelled = result.clone();
        relabelled.boundary.whole.as_mut().unwrap().boundary.simplex_regions[simplex] = 4;
        assert_eq!(check(&relabelled), Some(ViolationKind::RegionArea), "{simplex}");
    }
    // A domain that ends within a region has an edge there that is no subsegment.
    let mut less = result.clone();
    less.simplices.truncate(3 * (result.simplex_count() - 1));
    assert_eq!(check(&less), Some(ViolationKind::RegionArea));
}

#[test]
fn regions_need_no_seeds() {
    let check = |result: &Triangulation| {
        findings(result, |view, edges, promised, found| {
            regions::check(None, view, &edges.walls, None, promised, found).unwrap();
        })
    };
    let mut result = squares();
    assert_eq!(check(&result), None);
    result.simplices.clear();
    assert_eq!(check(&result), None, "without seeds any region may be a hole");
}

/// Holds that a segment that passes its end and comes back to it is refused.
#[test]
fn lines_do_not_go_back() {
    let check = |ends: &[u32], subsegments: &[[u32; 2]]| {
        let points = [0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 1.0, 1.0];
        let mut mesh = Mesh::new(2, 4, &points, 0).unwrap();
        mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
        let mut result = mesh.result().unwrap().clone();
        result.boundary.subsegments = subsegments.to_vec();
        result.boundary.parents = vec![0; subsegments.len()];
        findings(&result, |view, edges, _, found| {
            let lines = Lines::new(view.mesh, &Anchors::new(view, 0, edges)).unwrap();
            assert_eq!(lines.ends.as_flattened(), ends);
            lines::check(view, &lines, found).unwrap();
        })
    };
    assert_eq!(check(&[0, 2], &[[0, 1], [1, 2]]), None);
    assert_eq!(check(&[0, 1], &[[0, 2], [2, 1]]), Some(ViolationKind::SegmentChain));
    assert_eq!(check(&[0, 2], &[[0, 3], [3, 2]]), Some(ViolationKind::SegmentLine));
}

/// Checks a triangle whose shortest edge is between two segments from the origin: at `angle`
/// degrees, and at the distances 1 and `distance`.
fn between_segments(angle: f64, distance: f64) -> Option<ViolationKind> {
    let (sine, cosine) = angle.to_radians().sin_cos();
    let far = [4.0 * cosine, 4.0 * sine];
    let near = [distance * cosine, distance * sine];
    let points = [[0.0, 0.0], [4.0, 0.0], far, [2.2, 2.0], [1.0, 0.0], near];
    let mut mesh = Mesh::new(2, 6, points.as_flattened(), 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    let mut result = mesh.result().unwrap().clone();
    let is_between =
        |&simplex: &usize| [3, 4, 5].iter().all(|v| result.simplex(simplex).contains(v));
    let simplex = (0..result.simplex_count()).find(is_between).unwrap();
    result.boundary.subsegments = vec![[0, 4], [4, 1], [0, 5], [5, 2]];
    result.boundary.parents = vec![0, 0, 1, 1];
    result.boundary.forced = vec![simplex as u32];
    result.parameters.quality_bound = 0.6;
    findings(&result, |view, edges, _, found| {
        let anchors = Anchors::new(view, 4, edges);
        let lines = Lines::new(view.mesh, &anchors).unwrap();
        forced::check(view, edges, &lines, &anchors, found).unwrap();
    })
}

#[test]
fn small_angles_force_what_is_on_one_shell() {
    assert_eq!(between_segments(50.0, 1.0), None);
    assert_eq!(between_segments(50.0, 1.0005), None);
    assert_eq!(between_segments(50.0, 1.01), Some(ViolationKind::ForcedSimplex));
    assert_eq!(between_segments(80.0, 1.0), Some(ViolationKind::ForcedSimplex));
}
