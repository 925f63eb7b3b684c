//! Inputs that no facet or segment has but that are on one, exactly or up to rounding: segments and
//! edges go through them, and facets have them as vertices.

use super::meet::is_between;
use super::pieces::{Piece, Pieces};
use super::plane::{Gauge, units_of};
use super::projection::Projection;
use crate::arrangement::near::Near;
use crate::arrangement::poll::Poll;
use crate::arrangement::reach::Reach;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::nearest::{Bounds, BoxTree, bounds_of};
use crate::numerics::orientation;
use std::ops::Range;

/// Number of polls' units of work for one edge or triangle.
const WORK: u32 = 4;

/// Inputs on edges and in facets. Distances, in units in the last place or in what rounding
/// explains at most, are kept as the bits of doubles, which have their order.
#[derive(Default)]
pub(super) struct Isolated {
    /// Edge, the smaller vertex first, a vertex on it, and its distance; sorted by edge, and along
    /// it.
    on_edges: Vec<([u32; 2], u32, u64)>,
    /// Facet, a vertex in it, and its distance; sorted, each vertex once.
    in_facets: Vec<(u32, u32, u64)>,
    /// Facet, and a line in it between two vertices, the smaller one first; sorted, each once.
    lines: Vec<(u32, [u32; 2])>,
}

/// Vertices on edges, given by their ends with the smaller one first, vertices in facets and lines
/// in facets, in any order and any number of times.
#[derive(Default)]
pub(super) struct Added {
    pub on_edges: Vec<([u32; 2], u32)>,
    pub in_facets: Vec<(u32, u32)>,
    pub lines: Vec<(u32, [u32; 2])>,
}

/// Place of an isolated input: the edge that it is on, or a facet.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Edge([u32; 2]),
    Facet(u32),
}

impl Isolated {
    pub fn is_empty(&self) -> bool {
        self.on_edges.is_empty() && self.in_facets.is_empty()
    }

    /// Returns the distances of those that are not exactly on an edge or facet.
    pub fn offsets(&self) -> impl Iterator<Item = f64> {
        let on_edges = self.on_edges.iter().map(|on| on.2);
        let all = on_edges.chain(self.in_facets.iter().map(|within| within.2));
        all.filter(|&bits| bits > 0).map(f64::from_bits)
    }

    /// Returns true if a vertex is on two edges that have an end in common, and much nearer to one
    /// of them: if both go through it, their corner has no area. O(n log n).
    pub fn is_beside_corner(&self) -> AllocResult<bool> {
        const MUCH: f64 = 8.0;
        let on_edges = self.on_edges.iter();
        let mut all = collected(on_edges.map(|&(edge, at, bits)| (at, bits, edge)))?;
        // By the vertices, the nearest first.
        all.sort_unstable();
        let is_corner = |one: &(u32, u64, [u32; 2]), other: &(u32, u64, [u32; 2])| {
            let [near, far] = [one.1, other.1].map(f64::from_bits);
            far > MUCH * near && one.2.iter().any(|end| other.2.contains(end))
        };
        Ok(all.chunk_by(|a, b| a.0 == b.0).any(|own| {
            (0..own.len()).any(|at| own[at + 1..].iter().any(|next| is_corner(&own[at], next)))
        }))
    }

    /// Returns the number of vertices in a facet.
    pub fn count_within(&self, facet: u32) -> usize {
        self.range_within(facet).len()
    }

    /// Returns the vertices in a facet.
    pub fn within(&self, facet: u32) -> impl Iterator<Item = u32> {
        self.in_facets[self.range_within(facet)].iter().map(|within| within.1)
    }

    /// Returns the lines in a facet.
    pub fn lines_in(&self, facet: u32) -> impl Iterator<Item = [u32; 2]> {
        let begin = self.lines.partition_point(|line| line.0 < facet);
        let end = self.lines.partition_point(|line| line.0 <= facet);
        self.lines[begin..end].iter().map(|line| line.1)
    }

