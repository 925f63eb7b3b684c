//! The sizes at vertices that come or move.

use crate::complex::VertexId;
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::sizes::UNKNOWN;

impl Mesher<'_, '_, 3> {
    /// Asks for the sizes at all vertices that have none yet, after slivers were mended.
    pub(super) fn ask_all_sizes(&mut self) -> Result<()> {
        if self.sizes.is_none() {
            return Ok(());
        }
        for simplex in self.state.delaunay.complex().simplices() {
            self.watch.poll_after(1)?;
            let Some(sizes) = &mut self.sizes else { return Ok(()) };
            if self.state.delaunay.complex().is_live(simplex) {
                sizes.excess(&self.state.delaunay, simplex, f64::INFINITY)?;
            }
        }
        Ok(())
    }

    /// Asks for the size at `vertex`, which has come or moved.
    pub(super) fn ask_size_again(&mut self, vertex: VertexId) -> Result<()> {
        let Some(sizes) = &mut self.sizes else { return Ok(()) };
        if let Some(answer) = sizes.answers.get_mut(vertex.index()) {
            *answer = UNKNOWN;
        }
        sizes.ask(vertex, self.state.delaunay.point(vertex)).map(drop)
    }
}
