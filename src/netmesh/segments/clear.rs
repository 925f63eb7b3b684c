//! Away with the Steiner vertices that the mesh of the points has before it knows of segments: with
//! them the inputs went in fast, whatever their spread. Refinement that knows of the segments puts
//! fewer vertices, and better ones, and none outside of the domain.

use crate::complex::VertexId;
use crate::delaunay::Hole;
use crate::error::Result;
use crate::netmesh::Mesher;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Removes all vertices that are neither inputs nor part of a cage, nor in the centre of one.
    pub(super) fn clear_steiner_vertices(&mut self) -> Result<()> {
        let (mut hole, mut filled) = (Hole::default(), Vec::new());
        let is_center = self.centers()?;
        for vertex in VertexId::range(self.state.inputs..self.state.delaunay.point_count()) {
            self.watch.poll_after(32)?;
            if self.is_free(vertex)
                && !is_center[vertex]
                && self.state.delaunay.find_hole(vertex, &mut hole)?
            {
                self.remove_with_regions(vertex, &hole, &mut filled)?;
            }
        }
        Ok(())
    }
}
