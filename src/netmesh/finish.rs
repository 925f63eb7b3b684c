//! FINISHMESH (§6.6): cages grow until they meet what is outside and dissolve; one domain is left.

use super::Mesher;
use super::domains::ROOT;
use crate::error::Result;
use crate::options::Phase;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(super) fn finish_mesh(&mut self) -> Result<()> {
        self.phase = Phase::Finish;
        let first = ROOT + 1..self.hierarchy.len();
        let mut first_grown = first.end;
        for domain in first {
            self.dissolve(domain)?;
            // The larger cages in its place come next: they are where the mesh is in the cache.
            while first_grown < self.hierarchy.len() {
                first_grown += 1;
                self.dissolve(first_grown - 1)?;
            }
        }
        self.report_progress()
    }

    /// GROWCAGE and CLEAN, unless another cage has taken this one in.
    fn dissolve(&mut self, domain: u32) -> Result<()> {
        let node = self.hierarchy.node(domain);
        if !node.alive {
            return Ok(());
        }
        let near = node.cage.first().copied().unwrap_or(node.center);
        let start = self.delaunay.complex().incident(near);
        let radius = node.radius / self.parameters.epsilon;
        self.grow_cage(domain, radius, start)?;
        self.clean()
    }
}
