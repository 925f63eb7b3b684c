//! INSERT, second half (§6.3): a vertex goes into the Voronoi diagram, and all that the state knows
//! of the simplices that it replaces is brought up to date.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::options::Algorithm;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Adds `vertex`, whose domain is set, to the Voronoi diagram. Then updates conflict lists,
    /// nearest distances and the refine list (INSERT, second half).
    pub(in crate::netmesh) fn insert_into_cavity(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> Result<()> {
        if self.state.segments.is_active() {
            self.state.note_insertion_near_segments(vertex, cavity)?;
        }
        self.insert_noted(vertex, cavity)
    }

    /// Inserts `vertex`, which encroaches no subsegment, as [`Self::insert_into_cavity`] does.
    pub(in crate::netmesh) fn insert_off_segments(
        &mut self,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> Result<()> {
        if self.state.segments.is_active() {
            self.state.note_insertion_off_segments(cavity)?;
        }
        self.insert_noted(vertex, cavity)
    }

    fn insert_noted(&mut self, vertex: VertexId, cavity: &Cavity) -> Result<()> {
        let created = &mut self.scratch.created;
        let work = 4 * cavity.boundary.len() as u32;
        self.state.delaunay.insert(vertex, cavity, created)?;
        self.state.conflict_lists.redistribute(
            &self.state.delaunay,
            cavity,
            created,
            vertex,
            &mut self.watch,
        )?;
        self.state.refine_list.forget(created, self.state.delaunay.complex().simplex_bound())?;
        self.state.interface.forget(created);
        self.state.note_created(created)?;
        if self.state.parameters.algorithm != Algorithm::Delaunay {
            self.update_star(vertex, cavity)?;
            if self.state.parameters.instruments {
                self.observe_insertion(vertex)?;
            }
        }
        if self.state.parameters.algorithm == Algorithm::Svr {
            self.queue_crowded()?;
        }
        if self.watch.is_due(work) {
            self.report_progress()?;
        }
        Ok(())
    }
}
