//! Vertices of the boundary in space that doubles put on top of others.

use crate::complex::VertexId;
use crate::error::{Error, ErrorKind, Result, message};
use crate::netmesh::questions::exempt::unit_of;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::segments::At;

/// Vertices on the boundary that are so many units in the last place from another one, or fewer,
/// are on top of it but for roundings.
const ON_TOP: f64 = 2.0;

/// Largest number of such vertices. Between facets that are nearer to each other than roundings of
/// their vertices there is no end of them.
const MOST_ON_TOP: u32 = 1024;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refuses too many vertices of the boundary that are on top of others, of which `vertex` may
    /// be one.
    pub(super) fn refuse_crowding(&mut self, vertex: VertexId) -> Result<()> {
        let nearest = self.state.cells[vertex].nearest;
        let Some(state) = self.state.in_space() else { return Ok(()) };
        let x = *state.delaunay.point(vertex);
        if nearest > ON_TOP * unit_of(&x) {
            return Ok(());
        }
        state.facets.on_top += 1;
        match state.facets.on_top > MOST_ON_TOP {
            true => Err(Error::new(
                ErrorKind::Limit,
                message!(
                    "doubles have no room between facets near {}: they are nearer to each other \
                     than the roundings of their vertices",
                    At(&x)
                ),
            )),
            false => Ok(()),
        }
    }
}
