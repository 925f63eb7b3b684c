//! Random sequences of insertions, removals and relocations end in the complex that inserting the
//! remaining vertices in their order makes: the same simplices, on degenerate points too.

use super::*;
use crate::delaunay::Cavity;
use crate::delaunay::tests::{assert_closed, assert_delaunay};
use crate::memory::AllocError;
use crate::numerics::testing::Random;
use std::collections::BTreeSet;

/// Triangulation that the tests change.
struct Changing<const D: usize> {
    delaunay: Delaunay<D>,
    /// Vertices of the first simplex, which are never removed.
    first: Vec<VertexId>,
    hole: Hole<D>,
    cavity: Cavity,
    created: Vec<SimplexId>,
}

impl<const D: usize> Changing<D> {
    /// Builds the triangulation of one simplex.
    fn new(first: &[[f64; D]]) -> Self {
        let mut delaunay = Delaunay::new(Array::copied(first).unwrap()).unwrap();
        let first: Vec<_> = VertexId::below(first.len()).collect();
        delaunay.begin(&first).unwrap();
        let (hole, cavity, created) = Default::default();
        Self { delaunay, first, hole, cavity, created }
    }

    fn is_inserted(&self, vertex: VertexId) -> bool {
        self.delaunay.complex().contains_vertex(vertex)
    }

    /// Inserts a vertex; returns false if another one is at its point.
    fn insert(&mut self, vertex: VertexId) -> bool {
        let near = self.delaunay.complex().incident(self.first[0]);
        let x = *self.delaunay.point(vertex);
        let Some(start) = self.delaunay.locate(near, &x) else { return false };
        self.delaunay.find_cavity(start, &x, &mut self.cavity).unwrap();
        self.delaunay.insert(vertex, &self.cavity, &mut self.created).unwrap();
        true
    }

    /// Removes a vertex; returns false if it is on the hull.
    fn remove(&mut self, vertex: VertexId) -> bool {
        let is_inside = self.delaunay.find_hole(vertex, &mut self.hole).unwrap();
        let infinite = |&simplex: &SimplexId| self.delaunay.complex().is_infinite(simplex);
        assert_eq!(is_inside, !self.hole.star.iter().any(infinite));
        if is_inside {
            self.delaunay.remove(vertex, &self.hole, &mut self.created).unwrap();
            assert!(!self.is_inserted(vertex));
        }
        is_inside
    }

    fn relocate(&mut self, vertex: VertexId, x: &[f64; D]) {
        let before = *self.delaunay.point(vertex);
        if self.remove(vertex) {
            self.delaunay.set_point(vertex, *x);
            if !self.insert(vertex) {
                self.delaunay.set_point(vertex, before);
                assert!(self.insert(vertex), "no vertex is where it was");
            }
        }
        assert!(self.is_inserted(vertex));
    }

    /// Makes a triangulation of the inserted vertices, in the order of their insertion.
    fn made_anew(&self) -> Self {
        let count = self.delaunay.point_count();
        let points = Array::copied(&self.delaunay.points).unwrap();
        let mut scratch =
            Self { delaunay: Delaunay::new(points).unwrap(), ..Self::new(&self.corners()) };
        scratch.delaunay.begin(&self.first).unwrap();
        let others = VertexId::below(count).filter(|vertex| !self.first.contains(vertex));
        let mut order: Vec<_> = others.filter(|&vertex| self.is_inserted(vertex)).collect();
        order.sort_by_key(|&vertex| self.delaunay.turn(vertex));
        order.into_iter().for_each(|vertex| assert!(scratch.insert(vertex)));
        scratch
    }

    fn corners(&self) -> Vec<[f64; D]> {
        self.first.iter().map(|&vertex| *self.delaunay.point(vertex)).collect()
    }

    /// Returns the sorted vertices of all simplices.
    fn simplices(&self) -> BTreeSet<Vec<VertexId>> {
        let complex = self.delaunay.complex();
        let sorted = |simplex| {
            let mut vertices = complex.vertices(simplex).to_vec();
            vertices.sort();
            vertices
        };
        complex.simplices().filter(|&simplex| complex.is_live(simplex)).map(sorted).collect()
    }

    fn check(&self) {
        assert!(self.simplices() == self.made_anew().simplices());
        assert_closed(&self.delaunay);
    }
}

/// Runs a sequence of `operations` on about `size` points from `source`, with a check now and then.
/// Returns the number of exact signs that were needed.
fn run<const D: usize>(
    first: &[[f64; D]],
    operations: usize,
    size: usize,
    mut source: impl FnMut(&mut Random) -> [f64; D],
) -> u64 {
    let mut random = Random((operations + size + D) as u64);
    let mut changing = Changing::new(first);
    for _ in 0..size {
        let point = source(&mut random);
        changing.delaunay.add_point(point).unwrap();
    }
    let pick =
        |random: &mut Random| VertexId::new(D + 1 + random.integer(0, size as i64 - 1) as usize);
    for operation in 1..=operations {
        let vertex = pick(&mut random);
        let x = source(&mut random);
        match (changing.is_inserted(vertex), random.bits() & 1) {
            (false, _) => {
                changing.delaunay.points[vertex] = x;
                changing.insert(vertex);
            }
            (true, 0) => {
                changing.remove(vertex);
            }
            _ => changing.relocate(vertex, &x),
        }
        if operation % (operations / 50) == 0 {
            changing.check();
        }
    }
    assert_delaunay(&changing.delaunay);
    changing.delaunay.exact_fallbacks()
}

/// Returns the vertices of a simplex round the ball of radius 10.
fn around<const D: usize>() -> Vec<[f64; D]> {
    let corner = |i| std::array::from_fn(|axis| if i == axis { 99.0 } else { -17.0 });
    (0..=D).map(corner).collect()
}

