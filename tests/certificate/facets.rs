//! Corruptions of facets in space.

use super::shapes::{at, boxes, cube, grid, sheet, triangulated_cube, turned_cube};
use super::solids::{Solid, facets_of};
use netmesh::mesh::Boxed;
use netmesh::validate::{ViolationKind as Kind, validate};
use netmesh::{NONE, Triangulation};

#[test]
fn solids_hold() {
    cube().assert_sound(3);
    boxes().assert_sound(3);
    triangulated_cube().assert_sound(3);
    let turned = turned_cube(4);
    assert!(!turned.clone().whole().boundary.flat.is_empty());
    turned.assert_sound(3);
}

pub fn corrupted(solid: &Solid, kind: Kind, corrupt: impl FnOnce(&mut Triangulation)) {
    let mut solid = solid.clone();
    solid.corrupt(corrupt);
    solid.assert_violates(kind);
}

/// Does as [`corrupted`], with the simplices of the subfacets as they are then.
fn refaced(solid: &Solid, kind: Kind, corrupt: impl FnOnce(&mut Triangulation)) {
    let mut solid = solid.clone();
    solid.corrupt(corrupt);
    solid.find_sides();
    solid.assert_violates(kind);
}

pub fn remove_subfacet(mesh: &mut Triangulation, at: usize) {
    mesh.boundary.subfacets.remove(at);
    mesh.boundary.subfacet_parents.remove(at);
    mesh.boundary.subfacet_simplices.remove(at);
}

fn remove_subsegment(mesh: &mut Triangulation, at: usize) {
    mesh.boundary.subsegments.remove(at);
    mesh.boundary.parents.remove(at);
}

#[test]
fn arrays_that_do_not_fit() {
    let corruptions: [fn(&mut Triangulation); 13] = [
        |mesh| _ = mesh.boundary.subfacet_parents.pop(),
        |mesh| _ = mesh.boundary.subfacet_simplices.pop(),
        |mesh| _ = mesh.boundary.simplex_regions.pop(),
        |mesh| mesh.boundary.subfacet_parents[1] = 9,
        |mesh| mesh.boundary.subfacet_parents[0] = 1,
        |mesh| *mesh.boundary.subfacet_parents.last_mut().unwrap() = NONE,
        |mesh| mesh.boundary.subfacets[2][1] = mesh.vertex_count() as u32,
        |mesh| mesh.boundary.subfacets[2][1] = mesh.boundary.subfacets[2][2],
        |mesh| mesh.boundary.parents[0] = 0,
        |mesh| mesh.boundary.flat = vec![2, 1],
        |mesh| mesh.boundary.flat = vec![mesh.simplex_count() as u32],
        |mesh| mesh.boundary.forced = vec![1, 1],
        |mesh| mesh.boundary.subsegments[5][1] = mesh.vertex_count() as u32,
    ];
    for corrupt in corruptions {
        let mut solid = cube();
        corrupt(&mut solid.case.mesh);
        solid.assert_violates(Kind::BoundaryArrays);
    }
    let mut twice = boxes();
    let whole = twice.whole();
    whole.boundary.whole = Some(Boxed::new(whole.clone()).unwrap());
    twice.assert_violates(Kind::BoundaryArrays);
    // Without facets no simplex is flat or forced, and none has a label.
    let bare = |corrupt: fn(&mut Triangulation)| {
        let mut solid = cube();
        solid.case.mesh.boundary = Default::default();
        corrupt(&mut solid.case.mesh);
        let first = validate(&solid.case.inputs, &solid.case.mesh, 3).unwrap().first;
        first.map(|first| first.kind)
    };
    assert_eq!(bare(|_| ()), None);
    assert_eq!(bare(|mesh| mesh.boundary.flat = vec![0]), Some(Kind::BoundaryArrays));
    assert_eq!(bare(|mesh| mesh.boundary.forced = vec![0]), Some(Kind::BoundaryArrays));
    assert_eq!(bare(|mesh| mesh.boundary.simplex_regions = vec![0]), Some(Kind::BoundaryArrays));
}

#[test]
fn facets_out_of_space() {
    let points = super::meshes::random_points::<2>(9, 3);
    let mut case = super::meshes::run(&points, &Default::default());
    case.mesh.boundary.subfacets = vec![[0, 1, 2]];
    case.mesh.boundary.subfacet_parents = vec![0];
    case.mesh.boundary.subfacet_simplices = vec![[0, 1]];
    case.mesh.boundary.simplex_regions = vec![0; case.mesh.simplex_count()];
    super::assert_violates(&case, Kind::BoundaryArrays);
}

