//! Probes: the few of many things that are measured.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::state::Mesher;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Live finite simplices at a regular stride, at most `most`.
    pub(super) fn probes(&mut self, most: usize) -> Result<Vec<SimplexId>> {
        let complex = self.state.delaunay.complex();
        let all = complex.simplices();
        let is_finite = |s: SimplexId| complex.is_live(s) && !complex.is_infinite(s);
        let mut count = 0;
        for simplex in all.clone() {
            self.watch.poll_after(1)?;
            count += usize::from(is_finite(simplex));
        }
        let step = stride(count, most);
        let mut probes = Vec::new();
        for (at, simplex) in all.filter(|&s| is_finite(s)).enumerate() {
            self.watch.poll_after(1)?;
            if at % step == 0 {
                probes.try_push(simplex)?;
            }
        }
        Ok(probes)
    }
}

/// Every how many-th of `count` things is a probe, so that there are at most `probes`.
pub(super) fn stride(count: usize, probes: usize) -> usize {
    count.div_ceil(probes).max(1)
}
