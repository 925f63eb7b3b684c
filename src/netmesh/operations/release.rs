//! RELEASECAGE (§6.3), and OUTENCROACH, which calls it for every cage that a new point is too close
//! to from outside.

use crate::delaunay::Cavity;
use crate::memory::AllocResult;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Releases a cage (RELEASECAGE): its vertices become vertices of the parent domain. Their
    /// cells, and those of their neighbours, whose corners were exempt inside the cage, are
    /// examined anew.
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

    /// Releases every cage that `x`, whose conflicts are `cavity`, encroaches from outside
    /// (OUTENCROACH). Returns the innermost domain that then holds `x`.
    pub(in crate::netmesh) fn enter(
        &mut self,
        x: &[f64; D],
        cavity: &Cavity,
    ) -> AllocResult<DomainId> {
        if self.state.hierarchy.is_single() {
            return Ok(ROOT);
        }
        if let Some(domain) = self.state.common_domain(cavity) {
            if self.state.hierarchy.contains(domain, x) {
                return Ok(domain);
            }
        }
        for at in 0..cavity.vertices.ids.len() {
            let mut domain = self.state.hierarchy.domain_of(cavity.vertices.ids[at]);
            while !self.state.hierarchy.contains(domain, x) {
                let parent = self.state.hierarchy.parent(domain);
                if self.state.outer_encroaches(domain, x) {
                    self.release_cage(domain)?;
                }
                domain = parent;
            }
        }
        Ok(self.state.containing_domain(x, cavity))
    }
}
