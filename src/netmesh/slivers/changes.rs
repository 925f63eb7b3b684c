//! The three changes of a mesh: a point goes in, a vertex moves, a vertex goes.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::Stats;
use crate::netmesh::slivers::log::Step;
use crate::netmesh::slivers::vacancy::{Target, may_leave};
use crate::netmesh::slivers::view::View;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::{Cell, Mesher};

impl Mesher<'_, '_, 3> {
    /// Inserts a point into the D-ball of `start`.
    pub(super) fn insert_point(
        &mut self,
        start: SimplexId,
        x: &[f64; 3],
        slivers: &mut Slivers,
    ) -> Result<VertexId> {
        self.state.delaunay.find_cavity(start, x, &mut slivers.cavity)?;
        let domain = self.enter(x, &slivers.cavity)?;
        let vertex = match slivers.free.pop() {
            Some(vertex) => {
                self.state.delaunay.set_point(vertex, *x);
                self.state.cells[vertex] = Cell::NEW;
                self.state.precision_limited[vertex] = false;
                vertex
            }
            None => self.state.add_vertex(*x)?,
        };
        self.state.stats.off_centers += 1;
        if let Some(log) = &mut slivers.log {
            log.steps.try_push(Step::Inserted(vertex))?;
        }
        self.state.hierarchy.set_domain(vertex, domain);
        self.fill_cavity(vertex, slivers)?;
        self.weigh_cone(slivers)?;
        self.state.note_arrival(vertex, &slivers.cavity.vertices.ids);
        self.ask_size_again(vertex)?;
        Ok(vertex)
    }

    /// Moves the vertex that `slivers.vacancy` is without.
    pub(super) fn move_vertex(
        &mut self,
        vertex: VertexId,
        place: &Target,
        slivers: &mut Slivers,
    ) -> Result<()> {
        let from = *self.state.delaunay.point(vertex);
        if let Some(log) = &mut slivers.log {
            log.steps.try_push(Step::Moved(vertex, from))?;
        }
        let mut filled = std::mem::take(&mut slivers.filled);
        self.state.remove_with_regions(vertex, &slivers.vacancy.hole, &mut filled)?;
        self.state.delaunay.set_point(vertex, place.x);
        self.state.delaunay.find_cavity(filled[place.near], &place.x, &mut slivers.cavity)?;
        self.fill_cavity(vertex, slivers)?;
        self.state.cells[vertex] = Cell::NEW;
        self.state.weigh(&filled, slivers)?;
        self.weigh_cone(slivers)?;
        slivers.filled = filled;
        self.note_departure(&from, &slivers.vacancy.hole.vertices.ids)?;
        self.state.note_arrival(vertex, &slivers.cavity.vertices.ids);
        self.ask_size_again(vertex)
    }

    /// Inserts a vertex into `slivers.cavity`, which crosses no facet: what it makes is in the
    /// region of what was there.
    pub(super) fn fill_cavity(&mut self, vertex: VertexId, slivers: &Slivers) -> Result<()> {
        let created = &mut self.scratch.created;
        self.state.note_insertion_off_segments(&slivers.cavity)?;
        self.state.delaunay.insert(vertex, &slivers.cavity, created)?;
        Ok(self.state.note_created(created)?)
    }

    /// Finds the mesh without `vertex`; false if the vertex must stay.
    pub(super) fn find_vacancy(&mut self, vertex: VertexId, slivers: &mut Slivers) -> Result<bool> {
        let Slivers { measure, penalties, vacancy, .. } = slivers;
        if !self.state.may_move(vertex)
            || !may_leave(&mut self.state.delaunay, vertex, &mut vacancy.hole)?
            || !self.state.hierarchy.same_domain(&vacancy.hole.vertices.ids)
            || !self.state.hierarchy.same_domain(&[vertex, vacancy.hole.vertices.ids[0]])
        {
            return Ok(false);
        }
        vacancy.measure(View::new(&self.state, self.sizes.as_ref(), penalties, measure), vertex)?;
        Ok(true)
    }

    /// Removes the vertex that `slivers.vacancy` is without.
    pub(super) fn remove_vertex(&mut self, vertex: VertexId, slivers: &mut Slivers) -> Result<()> {
        let x = *self.state.delaunay.point(vertex);
        match &mut slivers.log {
            Some(log) => {
                let near = slivers.vacancy.hole.vertices.ids[0];
                log.steps.try_push(Step::Removed(vertex, near))?;
            }
            None => slivers.free.try_push(vertex)?,
        }
        let mut filled = std::mem::take(&mut slivers.filled);
        self.state.remove_with_regions(vertex, &slivers.vacancy.hole, &mut filled)?;
        discount_point(&mut self.state.stats);
        self.state.weigh(&filled, slivers)?;
        slivers.filled = filled;
        Ok(self.note_departure(&x, &slivers.vacancy.hole.vertices.ids)?)
    }
}

/// Takes a point that was removed out of the counts: the points of all kinds are as many as the
/// vertices beside the inputs.
fn discount_point(stats: &mut Stats) {
    let counts = [&mut stats.off_centers, &mut stats.far_corners, &mut stats.cage_points];
    if let Some(count) = counts.into_iter().find(|count| **count > 0) {
        *count -= 1;
    }
}