    /// Returns the vertices on edges and lines, each with the edge.
    pub fn on_edges(&self) -> impl Iterator<Item = ([u32; 2], u32)> {
        self.on_edges.iter().map(|on| (on.0, on.1))
    }

    /// Returns the lines in all facets, each with its facet.
    pub fn lines(&self) -> impl Iterator<Item = ([u32; 2], u32)> {
        self.lines.iter().map(|&(facet, line)| (line, facet))
    }

    /// Adds vertices on edges, vertices in facets and lines in facets. Returns true if any of them
    /// is new. Vertices are in their order along the `reach` of an edge. O(n log n) for n of all.
    pub fn extend(
        &mut self,
        points: &[[f64; 3]],
        added: &Added,
        reach: impl Fn([u32; 2]) -> Reach<3>,
    ) -> AllocResult<bool> {
        let count = |own: &Self| [own.on_edges.len(), own.in_facets.len(), own.lines.len()];
        let before = count(self);
        for &(edge, vertex) in &added.on_edges {
            self.on_edges.try_push((edge, vertex, 0))?;
        }
        for &(facet, vertex) in &added.in_facets {
            self.in_facets.try_push((facet, vertex, 0))?;
        }
        self.lines.try_extend(&added.lines)?;
        self.on_edges.sort_unstable();
        self.on_edges.dedup_by_key(|on| (on.0, on.1));
        for own in self.on_edges.chunk_by_mut(|a, b| a.0 == b.0) {
            let reach = reach(own[0].0);
            own.sort_unstable_by_key(|on| reach.position(&points[on.1 as usize]));
        }
        self.in_facets.sort_unstable();
        self.in_facets.dedup_by_key(|within| (within.0, within.1));
        self.lines.sort_unstable();
        self.lines.dedup();
        Ok(count(self) != before)
    }

    fn range_within(&self, facet: u32) -> Range<usize> {
        let begin = self.in_facets.partition_point(|within| within.0 < facet);
        begin..self.in_facets.partition_point(|within| within.0 <= facet)
    }

    /// Returns the vertices on edges and in facets, in order.
    pub fn vertices(&self) -> AllocResult<Vec<u32>> {
        let on_edges = self.on_edges.iter().map(|on| on.1);
        let mut all = collected(on_edges.chain(self.in_facets.iter().map(|within| within.1)))?;
        all.sort_unstable();
        all.dedup();
        Ok(all)
    }

    /// Leaves each vertex one place of those that are near it: an edge if it is near one, with
    /// those exactly on one first, otherwise the nearest facet. A vertex near several edges and
    /// exactly on nothing is near a corner, and keeps no place; such are returned.
    pub fn settle(&mut self) -> AllocResult<Vec<u32>> {
        let on_edges = self.on_edges.iter().map(|&(edge, at, bits)| (at, Place::Edge(edge), bits));
        let within = self.in_facets.iter();
        let within = within.map(|&(facet, at, bits)| (at, Place::Facet(facet), bits));
        let mut places = collected(on_edges.chain(within))?;
        let is_facet = |place: &Place| matches!(place, Place::Facet(_));
        // By the vertices, edges before facets, the nearest first.
        places.sort_unstable_by_key(|&(at, place, bits)| (at, is_facet(&place), bits, place));
        let (mut kept, mut homeless) = (Vec::new(), Vec::new());
        for own in places.chunk_by(|a, b| a.0 == b.0) {
            let edges = own.iter().filter(|(_, place, _)| !is_facet(place)).count();
            if edges < 2 || own.iter().any(|place| place.2 == 0) {
                kept.try_push((own[0].0, own[0].1))?;
            } else {
                homeless.try_push(own[0].0)?;
            }
        }
        let is_kept = |at: u32, place: Place| kept.binary_search(&(at, place)).is_ok();
        self.on_edges.retain(|&(edge, at, _)| is_kept(at, Place::Edge(edge)));
        self.in_facets.retain(|&(facet, at, _)| is_kept(at, Place::Facet(facet)));
        Ok(homeless)
    }

