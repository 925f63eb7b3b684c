//! An order of locality: simplices that are near each other in the complex come near each other.

use super::Complex;
use crate::error::Result;
use crate::memory::{TryGrow, filled, with_room};
use crate::mesh::NONE;

impl<const D: usize> Complex<D> {
    /// The live simplices, by the vertex below `anchors` that has the smallest id among their own or,
    /// where they have none, among those of the simplices that are fewest steps away. At least one
    /// vertex must be below `anchors`. `tick` is called for every simplex, so that the caller can watch the
    /// time or give up. O(simplices + anchors).
    pub fn order_by_anchor(
        &self,
        anchors: usize,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Vec<u32>> {
        // Arrays of this size are filled as the loops go: fresh memory may be slow to come.
        let mut owners = with_room(self.simplex_bound())?;
        let mut reached = with_room(self.simplex_count())?;
        for simplex in 0..self.simplex_bound() as u32 {
            tick()?;
            let least = self.vertices(simplex).iter().copied().min().unwrap_or(NONE);
            let is_reached = (least as usize) < anchors && self.is_live(simplex);
            owners.push(if is_reached { least } else { NONE });
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
                if owners[neighbor as usize] == NONE {
                    owners[neighbor as usize] = owners[simplex as usize];
                    reached.try_push(neighbor)?;
                }
            }
        }
        let mut starts = filled(anchors + 1, 0u32)?;
        let mut order = with_room(reached.len())?;
        for &simplex in &reached {
            tick()?;
            order.push(NONE);
            starts[owners[simplex as usize] as usize + 1] += 1;
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        for &simplex in &reached {
            tick()?;
            let at = &mut starts[owners[simplex as usize] as usize];
            order[*at as usize] = simplex;
            *at += 1;
        }
        Ok(order)
    }
}
