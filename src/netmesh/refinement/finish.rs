//! FINISHMESH (§6.6): cages grow until they meet what is outside and dissolve; one domain is left.

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::options::Phase;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(in crate::netmesh) fn finish_mesh(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.state.stage.phase = Phase::Finish;
        let first = ROOT.index() + 1..self.state.hierarchy.len();
        let mut first_grown = first.end;
        for domain in first {
            self.dissolve(DomainId::new(domain), cavity)?;
            // The larger cages in its place come next: they are where the mesh is in the cache.
            while first_grown < self.state.hierarchy.len() {
                first_grown += 1;
                self.dissolve(DomainId::new(first_grown - 1), cavity)?;
            }
        }
        self.report_progress()
    }

    /// Grows a cage and cleans the mesh, unless another cage has taken this one in, or the
    /// interface defers it.
    fn dissolve(&mut self, domain: DomainId, cavity: &mut Cavity) -> Result<()> {
        let node = self.state.hierarchy.node(domain);
        if !node.alive || self.state.interface.is_non_owned(domain) {
            return Ok(());
        }
        let near = node.cage.first().copied().unwrap_or(node.center);
        let start = self.state.delaunay.complex().incident(near);
        let radius = node.radius / self.state.parameters.epsilon;
        self.grow_cage(domain, radius, start, cavity)?;
        self.clean(cavity)
    }
}
