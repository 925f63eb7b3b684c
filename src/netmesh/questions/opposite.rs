//! Places opposite vertices of other lines. Two sides of a needle run beside each other at a
//! distance that is a small part of their length. A vertex on one of them is then next to a
//! subsegment of the other. Split in its middle, that one gets a vertex which is next to the first
//! side, but not next to the first vertex; so each side would be split for the other, down to their
//! distance. Split opposite the vertex, both stay as long as they are. Shells do the same about an
//! end that both sides have.

use crate::complex::{SimplexId, VertexId};
use crate::memory::AllocResult;
use crate::netmesh::questions::small_angles::cosine;
use crate::netmesh::state::State;
use crate::netmesh::state::segments::chain::{Fraction, Subsegment};
use crate::numerics::distance;

/// Largest distance of a vertex that a subsegment is split opposite of, relative to that of the
/// place from the nearer end. From 0.05 on some surfaces have a sixth more vertices: there lines
/// are split for each other where they need not be.
const BESIDE: f64 = 0.02;

/// Least cosine of the angle between lines that run beside each other.
const PARALLEL: f64 = 0.9998;

/// A place on a subsegment, opposite a vertex.
struct Opposite {
    vertex: VertexId,
    /// Part of the way from the first end to the second.
    along: f64,
    /// Distance from the nearer end, relative to the length.
    depth: f64,
}

impl Opposite {
    fn is_better_than(&self, other: &Self) -> bool {
        self.depth > other.depth || self.depth == other.depth && self.vertex < other.vertex
    }
}

impl State<3> {
    /// Returns the place at which a subsegment of a line with a small angle is opposite a vertex of
    /// another line that runs beside it; that nearest to the middle, if there are several. Lines
    /// that have the end number `shell_end`, about which the subsegment is split on shells, do not
    /// count.
    pub(super) fn place_opposite(
        &mut self,
        own: &Subsegment,
        shell_end: Option<u8>,
    ) -> AllocResult<Option<Fraction>> {
        if !self.facets.is_sharp_line(own.line) {
            return Ok(None);
        }
        let ends = self.segments.chains.lines[own.line as usize].ends;
        let center = shell_end.map(|end| ends[end as usize]);
        let mut star = std::mem::take(&mut self.facets.star);
        let mut best: Option<Opposite> = None;
        for end in own.ends {
            self.delaunay.star(end, &mut star)?;
            for &simplex in &star {
                best = self.best_opposite(simplex, own, center, best);
            }
        }
        self.facets.star = star;
        let [first, second] = own.fractions;
        let [from, to] = [first, second].map(|fraction| fraction.seen_from(first.end));
        Ok(best.map(|best| Fraction::at(first.end, from + best.along * (to - from))))
    }

    /// Returns the better of `best` and the places opposite the vertices of a simplex.
    fn best_opposite(
        &self,
        simplex: SimplexId,
        own: &Subsegment,
        center: Option<VertexId>,
        mut best: Option<Opposite>,
    ) -> Option<Opposite> {
        for &vertex in self.delaunay.complex().vertices(simplex) {
            if !vertex.is_valid() || own.ends.contains(&vertex) {
                continue;
            }
            let Some(other) = self.opposite_vertex(vertex, own) else { continue };
            let is_best = best.as_ref().is_none_or(|best| other.is_better_than(best));
            if is_best && self.is_on_line_beside(vertex, own.line, center) {
                best = Some(other);
            }
        }
        best
    }

    /// Returns the place on a subsegment opposite a vertex of a line, if that is near to it.
    fn opposite_vertex(&self, vertex: VertexId, own: &Subsegment) -> Option<Opposite> {
        if !self.segments.chains.holds(vertex) {
            return None;
        }
        let [a, b] = own.ends.map(|end| self.delaunay.point(end));
        let x = self.delaunay.point(vertex);
        let length = distance(a, b);
        let part = |to: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|k| (to[k] - a[k]) / length) };
        let (way, to) = (part(b), part(x));
        let along: f64 = (0..3).map(|k| way[k] * to[k]).sum();
        let depth = along.min(1.0 - along);
        let foot = way.map(|part| along * part);
        let is_beside = depth > 0.0 && distance(&foot, &to) <= BESIDE * depth;
        is_beside.then_some(Opposite { vertex, along, depth })
    }

    /// Returns true if `vertex` is on another line than `own` that runs beside it, and does not end
    /// at `center`.
    fn is_on_line_beside(&self, vertex: VertexId, own: u32, center: Option<VertexId>) -> bool {
        let chains = &self.segments.chains;
        let way = self.way_between(chains.lines[own as usize].ends);
        chains.lines_at(vertex).filter(|&line| line != own).any(|line| {
            let ends = chains.lines[line as usize].ends;
            let is_on_shells = center.is_some_and(|center| ends.contains(&center));
            !is_on_shells && cosine(&way, &self.way_between(ends)).abs() >= PARALLEL
        })
    }

    fn way_between(&self, [from, to]: [VertexId; 2]) -> [f64; 3] {
        let [from, to] = [from, to].map(|end| self.delaunay.point(end));
        std::array::from_fn(|k| to[k] - from[k])
    }
}
