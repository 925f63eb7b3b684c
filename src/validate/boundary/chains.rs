//! Level 2: subsegments lead from one end of each of the caller's segments to the other. Where
//! segments overlap, the subsegments are the first one's, and those of the others lead from one end
//! of that part to the other.

use super::anchors::Anchors;
use super::edges::Edges;
use super::exact::{meets, unit_in_last_place};
use super::rims::{Keep, Rims};
use super::roundings::Roundings;
use crate::error::message;
use crate::memory::{AllocResult, Lists, TryGrow, filled};
use crate::mesh::{Inputs, NONE, Segments};
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// A segment goes through inputs and crossings that are nearer to it than rounding explains, and
/// through those near it then. None of these is farther from it than so many units of [`Roundings`]
/// of its ends, along each axis.
pub(super) const BENT: f64 = 16.0;

/// Most units by which a chain is bent that goes through inputs near the straight segment alone.
const NEAR: f64 = 4.0;

/// Length, in units of roundings of its ends, below which a segment is bent through no input on any
/// axis: rounding explains no gap beside it.
const SHORTEST: f64 = 4096.0;

/// Part of a unit of roundings of its ends up to which vertices are level along a segment.
const LEVEL: f64 = 0.25;

/// Distance from a segment up to which a vertex is on its chain.
#[derive(Clone, Copy)]
pub(super) enum Nearness {
    /// None for so many inputs, half a unit in the last place for others.
    Exact(usize),
    /// Half a unit in the last place.
    Rounded,
    /// [`NEAR`] units of roundings of the segment's ends.
    Near,
    /// [`BENT`] units of roundings of the segment's ends.
    Bent,
}

pub(super) struct Chains<'a, const D: usize> {
    view: View<'a, D>,
    /// Vertex -> the subsegments that end there.
    at: &'a Lists,
    /// Vertex -> from where the search of a way has come to it, and in which search.
    reached: Vec<(u32, u32)>,
    searches: u32,
    /// The vertices of the chain at hand.
    path: Vec<u32>,
    /// Vertices that a search has yet to leave.
    waiting: Vec<Waiting>,
    roundings: Roundings<D>,
    /// Vertex -> true if no way bends through it; vertices beyond are not such.
    is_firm: &'a [bool],
    rims: Rims,
}

/// Vertex that a search has yet to leave.
#[derive(Clone, Copy)]
struct Waiting {
    vertex: u32,
    /// Vertex that the search came from.
    before: u32,
    /// True if it came along the rim to which it keeps, without a bend, and along a subsegment of
    /// no segment: what comes so is better, by these in turn.
    is_good: [bool; 3],
}

/// A segment between two vertices, or with [`NONE`] a side of the extent, which has all
/// subsegments.
#[derive(Clone, Copy)]
pub(super) struct Way {
    pub segment: u32,
    pub ends: [u32; 2],
}

pub(super) fn check(
    inputs: &Inputs,
    segments: &Segments,
    view: View<'_, 2>,
    edges: &Edges,
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut chains = Chains::new(view, &edges.at)?;
    for segment in 0..segments.count() {
        let way = Way::of(inputs, segments, segment);
        let found = chains.follow(way)?;
        findings.check(found.is_ok(), || describe(way, found.err().unwrap_or(NONE)));
        if found.is_ok() {
            check_anchors(&chains, inputs.distinct(), edges, way, findings)?;
        }
    }
    Ok(())
}

impl Way {
    /// Returns the way of a segment of the caller's; [`NONE`] for an end that is no input.
    pub fn of(inputs: &Inputs, segments: &Segments, segment: usize) -> Self {
        let vertex = |end: u32| inputs.vertices().get(end as usize).copied().unwrap_or(NONE);
        Self { segment: segment as u32, ends: segments.inputs[segment].map(vertex) }
    }
}

pub(super) fn describe(way: Way, vertex: u32) -> Violation {
    let message = message!(
        "no subsegments lead on from vertex {vertex} on segment {}, from vertex {} to {}",
        way.segment,
        way.ends[0],
        way.ends[1]
    );
    Violation::new(ViolationKind::SegmentChain, message).vertex(vertex as usize)
}

impl<'a, const D: usize> Chains<'a, D> {
    pub fn new(view: View<'a, D>, at: &'a Lists) -> AllocResult<Self> {
        let reached = filled(view.vertex_count(), (NONE, NONE))?;
        let (path, waiting) = Default::default();
        let (roundings, is_firm, searches) = (Roundings::of_axes(), &[][..], 0);
        Ok(Self {
            view,
            at,
            reached,
            searches,
            path,
            waiting,
            roundings,
            is_firm,
            rims: Rims::default(),
        })
    }