#[test]
fn subfacets_with_other_simplices() {
    let solid = boxes();
    let kind = Kind::SubfacetSimplices;
    for at in (0..solid.clone().whole().boundary.subfacets.len()).step_by(17) {
        corrupted(&solid, kind, |mesh| mesh.boundary.subfacet_simplices[at].reverse());
        corrupted(&solid, kind, |mesh| mesh.boundary.subfacet_simplices[at][0] ^= 1);
    }
    corrupted(&solid, kind, |mesh| mesh.boundary.subfacet_simplices[7][1] = NONE);
    corrupted(&solid, kind, |mesh| mesh.boundary.subfacets[7].swap(0, 1));
    corrupted(&solid, kind, |mesh| {
        let boundary = &mut mesh.boundary;
        boundary.subfacets.insert(1, boundary.subfacets[0]);
        boundary.subfacet_parents.insert(1, boundary.subfacet_parents[0]);
        boundary.subfacet_simplices.insert(1, boundary.subfacet_simplices[0]);
    });
}

#[test]
fn domains_that_are_no_part_of_the_whole() {
    let corruptions: [fn(&mut Triangulation); 9] = [
        |mesh| _ = mesh.boundary.subsegments.pop(),
        |mesh| _ = mesh.boundary.parents.pop(),
        |mesh| mesh.boundary.parents[1] = 1,
        |mesh| _ = mesh.boundary.subfacets.pop(),
        |mesh| _ = mesh.boundary.subfacet_parents.pop(),
        |mesh| _ = mesh.boundary.subfacet_simplices.pop(),
        |mesh| mesh.boundary.subfacet_parents[1] = 1,
        |mesh| mesh.boundary.subfacet_simplices[0] = [5, 6],
        |mesh| mesh.boundary.flat.push(0),
    ];
    for (number, corrupt) in corruptions.into_iter().enumerate() {
        let mut solid = boxes();
        corrupt(&mut solid.case.mesh);
        let first = solid.report(3).first.unwrap();
        assert_eq!(first.kind, Kind::DomainArrays, "{number}");
    }
    // Where the whole has no boundary the domain has none.
    let mut bare = boxes();
    let ends = bare.case.mesh.boundary.subsegments[0];
    bare.corrupt(|mesh| mesh.boundary = Default::default());
    bare.case.mesh.boundary.subsegments = vec![ends];
    bare.assert_violates(Kind::DomainArrays);
    // What is outside may not be there.
    let mut solid = boxes();
    let whole = solid.whole().boundary.clone();
    let at = whole.subfacet_parents.iter().position(|&parent| parent == 8).unwrap();
    let own = &mut solid.case.mesh.boundary;
    own.subfacets.push(whole.subfacets[at]);
    own.subfacet_parents.push(8);
    own.subfacet_simplices.push([NONE; 2]);
    solid.assert_violates(Kind::DomainArrays);
}

#[test]
fn a_subfacet_that_is_no_face() {
    // The other diagonal of a side.
    refaced(&cube(), Kind::SubfacetFace, |mesh| {
        let [one, other] = [mesh.boundary.subfacets[0], mesh.boundary.subfacets[1]];
        let apex = *other.iter().find(|vertex| !one.contains(vertex)).unwrap();
        let own = one.iter().position(|vertex| !other.contains(vertex)).unwrap();
        let [a, b, c] = [0, 1, 2].map(|step| one[(own + step) % 3]);
        mesh.boundary.subfacets[0] = [a, b, apex];
        mesh.boundary.subfacets[1] = [a, apex, c];
    });
}

#[test]
fn a_subsegment_that_is_no_edge() {
    let solid = boxes();
    // The first segment has two pieces.
    corrupted(&solid, Kind::SubsegmentEdge, |mesh| {
        mesh.boundary.subsegments[0][1] = mesh.boundary.subsegments[1][1];
        remove_subsegment(mesh, 1);
    });
    corrupted(&cube(), Kind::SubsegmentEdge, |mesh| {
        mesh.boundary.subsegments.insert(0, mesh.boundary.subsegments[0]);
        mesh.boundary.parents.insert(0, NONE);
    });
}

