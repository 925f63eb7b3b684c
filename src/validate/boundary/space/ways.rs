//! Level 2: chains of subsegments lead along the caller's segments and along the edges of facets,
//! their vertices are as near to these as doubles can be, and no subsegment is on none of them.

use super::super::Outline;
use super::super::chains::{Chains, Nearness, Way, describe, describe_distance};
use super::super::exact::{meets, unit_in_last_place};
use super::super::roundings::Roundings;
use super::faces::Faces;
use super::given;
use super::tiling::name_of;
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::{Inputs, NONE, Segments};
use crate::options::{Crossings, Extent};
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Searches for chains between inputs, and what was found of the subsegments.
pub(super) struct Ways<'a> {
    pub view: View<'a, 3>,
    pub faces: &'a Faces,
    pub inputs: &'a Inputs,
    pub roundings: Roundings<3>,
    chains: Chains<'a, 3>,
    /// Vertices of the chain that was found last.
    path: Vec<u32>,
    /// Subsegment -> true if it is on a chain.
    is_covered: Vec<bool>,
    /// Subsegment -> the first segment of the caller's whose chain has it, or [`NONE`].
    owners: Vec<u32>,
    /// Vertex -> true if it is an end of a subsegment.
    is_on_chain: Vec<bool>,
    /// Subfacet -> the facet that was last found to have it, or [`NONE`], and how many times.
    pub tile_of: Vec<(u32, i64)>,
    /// How the mesh is read.
    crossings: Crossings,
}

impl<'a> Ways<'a> {
    /// Makes ways in a mesh that is read as one whose facets and segments were split where they
    /// cross, or were refused if they did: then they go through each other's inputs nowhere.
    pub fn new(
        inputs: &'a Inputs,
        outline: Option<Outline<'_>>,
        view: View<'a, 3>,
        faces: &'a Faces,
        crossings: Crossings,
    ) -> AllocResult<Self> {
        let count = view.mesh.boundary.subsegments.len();
        let (roundings, is_firm) = match crossings {
            Crossings::Split => (Roundings::of_crossings(inputs), Vec::new()),
            Crossings::Refuse => (Roundings::of_axes(), held(inputs, outline)?),
        };
        let chains = Chains::new(view, &faces.at)?.with_roundings(roundings).with_firm(is_firm);
        let (is_covered, owners) = (filled(count, false)?, filled(count, NONE)?);
        let mut is_on_chain = filled(view.mesh.vertex_count(), false)?;
        let ends = view.mesh.boundary.subsegments.iter().flatten();
        ends.for_each(|&vertex| is_on_chain[vertex as usize] = true);
        let (tile_of, path) = (filled(view.mesh.boundary.subfacets.len(), (NONE, 0))?, Vec::new());
        Ok(Self {
            view,
            faces,
            inputs,
            roundings,
            chains,
            path,
            is_covered,
            owners,
            is_on_chain,
            tile_of,
            crossings,
        })
    }

    /// Returns true if a vertex is on a segment, or on an edge of a facet.
    pub fn is_on_chain(&self, vertex: u32) -> bool {
        self.is_on_chain[vertex as usize]
    }

    pub fn is_input(&self, vertex: u32) -> bool {
        (vertex as usize) < self.inputs.distinct()
    }

    /// Returns true if the mesh is read as one whose crossings were split.
    pub fn splits_crossings(&self) -> bool {
        self.crossings == Crossings::Split
    }

    /// Returns true if two facets have subfacets beside a subsegment.
    fn is_between_facets(&self, ends: [u32; 2]) -> bool {
        let facet = |subfacet: u32| self.faces.facets[subfacet as usize];
        let mut beside = self.faces.beside(self.view, ends).map(facet);
        beside.next().is_some_and(|first| beside.any(|other| other != first))
    }

