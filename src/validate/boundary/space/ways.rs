//! Level 2: chains of subsegments lead along the caller's segments and along the edges of facets,
//! their vertices are as near to these as doubles can be, and no subsegment is on none of them.

use super::super::chains::{Chains, Nearness, Way, describe, describe_distance};
use super::super::exact::{meets, unit_in_last_place};
use super::super::rims::Keep;
use super::super::roundings::Roundings;
use super::faces::Faces;
use super::given;
use super::reading::Reading;
use super::tiling::{Directed, name_of};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::{Inputs, NONE, Segments};
use crate::options::{Crossings, Extent};
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Searches for chains between inputs, and what was found of the subsegments.
pub(super) struct Ways<'a> {
    pub view: View<'a, 3>,
    pub faces: &'a Faces,
    pub inputs: &'a Inputs,
    reading: &'a Reading,
    splits_any: bool,
    /// Roundings of what was split.
    crossings: Roundings<3>,
    chains: Chains<'a, 3>,
    keeps: &'static [Keep],
    /// Vertices of the chain that was found last.
    path: Vec<u32>,
    /// Subsegment -> true if it is on a chain.
    is_covered: Vec<bool>,
    /// Subsegment -> the first segment of the caller's whose chain has it, or [`NONE`].
    owners: Vec<u32>,
    /// Vertex -> true if it is an end of a subsegment.
    is_on_chain: Vec<bool>,
    /// Ends of the edges of facets that are read as split along which chains lead.
    split_edges: Vec<[u32; 2]>,
    /// Subfacet -> the facet that was last found to have it, or [`NONE`], and how many times.
    pub tile_of: Vec<(u32, i64)>,
    /// Triangle of the caller's -> one of those that are one facet with it, the same for all.
    pub group_of: Vec<u32>,
    /// Facets and segments that do not hold as they are read.
    pub failing: Failing,
}

/// Facets and segments for which something does not hold.
pub(super) struct Failing {
    pub facets: Vec<bool>,
    pub segments: Vec<bool>,
}

impl<'a> Ways<'a> {
    pub fn new(
        inputs: &'a Inputs,
        view: View<'a, 3>,
        faces: &'a Faces,
        reading: &'a Reading,
    ) -> AllocResult<Self> {
        let count = view.mesh.boundary.subsegments.len();
        let (chains, crossings) = (Chains::new(view, &faces.at)?, Roundings::of_crossings(inputs));
        let failing = Failing {
            facets: filled(reading.facets.len(), false)?,
            segments: filled(reading.segments.len(), false)?,
        };
        let (is_covered, owners) = (filled(count, false)?, filled(count, NONE)?);
        let mut is_on_chain = filled(view.mesh.vertex_count(), false)?;
        let ends = view.mesh.boundary.subsegments.iter().flatten();
        ends.for_each(|&vertex| is_on_chain[vertex as usize] = true);
        let tile_of = filled(view.mesh.boundary.subfacets.len(), (NONE, 0))?;
        let (path, split_edges) = Default::default();
        Ok(Self {
            view,
            faces,
            inputs,
            reading,
            splits_any: reading.splits_any(),
            crossings,
            chains,
            keeps: &[],
            path,
            is_covered,
            owners,
            is_on_chain,
            split_edges,
            tile_of,
            group_of: collected(0..reading.facets.len() as u32)?,
            failing,
        })
    }

    /// Returns true if a vertex is on a segment, or on an edge of a facet.
    pub fn is_on_chain(&self, vertex: u32) -> bool {
        self.is_on_chain[vertex as usize]
    }

    pub fn is_input(&self, vertex: u32) -> bool {
        (vertex as usize) < self.inputs.distinct()
    }

    /// Returns true if a facet is read as split; of the boundary of an extent, if any is.
    pub fn splits(&self, facet: u32) -> bool {
        let own = self.reading.facets.get(facet as usize).copied();
        own.unwrap_or(self.splits_any)
    }

    /// Returns what rounding explains of what is read as split, or as given.
    pub fn roundings(&self, splits: bool) -> Roundings<3> {
        if splits { self.crossings } else { Roundings::of_axes() }
    }

