//! Recovery: every subsegment becomes an edge whose diametral ball no vertex is in, and stays one.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, TryGrow};
use crate::mesh;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::segments::chain::{Line, Subsegment};
use crate::netmesh::state::segments::{At, Crowded, SegmentState, name_of};
use crate::netmesh::state::{Mesher, State};
use crate::numerics::{distance, in_diametral_ball};

/// Needs of a subsegment to be recovered.
#[derive(Clone, Copy, PartialEq)]
enum Need {
    Nothing,
    Vertex,
    /// A vertex, for which doubles have no room; it may stay as it is.
    Room,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Splits subsegments until all that wait are recovered.
    ///
    /// # Errors
    /// `Limit` where doubles have no room for a chain; [`SegmentState::crowded`] has the points
    /// where segments had to go through a common vertex.
    pub(in crate::netmesh) fn recover_segments(&mut self, cavity: &mut Cavity) -> Result<()> {
        while let Some(subsegment) = self.state.segments.chains.next() {
            self.recover(subsegment, cavity)?;
        }
        match self.state.segments.crowded.first() {
            None => Ok(()),
            Some(crowded) => Err(self.state.crowded_error(crowded)),
        }
    }

    /// Splits `subsegment` unless it is recovered.
    fn recover(&mut self, subsegment: u32, cavity: &mut Cavity) -> Result<()> {
        self.watch.poll_after(8)?;
        let [a, b] = self.state.segments.chains.get(subsegment).ends;
        self.leave_domains(a, b)?;
        let need = match self.state.in_space() {
            Some(state) => match state.has_edge(a, b)? {
                true => Need::Nothing,
                false => Need::Vertex,
            },
            None => self.state.need_of(subsegment),
        };
        match need {
            Need::Nothing => Ok(()),
            Need::Vertex if self.shrink_shield_around(subsegment, cavity)? => Ok(()),
            Need::Vertex if self.split(subsegment, cavity)? => Ok(()),
            need => Ok(self.state.limit_subsegment(subsegment, need == Need::Room)?),
        }
    }

    /// Splits `subsegment`; false where doubles have no room for a vertex on it, or it is within a
    /// shield.
    pub(in crate::netmesh) fn split(
        &mut self,
        subsegment: u32,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        if self.state.segments.chains.is_limited(subsegment) {
            return Ok(false);
        }
        if self.state.as_space().is_some_and(|state| state.shield_around(subsegment).is_some()) {
            return Ok(false);
        }
        if self.shield_end_of(subsegment, cavity)? {
            return Ok(true);
        }
        let own = *self.state.segments.chains.get(subsegment);
        let (place, x) = self.state.splitting_point(&own)?;
        self.split_line_at(subsegment, place, x, cavity)
    }

    /// Releases the cages that a subsegment between two vertices crosses: those of the domains
    /// that have one of them.
    pub(in crate::netmesh) fn leave_domains(
        &mut self,
        a: VertexId,
        b: VertexId,
    ) -> AllocResult<()> {
        loop {
            let [first, second] = [a, b].map(|end| self.state.hierarchy.domain_of(end));
            if first == second {
                return Ok(());
            }
            let radius = |domain: DomainId| self.state.hierarchy.node(domain).radius;
            let inner = if radius(first) < radius(second) { first } else { second };
            self.release_cage(inner)?;
        }
    }
}

impl<const D: usize> State<D> {
    /// Returns what a subsegment of the plane needs to be recovered.
    fn need_of(&self, subsegment: u32) -> Need {
        let [a, b] = self.segments.chains.get(subsegment).ends;
        let Some(apexes) = self.apexes(a, b) else { return Need::Vertex };
        let [from, to] = [a, b].map(|end| self.delaunay.point(end));
        let encroaches = |&apex: &VertexId| {
            apex.is_valid() && in_diametral_ball(from, to, self.delaunay.point(apex)).is_positive()
        };
        let mut encroaching = apexes.into_iter().filter(encroaches).peekable();
        if encroaching.peek().is_none() {
            return Need::Nothing;
        }
        match self.is_short(subsegment) || !encroaching.any(|apex| self.is_apart([a, b], apex)) {
            true => Need::Room,
            false => Need::Vertex,
        }
    }

    /// Leaves a subsegment as it is for which doubles are too coarse. Where it cannot stay as it
    /// is, it must go through a vertex beside it.
    fn limit_subsegment(&mut self, subsegment: u32, may_stay: bool) -> AllocResult<()> {
        let own = *self.segments.chains.get(subsegment);
        let Subsegment { ends, line, .. } = own;
        if !may_stay {
            let (_, x) = self.splitting_point(&own)?;
            let State { delaunay, segments: SegmentState { chains, .. }, .. } = self;
            let vertex = delaunay.vertex_at(delaunay.complex().incident(ends[0]), &x);
            let beside = vertex.and_then(|vertex| chains.line_at(vertex));
            let segment_of = |line: u32| chains.lines[line as usize].segment;
            let (segment, beside) = (segment_of(line), beside.map(segment_of));
            let place = std::array::from_fn(|axis| x.get(axis).copied().unwrap_or(0.0));
            let at = self.crowded_at(line, &x);
            let crowded = Crowded { segment, beside, at, x: place };
            self.segments.crowded.try_push(crowded)?;
        }
        self.segments.chains.limit(subsegment);
        ends.into_iter().for_each(|end| self.precision_limited[end] = true);
        Ok(())
    }

    /// Returns a point on a line, with the ends of the line.
    fn crowded_at(&self, line: u32, x: &[f64; D]) -> mesh::Crowded {
        let flat = |x: &[f64; D]| [0, 1].map(|axis| x[axis]);
        let Line { ends, segment, .. } = self.segments.chains.lines[line as usize];
        let mut ends = ends.map(|end| flat(self.delaunay.point(end)));
        let x = flat(x);
        if distance(&x, &ends[1]) < distance(&x, &ends[0]) {
            ends.swap(0, 1);
        }
        mesh::Crowded { segment, x, ends }
    }

    fn crowded_error(&self, &Crowded { segment, beside, at, x }: &Crowded) -> Error {
        if D > 2 {
            let message = message!(
                "an edge of the facets or a segment passes a vertex so closely near {} that \
                 doubles have no room for its subsegments",
                At(&x)
            );
            return Error::new(ErrorKind::Limit, message);
        }
        let [x, y] = at.x;
        let name = name_of(segment);
        let other = beside.filter(|&other| other != segment).map_or("a vertex".into(), name_of);
        let message = message!(
            "{name} passes {other} so closely near ({x:?}, {y:?}) that doubles have no room for \
             its subsegments"
        );
        Error::new(ErrorKind::Limit, message)
    }
}