    /// Returns the point of a distinct input.
    pub fn input(&self, vertex: u32) -> &'a [f64; 3] {
        given::point(self.inputs, vertex)
    }

    /// Returns the vertices of the chain that was found last, from end to end.
    pub fn vertices_on_way(&self) -> &[u32] {
        &self.path
    }

    /// Checks the chains of the caller's segments.
    pub fn check_segments(
        &mut self,
        segments: &Segments,
        findings: &mut Findings,
    ) -> AllocResult<()> {
        for segment in 0..segments.count() {
            let way = Way::of(self.inputs, segments, segment);
            let found = self.chains.follow(way)?;
            let is_there =
                findings.check(found.is_ok(), || describe(way, found.err().unwrap_or(NONE)));
            if is_there {
                self.keep_path()?;
                self.check_vertices(way, findings)?;
                self.cover(way.segment);
            }
        }
        Ok(())
    }

    /// Searches for a chain between two inputs, along any subsegments; whether there is one.
    pub fn find(&mut self, ends: [u32; 2]) -> AllocResult<bool> {
        let are_vertices = ends.iter().all(|&end| (end as usize) < self.view.vertex_count());
        if !are_vertices || ends[0] == ends[1] {
            return Ok(false);
        }
        if self.faces.subsegment(self.view, ends).is_some() {
            self.path.clear();
            self.path.try_extend(&ends)?;
            return Ok(true);
        }
        let way = Way { segment: NONE, ends };
        // Only vertices at crossings bend short edges.
        let is_straight = !self.splits_crossings() && self.chains.is_short(way);
        let is_found = match is_straight {
            true => self.chains.lead_straight(way, self.inputs.distinct())?,
            false => self.chains.lead(way)?,
        };
        if is_found {
            self.keep_path()?;
        }
        Ok(is_found)
    }

    /// Returns true if a corner of a triangle of inputs is so near to the edge opposite that this
    /// may be bent through it.
    pub fn is_needle(&self, [a, b, c]: [u32; 3]) -> AllocResult<bool> {
        for (ends, corner) in [([a, b], c), ([b, c], a), ([c, a], b)] {
            let way = Way { segment: NONE, ends };
            if !self.chains.is_short(way) && self.chains.is_near(way, corner, Nearness::Bent)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Checks that a chain leads along an edge of a facet; whether one does.
    pub fn check_edge(
        &mut self,
        facet: u32,
        ends: [u32; 2],
        findings: &mut Findings,
    ) -> AllocResult<bool> {
        let is_found = self.find(ends)?;
        findings.check(is_found, || {
            let [from, to] = ends;
            let message = message!(
                "no subsegments lead along an edge of {} from vertex {from} to {to}",
                name_of(facet)
            );
            Violation::new(ViolationKind::SegmentChain, message).vertex(from as usize)
        });
        if is_found {
            self.check_vertices(Way { segment: NONE, ends }, findings)?;
            self.cover(NONE);
        }
        Ok(is_found)
    }

    fn keep_path(&mut self) -> AllocResult<()> {
        self.path.clear();
        self.path.try_extend(self.chains.found())
    }

    /// Notes that the subsegments of the chain that was found last are on one.
    fn cover(&mut self, segment: u32) {
        for pair in self.path.windows(2) {
            if let Some(subsegment) = self.faces.subsegment(self.view, [pair[0], pair[1]]) {
                self.is_covered[subsegment as usize] = true;
                let owner = &mut self.owners[subsegment as usize];
                *owner = segment.min(*owner);
            }
        }
    }

    /// Checks that inputs on the chain that was found last are near its way, and other vertices
    /// within half a unit in the last place of the line between the inputs next to them. If
    /// crossings are split, they may be as far from the way as inputs.
    fn check_vertices(&self, way: Way, findings: &mut Findings) -> AllocResult<()> {
        let splits = self.splits_crossings();
        let mut from = 0;
        for to in 1..self.path.len() {
            let end = self.path[to];
            if !self.is_input(end) && !splits {
                continue;
            }
            if end != way.ends[1] {
                let is_near = self.chains.is_near(way, end, Nearness::Bent)?;
                findings.check(is_near, || describe_distance(way.segment, end));
            }
            for at in from + 1..to {
                self.check_line([self.path[from], end], self.path[at], findings)?;
            }
            from = to;
        }
        Ok(())
    }

    fn check_line(&self, ends: [u32; 2], vertex: u32, findings: &mut Findings) -> AllocResult<()> {
        let [a, b] = ends.map(|end| self.view.point(end));
        let p = self.view.point(vertex);
        let is_near = meets(a, b, p, p.map(unit_in_last_place))?;
        findings.check(is_near, || {
            let [from, to] = ends;
            let message = message!(
                "vertex {vertex} is more than half a unit in the last place off the line from \
                 vertex {from} to {to}"
            );
            Violation::new(ViolationKind::SegmentLine, message).vertex(vertex as usize)
        });
        Ok(())
    }

    /// Checks that every subsegment is on a chain, and of the first segment that has it. The
    /// boundary of a hull has subsegments of its own, and so have facets where they cross, if
    /// crossings are split.
    pub fn check_owners(&self, findings: &mut Findings) {
        let boundary = &self.view.mesh.boundary;
        let has_own = self.view.mesh.parameters.extent == Extent::Hull;
        let is_of_frame = |ends: [u32; 2]| {
            let mut beside = self.faces.beside(self.view, ends);
            has_own && beside.any(|at| boundary.subfacet_parents[at as usize] == NONE)
        };
        for (at, (&[a, b], &parent)) in
            boundary.subsegments.iter().zip(&boundary.parents).enumerate()
        {
            let is_own =
                || is_of_frame([a, b]) || self.splits_crossings() && self.is_between_facets([a, b]);
            let is_known = self.is_covered[at] || parent == NONE && is_own();
            findings.check(is_known && parent == self.owners[at], || {
                let message = message!(
                    "subsegment {at} from vertex {a} to {b} is of segment {parent}, and no chain \
                     of that or of a facet's edge has it"
                );
                Violation::new(ViolationKind::SegmentLine, message).vertex(a as usize)
            });
        }
    }
}

/// Returns for each distinct input true if a facet or segment of the caller's has it.
fn held(inputs: &Inputs, outline: Option<Outline<'_>>) -> AllocResult<Vec<bool>> {
    let mut is_held = filled(inputs.distinct(), false)?;
    let Some(Outline { segments, facets, .. }) = outline else { return Ok(is_held) };
    for &input in segments.inputs.as_flattened().iter().chain(&facets.inputs) {
        let vertex = inputs.vertices().get(input as usize);
        if let Some(is_held) = vertex.and_then(|&vertex| is_held.get_mut(vertex as usize)) {
            *is_held = true;
        }
    }
    Ok(is_held)
}
