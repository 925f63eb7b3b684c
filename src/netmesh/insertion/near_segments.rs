//! The subsegments and regions around a point that is to go in.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::{Cavity, Hole};
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::state::State;
use crate::netmesh::state::segments::SegmentState;
use crate::numerics::in_diametral_ball;

impl<const D: usize> State<D> {
    /// Collects the recovered subsegments that a point with `cavity` would encroach.
    pub(in crate::netmesh) fn find_encroached(
        &mut self,
        x: &[f64; D],
        cavity: &Cavity,
    ) -> AllocResult<bool> {
        let State { delaunay, segments, .. } = self;
        let SegmentState { chains, encroached, crossed, .. } = segments;
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

    /// Notes that a vertex goes in with `cavity`, and encroaches no subsegment: the new simplices
    /// will be in the regions of those that they replace.
    pub(in crate::netmesh) fn note_insertion_off_segments(
        &mut self,
        cavity: &Cavity,
    ) -> AllocResult<()> {
        self.segments.regions.note_insertion(cavity, false)
    }

    /// Notes which simplices an insertion has made.
    pub(in crate::netmesh) fn note_created(&mut self, created: &[SimplexId]) -> AllocResult<()> {
        let bound = self.delaunay.complex().simplex_bound();
        self.segments.regions.note_created(created, bound)?;
        self.facets.forget(created);
        Ok(())
    }

    /// Removes a vertex between segments and facets, whose hole is found: the simplices that fill
    /// it are in the region of those that were there.
    pub(in crate::netmesh) fn remove_with_regions(
        &mut self,
        vertex: VertexId,
        hole: &Hole<D>,
        filled: &mut Vec<SimplexId>,
    ) -> AllocResult<()> {
        self.segments.regions.note_removal(&hole.star);
        self.delaunay.remove(vertex, hole, filled)?;
        let bound = self.delaunay.complex().simplex_bound();
        self.segments.regions.note_filled(filled, bound)?;
        self.facets.forget(filled);
        Ok(())
    }

    /// Queues the subsegments that `vertex`, which goes in with `cavity`, encroaches. Regions stay
    /// known where all subsegments but the one that it splits are recovered, and that one is an
    /// edge.
    pub(super) fn note_insertion_near_segments(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> AllocResult<()> {
        if let Some(state) = self.in_space() {
            return state.note_insertion_near_facets(cavity);
        }
        let x = *self.delaunay.point(vertex);
        let is_any = self.find_encroached(&x, cavity)?;
        let is_split = is_any || !self.is_within_regions(vertex, cavity);
        for at in 0..self.segments.encroached.len() {
            let subsegment = self.segments.encroached[at];
            // It may have stayed whole beside a vertex close to its line; this one may be apart.
            if !self.is_short(subsegment) {
                self.segments.chains.release(subsegment);
            }
            self.segments.chains.wait(subsegment)?;
        }
        let SegmentState { chains, regions, crossed, .. } = &mut self.segments;
        for &subsegment in crossed.iter() {
            chains.wait_although_limited(subsegment)?;
        }
        regions.note_insertion(cavity, is_split)
    }

    /// Returns true if no segment passes through a simplex of `cavity`, but for the one that
    /// `vertex` is on and has split: where another waits, it may be no edge. A vertex that is
    /// rounded to one side of its edge may have no conflict on the other; then a simplex on the
    /// edge, which leaves `cavity`, is beyond the two edges that replace it.
    fn is_within_regions(&self, vertex: VertexId, cavity: &Cavity) -> bool {
        let chains = &self.segments.chains;
        let Some(ends) = chains.neighbors_on_line(vertex) else {
            return chains.waiting_count() == 0;
        };
        let has_edge = |&simplex: &SimplexId| {
            let vertices = self.delaunay.complex().vertices(simplex);
            ends.iter().all(|end| vertices.contains(end))
        };
        chains.waiting_count() == 2
            && cavity.simplices.iter().filter(|simplex| has_edge(simplex)).count() == 2
    }
}
