//! FINISHMESH (§6.6): cages grow until they meet what is outside and dissolve; one domain is left.

use super::Mesher;
use super::domains::ROOT;
use crate::error::Result;
use crate::options::Phase;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(super) fn finish_mesh(&mut self) -> Result<()> {
        self.phase = Phase::Finish;
        let mut domain = ROOT + 1;
        // Growing appends the larger cage, whose turn comes later.
        while domain < self.hierarchy.len() {
            if self.hierarchy.node(domain).alive {
                let node = self.hierarchy.node(domain);
                let near = node.cage.first().copied().unwrap_or(node.center);
                let start = self.delaunay.complex().incident(near);
                let radius = node.radius / self.parameters.epsilon;
                self.grow_cage(domain, radius, start)?;
                self.clean()?;
            }
            domain += 1;
        }
        self.report_progress()
    }
}