#[test]
fn chains_that_are_none() {
    let solid = boxes();
    let count = solid.clone().whole().boundary.subsegments.len();
    for at in (0..count).step_by(5) {
        corrupted(&solid, Kind::SegmentChain, |mesh| remove_subsegment(mesh, at));
    }
    corrupted(&solid, Kind::SegmentChain, |mesh| mesh.boundary.subsegments[0].reverse());
    corrupted(&solid, Kind::SegmentChain, |mesh| mesh.boundary.subsegments.swap(0, 1));
    // A piece of the second segment that is given to the first.
    corrupted(&solid, Kind::SegmentChain, |mesh| mesh.boundary.parents[2] = 0);
}

#[test]
fn subsegments_that_are_on_nothing() {
    let solid = boxes();
    let points = grid([6, 5, 5]);
    corrupted(&solid, Kind::SegmentLine, |mesh| {
        let edge = [at(&points, [5.0, 4.0, 4.0]), at(&points, [4.0, 4.0, 4.0])];
        mesh.boundary.subsegments.push(edge);
        mesh.boundary.parents.push(NONE);
    });
    // A segment's piece that is said to be an edge of a facet only, which is found elsewhere, too.
    corrupted(&solid, Kind::SegmentChain, |mesh| {
        let first = mesh.boundary.subsegments.remove(0);
        mesh.boundary.parents.remove(0);
        mesh.boundary.subsegments.push(first);
        mesh.boundary.parents.push(NONE);
    });
}

#[test]
fn a_subfacet_turned_round() {
    for solid in [cube(), triangulated_cube(), boxes()] {
        refaced(&solid, Kind::FacetTriangle, |mesh| mesh.boundary.subfacets[2].swap(0, 1));
    }
    // A side that the caller gave the other way round.
    let mut solid = cube();
    solid.facets.inputs[4..8].reverse();
    solid.assert_violates(Kind::FacetTriangle);
}

#[test]
fn facets_that_are_not_tiled() {
    for solid in [cube(), triangulated_cube(), boxes()] {
        for at in (0..solid.clone().whole().boundary.subfacets.len()).step_by(7) {
            corrupted(&solid, Kind::FacetTiling, |mesh| remove_subfacet(mesh, at));
        }
    }
    // Of another facet, in the same plane or not.
    let solid = boxes();
    let parents = solid.clone().whole().boundary.subfacet_parents.clone();
    for (at, _) in parents.windows(2).enumerate().filter(|(_, pair)| pair[0] < pair[1]) {
        let report = {
            let mut solid = solid.clone();
            solid.corrupt(|mesh| mesh.boundary.subfacet_parents[at] += 1);
            solid.report(2)
        };
        let kind = report.first.unwrap().kind;
        assert!(matches!(kind, Kind::FacetTiling | Kind::FacetTriangle), "{at}: {kind:?}");
    }
    // A hole that the caller did not give, and one that the mesh does not have.
    let mut filled = solid.clone();
    let loops = filled.facets.loop_starts[8] as usize;
    let corners = filled.facets.input_starts[loops + 1] as usize
        ..filled.facets.input_starts[loops + 2] as usize;
    let hole = filled.facets.inputs[corners].to_vec();
    let mut all: Vec<Vec<Vec<u32>>> =
        (0..9).map(|facet| solid.facets.loops(facet).map(<[u32]>::to_vec).collect()).collect();
    all[8].remove(1);
    filled.facets = facets_of(&all, false);
    assert_eq!(filled.report(2).first.unwrap().kind, Kind::FacetTiling);
    all[8].insert(1, hole);
    filled.facets = facets_of(&all, false);
    filled.assert_sound(2);
    // A vertex and a segment that are not on a facet, and would be within it.
    let points = grid([6, 5, 5]);
    let near = [[3.0, 2.0, 2.0], [3.0, 1.0, 2.0]].map(|point| at(&points, point));
    for within in [near[..1].to_vec(), near.to_vec()] {
        let mut more = all.clone();
        more[6].push(within);
        filled.facets = facets_of(&more, false);
        filled.assert_violates(Kind::FacetTiling);
    }
}

fn moved(solid: &Solid, vertex: usize, axis: usize, x: f64) -> Solid {
    let mut solid = solid.clone();
    solid.case.mesh.points[3 * vertex + axis] = x;
    solid
}

