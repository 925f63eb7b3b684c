//! Locality of simplices, between two parts of a run: those near the inputs with low ids, which are in
//! an order of locality (`order`), come first. Later work goes through them by id.

use super::Mesher;
use crate::error::Result;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Renumbers the simplices. All inputs must be inserted, and no simplex be on REFINELIST.
    pub(super) fn arrange_simplices(&mut self) -> Result<()> {
        debug_assert!(self.location.remaining() == 0 && self.refine.is_empty());
        let watch = &mut self.watch;
        let order = self.delaunay.arrange(self.inputs, || watch.tick(1))?;
        self.refine.renumber(&order)?;
        self.location.forget_homes();
        self.location.cover(order.len())?;
        self.report_progress()
    }
}