    /// Returns the parts into which the vertices on it divide an edge, from its first end on.
    pub fn chain(&self, [from, to]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let on = self.on([from, to]);
        let is_reversed = from > to;
        let vertex = move |at: usize| match at {
            0 => from,
            _ if at > on.len() => to,
            _ if is_reversed => on[on.len() - at].1,
            _ => on[at - 1].1,
        };
        (0..=on.len()).map(move |at| [vertex(at), vertex(at + 1)])
    }

    /// Returns true if a triangle has such vertices in its edges.
    pub fn splits(&self, triangle: [u32; 3]) -> bool {
        let [a, b, c] = triangle;
        [[a, b], [b, c], [c, a]].iter().any(|&edge| !self.on(edge).is_empty())
    }

    fn on(&self, [from, to]: [u32; 2]) -> &[([u32; 2], u32, u64)] {
        let edge = [from.min(to), from.max(to)];
        let begin = self.on_edges.partition_point(|on| on.0 < edge);
        let end = self.on_edges.partition_point(|on| on.0 <= edge);
        &self.on_edges[begin..end]
    }

    /// Finds the vertices that no piece has, on the edges and in the facets; only those that are
    /// exactly there if `is_exact` is set. Expected O(n log n), where edges and triangles pass
    /// between few vertices.
    pub fn find(
        points: &[[f64; 3]],
        pieces: &Pieces,
        is_exact: bool,
        poll: Poll<'_>,
    ) -> Result<Self> {
        let mut found = Self::default();
        let mut is_alone = filled(points.len(), true)?;
        for &vertex in pieces.all.iter().flat_map(Piece::vertices) {
            is_alone[vertex as usize] = false;
        }
        let alone = (0..points.len() as u32).filter(|&vertex| is_alone[vertex as usize]);
        let alone = collected(alone)?;
        if alone.is_empty() {
            return Ok(found);
        }
        let own = collected(alone.iter().map(|&vertex| points[vertex as usize]))?;
        let mut near = Near::new(&own)?;
        let mut candidates = Vec::new();
        for edge in pieces.edges()? {
            poll(WORK)?;
            candidates.clear();
            let reach = Reach::of(edge.map(|end| &points[end as usize]));
            near.collect(&reach, edge.map(|end| &points[end as usize]), &mut candidates)?;
            found.add_on_edge((edge, reach), &own, (&alone, &mut candidates), is_exact)?;
        }
        debug_assert!(found.on_edges.is_sorted_by_key(|on| on.0));
        found.find_in_facets(points, pieces, (&alone, &own), is_exact, poll)?;
        Ok(found)
    }

    /// Adds those of some vertices that are on an edge, in their order along it.
    fn add_on_edge(
        &mut self,
        (edge, reach): ([u32; 2], Reach<3>),
        own: &[[f64; 3]],
        (alone, candidates): (&[u32], &mut Vec<u32>),
        is_exact: bool,
    ) -> AllocResult<()> {
        let point = |at: u32| &own[at as usize];
        let [from, to] = reach.ends.each_ref();
        let is_on = |x: &[f64; 3]| {
            let is_straight = Projection::ALL.iter().all(|all| all.turn([from, to, x]).is_zero());
            is_straight && is_between([from, to], x)
        };
        candidates.retain(|&at| is_on(point(at)) || !is_exact && reach.holds(point(at)));
        candidates.sort_unstable_by_key(|&at| reach.position(point(at)));
        for &at in candidates.iter() {
            let offset = reach.offset_from_segment(point(at));
            self.on_edges.try_push((edge, alone[at as usize], offset.max(0.0).to_bits()))?;
        }
        Ok(())
    }

