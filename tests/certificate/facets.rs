//! Corruptions of facets in space, of regions between them and of the domain that they enclose.

use super::solids::{Plan, Solid};
use netmesh::mesh::Boxed;
use netmesh::options::{Extent, Interior};
use netmesh::validate::{ViolationKind as Kind, validate};
use netmesh::{NONE, Region, Triangulation};

type Point = [f64; 3];

/// Returns the points of a grid of whole numbers.
fn grid([x, y, z]: [usize; 3]) -> Vec<Point> {
    let point = |i: usize| [i % x, i / x % y, i / x / y].map(|k| k as f64);
    (0..x * y * z).map(point).collect()
}

/// Returns the vertex of a point.
fn at(points: &[Point], point: Point) -> u32 {
    points.iter().position(|p| *p == point).unwrap_or_else(|| panic!("{point:?}")) as u32
}

/// Returns the six sides of a box, with normals that point out of it.
fn sides(points: &[Point], low: Point, high: Point) -> Vec<Vec<Vec<u32>>> {
    let corner = |i: usize| {
        at(points, std::array::from_fn(|k| if i >> k & 1 == 1 { high[k] } else { low[k] }))
    };
    let sides =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.iter().map(|side| vec![side.map(corner).to_vec()]).collect()
}

fn everywhere(_: Point) -> Option<i32> {
    Some(0)
}

fn within(low: Point, high: Point, p: Point) -> bool {
    (0..3).all(|k| low[k] < p[k] && p[k] < high[k])
}

fn cube() -> Solid {
    let points = grid([2, 2, 2]);
    let facets = sides(&points, [0.0; 3], [1.0; 3]);
    Plan { inputs: 8, points, facets, ..Plan::default() }.build(everywhere)
}

/// The surface of a cube as twelve triangles.
fn triangulated_cube() -> Solid {
    let points = grid([2, 2, 2]);
    let quads = sides(&points, [0.0; 3], [1.0; 3]);
    let halves = |side: &Vec<Vec<u32>>| {
        let [a, b, c, d]: [u32; 4] = side[0][..].try_into().unwrap();
        [vec![vec![a, b, c]], vec![vec![a, c, d]]]
    };
    // The diagonals that the mesh does not have, as likely as not.
    let facets: Vec<Vec<Vec<u32>>> = quads.iter().flat_map(halves).collect();
    let plan = Plan { inputs: 8, points, facets: quads, ..Plan::default() };
    let mut solid = plan.build(everywhere);
    solid.facets = super::solids::facets_of(&facets, true);
    for parent in &mut solid.case.mesh.boundary.subfacet_parents {
        *parent *= 2;
    }
    solid
}

/// A grid of 5 x 4 x 4 cubes, of which 3 x 2 x 2 in the middle are the domain: two boxes that share
/// a facet, with labels, a facet with a hole, another that hangs from a side, and a segment.
pub fn boxes() -> Solid {
    let points = grid([6, 5, 5]);
    let v = |x: f64, y: f64, z: f64| at(&points, [x, y, z]);
    let (low, high) = ([1.0; 3], [4.0, 3.0, 3.0]);
    let mut facets = sides(&points, low, high);
    let square = |x: f64, a: f64, b: f64| vec![v(x, a, a), v(x, b, a), v(x, b, b), v(x, a, b)];
    // Where both boxes meet, with edges on the sides.
    facets.push(vec![square(2.0, 1.0, 3.0)]);
    facets.push(vec![vec![v(3.0, 1.0, 1.0), v(3.0, 2.0, 1.0), v(3.0, 2.0, 2.0), v(3.0, 1.0, 2.0)]]);
    // Outside, with a hole; and with a vertex and a segment within.
    facets.push(vec![
        square(5.0, 0.0, 4.0),
        square(5.0, 1.0, 3.0),
        vec![v(5.0, 0.0, 2.0), v(5.0, 1.0, 2.0)],
    ]);
    facets[8].push(vec![v(5.0, 4.0, 2.0)]);
    split_sides(&points, &mut facets);
    let segments = vec![[v(2.0, 2.0, 3.0), v(4.0, 2.0, 3.0)], [v(3.0, 2.0, 2.0), v(4.0, 2.0, 2.0)]];
    facets[1].push(vec![v(2.0, 2.0, 3.0), v(4.0, 2.0, 3.0)]);
    let seed = |x: f64, label: i32| Region { seed: [x, 1.5, 2.5], label, ..Region::default() };
    let regions = vec![seed(1.5, 7), seed(3.5, -2)];
    let inputs = points.len();
    let plan = Plan { points, inputs, facets, segments, regions, ..Plan::default() };
    plan.build(|p| within(low, high, p).then_some(if p[0] < 2.0 { 7 } else { -2 }))
}

