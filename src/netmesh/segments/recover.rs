//! Recovery: every subsegment becomes an edge whose diametral ball no vertex is in, and stays one.

use super::chain::Subsegment;
use super::{Crowded, name_of};
use crate::complex::{SimplexId, VertexId, position};
use crate::delaunay::Cavity;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, TryGrow};
use crate::mesh;
use crate::netmesh::cages::domains::{DomainId, ROOT};
use crate::netmesh::segments::Segments;
use crate::netmesh::{Mesher, State};
use crate::numerics::{distance, in_diametral_ball, offset_from_line};

/// A subsegment that is not so many units in the last place long stays whole where it is an edge.
const SHORTEST: f64 = 64.0;

/// One that is an edge stays whole, too, where the vertices that encroach it are no farther from it
/// than so many.
const NO_ROOM: f64 = 8.0;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Splits subsegments until all that wait are recovered.
    ///
    /// # Errors
    /// `Limit` where doubles have no room for a chain; [`Segments::crowded`] has the points where
    /// segments had to go through a common vertex.
    pub(in crate::netmesh) fn recover_segments(&mut self, cavity: &mut Cavity) -> Result<()> {
        while let Some(subsegment) = self.state.segments.chains.next() {
            self.recover(subsegment, cavity)?;
        }
        match self.state.segments.crowded.first() {
            None => Ok(()),
            Some(crowded) => Err(self.crowded_error(crowded)),
        }
    }

    /// Splits `subsegment` unless it is recovered.
    fn recover(&mut self, subsegment: u32, cavity: &mut Cavity) -> Result<()> {
        self.watch.poll_after(8)?;
        let [a, b] = self.state.segments.chains.get(subsegment).ends;
        self.leave_domains(a, b)?;
        let apexes = self.apexes(a, b);
        let [from, to] = [a, b].map(|end| self.state.delaunay.point(end));
        let encroaches = |&apex: &VertexId| {
            apex.is_valid()
                && in_diametral_ball(from, to, self.state.delaunay.point(apex)).is_positive()
        };
        let has_room = match apexes {
            None => true,
            Some(apexes) => {
                let mut encroaching = apexes.into_iter().filter(encroaches).peekable();
                if encroaching.peek().is_none() {
                    return Ok(());
                }
                !self.is_short(subsegment) && encroaching.any(|apex| self.is_apart(a, b, apex))
            }
        };
        if has_room && self.split(subsegment, cavity)? {
            return Ok(());
        }
        Ok(self.limit_subsegment(subsegment, apexes.is_some())?)
    }

    /// Returns true if a vertex is so far from the line from `a` to `b` that doubles tell vertices
    /// on this line from those on a line through the vertex. In a sharper angle, vertices as far
    /// from its apex on both lines encroach each other by their roundings, down to the apex.
    fn is_apart(&self, a: VertexId, b: VertexId, vertex: VertexId) -> bool {
        let [a, b, x] = [a, b, vertex].map(|vertex| self.state.delaunay.point(vertex));
        let flat = |x: &[f64; D]| [x[0], x[1]];
        let units = [0, 1].map(|axis| {
            let largest = a[axis].abs().max(b[axis].abs());
            largest - largest.next_down()
        });
        offset_from_line(&flat(a), &flat(b), &flat(x), units) > NO_ROOM
    }

    /// Returns true if doubles are too coarse for vertices on `subsegment`: their roundings would
    /// be as large as the distances of segments at the same end.
    fn is_short(&self, subsegment: u32) -> bool {
        let [a, b] = self.state.segments.chains.get(subsegment).ends;
        let [a, b] = [a, b].map(|end| self.state.delaunay.point(end));
        let largest = a.iter().chain(b).fold(0.0f64, |largest, x| largest.max(x.abs()));
        let unit = largest - largest.next_down();
        a.iter().zip(b).all(|(x, y)| (x - y).abs() <= SHORTEST * unit)
    }

    /// The vertices opposite the edge between `a` and `b`, if there is one.
    fn apexes(&self, a: VertexId, b: VertexId) -> Option<[VertexId; 2]> {
        // The star of an end of many lines is large, that of a vertex between two is not.
        let chains = &self.state.segments.chains;
        let (center, other) = if chains.line_through(a).is_some() { (a, b) } else { (b, a) };
        let complex = self.state.delaunay.complex();
        let first = complex.incident(center);
        let mut simplex = first;
        loop {
            let vertices = complex.vertices(simplex);
            let own = position(vertices, center);
            let [next, last] = [(own + 1) % 3, (own + 2) % 3];
            if vertices[next] == other {
                let beyond = complex.vertices(complex.neighbors(simplex)[last]);
                let apex = beyond.iter().find(|&&vertex| vertex != a && vertex != b);
                return Some([vertices[last], *apex.expect("a triangle has three vertices")]);
            }
            // Counterclockwise.
            simplex = complex.neighbors(simplex)[next];
            if simplex == first {
                return None;
            }
        }
    }

    /// Leaves a subsegment as it is for which doubles are too coarse. Where it is no edge of the
    /// mesh, it must go through a vertex beside it.
    fn limit_subsegment(&mut self, subsegment: u32, is_edge: bool) -> AllocResult<()> {
        let own = *self.state.segments.chains.get(subsegment);
        let Subsegment { ends, line, .. } = own;
        if !is_edge {
            let place = self.splitting_place(&own);
            let x = self.point_at(line, place);
            let State { delaunay, segments: Segments { chains, .. }, .. } = &self.state;
            let vertex = delaunay.vertex_at(delaunay.complex().incident(ends[0]), &x);
            let beside = vertex.and_then(|vertex| chains.line_at(vertex));
            let segment_of = |line: u32| chains.lines[line as usize].segment;
            let (segment, beside) = (segment_of(line), beside.map(segment_of));
            let crowded = Crowded { segment, beside, at: self.crowded_at(line, &x) };
            self.state.segments.crowded.try_push(crowded)?;
        }
        self.state.segments.chains.limit(subsegment);
        ends.into_iter().for_each(|end| self.state.precision_limited[end] = true);
        Ok(())
    }

    /// Returns a point on a line, with the ends of the line.
    fn crowded_at(&self, line: u32, x: &[f64; D]) -> mesh::Crowded {
        let flat = |x: &[f64; D]| [0, 1].map(|axis| x[axis]);
        let ends = self.state.segments.chains.lines[line as usize].ends;
        let mut ends = ends.map(|end| flat(self.state.delaunay.point(end)));
        let x = flat(x);
        if distance(&x, &ends[1]) < distance(&x, &ends[0]) {
            ends.swap(0, 1);
        }
        mesh::Crowded { x, ends }
    }

    fn crowded_error(&self, &Crowded { segment, beside, at }: &Crowded) -> Error {
        let [x, y] = at.x;
        let name = name_of(segment);
        let other = beside.filter(|&other| other != segment).map_or("a vertex".into(), name_of);
        let message = message!(
            "{name} passes {other} so closely near ({x:?}, {y:?}) that doubles have no room for its \
             subsegments"
        );
        Error::new(ErrorKind::Limit, message)
    }

    /// Splits `subsegment`; false where doubles have no room for a vertex on it.
    fn split(&mut self, subsegment: u32, cavity: &mut Cavity) -> Result<bool> {
        let Subsegment { ends: [a, _], line, .. } = *self.state.segments.chains.get(subsegment);
        if self.state.segments.chains.is_limited(subsegment) {
            return Ok(false);
        }
        let place = self.splitting_place(self.state.segments.chains.get(subsegment));
        let x = self.point_at(line, place);
        let near = self.state.delaunay.complex().incident(a);
        if self.state.delaunay.vertex_at(near, &x).is_some() {
            return Ok(false);
        }
        let Some(start) = self.state.delaunay.locate(near, &x) else { return Ok(false) };
        self.state.delaunay.find_cavity(start, &x, cavity)?;
        let domain = self.enter_from_segment(&x, cavity)?;
        let vertex = self.add_vertex(x)?;
        self.state.stats.segment_points += 1;
        self.state.hierarchy.set_domain(vertex, domain);
        self.state.segments.chains.split(subsegment, vertex, place)?;
        self.insert_into_cavity(vertex, cavity)?;
        Ok(true)
    }

    /// Releases the cages that a subsegment between two vertices crosses: those of the domains
    /// that have one of them.
    pub(super) fn leave_domains(&mut self, a: VertexId, b: VertexId) -> AllocResult<()> {
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

    /// The innermost domain that holds `x`, which is on a segment, after the release of all whose
    /// cages it is too close to from either side.
    pub(super) fn enter_from_segment(
        &mut self,
        x: &[f64; D],
        cavity: &Cavity,
    ) -> AllocResult<DomainId> {
        let mut domain = self.enter(x, cavity)?;
        while let Some(encroached) = self.inner_encroached_from(domain, x) {
            self.release_cage(encroached)?;
            domain = self.state.hierarchy.find(domain);
        }
        debug_assert!(domain == ROOT || self.state.hierarchy.contains(domain, x));
        Ok(domain)
    }

    /// Collects the recovered subsegments that a point with `cavity` would encroach.
    pub(super) fn find_encroached(&mut self, x: &[f64; D], cavity: &Cavity) -> AllocResult<bool> {
        let State { delaunay, segments, .. } = &mut self.state;
        let Segments { chains, encroached, crossed, .. } = segments;
        encroached.clear();
        crossed.clear();
        for &simplex in &cavity.simplices {
            let (vertices, neighbors) =
                (delaunay.complex().vertices(simplex), delaunay.complex().neighbors(simplex));
            for (subsegment, beyond) in chains.sides_of(vertices).into_iter().zip(neighbors) {
                let Some(subsegment) = subsegment else { continue };
                let [a, b] = chains.get(subsegment).ends;
                let (a, b) = (delaunay.point(a), delaunay.point(b));
                // One for which doubles are too coarse may be crossed by points farther away.
                if chains.is_limited(subsegment) && cavity.simplices.contains(beyond) {
                    crossed.try_push(subsegment)?;
                    encroached.try_push(subsegment)?;
                } else if in_diametral_ball(a, b, x).is_positive() {
                    encroached.try_push(subsegment)?;
                }
            }
        }
        Ok(!encroached.is_empty())
    }

    /// Before a vertex goes in with `cavity` that encroaches nothing.
    pub(in crate::netmesh) fn note_insertion_off_segments(
        &mut self,
        cavity: &Cavity,
    ) -> AllocResult<()> {
        self.state.segments.regions.note_insertion(cavity, false)
    }

    /// Before `vertex` goes in: what it encroaches waits. Regions stay known where all subsegments
    /// but the one that it splits are recovered, and that one is an edge.
    pub(in crate::netmesh) fn note_insertion_near_segments(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> AllocResult<()> {
        let x = *self.state.delaunay.point(vertex);
        let is_any = self.find_encroached(&x, cavity)?;
        let is_split = is_any || !self.is_within_regions(vertex, cavity);
        let Segments { chains, regions, encroached, crossed, .. } = &mut self.state.segments;
        for &subsegment in encroached.iter() {
            chains.wait(subsegment)?;
        }
        for &subsegment in crossed.iter() {
            chains.wait_although_limited(subsegment)?;
        }
        regions.note_insertion(cavity, is_split)
    }

    /// Whether no segment passes through a simplex of `cavity`, but for the one that `vertex` is
    /// on and has split: where another waits, it may be no edge. A vertex that is rounded to one
    /// side of its edge may have no conflict on the other; then a simplex on the edge, which
    /// leaves `cavity`, is beyond the two edges that replace it.
    fn is_within_regions(&self, vertex: VertexId, cavity: &Cavity) -> bool {
        let chains = &self.state.segments.chains;
        let Some(ends) = chains.neighbors_on_line(vertex) else {
            return chains.waiting_count() == 0;
        };
        let has_edge = |&simplex: &SimplexId| {
            let vertices = self.state.delaunay.complex().vertices(simplex);
            ends.iter().all(|end| vertices.contains(end))
        };
        chains.waiting_count() == 2
            && cavity.simplices.iter().filter(|simplex| has_edge(simplex)).count() == 2
    }

    /// Splits the subsegments that a Steiner point at `x` would encroach, and recovers all. False
    /// if there is none.
    pub(in crate::netmesh) fn split_encroached(
        &mut self,
        x: &[f64; D],
        cavity: &mut Cavity,
    ) -> Result<Option<bool>> {
        if !self.state.segments.is_active() || !self.find_encroached(x, cavity)? {
            return Ok(None);
        }
        let mut encroached = std::mem::take(&mut self.state.segments.encroached);
        encroached.sort_unstable();
        encroached.dedup();
        let mut is_any = false;
        for &subsegment in &encroached {
            is_any |= self.split(subsegment, cavity)?;
        }
        self.state.segments.encroached = encroached;
        self.recover_segments(cavity)?;
        Ok(Some(is_any))
    }
}