    /// Takes other roundings from now on, and some vertices for on a way only where they are
    /// exactly.
    pub fn read(&mut self, roundings: Roundings<D>, is_firm: &'a [bool]) {
        (self.roundings, self.is_firm) = (roundings, is_firm);
    }

    /// Notes the rim of a facet's own subfacets, each subsegment with its direction.
    pub fn note_rim(&mut self, facet: u32, rim: &[(u32, bool)]) -> AllocResult<()> {
        self.rims.note(self.view.mesh.boundary.subsegments.len(), facet, rim)
    }

    /// Fills `path` as [`Self::lead`] does, keeping to the rim that was noted of a facet. A rim
    /// that begins beside the first end is come to from the other one.
    pub fn lead_along_rim(&mut self, way: Way, facet: u32, keep: Keep) -> AllocResult<bool> {
        self.rims.keep(Some((facet, keep)));
        let mut is_found = self.search_along_rim(way, keep)?;
        if keep.leaves_rim() && !(is_found && self.is_along_rim()) {
            let forwards = std::mem::take(&mut self.path);
            let [from, to] = way.ends;
            self.rims.turn_round();
            match self.search_along_rim(Way { ends: [to, from], ..way }, keep)? {
                true if self.is_along_rim() => {
                    self.path.reverse();
                    is_found = true;
                }
                _ => self.path = forwards,
            }
        }
        self.rims.keep(None);
        Ok(is_found)
    }

    fn search_along_rim(&mut self, way: Way, keep: Keep) -> AllocResult<bool> {
        let [from, to] = way.ends;
        self.path.clear();
        self.path.try_push(from)?;
        // A way that keeps to the rim as far as that leads may be bent where a straight one is.
        match keep {
            Keep::AsFar => self.search_bent(way, from, to),
            Keep::Bent => self.search_gap(way, from, to, Nearness::Bent),
            Keep::Directed | Keep::Along => self.cross_gap(way, from, to),
        }
    }

    /// Returns true if some subsegment of the way that was found last is at the rim to which
    /// searches keep.
    fn is_along_rim(&self) -> bool {
        let boundary = &self.view.mesh.boundary;
        self.path.windows(2).any(|pair| {
            self.at.of(pair[0] as usize).iter().any(|&own| {
                let is_between = boundary.subsegments[own as usize].contains(&pair[1]);
                is_between && self.rims.hold(own, pair[0] < pair[1])
            })
        })
    }

    /// Returns the vertices of the way that was found last, from end to end.
    pub fn found(&self) -> &[u32] {
        &self.path
    }

    /// Fills `path` with the vertices from end to end, along any subsegments. Returns true if there
    /// are any.
    pub fn lead(&mut self, way: Way) -> AllocResult<bool> {
        let [from, to] = way.ends;
        self.path.clear();
        self.path.try_push(from)?;
        self.cross_gap(way, from, to)
    }

    /// Fills `path` as [`Self::lead`] does, along subsegments that are as near to the way as
    /// doubles can be; so many inputs are exactly on it.
    pub fn lead_straight(&mut self, way: Way, inputs: usize) -> AllocResult<bool> {
        let [from, to] = way.ends;
        self.path.clear();
        self.path.try_push(from)?;
        self.search_gap(way, from, to, Nearness::Exact(inputs))
    }

    /// Returns true if a way is so short that no input bends it.
    pub fn is_short(&self, way: Way) -> bool {
        let [from, to] = way.ends.map(|end| self.view.point(end));
        let units = self.roundings.steps_of([from, to]);
        (0..D).all(|axis| steps(from, to, axis, units[axis]) < SHORTEST)
    }

    /// Fills `path` with the vertices of a segment from end to end; the vertex where they end
    /// before that otherwise.
    pub fn follow(&mut self, way: Way) -> AllocResult<Result<(), u32>> {
        let are_vertices = way.ends.iter().all(|&end| (end as usize) < self.view.vertex_count());
        if !are_vertices || way.ends[0] == way.ends[1] {
            return Ok(Err(way.ends[0]));
        }
        let boundary = &self.view.mesh.boundary;
        let own = boundary.parents.partition_point(|&parent| parent < way.segment)
            ..boundary.parents.partition_point(|&parent| parent <= way.segment);
        let mut last = way.ends[0];
        self.path.clear();
        self.path.try_push(last)?;
        for &[from, to] in &boundary.subsegments[own] {
            if !self.cross_gap(way, last, from)? {
                return Ok(Err(last));
            }
            if !self.advances(way, from, to) {
                return Ok(Err(from));
            }
            self.path.try_push(to)?;
            last = to;
        }
        Ok(if self.cross_gap(way, last, way.ends[1])? { Ok(()) } else { Err(last) })
    }

