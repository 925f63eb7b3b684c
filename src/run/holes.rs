//! Holes of the facets that a mesh was given, closed without a run.

use crate::arrangement::space::fill_holes;
use crate::error::{Error, Result, message};
use crate::mesh::{HoleFilling, Mesh};

/// Largest number of edges of a hole that can be closed: the time grows with its third power.
const MOST: usize = 1000;

impl Mesh {
    /// Closes the holes of the facets in space that have at most `max_edges` edges: loops of edges
    /// at which one facet ends and no other begins. The triangles that do are between the inputs of
    /// the hole, and become the last facets, after those that the mesh has been given. They have no
    /// sharper fold than they must, so that a missing flat facet is closed within its plane. Holes
    /// that can be closed only by a triangle that is there already, or by one without an area, stay
    /// open. A run tells if the triangles cross others. The result of an earlier run stays as it
    /// is. O(n log n + sum of k^3) for n triangles and holes of k edges.
    ///
    /// # Errors
    /// `InvalidArgument` (a mesh that is not in space; `max_edges`, which must be from 3 to 1000),
    /// `Capacity`, `OutOfMemory`.
    pub fn close_holes(&mut self, max_edges: usize) -> Result<HoleFilling> {
        let dim = self.inputs().dim();
        if dim != 3 {
            let message = message!("the mesh has dimension {dim}; holes of facets are for 3D");
            return Err(Error::invalid(message));
        }
        if !(3..=MOST).contains(&max_edges) {
            let message = message!("max_edges is {max_edges}; it must be from 3 to {MOST}");
            return Err(Error::invalid(message));
        }
        let given = self.given_facets();
        let filling = fill_holes(self.inputs(), given, max_edges, &mut |_| Ok(()))?;
        if filling.holes > 0 {
            let closed = given.with_triangles(&filling.triangles, &filling.markers)?;
            self.replace_facets(closed);
        }
        Ok(filling)
    }
}
