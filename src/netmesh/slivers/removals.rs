//! Removals: a Steiner point goes, where the mesh is as good without it or becomes so by moves.

use super::journal::{Journal, Step};
use super::random::Random;
use super::vacancy::may_leave;
use super::{Slivers, View};
use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::Stats;
use crate::netmesh::Mesher;

/// What a removal may cost before vertices move: about three slivers.
const COST: f64 = 6.0;

/// What the objective may be larger by in the end, for the rounding of its terms.
const ROUNDING: f64 = 1e-6;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Removes the points from number `first` on that the mesh can do without, the last first:
    /// they were inserted for slivers that others may have mended since.
    pub(super) fn thin_out(
        &mut self,
        first: usize,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        for number in (first..self.state.delaunay.point_count()).rev() {
            if self.is_spent(slivers) {
                break;
            }
            self.watch.poll_after(200)?;
            let vertex = VertexId::new(number);
            if self.is_inserted(vertex) && self.find_vacancy(vertex, slivers)? {
                self.do_without(vertex, slivers, cavity)?;
            }
        }
        Ok(())
    }

    /// Finds the mesh without `vertex`; false if the vertex must stay.
    pub(super) fn find_vacancy(
        &mut self,
        vertex: VertexId,
        slivers: &mut Slivers<D>,
    ) -> Result<bool> {
        let Slivers { measure, penalties, vacancy, .. } = slivers;
        if !self.may_move(vertex)
            || !may_leave(&mut self.state.delaunay, vertex, &mut vacancy.hole)?
            || !self.state.hierarchy.same_domain(&vacancy.hole.vertices.ids)
            || !self.state.hierarchy.same_domain(&[vertex, vacancy.hole.vertices.ids[0]])
        {
            return Ok(false);
        }
        vacancy.measure(View::new(&self.state, self.sizes.as_ref(), penalties, measure), vertex)?;
        Ok(true)
    }

    /// Removes the vertex that `slivers.vacancy` is without, if moves then make up for it.
    fn do_without(
        &mut self,
        vertex: VertexId,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let Slivers { measure, penalties, vacancy, .. } = slivers;
        let view = View::new(&self.state, self.sizes.as_ref(), penalties, measure);
        let Some(gain) = vacancy.judge_removal(view, -COST) else { return Ok(()) };
        let random = &mut Random::of_vertex(vertex);
        slivers.journal = Some(Journal::default());
        self.remove_vertex(vertex, slivers)?;
        let wanted = -ROUNDING - gain;
        let made_up = self.move_around(wanted, random, slivers, cavity)?;
        match made_up >= wanted {
            true => self.keep_changes(slivers),
            false => self.undo_changes(slivers, cavity),
        }
    }

    /// Removes the vertex that `slivers.vacancy` is without.
    pub(super) fn remove_vertex(
        &mut self,
        vertex: VertexId,
        slivers: &mut Slivers<D>,
    ) -> Result<()> {
        let x = *self.state.delaunay.point(vertex);
        match &mut slivers.journal {
            Some(journal) => {
                let near = slivers.vacancy.hole.vertices.ids[0];
                journal.steps.try_push(Step::Removed(vertex, near))?;
            }
            None => slivers.free.try_push(vertex)?,
        }
        let mut filled = std::mem::take(&mut slivers.filled);
        self.state.delaunay.remove(vertex, &slivers.vacancy.hole, &mut filled)?;
        discount_point(&mut self.state.stats);
        self.weigh(&filled, slivers)?;
        slivers.filled = filled;
        Ok(self.note_departure(&x, &slivers.vacancy.hole.vertices.ids)?)
    }
}

/// The points of all kinds are as many as the vertices beside the inputs.
fn discount_point(stats: &mut Stats) {
    let counts = [&mut stats.off_centers, &mut stats.far_corners, &mut stats.cage_points];
    if let Some(count) = counts.into_iter().find(|count| **count > 0) {
        *count -= 1;
    }
}