    /// Finds the vertices in the triangles of facets, apart from those on their edges.
    fn find_in_facets(
        &mut self,
        points: &[[f64; 3]],
        pieces: &Pieces,
        (alone, own): (&[u32], &[[f64; 3]]),
        is_exact: bool,
        poll: Poll<'_>,
    ) -> Result<()> {
        let boxes = collected(own.iter().map(|x| -> Bounds { [*x, *x] }))?;
        let tree = BoxTree::new(&boxes)?;
        for piece in &pieces.all {
            let (Some(triangle), Some(facet)) = (piece.triangle(), piece.facet()) else { continue };
            poll(WORK)?;
            let leaf = Leaf::new(triangle.map(|vertex| &points[vertex as usize]));
            let meets = |bounds: &Bounds| leaf.may_meet(bounds);
            tree.each_at(meets, |at| {
                let (vertex, x) = (alone[at as usize], &own[at as usize]);
                let edges = [[0, 1], [1, 2], [2, 0]].map(|ends| ends.map(|k: usize| triangle[k]));
                let is_on_edge = |edge: &[u32; 2]| self.on(*edge).iter().any(|on| on.1 == vertex);
                if edges.iter().any(is_on_edge) {
                    return Ok(());
                }
                match leaf.offset(x).filter(|&offset| offset <= if is_exact { 0.0 } else { 1.0 }) {
                    Some(offset) => {
                        let bits = offset.max(0.0).to_bits();
                        Ok(self.in_facets.try_push((facet, vertex, bits))?)
                    }
                    None => Ok(()),
                }
            })?;
        }
        self.in_facets.sort_unstable();
        self.in_facets.dedup_by_key(|within| (within.0, within.1));
        Ok(())
    }
}

/// Triangle of a facet in the form that a search needs.
struct Leaf<'a> {
    corners: [&'a [f64; 3]; 3],
    /// Bounds, with a margin for roundings.
    bounds: Bounds,
    gauge: Gauge<'a>,
    /// True if rounding explains a gap beside the triangle, as beside its edges.
    is_long: bool,
}

impl<'a> Leaf<'a> {
    fn new(corners: [&'a [f64; 3]; 3]) -> Self {
        let units = units_of(corners.into_iter());
        let [low, high] = bounds_of(corners.into_iter());
        let bounds = [
            std::array::from_fn(|k| low[k] - 32.0 * units[k]),
            std::array::from_fn(|k| high[k] + 32.0 * units[k]),
        ];
        let is_long = Reach::of([&low, &high]).is_long();
        Self { corners, bounds, gauge: Gauge::new(corners, units), is_long }
    }

    /// Returns false only if no point of the box is near the triangle.
    fn may_meet(&self, [low, high]: &Bounds) -> bool {
        let [own_low, own_high] = &self.bounds;
        (0..3).all(|k| low[k] <= own_high[k] && own_low[k] <= high[k])
            && self.gauge.may_meet([low, high])
    }

    /// Returns the distance of a point from the triangle in what rounding explains at most, 0 for a
    /// point exactly in its plane, infinite for others where rounding explains no gap; `None` for a
    /// point that is not projected into it.
    fn offset(&self, x: &[f64; 3]) -> Option<f64> {
        let [a, b, c] = self.corners;
        let projection = Projection::of_triangle(self.corners)?;
        let turn = projection.turn(self.corners);
        let sides = [[b, c], [c, a], [a, b]];
        let is_in = sides.iter().all(|&[p, q]| !(projection.turn([p, q, x]) * turn).is_negative());
        let offset = || match orientation(&[a, b, c, x]).is_zero() {
            true => 0.0,
            false if !self.is_long => f64::INFINITY,
            false => self.gauge.measure(x).0,
        };
        is_in.then(offset)
    }
}

/// Returns true if a point is strictly before a triangle, where that is counterclockwise, and is
/// projected into it.
pub(super) fn is_outside_of(corners: [&[f64; 3]; 3], x: &[f64; 3]) -> bool {
    let [a, b, c] = corners;
    orientation(&[a, b, c, x]).is_positive() && Leaf::new(corners).offset(x).is_some()
}
