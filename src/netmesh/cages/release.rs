//! RELEASECAGE (§6.3).

use crate::memory::AllocResult;
use crate::netmesh::Mesher;
use crate::netmesh::cages::domains::DomainId;

impl<const D: usize> Mesher<'_, '_, D> {
    /// RELEASECAGE(C): its vertices become vertices of the parent domain. Their cells, and those of
    /// their neighbours, whose corners were exempt inside the cage, are examined anew.
    pub(in crate::netmesh) fn release_cage(&mut self, cage: DomainId) -> AllocResult<()> {
        debug_assert!(!self.state.interface.is_non_owned(cage));
        self.state.hierarchy.release(cage);
        self.state.stats.cages_released += 1;
        let mut affected = std::mem::take(&mut self.scratch.affected);
        affected.restart(self.state.delaunay.point_count())?;
        for at in 0..self.state.hierarchy.node(cage).cage.len() {
            let vertex = self.state.hierarchy.node(cage).cage[at];
            self.state.delaunay.star(vertex, &mut self.scratch.star)?;
            for &simplex in &self.scratch.star {
                for &other in self.state.delaunay.complex().vertices(simplex) {
                    if other.is_valid() {
                        affected.insert(other)?;
                    }
                }
            }
        }
        for &vertex in &affected.ids {
            self.examine_star(vertex)?;
        }
        self.scratch.affected = affected;
        Ok(())
    }
}
