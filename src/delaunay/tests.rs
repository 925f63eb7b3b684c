//! Insertion compared with brute force: after every set of insertions each D-ball is empty of all
//! points (by exact signs), adjacency is closed, and every distinct point is a vertex.

use super::{Cavity, Delaunay};
use crate::complex::{SimplexId, VertexId};
use crate::memory::{AllocError, Array};
use crate::numerics::testing::Random;
use crate::numerics::{Sign, affine_basis, in_ball, norm, orientation};
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Inserts all points in their order, except those that coincide with a vertex.
fn triangulate<const D: usize>(points: &[[f64; D]]) -> Option<Delaunay<D>> {
    let basis = affine_basis::<D>(points.len(), |i| points[i]);
    if basis.len() < D + 1 {
        return None;
    }
    let mut delaunay = Delaunay::new(Array::copied(points).unwrap()).unwrap();
    let vertices: Vec<_> = basis.iter().copied().map(VertexId::new).collect();
    delaunay.begin(&vertices).unwrap();
    let (mut cavity, mut created) = (Cavity::default(), Vec::new());
    let mut near = delaunay.complex().incident(vertices[0]);
    let mut destroyed = 0;
    for vertex in VertexId::below(points.len()) {
        if delaunay.complex().contains_vertex(vertex) {
            continue;
        }
        if let Some(start) = delaunay.locate(near, &points[vertex]) {
            delaunay.find_cavity(start, &points[vertex], &mut cavity).unwrap();
            assert_corners(&delaunay, &cavity);
            delaunay.insert(vertex, &cavity, &mut created).unwrap();
            destroyed += cavity.simplices.len();
            near = created[0];
        }
    }
    let live = delaunay.complex().simplex_count();
    assert_eq!(delaunay.simplices_created(), (live + destroyed) as u64);
    Some(delaunay)
}

/// Asserts that the cavity's vertices are the finite vertices of its simplices, each once.
fn assert_corners<const D: usize>(delaunay: &Delaunay<D>, cavity: &Cavity) {
    let vertices = |simplex: &SimplexId| delaunay.complex().vertices(*simplex).iter().copied();
    let found_vertices =
        cavity.simplices.iter().flat_map(vertices).filter(|&vertex| vertex != VertexId::INFINITE);
    let found = BTreeSet::from_iter(cavity.vertices.ids.iter().copied());
    assert_eq!(found, found_vertices.collect());
    assert_eq!(found.len(), cavity.vertices.ids.len());
}

fn live_simplices<const D: usize>(delaunay: &Delaunay<D>) -> Vec<SimplexId> {
    let complex = delaunay.complex();
    complex.simplices().filter(|&s| complex.is_live(s)).collect()
}

pub(super) fn assert_delaunay<const D: usize>(delaunay: &Delaunay<D>) {
    for simplex in live_simplices(delaunay) {
        let vertices = delaunay.complex().vertices(simplex);
        if !vertices.contains(&VertexId::INFINITE) {
            let points = delaunay.vertex_points(vertices);
            assert_eq!(orientation(&points[..=D]), Sign::Positive, "{vertices:?}");
        }
        let inserted = |v: &VertexId| delaunay.complex().contains_vertex(*v);
        for other in VertexId::below(delaunay.point_count()).filter(inserted) {
            if vertices.contains(&other) {
                continue;
            }
            let q = delaunay.point(other);
            assert!(!delaunay.in_conflict(simplex, q), "{vertices:?} conflicts with {other:?}");
            if !vertices.contains(&VertexId::INFINITE) {
                let points = delaunay.vertex_points(vertices);
                assert_ne!(in_ball(&points[..=D], q), Sign::Positive, "{vertices:?} {other:?}");
            }
        }
    }
}

/// Asserts that adjacent simplices share their facet and name each other, and that each of the D +
/// 1 facets has one neighbour.
pub(super) fn assert_closed<const D: usize>(delaunay: &Delaunay<D>) {
    let complex = delaunay.complex();
    let live = live_simplices(delaunay);
    assert_eq!(live.len(), complex.simplex_count());
    for simplex in live {
        for (index, &neighbor) in complex.neighbors(simplex).iter().enumerate() {
            assert!(complex.is_live(neighbor));
            assert_eq!(complex.neighbors(neighbor).iter().filter(|&&n| n == simplex).count(), 1);
            let shared = complex.vertices(simplex).iter().enumerate();
            let missing = shared.filter(|&(_, v)| !complex.vertices(neighbor).contains(v));
            assert_eq!(missing.map(|(i, _)| i).collect::<Vec<_>>(), [index]);
        }
    }
    for vertex in VertexId::below(delaunay.point_count()).filter(|&v| complex.contains_vertex(v)) {
        let incident = complex.incident(vertex);
        assert!(complex.is_live(incident) && complex.vertices(incident).contains(&vertex));
    }
}