    /// Follows chains of a facet or segment that is read as split, or as given.
    fn read(&mut self, splits: bool) {
        let is_firm = if splits { &[][..] } else { &self.reading.is_firm[..] };
        self.chains.read(self.roundings(splits), is_firm);
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
            let (way, before) = (Way::of(self.inputs, segments, segment), findings.violations);
            let splits = self.reading.segments[segment];
            self.read(splits);
            let found = self.chains.follow(way)?;
            let is_there =
                findings.check(found.is_ok(), || describe(way, found.err().unwrap_or(NONE)));
            if is_there {
                self.keep_path()?;
                self.check_vertices(way, splits, findings)?;
                self.cover(way.segment);
            }
            self.failing.segments[segment] = findings.violations > before;
        }
        Ok(())
    }

    /// Searches for a chain between two inputs, along any subsegments, which is read as split or as
    /// given. Returns true if there is one.
    pub fn find(&mut self, ends: [u32; 2], splits: bool) -> AllocResult<bool> {
        self.read(splits);
        self.lead(ends, splits)
    }

    /// Searches for a chain along an edge of a facet: as [`Self::keep`] says along the rim of the
    /// facet's own subfacets, and otherwise as [`Self::find`] does.
    fn find_of_facet(&mut self, facet: u32, ends: [u32; 2]) -> AllocResult<bool> {
        let splits = self.splits(facet);
        if !self.keeps.is_empty() && self.are_vertices(ends) {
            let way = self.read_edge(ends, splits);
            let is_straight = !splits && self.chains.is_short(way);
            for &keep in self.keeps.iter().filter(|_| !is_straight) {
                if self.chains.lead_along_rim(way, facet, keep)? {
                    return self.keep_path().map(|()| true);
                }
            }
        }
        self.find(ends, splits)
    }

    /// Lets chains along edges of facets keep to the rims of these from now on, in the first of
    /// some ways in which there is one.
    pub fn keep(&mut self, keeps: &'static [Keep]) {
        self.keeps = keeps;
    }

    /// Notes the rim of a facet's own subfacets for [`Self::check_edge`].
    pub fn note_rim(&mut self, facet: u32, rim: &[Directed]) -> AllocResult<()> {
        let of = |&(ends, is_upward): &Directed| {
            self.faces.subsegment(self.view, ends).map(|own| (own, is_upward))
        };
        let own = collected(rim.iter().filter_map(of))?;
        self.chains.note_rim(facet, &own)
    }

    /// Returns true if two ends are different vertices.
    fn are_vertices(&self, ends: [u32; 2]) -> bool {
        ends[0] != ends[1] && ends.iter().all(|&end| (end as usize) < self.view.vertex_count())
    }

    /// Follows a chain of what is read as split, or as given. Only vertices at crossings bend short
    /// edges.
    fn read_edge(&mut self, ends: [u32; 2], splits: bool) -> Way {
        let way = Way { segment: NONE, ends };
        self.read(splits);
        if splits && self.chains.is_short(way) {
            let inputs = self.inputs.distinct().min(self.reading.is_firm.len());
            self.chains.read(self.crossings, &self.reading.is_firm[..inputs]);
        }
        way
    }

    /// Searches for a chain along an edge of the extent's boundary, as [`Self::find`] does. Such
    /// may bend through all inputs, where it does not lead straight on.
    fn find_of_frame(&mut self, ends: [u32; 2]) -> AllocResult<bool> {
        if self.find(ends, false)? {
            return Ok(true);
        }
        self.chains.read(self.roundings(self.splits_any), &[]);
        self.lead(ends, self.splits_any)
    }

    fn lead(&mut self, ends: [u32; 2], splits: bool) -> AllocResult<bool> {
        if !self.are_vertices(ends) {
            return Ok(false);
        }
        if self.faces.subsegment(self.view, ends).is_some() {
            self.path.clear();
            self.path.try_extend(&ends)?;
            return Ok(true);
        }
        let way = Way { segment: NONE, ends };
        let is_found = match (self.chains.is_short(way), splits) {
            (true, false) => self.chains.lead_straight(way, self.inputs.distinct())?,
            (true, true) => {
                let way = self.read_edge(ends, true);
                self.chains.lead(way)?
            }
            (false, _) => self.chains.lead(way)?,
        };
        if is_found {
            self.keep_path()?;
        }
        Ok(is_found)
    }

    /// Returns true if a corner of a triangle of inputs is so near to the edge opposite that this
    /// may be bent through it, by so much.
    pub fn is_needle(&mut self, [a, b, c]: [u32; 3], nearness: Nearness) -> AllocResult<bool> {
        self.read(true);
        for (ends, corner) in [([a, b], c), ([b, c], a), ([c, a], b)] {
            let way = Way { segment: NONE, ends };
            if !self.chains.is_short(way) && self.chains.is_near(way, corner, nearness)? {
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
        let splits = self.splits(facet);
        let is_found = match facet {
            NONE => self.find_of_frame(ends)?,
            _ => self.find_of_facet(facet, ends)?,
        };
        findings.check(is_found, || {
            let [from, to] = ends;
            let message = message!(
                "no subsegments lead along an edge of {} from vertex {from} to {to}",
                name_of(facet)
            );
            Violation::new(ViolationKind::SegmentChain, message).vertex(from as usize)
        });
        if is_found {
            self.check_vertices(Way { segment: NONE, ends }, splits, findings)?;
            self.cover(NONE);
            if splits {
                self.split_edges.try_push(ends)?;
            }
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
    fn check_vertices(&self, way: Way, splits: bool, findings: &mut Findings) -> AllocResult<()> {
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
    /// crossings are split, or where a side of a box leaves them that is bent through their inputs;
    /// and along an edge that is split there may be two ways within roundings.
    pub fn check_owners(&mut self, findings: &mut Findings) -> AllocResult<()> {
        self.read(true);
        let boundary = &self.view.mesh.boundary;
        let parameters = &self.view.mesh.parameters;
        let has_own = parameters.extent == Extent::Hull;
        let meets = parameters.crossings == Crossings::Split || parameters.extent == Extent::Box;
        let mut doubted = Vec::new();
        let is_of_frame = |ends: [u32; 2]| {
            let mut beside = self.faces.beside(self.view, ends);
            has_own && beside.any(|at| boundary.subfacet_parents[at as usize] == NONE)
        };
        for (at, (&[a, b], &parent)) in
            boundary.subsegments.iter().zip(&boundary.parents).enumerate()
        {
            let is_own = || is_of_frame([a, b]) || meets && self.is_between_facets([a, b]);
            let is_known = self.is_covered[at]
                || parent == NONE && (is_own() || self.leads_along_edge([a, b])?);
            if !is_known {
                self.doubt_facets_at([a, b], &mut doubted)?;
            }
            findings.check(is_known && parent == self.owners[at], || {
                let message = message!(
                    "subsegment {at} from vertex {a} to {b} is of segment {parent}, and no chain \
                     of that or of a facet's edge has it"
                );
                Violation::new(ViolationKind::SegmentLine, message).vertex(a as usize)
            });
        }
        self.note_failing(&doubted)
    }

    /// Adds the facets at a subsegment that is of none of their edges.
    fn doubt_facets_at(&self, ends: [u32; 2], doubted: &mut Vec<u32>) -> AllocResult<()> {
        for subfacet in self.faces.beside(self.view, ends) {
            let parent = self.view.mesh.boundary.subfacet_parents[subfacet as usize];
            if (parent as usize) < self.failing.facets.len() {
                doubted.try_push(parent)?;
            }
        }
        Ok(())
    }

    /// Notes that some facets do not hold as they are read, with all triangles that are one with
    /// them.
    fn note_failing(&mut self, facets: &[u32]) -> AllocResult<()> {
        if facets.is_empty() {
            return Ok(());
        }
        let mut is_failing = filled(self.group_of.len(), false)?;
        for &facet in facets {
            is_failing[self.group_of[facet as usize] as usize] = true;
        }
        for (own, &group) in self.failing.facets.iter_mut().zip(&self.group_of) {
            *own |= is_failing[group as usize];
        }
        Ok(())
    }

    /// Returns true if a subsegment leads along an edge of a facet that is read as split, as the
    /// chain of that may.
    fn leads_along_edge(&self, subsegment: [u32; 2]) -> AllocResult<bool> {
        for &ends in &self.split_edges {
            if self.chains.leads_along(Way { segment: NONE, ends }, subsegment)? {
                return Ok(true);
            }
        }
        Ok(false)
    }
}