fn uniform<const D: usize>(random: &mut Random) -> [f64; D] {
    std::array::from_fn(|_| 2.0 * random.unit())
}

/// Returns a random point of a small lattice.
fn of_lattice<const D: usize>(random: &mut Random) -> [f64; D] {
    std::array::from_fn(|_| random.integer(-1, 2) as f64)
}

/// Returns a random point of the sphere of radius 5 with integer coordinates.
fn cospherical<const D: usize>(random: &mut Random) -> [f64; D] {
    let mut x = [0.0; D];
    let at = random.integer(0, D as i64 - 1) as usize;
    let other = (at + random.integer(1, D as i64 - 1) as usize) % D;
    let sign = |random: &mut Random| (2 * random.integer(0, 1) - 1) as f64;
    let legs = [[0.0, 5.0], [3.0, 4.0], [4.0, 3.0]][random.integer(0, 2) as usize];
    (x[at], x[other]) = (sign(random) * legs[0], sign(random) * legs[1]);
    x
}

fn collinear<const D: usize>(random: &mut Random) -> [f64; D] {
    let x = random.integer(-32, 31) as f64 / 32.0;
    if random.integer(0, 7) == 0 { uniform(random) } else { [x; D] }
}

/// Returns a random point, one of a few that are a unit in the last place apart.
fn near_pairs<const D: usize>(random: &mut Random) -> [f64; D] {
    let spread = |random: &mut Random| (0..random.integer(0, 2)).fold(1.0, |x: f64, _| x.next_up());
    std::array::from_fn(|_| spread(random))
}

/// Returns a random point of any magnitude.
fn of_all_scales<const D: usize>(random: &mut Random) -> [f64; D] {
    let exponent = random.integer(0, 59) as i32;
    uniform(random).map(|x: f64| x * 2f64.powi(-exponent))
}

#[test]
fn sequences_on_uniform_points_end_as_from_scratch() {
    run::<2>(&around(), 100_000, 80, uniform);
    run::<3>(&around(), 100_000, 60, uniform);
    run::<4>(&around(), 1_000, 24, uniform);
    run::<5>(&around(), 200, 14, uniform);
}

#[test]
fn sequences_on_lattices_end_as_from_scratch() {
    let exact =
        run::<2>(&around(), 30_000, 14, of_lattice) + run::<3>(&around(), 20_000, 40, of_lattice);
    assert!(exact > 100_000, "{exact}");
    run::<4>(&around(), 500, 24, of_lattice);
}

#[test]
fn sequences_on_spheres_end_as_from_scratch() {
    run::<2>(&around(), 20_000, 12, cospherical);
    run::<3>(&around(), 20_000, 24, cospherical);
    run::<4>(&around(), 500, 20, cospherical);
}

#[test]
fn sequences_on_lines_and_pairs_and_scales_end_as_from_scratch() {
    run::<2>(&around(), 10_000, 40, collinear);
    run::<3>(&around(), 10_000, 30, collinear);
    run::<2>(&around(), 10_000, 9, near_pairs);
    run::<3>(&around(), 10_000, 20, near_pairs);
    run::<2>(&around(), 10_000, 40, of_all_scales);
    run::<3>(&around(), 10_000, 40, of_all_scales);
}

/// Most vertices of a lattice that no larger simplex surrounds are on the hull, and stay.
#[test]
fn vertices_of_the_hull_stay() {
    run::<2>(&[[-1.0, -1.0], [2.0, -1.0], [-1.0, 2.0]], 10_000, 14, of_lattice);
    let corner = |i: usize| std::array::from_fn(|axis| if i == axis { 2.0 } else { -1.0 });
    run::<3>(&[0, 1, 2, 3].map(corner), 5_000, 50, of_lattice);
}

#[test]
fn holes_with_many_vertices_are_not_filled() {
    let mut changing = Changing::new(&around::<3>());
    let mut random = Random(5);
    for _ in 0..12 {
        let vertex = changing.delaunay.add_point(uniform(&mut random)).unwrap();
        assert!(changing.insert(vertex));
    }
    let vertex = VertexId::new(9);
    let Changing { delaunay, hole, .. } = &mut changing;
    assert!(delaunay.find_hole(vertex, hole).unwrap());
    let (neighbors, simplices) = (hole.vertices.ids.len(), hole.filling.len());
    assert!(!delaunay.find_small_hole(vertex, neighbors - 1, hole).unwrap());
    assert_eq!(hole.filling.len(), 0);
    assert!(delaunay.find_small_hole(vertex, neighbors, hole).unwrap());
    assert_eq!(hole.filling.len(), simplices);
}

#[test]
fn removals_that_ids_run_out_for_leave_the_complex() {
    let mut changing = Changing::new(&around::<3>());
    let mut random = Random(3);
    for _ in 0..12 {
        let vertex = changing.delaunay.add_point(uniform(&mut random)).unwrap();
        assert!(changing.insert(vertex));
    }
    let vertex = VertexId::new(9);
    assert!(changing.delaunay.find_hole(vertex, &mut changing.hole).unwrap());
    let before = changing.simplices();
    changing.delaunay.complex.limit_ids(changing.delaunay.complex.simplex_count());
    let Changing { delaunay, hole, created, .. } = &mut changing;
    assert_eq!(delaunay.remove(vertex, hole, created), Err(AllocError::Ids));
    assert!(changing.simplices() == before);
    changing.check();
    changing.delaunay.complex.limit_ids(usize::MAX);
    assert!(changing.remove(vertex));
    changing.check();
}