/// Asserts that the last search has left no mark.
fn assert_unmarked<const D: usize>(delaunay: &Delaunay<D>) {
    let complex = delaunay.complex();
    assert!(complex.simplices().all(|simplex| !complex.is_marked(simplex)));
}

/// Asserts that the star of each vertex has all simplices at it, each once, and that a search there
/// finds the vertices of one that has them and no others.
fn assert_stars<const D: usize>(delaunay: &mut Delaunay<D>) {
    let live = live_simplices(delaunay);
    let (mut star, mut searched) = (Array::new(), Array::new());
    for vertex in VertexId::below(delaunay.point_count()) {
        if delaunay.complex().contains_vertex(vertex) {
            delaunay.star(vertex, &mut star).unwrap();
            assert_unmarked(delaunay);
            star.sort_unstable();
            let has =
                |&&simplex: &&SimplexId| delaunay.complex().vertices(simplex).contains(&vertex);
            assert!(live.iter().filter(has).eq(&star));
            for other in VertexId::below(delaunay.point_count()).skip(vertex.index() / 3).take(4) {
                let both = [other, VertexId::new(other.index() / 2)];
                for others in [&both[..1], &both] {
                    let is_there = star.iter().any(|&simplex| {
                        let own = delaunay.complex().vertices(simplex);
                        others.iter().all(|other| own.contains(other))
                    });
                    let is_found = delaunay.star_has(vertex, others, &mut searched).unwrap();
                    assert_eq!(is_found, is_there, "{vertex:?} {others:?}");
                    assert_unmarked(delaunay);
                }
            }
        }
    }
}

/// Asserts that the order of locality has every live simplex once: sorted by the least vertex where
/// all vertices are anchors, and by the number of steps from its star where vertex 0 is the only
/// anchor.
fn assert_order<const D: usize>(delaunay: &Delaunay<D>) {
    let complex = delaunay.complex();
    let live = live_simplices(delaunay);
    let all = complex.order_by_anchor(delaunay.point_count(), || Ok(())).unwrap().order;
    assert!(all.is_sorted_by_key(|&simplex| complex.vertices(simplex).iter().min()));
    let by_steps = complex.order_by_anchor(1, || Ok(())).unwrap().order;
    let mut steps = vec![usize::MAX; complex.simplex_bound()];
    for &simplex in &by_steps {
        let neighbors = complex.neighbors(simplex).iter();
        let least = neighbors.map(|&neighbor| steps[neighbor]).min().unwrap();
        let is_at_anchor = complex.vertices(simplex).contains(&VertexId::new(0));
        steps[simplex] = if is_at_anchor { 0 } else { least.saturating_add(1) };
    }
    assert!(by_steps.is_sorted_by_key(|&simplex| steps[simplex]));
    assert!(by_steps.iter().all(|&simplex| steps[simplex] < usize::MAX));
    for mut order in [all, by_steps] {
        order.sort_unstable();
        assert_eq!(*order, live[..]);
    }
}

fn check<const D: usize>(points: &[[f64; D]]) -> Option<usize> {
    let mut delaunay = triangulate(points)?;
    assert_closed(&delaunay);
    assert_stars(&mut delaunay);
    assert_order(&delaunay);
    assert_delaunay(&delaunay);
    let mut distinct: Vec<_> = points.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    distinct.sort();
    distinct.dedup();
    let inserted = |v: &VertexId| delaunay.complex().contains_vertex(*v);
    assert_eq!(VertexId::below(points.len()).filter(inserted).count(), distinct.len());
    Some(delaunay.complex().simplex_count())
}

fn lattice<const D: usize>(side: usize) -> Vec<[f64; D]> {
    (0..side.pow(D as u32))
        .map(|i| std::array::from_fn(|axis| (i / side.pow(axis as u32) % side) as f64))
        .collect()
}

#[test]
fn lattices_are_triangulated_exactly() {
    // A triangulated n x n square has 2 (n-1)^2 triangles and 4 (n-1) hull edges.
    assert_eq!(check(&lattice::<2>(7)), Some(2 * 36 + 24));
    assert!(check(&lattice::<3>(4)).is_some());
    assert!(check(&lattice::<4>(2)).is_some());
    assert!(check(&lattice::<5>(2)).is_some());
}

