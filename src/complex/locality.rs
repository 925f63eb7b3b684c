//! An order of locality: simplices that are near each other in the complex are near each other in
//! it.

use super::{Complex, SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{Array, TryGrow};

/// All live simplices, each assigned to a vertex nearby, its anchor.
pub(crate) struct Anchored {
    /// Simplices, sorted by anchor.
    pub order: Array<SimplexId>,
    /// Anchor -> the position in `order` where its simplices begin; one more entry has the end.
    starts: Array<u32>,
}

impl Anchored {
    /// Returns the simplices of `anchor`.
    pub fn of(&self, anchor: VertexId) -> &[SimplexId] {
        let at = anchor.index();
        &self.order[self.starts[at] as usize..self.starts[at + 1] as usize]
    }
}

impl<const D: usize> Complex<D> {
    /// Assigns the live simplices to anchors, the vertices with ids below `anchors`. The anchor of
    /// a simplex is the smallest such id among its vertices; if it has none, the one of the
    /// simplices that are fewest steps away. Simplices that are connected to no anchor, as a
    /// partition may have them, get the first. `tick` is called for every simplex, so that the
    /// caller can watch the time or give up. O(simplices + anchors).
    pub fn order_by_anchor(
        &self,
        anchors: usize,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Anchored> {
        // Arrays of this size are filled as the loops go: fresh memory may be slow to come.
        let mut owners = Array::with_capacity(self.simplex_bound())?;
        let mut reached = Array::with_capacity(self.simplex_count())?;
        for simplex in self.simplices() {
            tick()?;
            let least = self.vertices(simplex).iter().copied().min().unwrap_or(VertexId::NONE);
            let is_reached = least.index() < anchors && self.is_live(simplex);
            owners.try_push(if is_reached { least } else { VertexId::NONE })?;
            if is_reached {
                reached.try_push(simplex)?;
            }
        }
        let mut next = 0;
        while next < reached.len() {
            tick()?;
            let simplex = reached[next];
            next += 1;
            for &neighbor in self.neighbors(simplex) {
                if !owners[neighbor].is_valid() {
                    owners[neighbor] = owners[simplex];
                    reached.try_push(neighbor)?;
                }
            }
        }
        if reached.len() < self.simplex_count() {
            for simplex in self.simplices() {
                tick()?;
                if self.is_live(simplex) && !owners[simplex].is_valid() {
                    owners[simplex] = VertexId::new(0);
                    reached.try_push(simplex)?;
                }
            }
        }
        // One place further on until `order` is made, which moves each to where the next one
        // begins.
        let mut starts = Array::filled(anchors + 2, 0u32)?;
        let mut order = Array::with_capacity(reached.len())?;
        for &simplex in &reached {
            tick()?;
            order.try_push(SimplexId::NONE)?;
            starts[owners[simplex].index() + 2] += 1;
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        for &simplex in &reached {
            tick()?;
            let at = &mut starts[owners[simplex].index() + 1];
            order[*at as usize] = simplex;
            *at += 1;
        }
        Ok(Anchored { order, starts })
    }
}
