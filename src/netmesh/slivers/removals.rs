//! Removals: a Steiner point goes, where the mesh is as good without it or becomes so by moves.

use crate::complex::VertexId;
use crate::error::Result;
use crate::netmesh::slivers::log::Log;
use crate::netmesh::slivers::random::Random;
use crate::netmesh::slivers::view::View;
use crate::netmesh::slivers::work::Slivers;
use crate::netmesh::state::Mesher;

/// Largest cost of a removal before vertices move: about three slivers.
const COST: f64 = 6.0;

/// Largest rise of the objective in the end, for the rounding of its terms.
const ROUNDING: f64 = 1e-6;

impl Mesher<'_, '_, 3> {
    /// Removes the points from number `first` on that the mesh can do without, the last first:
    /// they were inserted for slivers that others may have mended since.
    pub(super) fn thin_out(&mut self, first: usize, slivers: &mut Slivers) -> Result<()> {
        for number in (first..self.state.delaunay.point_count()).rev() {
            if self.state.is_exhausted(slivers) {
                break;
            }
            self.watch.poll_after(200)?;
            let vertex = VertexId::new(number);
            if self.state.is_inserted(vertex) && self.find_vacancy(vertex, slivers)? {
                self.do_without(vertex, slivers)?;
            }
        }
        Ok(())
    }

    /// Removes the vertex that `slivers.vacancy` is without, if moves then make up for it.
    fn do_without(&mut self, vertex: VertexId, slivers: &mut Slivers) -> Result<()> {
        let Slivers { measure, penalties, vacancy, .. } = slivers;
        let view = View::new(&self.state, self.sizes.as_ref(), penalties, measure);
        let Some(gain) = vacancy.judge_removal(view, -COST)? else { return Ok(()) };
        let random = &mut Random::of_vertex(vertex);
        slivers.log = Some(Log::default());
        self.remove_vertex(vertex, slivers)?;
        let wanted = -ROUNDING - gain;
        let made_up = self.move_around(wanted, random, slivers)?;
        match made_up >= wanted {
            true => self.state.keep_changes(slivers),
            false => self.undo_changes(slivers),
        }
    }
}
