//! The chains of subsegments that segments have become.
//!
//! A *line* is a segment, or the part of one between inputs that are on it: its ends are inputs, or
//! points where segments cross. It is a chain of subsegments from its first end to its second.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, enqueue, filled, with_capacity};
use crate::netmesh::state::bits::{bit_of, in_two_of, numbers_in};
use crate::netmesh::state::facets::faces::EDGES;
use crate::netmesh::state::watch::Watch;
use std::collections::VecDeque;

/// The chains, and the subsegments that wait for a look.
#[derive(Default)]
pub(in crate::netmesh) struct Chains {
    pub lines: Vec<Line>,
    /// The first subsegment of line i is number i.
    subsegments: Vec<Subsegment>,
    /// Vertex -> where it is on the chains; those beyond are not.
    places: Array<OnChain>,
    /// Vertex -> the bits of the lines that it is on; those beyond have none.
    bits: Array<u64>,
    /// End number i of lines has `at_ends[starts[i]..starts[i + 1]]`, by rising other end.
    starts: Vec<u32>,
    at_ends: Vec<AtEnd>,
    waiting: VecDeque<u32>,
}

/// Line: a segment, or the part of one between two inputs or crossings on it.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Line {
    pub ends: [VertexId; 2],
    /// The caller's segment that it is part of.
    pub segment: u32,
    /// End -> true if the line makes a sharp angle with another one there.
    pub is_sharp: [bool; 2],
    /// Number of segments that run along it, less those that run against it.
    pub balance: i64,
}

#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Subsegment {
    pub ends: [VertexId; 2],
    /// Places of the ends on the line.
    pub fractions: [Fraction; 2],
    pub line: u32,
    is_waiting: bool,
    /// Doubles are too coarse for a vertex on it.
    is_limited: bool,
}

/// A place on a line, as a part of its length, at most half of it, from the end with number `end`:
/// so places near either end are told apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::netmesh) struct Fraction {
    pub end: u8,
    pub of_line: f64,
}

/// OnChain of a vertex on the chains.
#[derive(Clone, Copy, PartialEq)]
enum OnChain {
    Elsewhere,
    /// An end of lines, by its number.
    End(u32),
    /// Between two subsegments of one line.
    Between([u32; 2]),
}

/// A line at one of its ends.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct AtEnd {
    pub other: VertexId,
    pub line: u32,
    /// True if the line has been split.
    is_split: bool,
}

impl Line {
    /// Returns the end that this line has in common with another one, and the other ends of both.
    pub fn corner_with(&self, other: &Self) -> Option<(VertexId, [VertexId; 2])> {
        let [a, b] = self.ends;
        [(a, b), (b, a)].into_iter().find_map(|(center, own)| match other.ends {
            [from, to] if from == center && to != own => Some((center, [own, to])),
            [to, from] if from == center && to != own => Some((center, [own, to])),
            _ => None,
        })
    }
}

impl Fraction {
    pub const ENDS: [Self; 2] = [Self { end: 0, of_line: 0.0 }, Self { end: 1, of_line: 0.0 }];

    /// Returns the place in the middle.
    pub fn middle(self, other: Self) -> Self {
        let sum = self.of_line + other.of_line;
        match self.end == other.end {
            true => Self { end: self.end, of_line: 0.5 * sum },
            // The way from one to the other is 1 - sum.
            false => {
                let from_own = 0.5 * (1.0 - other.of_line + self.of_line);
                let from_other = 0.5 * (1.0 - self.of_line + other.of_line);
                match from_own <= from_other {
                    true => Self { end: self.end, of_line: from_own },
                    false => Self { end: other.end, of_line: from_other },
                }
            }
        }
    }

    /// Returns the part of the line's length from its end with number `end`.
    pub fn seen_from(self, end: u8) -> f64 {
        if self.end == end { self.of_line } else { 1.0 - self.of_line }
    }