/// Adds what other facets have of the sides to them: segments within.
fn split_sides(points: &[Point], facets: &mut [Vec<Vec<u32>>]) {
    let v = |x: f64, y: f64, z: f64| at(points, [x, y, z]);
    // z = 1, z = 3, y = 1, y = 3 for the plane x = 2; then z = 1 and y = 1 for x = 3.
    facets[0].push(vec![v(2.0, 1.0, 1.0), v(2.0, 3.0, 1.0)]);
    facets[1].push(vec![v(2.0, 1.0, 3.0), v(2.0, 3.0, 3.0)]);
    facets[2].push(vec![v(2.0, 1.0, 1.0), v(2.0, 1.0, 3.0)]);
    facets[3].push(vec![v(2.0, 3.0, 1.0), v(2.0, 3.0, 3.0)]);
    facets[0].push(vec![v(3.0, 1.0, 1.0), v(3.0, 2.0, 1.0)]);
    facets[2].push(vec![v(3.0, 1.0, 1.0), v(3.0, 1.0, 2.0)]);
}

#[test]
fn solids_hold() {
    cube().assert_sound(3);
    boxes().assert_sound(3);
    triangulated_cube().assert_sound(3);
}

fn corrupted(solid: &Solid, kind: Kind, corrupt: impl FnOnce(&mut Triangulation)) {
    let mut solid = solid.clone();
    solid.corrupt(corrupt);
    solid.assert_violates(kind);
}

/// As [`corrupted`], with the simplices of the subfacets as they are then.
fn refaced(solid: &Solid, kind: Kind, corrupt: impl FnOnce(&mut Triangulation)) {
    let mut solid = solid.clone();
    solid.corrupt(corrupt);
    solid.find_sides();
    solid.assert_violates(kind);
}