#[test]
fn vertices_off_their_facet() {
    let solid = sheet();
    solid.assert_sound(2);
    let inner = solid.case.mesh.vertex_count() - 1;
    let up = 1f64.next_up();
    for (height, is_near) in [
        (up, true),
        (up.next_up(), false),
        (1f64.next_down().next_down(), true),
        (1f64.next_down().next_down().next_down(), false),
    ] {
        let moved = moved(&solid, inner, 2, height);
        if is_near {
            moved.assert_sound(2);
        } else {
            moved.assert_violates(Kind::FacetPlane);
        }
    }
    // An input that is near a facet may be as far from it as one near a segment.
    let mut near = moved(&solid, inner, 2, 1.0 + 15.0 * f64::EPSILON);
    let points = &near.case.mesh.points;
    near.case.inputs = netmesh::Inputs::new(3, points.len() / 3, points, 0).unwrap();
    near.assert_sound(2);
    near.case.mesh.points[3 * inner + 2] = 1.0 + 18.0 * f64::EPSILON;
    near.assert_violates(Kind::FacetPlane);
}

#[test]
fn vertices_off_their_line() {
    let solid = sheet();
    let on_edge = solid.case.inputs.distinct();
    assert_eq!(solid.case.mesh.point(on_edge as u32), [1.0, 0.0, 1.0]);
    moved(&solid, on_edge, 1, 1e-300).assert_violates(Kind::SegmentChain);
    moved(&solid, on_edge, 2, 1f64.next_up()).assert_violates(Kind::SegmentLine);
    moved(&solid, on_edge, 0, 1f64.next_up()).assert_sound(2);
}

#[test]
fn triangles_that_are_no_facet() {
    let solid = triangulated_cube();
    // Of two markers.
    let mut marked = solid.clone();
    marked.facets.markers[4] = 1;
    marked.assert_violates(Kind::FacetGroup);
    // Not the first.
    corrupted(&solid, Kind::FacetGroup, |mesh| {
        let parents = &mut mesh.boundary.subfacet_parents;
        parents.iter_mut().filter(|parent| **parent == 6).for_each(|parent| *parent = 7);
    });
    // Sides of the cube without an edge between them.
    for at in (0..12).step_by(5) {
        corrupted(&solid, Kind::FacetGroup, |mesh| remove_subsegment(mesh, at));
    }
    // In the direction of its neighbour.
    let mut turned = solid.clone();
    turned.facets.inputs[3..6].reverse();
    turned.assert_violates(Kind::FacetGroup);
}

/// Holds that a segment's own chain is refused where it is far from the segment.
#[test]
fn a_chain_that_leads_away_from_its_segment() {
    let points = grid([6, 5, 5]);
    let mut solid = boxes();
    let [corner, end] = [[4.0, 2.0, 3.0], [4.0, 2.0, 2.0]].map(|point| at(&points, point));
    solid.segments.inputs[0][1] = end;
    solid.corrupt(|mesh| {
        mesh.boundary.subsegments.insert(2, [corner, end]);
        mesh.boundary.parents.insert(2, 0);
    });
    solid.assert_violates(Kind::SegmentLine);
}

/// Holds that less is asked without the caller's facets, but that facets end at subsegments is.
#[test]
fn facets_of_which_nothing_is_known_end_at_subsegments() {
    let solid = cube();
    let report = |solid: &Solid| validate(&solid.case.inputs, &solid.case.mesh, 3).unwrap();
    assert_eq!(report(&solid).first, None);
    let mut less = solid.clone();
    less.corrupt(|mesh| remove_subfacet(mesh, 4));
    assert_eq!(report(&less).first.unwrap().kind, Kind::FacetTiling);
    let mut fewer = solid.clone();
    fewer.corrupt(|mesh| remove_subsegment(mesh, 4));
    assert_eq!(report(&fewer).first.unwrap().kind, Kind::FacetTiling);
}

#[test]
fn facets_that_cannot_be() {
    for solid in [cube(), triangulated_cube()] {
        let mut unknown = solid.clone();
        unknown.facets.inputs[1] = 99;
        unknown.assert_violates(Kind::FacetGroup);
        // All of its corners are one input.
        let mut flat = solid.clone();
        let corners = if solid.facets.are_triangles { 0..3 } else { 0..4 };
        flat.facets.inputs[corners].fill(0);
        assert!(flat.report(2).violations > 0);
    }
    let mut flat = cube();
    flat.facets.inputs[..4].fill(0);
    flat.assert_violates(Kind::FacetGroup);
}