    /// Returns a part of the line's length from its end with number `end`, in [0, 1].
    pub fn at(end: u8, part: f64) -> Self {
        match part <= 0.5 {
            true => Self { end, of_line: part },
            false => Self { end: 1 - end, of_line: 1.0 - part },
        }
    }
}

impl Chains {
    /// Makes one subsegment for each line, all of them waiting. No two lines have the same ends.
    pub fn new(lines: Vec<Line>, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<Self> {
        let mut chains =
            Self { places: Array::filled(vertices, OnChain::Elsewhere)?, ..Self::default() };
        chains.bits = Array::filled(vertices, 0)?;
        chains.subsegments = with_capacity(lines.len())?;
        chains.waiting.try_reserve(lines.len()).map_err(AllocError::from)?;
        for (line, &Line { ends, .. }) in (0..).zip(&lines) {
            watch.poll_after(1)?;
            let fractions = Fraction::ENDS;
            let subsegment =
                Subsegment { ends, fractions, line, is_waiting: true, is_limited: false };
            chains.subsegments.push(subsegment);
            enqueue(&mut chains.waiting, line)?;
        }
        chains.lines = lines;
        chains.collect_ends(vertices, watch)?;
        Ok(chains)
    }

    /// Finds which lines are at which ends.
    fn collect_ends(&mut self, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<()> {
        // Vertex -> how many lines end there, then where the next one of them goes.
        let mut next = filled(vertices, 0u32)?;
        self.lines.iter().flat_map(|line| line.ends).for_each(|end| next[end] += 1);
        watch.poll()?;
        let mut start = 0;
        for vertex in VertexId::below(vertices) {
            if next[vertex] == 0 {
                continue;
            }
            self.places[vertex] = OnChain::End(self.starts.len() as u32);
            self.starts.try_push(start)?;
            start += std::mem::replace(&mut next[vertex], start);
        }
        self.starts.try_push(start)?;
        let none = AtEnd { other: VertexId::NONE, line: 0, is_split: false };
        self.at_ends = filled(start as usize, none)?;
        for (line, &Line { ends, .. }) in (0..).zip(&self.lines) {
            watch.poll_after(1)?;
            for (end, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
                self.at_ends[next[end] as usize] = AtEnd { other, line, is_split: false };
                next[end] += 1;
                self.bits[end] |= bit_of(line);
            }
        }
        for range in self.starts.windows(2) {
            watch.poll_after(1)?;
            let own = &mut self.at_ends[range[0] as usize..range[1] as usize];
            own.sort_unstable_by_key(|at_end| at_end.other);
        }
        Ok(())
    }

    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Returns the number of subsegments.
    pub fn len(&self) -> usize {
        self.subsegments.len()
    }

    pub fn get(&self, subsegment: u32) -> &Subsegment {
        &self.subsegments[subsegment as usize]
    }

    #[inline]
    fn place(&self, vertex: VertexId) -> OnChain {
        self.places.get(vertex.index()).copied().unwrap_or(OnChain::Elsewhere)
    }

    /// Returns the bits of the lines that a vertex is on. Vertices of one line have a bit in
    /// common.
    #[inline]
    fn bits(&self, vertex: VertexId) -> u64 {
        self.bits.get(vertex.index()).copied().unwrap_or(0)
    }

    /// Returns true if `vertex` is on a segment.
    #[inline]
    pub fn holds(&self, vertex: VertexId) -> bool {
        self.bits(vertex) != 0
    }

    /// Returns the line that `vertex` is on and no end of.
    pub fn line_through(&self, vertex: VertexId) -> Option<u32> {
        match self.place(vertex) {
            OnChain::Between([before, _]) => Some(self.get(before).line),
            _ => None,
        }
    }

    /// Returns the subsegments before and behind `vertex` on the line that it is on and no end of.
    pub fn subsegments_at(&self, vertex: VertexId) -> Option<[u32; 2]> {
        match self.place(vertex) {
            OnChain::Between(two) => Some(two),
            _ => None,
        }
    }

    /// Returns the lines that `vertex` is on, be it an end of them or not.
    pub fn lines_at(&self, vertex: VertexId) -> impl Iterator<Item = u32> {
        let own = match self.place(vertex) {
            OnChain::End(end) => {
                let [start, end] = [end, end + 1].map(|at| self.starts[at as usize] as usize);
                &self.at_ends[start..end]
            }
            _ => &[],
        };
        self.line_through(vertex).into_iter().chain(own.iter().map(|at_end| at_end.line))
    }

    /// Returns the subsegment of a line at one of its ends. Takes time linear in the subsegments of
    /// the line.
    pub fn subsegment_at_end(&self, line: u32, end: VertexId) -> u32 {
        let mut subsegment = line;
        if self.lines[line as usize].ends[0] != end {
            while let Some([_, next]) = self.subsegments_at(self.get(subsegment).ends[1]) {
                subsegment = next;
            }
        }
        subsegment
    }

    /// Returns the first of the lines that `vertex` is on, be it an end of them or not.
    pub fn line_at(&self, vertex: VertexId) -> Option<u32> {
        self.lines_at(vertex).min()
    }

    /// Returns the vertices next to `vertex` on the line that it is on and no end of.
    pub fn neighbors_on_line(&self, vertex: VertexId) -> Option<[VertexId; 2]> {
        match self.place(vertex) {
            OnChain::Between([before, after]) => {
                Some([self.get(before).ends[0], self.get(after).ends[1]])
            }
            _ => None,
        }
    }

    /// Returns the number of subsegments that wait for a look.
    pub fn waiting_count(&self) -> usize {
        self.waiting.len()
    }

    /// Returns the lines at every vertex where several of them end.
    pub fn fans(&self) -> impl Iterator<Item = &[AtEnd]> {
        let ranges = self.starts.windows(2).map(|range| range[0] as usize..range[1] as usize);
        ranges.filter(|range| range.len() > 1).map(|range| &self.at_ends[range])
    }

    /// Returns the index in `at_ends` of a line between an end, by its number, and another vertex.
    #[inline]
    fn find_at_end(&self, end: u32, other: VertexId) -> Option<usize> {
        let [start, end] = [end, end + 1].map(|at| self.starts[at as usize] as usize);
        let own = &self.at_ends[start..end];
        let found = match own.len() {
            0..=8 => own.iter().position(|at_end| at_end.other == other),
            _ => own.binary_search_by_key(&other, |at_end| at_end.other).ok(),
        };
        found.map(|at| start + at)
    }

    /// Returns the subsegments between the vertices of a triangle: number i is opposite vertex
    /// number i.
    #[inline]
    pub fn sides_of(&self, vertices: &[VertexId]) -> [Option<u32>; 3] {
        let [a, b, c] = [vertices[0], vertices[1], vertices[2]];
        let (at_a, at_b, at_c) = (self.place(a), self.place(b), self.place(c));
        let off = OnChain::Elsewhere;
        // Most triangles have at most one vertex on a segment.
        if u8::from(at_a == off) + u8::from(at_b == off) + u8::from(at_c == off) > 1 {
            return [None; 3];
        }
        let (a, b, c) = ((a, at_a), (b, at_b), (c, at_c));
        [(b, c), (c, a), (a, b)].map(|(from, to)| self.between_places(from, to))
    }

    /// Returns the subsegment between two vertices.
    #[inline]
    pub fn edge_between(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.between_places((a, self.place(a)), (b, self.place(b)))
    }

    /// Returns the subsegments between the vertices of a tetrahedron, with their places in
    /// [`EDGES`].
    #[inline]
    pub fn edges_of(&self, vertices: &[VertexId]) -> impl Iterator<Item = (usize, u32)> {
        let bits = self.bits_of(vertices);
        let may_be = EDGES.iter().enumerate().fold(0, |all, (at, &[a, b])| {
            let has_common = bits[a] & bits[b] != 0;
            all | u32::from(has_common) << at
        });
        numbers_in(may_be).filter_map(move |at| {
            let [a, b] = EDGES[at];
            Some((at, self.edge_between(vertices[a], vertices[b])?))
        })
    }

    /// Returns true if two vertices of a tetrahedron may be on one line.
    #[inline]
    pub fn may_have_edge(&self, vertices: &[VertexId]) -> bool {
        in_two_of(self.bits_of(vertices)) != 0
    }

    #[inline]
    fn bits_of(&self, vertices: &[VertexId]) -> [u64; 4] {
        std::array::from_fn(|at| self.bits(vertices[at]))
    }

    #[inline]
    fn between_places(&self, a: (VertexId, OnChain), b: (VertexId, OnChain)) -> Option<u32> {
        match (a.1, b.1) {
            (OnChain::Elsewhere, _) | (_, OnChain::Elsewhere) => None,
            // One that ends at both.
            (OnChain::Between(own), OnChain::Between(other)) => {
                own.into_iter().find(|subsegment| other.contains(subsegment))
            }
            (OnChain::Between(two), _) | (_, OnChain::Between(two)) => {
                two.into_iter().find(|&subsegment| {
                    let ends = self.get(subsegment).ends;
                    ends == [a.0, b.0] || ends == [b.0, a.0]
                })
            }
            (OnChain::End(end), _) => {
                let at_end = self.at_ends[self.find_at_end(end, b.0)?];
                (!at_end.is_split).then_some(at_end.line)
            }
        }
    }

    /// Splits `subsegment` at `vertex`, which is at `fraction` of its line. Both parts wait.
    pub fn split(
        &mut self,
        subsegment: u32,
        vertex: VertexId,
        fraction: Fraction,
    ) -> AllocResult<()> {
        let whole = self.subsegments[subsegment as usize];
        if whole.ends == self.lines[whole.line as usize].ends {
            self.note_first_split(whole.ends);
        }
        let second = self.subsegments.len() as u32;
        let (mut first_half, mut second_half) = (whole, whole);
        (first_half.ends[1], first_half.fractions[1]) = (vertex, fraction);
        (second_half.ends[0], second_half.fractions[0]) = (vertex, fraction);
        second_half.is_waiting = false;
        self.subsegments.try_push(second_half)?;
        self.subsegments[subsegment as usize] = first_half;
        self.places.cover(vertex.index() + 1, OnChain::Elsewhere)?;
        self.bits.cover(vertex.index() + 1, 0)?;
        self.bits[vertex] = bit_of(whole.line);
        self.places[vertex] = OnChain::Between([subsegment, second]);
        if let OnChain::Between(two) = &mut self.places[whole.ends[1]] {
            two[0] = second;
        }
        self.wait(subsegment)?;
        self.wait(second)
    }

    /// Notes that the line between two ends is no subsegment any more.
    fn note_first_split(&mut self, ends: [VertexId; 2]) {
        for [end, other] in [ends, [ends[1], ends[0]]] {
            if let OnChain::End(end) = self.place(end) {
                if let Some(at) = self.find_at_end(end, other) {
                    self.at_ends[at].is_split = true;
                }
            }
        }
    }

    /// Queues `subsegment`, unless it waits or is limited.
    pub fn wait(&mut self, subsegment: u32) -> AllocResult<()> {
        let Subsegment { is_waiting, is_limited, .. } = &mut self.subsegments[subsegment as usize];
        if *is_waiting || *is_limited {
            return Ok(());
        }
        *is_waiting = true;
        enqueue(&mut self.waiting, subsegment)
    }

    /// Queues `subsegment`, and lets it be split although doubles are coarse there: it is no edge
    /// any more.
    pub fn wait_although_limited(&mut self, subsegment: u32) -> AllocResult<()> {
        self.subsegments[subsegment as usize].is_limited = false;
        self.wait(subsegment)
    }

    /// Returns the next subsegment to look at.
    pub fn next(&mut self) -> Option<u32> {
        let next = self.waiting.pop_front()?;
        self.subsegments[next as usize].is_waiting = false;
        Some(next)
    }

    /// Marks a subsegment as one that is not split any more, since doubles are too coarse for a
    /// vertex on it.
    pub fn limit(&mut self, subsegment: u32) {
        self.subsegments[subsegment as usize].is_limited = true;
    }

    /// Lets a subsegment be split again.
    pub fn release(&mut self, subsegment: u32) {
        self.subsegments[subsegment as usize].is_limited = false;
    }

    pub fn is_limited(&self, subsegment: u32) -> bool {
        self.get(subsegment).is_limited
    }

    /// Returns all subsegments in the order of their lines, each from its line's first end on.
    pub fn in_order(&self) -> impl Iterator<Item = &Subsegment> {
        (0..self.lines.len() as u32).flat_map(|line| {
            std::iter::successors(Some(self.get(line)), |subsegment| {
                let [_, second] = subsegment.ends;
                match self.place(second) {
                    OnChain::Between([_, next]) => Some(self.get(next)),
                    _ => None,
                }
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(number: usize) -> VertexId {
        VertexId::new(number)
    }

    /// Returns the chains of two lines from vertex 0, and one between their other ends.
    fn triangle() -> Chains {
        let line = |a, b| {
            let ends = [vertex(a), vertex(b)];
            Line { ends, segment: 0, is_sharp: [false; 2], balance: 1 }
        };
        Chains::new(vec![line(0, 1), line(2, 0), line(1, 2)], 4, &mut Watch::new(None)).unwrap()
    }

    #[test]
    fn edges_are_found_from_both_ends_before_and_after_splits() {
        let mut chains = triangle();
        let ends = |chains: &Chains, a, b| {
            let elsewhere = vertex(6);
            let found = [(a, b), (b, a)]
                .map(|(a, b)| chains.sides_of(&[vertex(a), vertex(b), elsewhere])[2]);
            assert_eq!(found[0], found[1]);
            let four = [elsewhere, vertex(a), vertex(b), VertexId::INFINITE];
            assert!(chains.edges_of(&four).eq(found[0].map(|own| (3, own))));
            found[0]
        };
        assert_eq!([ends(&chains, 0, 1), ends(&chains, 0, 2)], [Some(0), Some(1)]);
        assert_eq!([ends(&chains, 1, 2), ends(&chains, 1, 3)], [Some(2), None]);
        let middle = Fraction::ENDS[0].middle(Fraction::ENDS[1]);
        chains.split(0, vertex(4), middle).unwrap();
        let quarter = middle.middle(Fraction::ENDS[1]);
        chains.split(3, vertex(5), quarter).unwrap();
        assert_eq!(ends(&chains, 0, 1), None);
        assert_eq!([ends(&chains, 0, 4), ends(&chains, 4, 5)], [Some(0), Some(3)]);
        assert_eq!([ends(&chains, 5, 1), ends(&chains, 4, 1)], [Some(4), None]);
        assert_eq!(chains.line_through(vertex(5)), Some(0));
        assert_eq!(chains.line_through(vertex(0)), None);
        let order: Vec<[VertexId; 2]> = chains.in_order().map(|part| part.ends).collect();
        let expected = [(0, 4), (4, 5), (5, 1), (2, 0), (1, 2)];
        assert_eq!(order, expected.map(|(a, b)| [vertex(a), vertex(b)]));
        let waiting: Vec<u32> = std::iter::from_fn(|| chains.next()).collect();
        assert_eq!(waiting, [0, 1, 2, 3, 4]);
    }

    #[test]
    fn places_near_either_end_are_told_apart() {
        let [mut place, end] = Fraction::ENDS;
        for _ in 0..1000 {
            place = end.middle(place);
        }
        assert_eq!(place, Fraction { end: 1, of_line: 2f64.powi(-1000) });
        let quarter = Fraction { end: 0, of_line: 0.25 };
        assert_eq!(quarter.middle(end), Fraction { end: 1, of_line: 0.375 });
        assert_eq!(Fraction::at(1, 0.75), quarter);
        assert_eq!((quarter.seen_from(0), quarter.seen_from(1)), (0.25, 0.75));
    }
}
