//! Edges of facets, segments and lines, of which the edges of pieces are parts.

use super::super::TaskInSpace;
use super::super::isolated::Isolated;
use super::roundings::Roundings;
use crate::arrangement::reach::Reach;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;

/// Edges of facets, segments and lines, by their parts.
pub(super) struct Owners {
    /// Part, and an edge that it is a part of, by their ends with the smaller one first; sorted.
    parts: Vec<([u32; 2], [u32; 2])>,
    /// Edges of facets and segments, sorted, each once.
    edges: Vec<[u32; 2]>,
    /// Lines in facets, sorted, with the facets of each.
    lines: Vec<([u32; 2], u32)>,
    /// Facet -> the units in the last place of its largest coordinates.
    units: Vec<[f64; 3]>,
    /// The units of what counts as near.
    pub roundings: Roundings,
    /// Facet -> its corners if it is a triangle, otherwise [`NONE`].
    triangles: Vec<[u32; 3]>,
}

impl Owners {
    /// Collects the edges and their parts. O(n log n).
    pub fn new(points: &[[f64; 3]], task: &TaskInSpace<'_>, on: &Isolated) -> AllocResult<Self> {
        let TaskInSpace { inputs, facets, segments, .. } = *task;
        let ordered = |[from, to]: [u32; 2]| [from.min(to), from.max(to)];
        let vertex = |input: u32| inputs.vertices()[input as usize];
        let mut edges = Vec::new();
        for own in (0..facets.count()).flat_map(|facet| facets.loops(facet)) {
            for (at, &from) in own.iter().enumerate() {
                let edge = [from, own[(at + 1) % own.len()]].map(vertex);
                if edge[0] != edge[1] {
                    edges.try_push(ordered(edge))?;
                }
            }
        }
        for ends in &segments.inputs {
            edges.try_push(ordered(ends.map(vertex)))?;
        }
        edges.sort_unstable();
        edges.dedup();
        let mut lines = collected(on.lines())?;
        lines.sort_unstable();
        let mut parts = Vec::new();
        let distinct = lines.chunk_by(|a, b| a.0 == b.0).map(|same| &same[0].0);
        for &edge in edges.iter().chain(distinct) {
            for part in on.chain(edge) {
                parts.try_push((ordered(part), edge))?;
            }
        }
        parts.sort_unstable();
        parts.dedup();
        let roundings = Roundings::within(points[..inputs.distinct()].iter());
        let units_of_facet = |facet: usize| {
            let own = facets.loops(facet).flatten();
            roundings.units_of(own.map(|&input| &points[vertex(input) as usize]))
        };
        let units = collected((0..facets.count()).map(units_of_facet))?;
        let triangle = |facet: usize| {
            let mut loops = facets.loops(facet);
            match (loops.next(), loops.next()) {
                (Some(&[a, b, c]), None) => [a, b, c].map(vertex),
                _ => [NONE; 3],
            }
        };
        let triangles = collected((0..facets.count()).map(triangle))?;
        Ok(Self { parts, edges, lines, units, roundings, triangles })
    }

    /// Returns the edges of facets and segments.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// Returns the lines in facets.
    pub fn lines(&self) -> impl Iterator<Item = [u32; 2]> {
        self.lines.chunk_by(|a, b| a.0 == b.0).map(|same| same[0].0)
    }

    /// Returns the corners of a facet that is a triangle.
    pub fn triangle(&self, facet: u32) -> Option<[u32; 3]> {
        let own = self.triangles[facet as usize];
        (own[0] != NONE).then_some(own)
    }

    /// Returns the reach of a line in some facets: its vertices were computed with the coordinates
    /// of these.
    pub fn reach(
        &self,
        points: &[[f64; 3]],
        line: [u32; 2],
        facets: impl Iterator<Item = u32>,
    ) -> Reach<3> {
        let reach = self.roundings.reach(points, line);
        facets.fold(reach, |reach, facet| reach.widened(&self.units[facet as usize]))
    }

    /// Returns the facets that have a line.
    pub fn facets_with(&self, line: [u32; 2]) -> impl Iterator<Item = u32> {
        let begin = self.lines.partition_point(|own| own.0 < line);
        let own = self.lines[begin..].iter().take_while(move |own| own.0 == line);
        own.map(|own| own.1)
    }

    /// Returns the edges of which an edge is a part.
    pub fn of(&self, [from, to]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let part = [from.min(to), from.max(to)];
        let begin = self.parts.partition_point(|own| own.0 < part);
        let own = self.parts[begin..].iter().take_while(move |own| own.0 == part);
        own.map(|own| own.1)
    }

    /// Returns the edge of a facet or segment that an edge is a part of; [`NONE`] for parts of
    /// lines, and for edges between triangles of a facet.
    pub fn straight(&self, part: [u32; 2]) -> [u32; 2] {
        let mut own = self.of(part).filter(|edge| self.edges.binary_search(edge).is_ok());
        own.next().unwrap_or([NONE; 2])
    }

    /// Returns true if an edge is a part of one, instead of one between triangles of a facet.
    pub fn has(&self, part: [u32; 2]) -> bool {
        self.of(part).next().is_some()
    }
}