#[test]
fn cospherical_points_leave_no_gap() {
    let circle: Vec<[f64; 2]> = [(3, 4), (5, 0), (4, 3), (0, 5)]
        .iter()
        .flat_map(|&(x, y)| [(x, y), (-x, y), (x, -y), (-x, -y)])
        .map(|(x, y)| [f64::from(x), f64::from(y)])
        .collect();
    // 12 distinct points on a circle: 10 triangles and 12 hull edges.
    assert_eq!(check(&circle), Some(22));
}

/// Cavities are linked, though one has more vertices round it than a table has room for, before and
/// after small ones.
#[test]
fn cavities_of_any_size_are_linked() {
    fn check_round<const D: usize>(count: usize) {
        let mut random = Random(D as u64);
        let mut points: Vec<[f64; D]> = Vec::new();
        for center in [0.0, 4.0] {
            for _ in 0..count {
                let direction: [f64; D] = std::array::from_fn(|_| random.unit());
                let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
                points.push(direction.map(|x| center + x / length));
            }
            points.push([center; D]);
            points.extend((0..10).map(|_| std::array::from_fn(|_| center + 0.5 * random.unit())));
        }
        assert!(check(&points).is_some());
    }
    check_round::<2>(100);
    check_round::<3>(100);
    check_round::<4>(30);
}

#[test]
fn points_one_ulp_apart_stay_distinct() {
    let near = 1f64.next_up();
    let points = [[1.0, 1.0], [near, 1.0], [1.0, near], [near, near], [2.0, 1.5], [0.0, 0.5]];
    assert!(check(&points).is_some());
}

#[test]
fn every_exponent_is_ordinary() {
    let tiny = f64::from_bits(1);
    let points = [[tiny, 0.0, 1.0], [-tiny, 3.0 * tiny, 0.0], [1e-200, 1e200, 0.0]];
    let more = [[1e300, -1e300, 1e100], [0.0, 0.0, 0.0], [1.0, 1.0, -1e-300], [8e307, 8e307, 1.0]];
    let all: Vec<[f64; 3]> = points.into_iter().chain(more).collect();
    assert!(check(&all).is_some());
}

#[test]
fn flat_sets_have_no_complex() {
    let line: Vec<[f64; 3]> = (0..9).map(|i| [f64::from(i), 2.0 * f64::from(i), 1.0]).collect();
    assert!(triangulate(&line).is_none());
}

fn points<const D: usize>(
    coordinate: impl Strategy<Value = f64> + Clone,
) -> impl Strategy<Value = Vec<[f64; D]>> {
    let point = prop::collection::vec(coordinate, D)
        .prop_map(|coordinates| <[f64; D]>::try_from(coordinates).expect("D coordinates"));
    prop::collection::vec(point, D + 1..24)
}

fn raw_finite() -> impl Strategy<Value = f64> + Clone {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |x| x.is_finite())
}

fn small_integers() -> impl Strategy<Value = f64> + Clone {
    (-2i32..=2).prop_map(f64::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn random_points_2d(points in points::<2>(-1.0..1.0)) { check(&points); }

    #[test]
    fn random_points_3d(points in points::<3>(-1.0..1.0)) { check(&points); }

    #[test]
    fn random_points_4d(points in points::<4>(-1.0..1.0)) { check(&points); }

    #[test]
    fn small_lattice_points_2d(points in points::<2>(small_integers())) { check(&points); }

    #[test]
    fn small_lattice_points_3d(points in points::<3>(small_integers())) { check(&points); }

    #[test]
    fn small_lattice_points_4d(points in points::<4>(small_integers())) { check(&points); }

    #[test]
    fn raw_bit_patterns_2d(points in points::<2>(raw_finite())) { check(&points); }
}

// Every sign is one of integers of hundreds of words: a case takes as long as a hundred others.
proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn raw_bit_patterns_3d(points in points::<3>(raw_finite())) { check(&points); }

    #[test]
    fn raw_bit_patterns_4d(points in points::<4>(raw_finite())) { check(&points); }
}

