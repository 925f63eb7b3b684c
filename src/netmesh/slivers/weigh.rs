//! Simplices that were made are measured, and the slivers among them queued.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::slivers::queue::Sliver;
use crate::netmesh::slivers::shape::{Measure, tetrahedron};
use crate::netmesh::slivers::stars::Stars;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::{Mesher, State};

impl State<3> {
    /// Returns true if `vertex` is no input, in no cage, and on no segment or facet. Its star may
    /// still keep it from moving.
    pub(super) fn may_move(&self, vertex: VertexId) -> bool {
        !self.is_input(vertex)
            && !self.hierarchy.cage_of(vertex).is_valid()
            && !self.is_on_boundary(vertex)
    }

    /// Measures simplices that were made, and queues those that are slivers. Some may be dead
    /// again.
    pub(super) fn weigh(&mut self, created: &[SimplexId], slivers: &mut Slivers) -> Result<()> {
        let bound = self.delaunay.complex().simplex_bound();
        slivers.penalties.cover(bound, 0.0)?;
        slivers.stars.cover(self.delaunay.point_count())?;
        self.refine_list.forget(created, bound)?;
        let now = self.now();
        for &simplex in created {
            let penalty = self.penalty(simplex, &slivers.measure)?;
            slivers.penalties[simplex] = penalty;
            self.note_corner(simplex);
            for &vertex in self.delaunay.complex().vertices(simplex) {
                if vertex.is_valid() {
                    slivers.stars.change(vertex, now);
                }
            }
            if penalty > 0.0 {
                let sliver = self.sliver(simplex, penalty);
                match &mut slivers.log {
                    Some(log) => log.fresh.try_push(sliver)?,
                    None => slivers.queue.push(sliver)?,
                }
            }
        }
        Ok(())
    }

    /// Returns the number of simplices made so far.
    pub(in crate::netmesh) fn now(&self) -> u64 {
        self.delaunay.simplices_created()
    }

    /// Returns what a simplex adds to the objective: nothing outside of the domain.
    pub(in crate::netmesh) fn penalty(
        &mut self,
        simplex: SimplexId,
        measure: &Measure,
    ) -> Result<f32> {
        let complex = self.delaunay.complex();
        let vertices = complex.vertices(simplex);
        let is_judged = complex.is_live(simplex)
            && !complex.is_infinite(simplex)
            && self.hierarchy.same_domain(vertices);
        let penalty = match is_judged {
            true => measure.penalty(&tetrahedron(&self.delaunay, vertices)) as f32,
            false => 0.0,
        };
        Ok(if penalty > 0.0 && self.is_outside(simplex)? { 0.0 } else { penalty })
    }

    /// Returns true if a star at a vertex of `sliver`, or of a simplex beside it, is another than
    /// when `time` simplices were made.
    pub(super) fn has_changed_since(&self, time: u64, sliver: &Sliver, stars: &Stars) -> bool {
        let complex = self.delaunay.complex();
        let is_new = |&vertex: &VertexId| stars.has_changed_since(time, vertex);
        let mut beside = complex.neighbors(sliver.simplex).iter();
        beside.any(|&neighbor| complex.vertices(neighbor).iter().any(is_new))
    }

    pub(super) fn sliver(&self, simplex: SimplexId, penalty: f32) -> Sliver {
        let vertices = self.delaunay.complex().vertices(simplex);
        let mut vertices: [VertexId; 4] = std::array::from_fn(|index| vertices[index]);
        vertices.sort_unstable();
        Sliver { penalty, simplex, vertices }
    }

    /// Returns true if `sliver` is still as it was when it was queued. Its id may be that of
    /// another simplex now, or of one with the same vertices, which have moved.
    pub(super) fn is_current(&self, sliver: &Sliver, penalties: &[f32]) -> bool {
        let complex = self.delaunay.complex();
        let is_vertex = |vertex: &VertexId| sliver.vertices.contains(vertex);
        complex.is_live(sliver.simplex)
            && penalties[sliver.simplex] == sliver.penalty
            && complex.vertices(sliver.simplex).iter().all(is_vertex)
    }
}

impl Mesher<'_, '_, 3> {
    /// Measures the simplices of a vertex that went in, and queues the slivers among them.
    pub(super) fn weigh_cone(&mut self, slivers: &mut Slivers) -> Result<()> {
        let created = std::mem::take(&mut self.scratch.created);
        let weighed = self.state.weigh(&created, slivers);
        self.scratch.created = created;
        weighed
    }
}