fn remove_subfacet(mesh: &mut Triangulation, at: usize) {
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
        |mesh| drop(mesh.boundary.subfacet_parents.pop()),
        |mesh| drop(mesh.boundary.subfacet_simplices.pop()),
        |mesh| drop(mesh.boundary.simplex_regions.pop()),
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
    for at in 0..solid.clone().whole().boundary.subfacets.len() {
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
        |mesh| drop(mesh.boundary.subsegments.pop()),
        |mesh| drop(mesh.boundary.parents.pop()),
        |mesh| mesh.boundary.parents[1] = 1,
        |mesh| drop(mesh.boundary.subfacets.pop()),
        |mesh| drop(mesh.boundary.subfacet_parents.pop()),
        |mesh| drop(mesh.boundary.subfacet_simplices.pop()),
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
    for at in 0..count {
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
        for at in 0..solid.clone().whole().boundary.subfacets.len() {
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
    filled.facets = super::solids::facets_of(&all, false);
    assert_eq!(filled.report(2).first.unwrap().kind, Kind::FacetTiling);
    all[8].insert(1, hole);
    filled.facets = super::solids::facets_of(&all, false);
    filled.assert_sound(2);
    // A vertex and a segment that are not on a facet, and would be within it.
    let points = grid([6, 5, 5]);
    let near = [[3.0, 2.0, 2.0], [3.0, 1.0, 2.0]].map(|point| at(&points, point));
    for within in [near[..1].to_vec(), near.to_vec()] {
        let mut more = all.clone();
        more[6].push(within);
        filled.facets = super::solids::facets_of(&more, false);
        filled.assert_violates(Kind::FacetTiling);
    }
}

/// A square at the height 1 with vertices in it and on its edges that are no inputs, and vertices
/// off it in pairs that mirror each other.
pub fn sheet() -> Solid {
    let mut random = crate::random::Random::new(5);
    let mut points = vec![[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [4.0, 4.0, 1.0], [0.0, 4.0, 1.0]];
    for _ in 0..20 {
        let [x, y, h] =
            [random.unit() * 10.0 - 3.0, random.unit() * 10.0 - 3.0, 2.0 + random.unit()];
        points.extend([[x, y, 1.0 + h], [x, y, 1.0 - h]]);
    }
    let inputs = points.len();
    for i in [1.0, 2.0, 3.0] {
        points.extend([[i, 0.0, 1.0], [4.0, i, 1.0], [i, 4.0, 1.0], [0.0, i, 1.0]]);
        for j in [1.0, 2.0, 3.0] {
            points.push([i + 0.3 * random.unit(), j + 0.3 * random.unit(), 1.0]);
        }
    }
    let facets = vec![vec![vec![0, 1, 2, 3]]];
    Plan { points, inputs, facets, ..Plan::default() }.build(everywhere)
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
    for at in 0..12 {
        corrupted(&solid, Kind::FacetGroup, |mesh| remove_subsegment(mesh, at));
    }
    // In the direction of its neighbour.
    let mut turned = solid.clone();
    turned.facets.inputs[3..6].reverse();
    turned.assert_violates(Kind::FacetGroup);
}

#[test]
fn labels_that_are_not_their_regions() {
    let solid = boxes();
    for simplex in (0..solid.clone().whole().simplex_count()).step_by(7) {
        corrupted(&solid, Kind::RegionLabel, |mesh| mesh.boundary.simplex_regions[simplex] += 1);
    }
    corrupted(&solid, Kind::RegionLabel, |mesh| {
        let labels = mesh.boundary.simplex_regions.iter_mut();
        labels.filter(|label| **label == 7).for_each(|label| *label = 8);
    });
    let mut twice = solid.clone();
    twice.regions.push(Region { seed: [1.2, 2.4, 1.3], label: 7, ..Region::default() });
    twice.assert_violates(Kind::RegionLabel);
    let mut outside = solid.clone();
    outside.regions.push(Region { seed: [0.5, 0.5, 0.5], ..Region::default() });
    outside.assert_violates(Kind::RegionLabel);
}

#[test]
fn domains_that_are_not_what_facets_enclose() {
    let solid = boxes();
    let count = solid.case.mesh.simplex_count();
    for count in [count - 1, count + 1] {
        let mut other = solid.clone();
        other.crop(count);
        other.assert_violates(Kind::DomainEnd);
    }
    let mut all = solid.clone();
    let whole = all.whole().simplex_count();
    all.crop(whole);
    all.assert_violates(Kind::DomainPlace);
    let mut hole = solid.clone();
    hole.regions[0].is_hole = true;
    hole.assert_violates(Kind::DomainPlace);
    let mut extent = solid.clone();
    extent.corrupt(|mesh| mesh.parameters.extent = Extent::All);
    extent.assert_violates(Kind::DomainPlace);
}

/// A box in a box, of a grid; the domain is between them, as surfaces count.
fn shell(is_inner_reversed: bool) -> Solid {
    let points = grid([6, 6, 6]);
    let mut facets = sides(&points, [0.0; 3], [5.0; 3]);
    let mut inner = sides(&points, [2.0; 3], [3.0; 3]);
    if is_inner_reversed {
        inner.iter_mut().for_each(|facet| facet[0].reverse());
    }
    facets.extend(inner);
    let plan = Plan { inputs: points.len(), points, facets, ..Plan::default() };
    let is_inside = |p| is_inner_reversed && within([2.0; 3], [3.0; 3], p);
    plan.build(|p| (!is_inside(p)).then_some(0))
}

#[test]
fn surfaces_tell_what_is_inside() {
    for interior in [Interior::Winding, Interior::Parity] {
        let mut solid = shell(true);
        solid.corrupt(|mesh| mesh.parameters.interior = interior);
        solid.assert_sound(3);
        let mut filled = shell(false);
        filled.corrupt(|mesh| mesh.parameters.interior = interior);
        match interior {
            Interior::Winding => filled.assert_sound(3),
            _ => filled.assert_violates(Kind::DomainPlace),
        }
        // A side is missing.
        let mut open = shell(true);
        open.corrupt(|mesh| {
            mesh.parameters.interior = interior;
            while mesh.boundary.subfacet_parents.last() == Some(&11) {
                let last = mesh.boundary.subfacets.len() - 1;
                remove_subfacet(mesh, last);
            }
        });
        let first = open.report(3).first.unwrap();
        assert_eq!(first.kind, Kind::FacetTiling);
        open.facets.markers.pop();
        open.facets.loop_starts.pop();
        open.assert_violates(Kind::DomainEnd);
    }
    // A side that points the other way.
    let mut turned = shell(true);
    turned.facets.inputs[0..4].reverse();
    turned.corrupt(|mesh| {
        mesh.parameters.interior = Interior::Winding;
        let own = mesh.boundary.subfacet_parents.iter().take_while(|&&parent| parent == 0).count();
        mesh.boundary.subfacets[..own].iter_mut().for_each(|vertices| vertices.swap(0, 1));
    });
    turned.find_sides();
    turned.assert_violates(Kind::DomainPlace);
}

#[test]
fn flat_simplices_that_are_not() {
    corrupted(&cube(), Kind::FlatSimplex, |mesh| mesh.boundary.flat = vec![1]);
    corrupted(&boxes(), Kind::FlatSimplex, |mesh| mesh.boundary.flat = vec![0, 3]);
}

/// A prism over a triangle with an angle of some degrees, and simplices that are forced.
fn wedge(degrees: f64, forced: &[u32]) -> Solid {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let base = [[0.0, 0.0], [1.0, 0.0], [cosine, sine]];
    let points: Vec<Point> =
        [0.0, 1.0].iter().flat_map(|&z| base.map(|[x, y]| [x, y, z])).collect();
    let facets = vec![
        vec![vec![0, 2, 1]],
        vec![vec![3, 4, 5]],
        vec![vec![0, 1, 4, 3]],
        vec![vec![1, 2, 5, 4]],
        vec![vec![2, 0, 3, 5]],
    ];
    let mut solid = Plan { inputs: 6, points, facets, ..Plan::default() }.build(everywhere);
    solid.corrupt(|mesh| mesh.boundary.forced = forced.to_vec());
    solid.corrupt(|mesh| mesh.parameters.quality_bound = 0.62);
    solid
}

#[test]
fn forced_simplices_lie_at_small_angles() {
    wedge(20.0, &[]).assert_sound(3);
    for simplex in 0..3 {
        wedge(20.0, &[simplex]).assert_sound(3);
        let mut within_bound = wedge(20.0, &[simplex]);
        within_bound.corrupt(|mesh| mesh.parameters.quality_bound = 1e9);
        within_bound.assert_violates(Kind::ForcedSimplex);
    }
    let mut solid = cube();
    solid.corrupt(|mesh| {
        mesh.parameters.quality_bound = 0.62;
        mesh.boundary.forced = vec![0];
    });
    solid.assert_violates(Kind::ForcedSimplex);
}

/// Without the caller's facets less is asked, but that facets end at subsegments is.
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