    /// Returns true if `b` comes after `a` along the segment on the axis on which its ends are most
    /// units in the last place apart. Level vertices may follow each other both ways: where the
    /// segment is bent its pieces of some units have ways of their own, and edges of a mesh do not
    /// lie on each other. Near zero, where doubles are finer than roundings of the ends, vertices
    /// are level that differ by less than [`LEVEL`] units of these.
    fn advances(&self, way: Way, a: u32, b: u32) -> bool {
        let (ends, axis) = (way.ends.map(|end| self.view.point(end)), self.axis_of(way));
        let level = LEVEL * self.roundings.steps_of(ends)[axis];
        let places = [a, b].map(|vertex| self.view.point(vertex)[axis]);
        let is_level = (places[0] - places[1]).abs() <= level;
        goes_on(ends.map(|end| end[axis]), places) || is_level && a != b
    }

    /// Returns the axis on which the ends of a segment are most units in the last place apart.
    fn axis_of(&self, way: Way) -> usize {
        let [from, to] = way.ends.map(|end| self.view.point(end));
        let units = self.roundings.steps_of([from, to]);
        let steps = |axis: usize| steps(from, to, axis, units[axis]);
        (1..D).fold(0, |axis, k| if steps(k) > steps(axis) { k } else { axis })
    }

    /// Returns true if an edge leads along a segment as its chain may: both ends are near it, and
    /// in its order from its first end to its second.
    pub fn leads_along(&self, way: Way, edge: [u32; 2]) -> AllocResult<bool> {
        let [from, to] = way.ends;
        if from == to || from.max(to) as usize >= self.view.vertex_count() {
            return Ok(false);
        }
        let [a, b] = if self.advances(way, edge[0], edge[1]) { edge } else { [edge[1], edge[0]] };
        let is_in_order = self.advances(way, a, b)
            && (a == from || self.advances(way, from, a))
            && (b == to || self.advances(way, b, to));
        Ok(is_in_order
            && self.is_near(way, a, Nearness::Bent)?
            && self.is_near(way, b, Nearness::Bent)?)
    }

    /// Appends the vertices from `from` to `to`, along subsegments of earlier segments: as near to
    /// the segment as doubles can be, or if there are none bent, as little as can be: other chains
    /// may lead from end to end where roundings are as wide as a box.
    fn cross_gap(&mut self, way: Way, from: u32, to: u32) -> AllocResult<bool> {
        Ok(from == to
            || self.search_gap(way, from, to, Nearness::Rounded)?
            || self.search_bent(way, from, to)?)
    }

    fn search_bent(&mut self, way: Way, from: u32, to: u32) -> AllocResult<bool> {
        Ok(self.search_gap(way, from, to, Nearness::Near)?
            || self.search_gap(way, from, to, Nearness::Bent)?)
    }

    fn search_gap(
        &mut self,
        way: Way,
        from: u32,
        to: u32,
        nearness: Nearness,
    ) -> AllocResult<bool> {
        let bends = matches!(nearness, Nearness::Near | Nearness::Bent);
        let (at, parents) = (self.at, &self.view.mesh.boundary.parents);
        self.searches += 1;
        self.waiting.clear();
        self.waiting.try_push(Waiting { vertex: from, before: from, is_good: [true; 3] })?;
        while let Some(Waiting { vertex, before, .. }) = self.waiting.pop() {
            if self.reached[vertex as usize].1 == self.searches {
                continue;
            }
            self.reached[vertex as usize] = (before, self.searches);
            if vertex == to {
                return self.append_way(from, to);
            }
            let first = self.waiting.len();
            for &own in at.of(vertex as usize) {
                let Some(next) = self.next_of_gap(way, own, [vertex, to], nearness)? else {
                    continue;
                };
                let is_straight = !bends || self.is_near(way, next, Nearness::Rounded)?;
                let is_of_none = parents[own as usize] == NONE;
                let is_good = [self.rims.hold(own, vertex < next), is_straight, is_of_none];
                self.waiting.try_push(Waiting { vertex: next, before: vertex, is_good })?;
            }
            self.sort_from_last(way, vertex, first);
        }
        Ok(false)
    }

