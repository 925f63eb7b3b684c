//! CLEAN (§6.4): simplices are taken from REFINELIST and mended until it is empty.

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::state::facets::floors::Purpose;
use crate::netmesh::state::refine_list::Entry;
use crate::netmesh::state::{Mesher, State};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines until no cell is bad that doubles can mend (CLEAN).
    pub(in crate::netmesh) fn clean(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.recover_boundary(cavity)?;
        while let Some(entry) = self.state.refine_list.pop() {
            let simplex = entry.simplex;
            if !self.state.delaunay.complex().is_live(simplex) {
                continue;
            }
            if self.state.is_exempt(simplex) || self.state.is_outside(simplex)? {
                continue;
            }
            if self.state.is_bad(simplex) {
                self.refine_corner(simplex, Purpose::Bound, cavity)?;
            } else if let Some(domain) = self.state.open_domain(simplex) {
                self.narrow_cage_gap(simplex, domain, Purpose::Bound, cavity)?;
            }
            self.recover_boundary(cavity)?;
            self.state.queue_again(entry)?;
        }
        Ok(())
    }
}

impl<const D: usize> State<D> {
    /// Queues the simplex of `entry` again if it is still there and bad: an input that was yielded
    /// to may lie on the D-ball within rounding, and a further cage vertex beyond it.
    fn queue_again(&mut self, entry: Entry) -> AllocResult<()> {
        if self.refine_list.is_current(entry) && self.delaunay.complex().is_live(entry.simplex) {
            self.examine(entry.simplex)?;
        }
        Ok(())
    }
}
