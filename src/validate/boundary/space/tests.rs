//! Rules of which the arrays must be broken in ways that other rules see first.

use super::faces::Faces;
use super::reading::Reading;
use super::ways::Ways;
use super::{areas, given, tiling};
use crate::mesh::{Facets, Inputs, Mesh, Triangulation};
use crate::options::{Algorithm, Options};
use crate::quality::view::View;
use crate::validate::report::{Findings, ViolationKind};

/// Makes two cubes beside each other, with the square between them as a facet. No plane through
/// three vertices goes through the origin.
fn cubes() -> (Inputs, Triangulation) {
    let point = |i: u32| {
        let [x, y, z] = [i % 3, i / 3 % 2, i / 6].map(f64::from);
        [x + 5.25, y + 7.5, z + 11.125]
    };
    let points: Vec<[f64; 3]> = (0..12).map(point).collect();
    let mut mesh = Mesh::new(3, 12, points.as_flattened(), 0).unwrap();
    mesh.run(&Options { algorithm: Algorithm::Delaunay, ..Options::default() }, None).unwrap();
    let mut result = mesh.result().unwrap().clone();
    let is_between = |face: &[u32]| face.iter().all(|&vertex| points[vertex as usize][0] == 6.25);
    let on_left = |simplex: &[u32]| simplex.iter().any(|&v| points[v as usize][0] < 6.0);
    let boundary = &mut result.boundary;
    for simplex in result.simplices.chunks(4) {
        boundary.simplex_regions.push(i32::from(on_left(simplex)));
        let [a, b, c, d] = [0, 1, 2, 3].map(|slot| simplex[slot]);
        // Their normals point out of the simplex.
        for face in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
            if is_between(&face) && on_left(simplex) {
                boundary.subfacets.push(face);
                boundary.subfacet_parents.push(0);
            }
        }
    }
    assert_eq!(boundary.subfacets.len(), 2);
    (mesh.inputs().clone(), result)
}

#[test]
fn volumes_are_those_that_facets_enclose() {
    let (_, result) = cubes();
    let check = |result: &Triangulation| {
        let view = View::<3> { mesh: result };
        let mut findings = Findings::default();
        let walls = super::walls(view).unwrap();
        areas::check(view, &walls, result.simplex_count(), &mut findings).unwrap();
        findings.first.map(|first| first.kind)
    };
    assert_eq!(check(&result), None);
    for simplex in 0..result.simplex_count() {
        let mut relabelled = result.clone();
        relabelled.boundary.simplex_regions[simplex] = 4;
        assert_eq!(check(&relabelled), Some(ViolationKind::RegionVolume), "{simplex}");
    }
}

#[test]
fn areas_are_those_of_facets() {
    let (inputs, result) = cubes();
    let view = View::<3> { mesh: &result };
    let square = Facets {
        loop_starts: vec![0, 1],
        input_starts: vec![0, 4],
        inputs: vec![1, 4, 10, 7],
        markers: vec![0],
        are_triangles: false,
    };
    let facet = given::polygon(&inputs, &square, 0).unwrap().unwrap();
    let faces = Faces::new(view).unwrap();
    let reading = Reading::as_given(&inputs, None, view, &faces).unwrap();
    let ways = Ways::new(&inputs, view, &faces, &reading).unwrap();
    let check = |subfacets: &[[u32; 3]]| {
        let mut findings = Findings::default();
        tiling::check_area(&facet, &ways, subfacets, false, &mut findings);
        findings.first.map(|first| first.kind)
    };
    let subfacets = &result.boundary.subfacets[..];
    assert_eq!(check(subfacets), None);
    assert_eq!(check(&subfacets[..1]), Some(ViolationKind::FacetArea));
    assert_eq!(check(&[subfacets, subfacets].concat()), Some(ViolationKind::FacetArea));
}

/// Holds that a rim has the facet on the side that the loops say, and that edges which loops have
/// twice are within.
#[test]
fn rims_have_the_facet_on_their_left() {
    let point = |i: u32| [f64::from(i % 4), f64::from(i / 4), 3.0];
    let points: Vec<[f64; 3]> = (0..16).map(point).collect();
    let inputs = Inputs::new(3, 16, points.as_flattened(), 0).unwrap();
    let facet = |loops: &[&[u32]]| {
        let starts = loops.iter().scan(0, |sum, corners| {
            *sum += corners.len() as u32;
            Some(*sum)
        });
        let facets = Facets {
            loop_starts: vec![0, loops.len() as u32],
            input_starts: [0].into_iter().chain(starts).collect(),
            inputs: loops.concat(),
            markers: vec![0],
            are_triangles: false,
        };
        given::polygon(&inputs, &facets, 0).unwrap()
    };
    let sorted = |mut edges: Vec<[u32; 2]>| {
        edges.sort_unstable();
        edges
    };
    let outer = [0, 3, 15, 12];
    // The hole runs about as the outer loop does.
    let ring = facet(&[&outer, &[5, 6, 10, 9]]).unwrap();
    assert!(ring.normal[2] > 0.0);
    let expected = [[0, 3], [3, 15], [15, 12], [12, 0], [6, 5], [10, 6], [9, 10], [5, 9]];
    assert_eq!(sorted(ring.rim), sorted(expected.to_vec()));
    // A hole first, which turns to the right.
    let turned = facet(&[&[5, 9, 10, 6], &outer, &[2, 7], &[1]]).unwrap();
    assert!(turned.normal[2] < 0.0);
    let reversed = expected.map(|[a, b]| [b, a]);
    assert_eq!(sorted(turned.rim), sorted(reversed.to_vec()));
    assert_eq!((turned.within, turned.points), (vec![[2, 7]], vec![1]));
    // A loop that goes to its hole and back.
    let slit = facet(&[&[0, 3, 15, 12, 0, 5, 9, 10, 6, 5]]).unwrap();
    assert_eq!(sorted(slit.rim), sorted(expected.to_vec()));
    assert_eq!(slit.within, [[0, 5]]);
    assert!(facet(&[&[0, 1, 2]]).is_none());
}

#[test]
fn edges_have_a_triangle_on_each_side() {
    let check = |triangles: &[[u32; 3]]| {
        let mut findings = Findings::default();
        let edges = tiling::sorted_edges(triangles).unwrap();
        let rim = tiling::rim(0, &edges, &mut findings).unwrap();
        (rim.len(), findings.first.map(|first| first.kind))
    };
    assert_eq!(check(&[[0, 1, 2], [2, 1, 3]]), (4, None));
    assert_eq!(check(&[[0, 1, 2], [1, 2, 3]]), (4, Some(ViolationKind::FacetTiling)));
    let three = [[0, 1, 2], [2, 1, 3], [2, 1, 4]];
    assert_eq!(check(&three), (6, Some(ViolationKind::FacetTiling)));
}
