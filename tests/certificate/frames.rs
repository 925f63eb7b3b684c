//! Corruptions of boxes and hulls in space.

use super::facets::{corrupted, remove_subfacet};
use super::meshes::{Case, random_points};
use super::solids::{Solid, facets_of};
use netmesh::options::{Criterion, Extent, Options};
use netmesh::validate::ViolationKind as Kind;
use netmesh::{Mesh, NONE};

type Point = [f64; 3];

/// Returns the mesh of the hull or box of points, with a triangle in the middle if it is asked for.
fn framed(extent: Extent, points: &[Point], has_facet: bool) -> Solid {
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    let facets =
        if has_facet { facets_of(&[vec![vec![0, 1, 2]]], false) } else { Default::default() };
    if has_facet {
        mesh.set_facets(&[0, 1], &[0, 3], &[0, 1, 2], None).unwrap();
    }
    let criterion = Criterion::RadiusEdge;
    mesh.run(&Options { extent, criterion, quality_bound: 4.0, ..Options::default() }, None)
        .unwrap();
    let case = Case { inputs: mesh.inputs().clone(), mesh: mesh.result().unwrap().clone() };
    Solid { case, facets, segments: Default::default(), regions: Vec::new() }
}

/// Returns a triangle within a cube of eight points, and the points.
fn points() -> Vec<Point> {
    let corner = |at: usize| [0, 1, 2].map(|k| if at >> k & 1 == 1 { 0.875 } else { -0.75 });
    let mut all = vec![[0.25, 0.0, 0.125], [-0.25, 0.25, 0.0], [0.0, -0.25, -0.25]];
    all.extend((0..8).map(corner));
    all.extend(random_points::<3>(6, 3).iter().map(|x| x.map(|x| 0.5 * x)));
    all
}

const BOTH: [Extent; 2] = [Extent::Hull, Extent::Box];

#[test]
fn frames_in_space_hold() {
    for extent in BOTH {
        for has_facet in [false, true] {
            framed(extent, &points(), has_facet).assert_sound(3);
            framed(extent, &random_points::<3>(20, 8), false).assert_sound(3);
        }
    }
}

#[test]
fn a_frame_in_space_with_a_gap() {
    for extent in BOTH {
        let solid = framed(extent, &points(), false);
        let count = solid.clone().whole().boundary.subfacets.len();
        for at in (0..count).step_by(5) {
            let mut solid = solid.clone();
            solid.corrupt(|whole| remove_subfacet(whole, at));
            solid.find_sides();
            assert!(solid.report(3).violations > 0);
        }
    }
}

/// The domain is a hull or box, but not of these inputs, or of the other kind.
#[test]
fn a_frame_in_space_of_another_extent() {
    let points = random_points::<3>(20, 8);
    let hull = framed(Extent::Hull, &points, false);
    corrupted(&hull, Kind::FacetPlane, |whole| whole.parameters.extent = Extent::Box);
    let boxed = framed(Extent::Box, &points, false);
    corrupted(&boxed, Kind::RegionVolume, |whole| whole.parameters.extent = Extent::Hull);
}

/// Returns what facets enclose, as if it were the hull of the inputs.
fn enclosed(points: &[Point], polygons: &[Vec<u32>]) -> Solid {
    let mut mesh = Mesh::new(3, points.len(), points.as_flattened(), 0).unwrap();
    let loops: Vec<u64> = (0..=polygons.len() as u64).collect();
    let mut starts = vec![0];
    polygons.iter().for_each(|own| starts.push(starts[starts.len() - 1] + own.len() as u64));
    mesh.set_facets(&loops, &starts, &polygons.concat(), None).unwrap();
    let (extent, criterion) = (Extent::Boundary, Criterion::RadiusEdge);
    mesh.run(&Options { extent, criterion, ..Options::default() }, None).unwrap();
    let case = Case { inputs: mesh.inputs().clone(), mesh: mesh.result().unwrap().clone() };
    let (facets, segments, regions) = Default::default();
    let mut solid = Solid { case, facets, segments, regions };
    solid.corrupt(|whole| {
        whole.parameters.extent = Extent::Hull;
        whole.boundary.subfacet_parents.fill(NONE);
    });
    solid
}

/// Returns the polygons of a prism over a polygon, whose points are there twice.
fn prism(count: u32) -> Vec<Vec<u32>> {
    let side = |at: u32| vec![at, (at + 1) % count, (at + 1) % count + count, at + count];
    let ends = [(0..count).rev().collect(), (count..2 * count).collect()];
    ends.into_iter().chain((0..count).map(side)).collect()
}

#[test]
fn a_hull_that_is_not_convex() {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let at = |z: f64| outline.map(|[x, y]| [x, y, z]);
    let corner = [&at(0.0)[..], &at(1.0)].concat();
    enclosed(&corner, &prism(6)).assert_violates(Kind::RegionVolume);
}

#[test]
fn a_hull_that_leaves_an_input_out() {
    let outline = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let at = |z: f64| outline.map(|[x, y]| [x, y, z]);
    let mut cube = [&at(0.0)[..], &at(1.0)].concat();
    cube.push([0.5; 3]);
    enclosed(&cube, &prism(4)).assert_sound(3);
    cube.push([1.5, 0.5, 0.5]);
    enclosed(&cube, &prism(4)).assert_violates(Kind::DomainPlace);
}

#[test]
fn a_subfacet_of_nobody_off_the_frame() {
    for extent in BOTH {
        let mut solid = framed(extent, &points(), true);
        solid.facets = Default::default();
        corrupted(&solid, Kind::FacetGroup, |whole| {
            // The triangle in the middle becomes one of the frame.
            let boundary = &mut whole.boundary;
            let own = boundary.subfacet_parents.iter().filter(|&&parent| parent == 0).count();
            boundary.subfacet_parents[..own].fill(NONE);
        });
    }
}

#[test]
fn an_edge_of_a_box_without_subsegments() {
    let solid = framed(Extent::Box, &points(), false);
    corrupted(&solid, Kind::SegmentChain, |whole| {
        whole.boundary.subsegments.remove(0);
        whole.boundary.parents.remove(0);
    });
}

/// Sides of a hull without a subsegment between them are one that is not plane.
#[test]
fn an_edge_of_a_hull_without_subsegments() {
    let solid = framed(Extent::Hull, &random_points::<3>(20, 8), false);
    corrupted(&solid, Kind::FacetPlane, |whole| {
        whole.boundary.subsegments.clear();
        whole.boundary.parents.clear();
    });
    let count = solid.clone().whole().boundary.subsegments.len();
    for at in (0..count).step_by(7) {
        corrupted(&solid, Kind::FacetPlane, |whole| {
            whole.boundary.subsegments.remove(at);
            whole.boundary.parents.remove(at);
        });
    }
}

#[test]
fn a_subsegment_of_nobody_off_the_frame() {
    for extent in BOTH {
        let solid = framed(extent, &points(), false);
        let mesh = solid.case.mesh.clone();
        let inputs = solid.case.inputs.distinct() as u32;
        let on: Vec<u32> = mesh.boundary.subfacets.as_flattened().to_vec();
        let mut edges = mesh
            .simplices
            .chunks_exact(4)
            .flat_map(|own| (0..4).flat_map(move |i| (0..i).map(move |j| [own[i], own[j]])));
        let inner = edges.find(|ends| ends.iter().all(|end| *end < inputs && !on.contains(end)));
        corrupted(&solid, Kind::SegmentLine, |whole| {
            whole.boundary.subsegments.push(inner.unwrap());
            whole.boundary.parents.push(NONE);
        });
    }
}
