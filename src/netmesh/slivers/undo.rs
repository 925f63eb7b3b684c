//! Changes are kept, or undone.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::slivers::log::{Log, Step};
use crate::netmesh::slivers::queue::UNTRIED;
use crate::netmesh::slivers::vacancy::Target;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::{Cell, Mesher, State};

impl State<3> {
    /// Ends the log: all that it has stays.
    pub(super) fn keep_changes(&mut self, slivers: &mut Slivers) -> Result<()> {
        let Some(log) = slivers.log.take() else { return Ok(()) };
        for step in log.steps {
            if let Step::Removed(vertex, _) = step {
                slivers.free.try_push(vertex)?;
            }
        }
        for sliver in log.fresh.into_iter().chain(log.failed) {
            if self.is_current(&sliver, &slivers.penalties) {
                slivers.queue.push(sliver)?;
            }
        }
        Ok(())
    }
}

impl Mesher<'_, '_, 3> {
    /// Ends the log and undoes what it has, the last step first. The slivers that come back
    /// wait for another pass.
    pub(super) fn undo_changes(&mut self, slivers: &mut Slivers) -> Result<()> {
        let steps = slivers.log.take().unwrap_or_default().steps;
        // What comes back is not new.
        slivers.log = Some(Log::default());
        for &step in steps.iter().rev() {
            let is_undone = match step {
                Step::Removed(vertex, near) => self.put_back(vertex, near, slivers)?,
                Step::Inserted(vertex) => self.take_out(vertex, slivers)?,
                Step::Moved(vertex, x) => self.move_back(vertex, &x, slivers)?,
            };
            debug_assert!(is_undone, "the mesh is as it was after the step");
            if !is_undone {
                break;
            }
        }
        for sliver in slivers.log.take().unwrap_or_default().fresh {
            if self.state.is_current(&sliver, &slivers.penalties) {
                slivers.queue.fail(sliver, UNTRIED)?;
            }
        }
        Ok(())
    }

    fn take_out(&mut self, vertex: VertexId, slivers: &mut Slivers) -> Result<bool> {
        let is_found = self.state.delaunay.find_hole(vertex, &mut slivers.vacancy.hole)?;
        if is_found {
            self.remove_vertex(vertex, slivers)?;
            slivers.free.try_push(vertex)?;
        }
        Ok(is_found)
    }

    fn move_back(&mut self, vertex: VertexId, x: &[f64; 3], slivers: &mut Slivers) -> Result<bool> {
        if !self.state.delaunay.find_hole(vertex, &mut slivers.vacancy.hole)? {
            return Ok(false);
        }
        let Some(near) = slivers.vacancy.filling_at(&self.state.delaunay, x) else {
            return Ok(false);
        };
        let place = Target { x: *x, gain: 0.0, near, is_clean: false };
        self.move_vertex(vertex, &place, slivers)?;
        Ok(true)
    }

    /// Inserts a vertex that was removed. `near` was a neighbour.
    fn put_back(
        &mut self,
        vertex: VertexId,
        near: VertexId,
        slivers: &mut Slivers,
    ) -> Result<bool> {
        let x = *self.state.delaunay.point(vertex);
        let start = self.state.delaunay.complex().incident(near);
        let Some(start) = self.state.delaunay.locate(start, &x) else { return Ok(false) };
        self.state.delaunay.find_cavity(start, &x, &mut slivers.cavity)?;
        self.fill_cavity(vertex, slivers)?;
        self.state.cells[vertex] = Cell::NEW;
        self.state.stats.off_centers += 1;
        self.weigh_cone(slivers)?;
        self.state.note_arrival(vertex, &slivers.cavity.vertices.ids);
        Ok(true)
    }
}