/// Points so near to one sphere that single precision cannot tell their sides need no exact signs:
/// doubles tell them.
#[test]
fn points_near_a_sphere_are_told_apart_in_doubles() {
    let mut random = Random(21);
    let mut point = || -> [f64; 3] {
        let direction: [f64; 3] = std::array::from_fn(|_| random.unit());
        let radius = 1.0 + 1e-8 * random.unit();
        direction.map(|x| x * radius / norm(&direction))
    };
    let points: Vec<[f64; 3]> = (0..150).map(|_| point()).collect();
    let delaunay = triangulate(&points).unwrap();
    assert!(delaunay.exact_fallbacks() < 20, "{}", delaunay.exact_fallbacks());
    assert_delaunay(&delaunay);
}

/// Simplices beyond the last id are refused; ids do not wrap round.
#[test]
fn too_many_simplices_are_refused() {
    let vertices = [[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0], [2.0, 1.0]];
    let mut delaunay = Delaunay::new(Array::copied(&vertices).unwrap()).unwrap();
    delaunay.complex.limit_ids(8);
    delaunay.begin(&[0, 1, 2].map(VertexId::new)).unwrap();
    let (mut cavity, mut created) = (Cavity::default(), Vec::new());
    for (vertex, expected) in [(3, Ok(())), (4, Err(AllocError::Ids))] {
        let vertex = VertexId::new(vertex);
        let q = vertices[vertex];
        let start = delaunay.locate(delaunay.complex().incident(VertexId::new(0)), &q).unwrap();
        delaunay.find_cavity(start, &q, &mut cavity).unwrap();
        assert_eq!(delaunay.insert(vertex, &cavity, &mut created), expected);
    }
}

/// Holds that a search leaves out what it may not enter, and what that alone leads to, unless few
/// were found before; and that the cavity tells so.
#[test]
fn cavities_end_where_a_search_may_not_go() {
    let mut random = Random(11);
    let mut point = || -> [f64; 3] { std::array::from_fn(|_| random.unit()) };
    let points: Vec<[f64; 3]> = (0..300).map(|_| point()).collect();
    let mut delaunay = triangulate(&points).unwrap();
    let near = delaunay.complex().incident(VertexId::new(0));
    let (mut whole, mut part) = (Cavity::default(), Cavity::default());
    let set = |cavity: &Cavity| BTreeSet::from_iter(cavity.simplices.iter().copied());
    let mut parts = 0;
    for round in 0..300 {
        let q = point();
        let Some(start) = delaunay.locate(near, &q) else { continue };
        delaunay.find_cavity(start, &q, &mut whole).unwrap();
        assert!(whole.is_whole);
        assert_unmarked(&delaunay);
        let may_go = |simplex: SimplexId| simplex.index() % 3 != round % 3;
        delaunay.find_cavity_within(start, &q, &mut part, |simplex, _| may_go(simplex)).unwrap();
        assert_unmarked(&delaunay);
        let (mut expected, mut waiting) = (BTreeSet::from([start]), vec![start]);
        while let Some(simplex) = waiting.pop() {
            for &beyond in delaunay.complex().neighbors(simplex) {
                let is_new = set(&whole).contains(&beyond) && may_go(beyond);
                if is_new && expected.insert(beyond) {
                    waiting.push(beyond);
                }
            }
        }
        assert_eq!(set(&part), expected);
        assert_eq!(part.is_whole, expected == set(&whole));
        parts += usize::from(!part.is_whole);
        let few = |simplex: SimplexId, found: usize| found < 5 || may_go(simplex);
        delaunay.find_cavity_within(start, &q, &mut part, few).unwrap();
        assert!(part.simplices.len() >= whole.simplices.len().min(5));
        assert!(set(&part).is_superset(&expected) && set(&part).is_subset(&set(&whole)));
    }
    assert!(parts > 100, "{parts}");
}

#[test]
fn location_counts_the_balls_it_tests() {
    let points = [[0.0, 0.0], [8.0, 0.0], [0.0, 8.0], [-8.0, -8.0], [30.0, -30.0], [60.0, -64.0]];
    let delaunay = triangulate(&points).unwrap();
    let q = [-3.0, -3.0];
    let mut tests = 0;
    let [near, far] = [3, 5].map(|vertex| delaunay.complex().incident(VertexId::new(vertex)));
    let found = delaunay.locate_and_count(near, &q, &mut tests).unwrap();
    assert!(tests >= 1);
    let mut again = 10;
    assert_eq!(delaunay.locate_and_count(found, &q, &mut again), Some(found));
    assert_eq!(again, 11);
    let mut walked = 0;
    delaunay.locate_and_count(far, &q, &mut walked).unwrap();
    assert!(walked > 1, "{walked}");
}
