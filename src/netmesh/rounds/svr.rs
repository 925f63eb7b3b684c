//! Sparse Voronoi Refinement (§3) [Hudson, Miller and Phillips, "Sparse Voronoi Refinement", 2006],
//! the algorithm that NETMESH beats: one domain and no cages. A D-ball with uninserted inputs is
//! broken by its Voronoi corner, which yields to an input near it, so that only medial inputs go in
//! and the mesh has its quality at all times. Each input is touched O(log spread) times.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::facets::floors::Purpose;
use crate::netmesh::state::hierarchy::ROOT;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Breaks D-balls until none holds an input.
    pub(in crate::netmesh) fn insert_sparsely(&mut self, cavity: &mut Cavity) -> Result<()> {
        for simplex in self.state.delaunay.complex().simplices() {
            self.queue_if_crowded(simplex)?;
        }
        while let Some(simplex) = self.crowded.pop_front() {
            if self.state.is_crowded(simplex) {
                self.break_ball(simplex, cavity)?;
                self.clean(cavity)?;
                // Its corner may have been encroached on by rounding, or two inputs lie on a
                // sphere.
                self.queue_if_crowded(simplex)?;
            }
        }
        Ok(())
    }

    /// Inserts the corner of `simplex`, or the input that it yields to. Where the corner is of no
    /// use (beyond the root cage, or doubles cannot express it) one of the inputs goes in as it is.
    fn break_ball(&mut self, simplex: SimplexId, cavity: &mut Cavity) -> Result<()> {
        if self.state.is_well_inside(simplex, ROOT) && !self.state.refine_list.is_limited(simplex) {
            self.refine_corner(simplex, Purpose::Bound, cavity)?;
        } else if let Some(input) = self.state.conflict_lists.entries(simplex).next() {
            self.insert_input(input, cavity)?;
        }
        Ok(())
    }
}
