//! Probes: the few of many things that are measured.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::state::Mesher;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns live finite simplices at a regular stride, at most `most`.
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

/// Returns the stride at which at most `probes` of `count` things are probes.
pub(super) fn stride(count: usize, probes: usize) -> usize {
    count.div_ceil(probes).max(1)
}