    /// Sorts those that wait from the `first` on: what comes last goes first. That is the best; of
    /// several the nearest along the way, since a chain leaves out no vertex on it; and after all
    /// others those that are level with the vertex.
    fn sort_from_last(&mut self, way: Way, vertex: u32, first: usize) {
        let (axis, view) = (self.axis_of(way), self.view);
        let [from, to] = way.ends.map(|end| view.point(end)[axis]);
        let place = |vertex: u32| view.point(vertex)[axis];
        let goes_on = |next: u32| goes_on([from, to], [vertex, next].map(place));
        self.waiting[first..].sort_unstable_by(|one, other| {
            let (a, b) = (one.vertex, other.vertex);
            let ascending = place(a).total_cmp(&place(b));
            let from_last = if to < from { ascending } else { ascending.reverse() };
            let by_place = goes_on(a).cmp(&goes_on(b)).then(from_last).then(a.cmp(&b));
            one.is_good.cmp(&other.is_good).then(by_place)
        });
    }

    /// Returns the other end of a subsegment of an earlier segment, if it is on the way to `to`.
    fn next_of_gap(
        &self,
        way: Way,
        subsegment: u32,
        [vertex, to]: [u32; 2],
        nearness: Nearness,
    ) -> AllocResult<Option<u32>> {
        let boundary = &self.view.mesh.boundary;
        let [a, b] = boundary.subsegments[subsegment as usize];
        let next = if a == vertex { b } else { a };
        let parent = boundary.parents[subsegment as usize];
        let is_on = self.rims.allow(subsegment, vertex < next)
            && (parent < way.segment || way.segment == NONE)
            && self.advances(way, vertex, next)
            && (next == to || self.advances(way, next, to))
            && self.is_near(way, next, nearness)?;
        Ok(is_on.then_some(next))
    }

    fn append_way(&mut self, from: u32, to: u32) -> AllocResult<bool> {
        let start = self.path.len();
        let mut vertex = to;
        while vertex != from {
            self.path.try_push(vertex)?;
            vertex = self.reached[vertex as usize].0;
        }
        self.path[start..].reverse();
        Ok(true)
    }

    /// Returns true if `vertex` is no farther from the segment than `nearness` allows.
    pub fn is_near(&self, way: Way, vertex: u32, nearness: Nearness) -> AllocResult<bool> {
        let [from, to] = way.ends.map(|end| self.view.point(end));
        let p = self.view.point(vertex);
        let is_firm = self.is_firm.get(vertex as usize).copied().unwrap_or(false);
        let widths = match nearness {
            _ if is_firm => [0.0; D],
            Nearness::Exact(inputs) if (vertex as usize) < inputs => [0.0; D],
            Nearness::Exact(_) | Nearness::Rounded => p.map(unit_in_last_place),
            Nearness::Near => self.roundings.units_of([from, to]).map(|unit| 2.0 * NEAR * unit),
            Nearness::Bent => self.roundings.units_of([from, to]).map(|unit| 2.0 * BENT * unit),
        };
        meets(from, to, p, widths)
    }
}

/// Returns true if the second of two places is beyond the first on the way from end to end.
fn goes_on([from, to]: [f64; 2], [a, b]: [f64; 2]) -> bool {
    if to < from { b < a } else { a < b }
}

/// Returns the number of units between two points on an axis.
fn steps<const D: usize>(from: &[f64; D], to: &[f64; D], axis: usize, unit: f64) -> f64 {
    (to[axis] - from[axis]).abs().min(f64::MAX) / unit
}

/// Checks that the anchors on the way that was found last are near the segment itself, not only
/// near each other's lines.
fn check_anchors(
    chains: &Chains<'_, 2>,
    inputs: usize,
    edges: &Edges,
    way: Way,
    findings: &mut Findings,
) -> AllocResult<()> {
    let path = chains.found();
    let anchors = Anchors::new(chains.view, inputs, edges);
    for &vertex in path[1..path.len() - 1].iter().filter(|&&vertex| anchors.holds(vertex)) {
        let is_near = chains.is_near(way, vertex, Nearness::Bent)?;
        findings.check(is_near, || describe_distance(way.segment, vertex));
    }
    Ok(())
}

/// Describes a vertex on a segment that is too far from it.
pub(super) fn describe_distance(segment: u32, vertex: u32) -> Violation {
    let message = message!("vertex {vertex} is too far from segment {segment}");
    Violation::new(ViolationKind::SegmentLine, message).vertex(vertex as usize)
}
