//! The subsegments and subfacets near a point that is to go in.

use crate::memory::{AllocResult, TryGrow};

/// Subsegments and subfacets near a point, each with true if the point crosses it.
#[derive(Default)]
pub(in crate::netmesh) struct NearBoundary {
    pub subsegments: Vec<(u32, bool)>,
    pub subfacets: Vec<(u32, bool)>,
    /// Place for the keys of a sort.
    pub depths: Vec<(u64, (u32, bool))>,
}

impl NearBoundary {
    pub fn is_empty(&self) -> bool {
        self.subsegments.is_empty() && self.subfacets.is_empty()
    }

    /// Keeps those of the subsegments and of the subfacets that pass, each once, by their numbers.
    pub fn retain(
        &mut self,
        subsegments: impl FnMut(&(u32, bool)) -> bool,
        subfacets: impl FnMut(&(u32, bool)) -> bool,
    ) {
        self.subsegments.retain(subsegments);
        self.subfacets.retain(subfacets);
        self.subsegments.sort_unstable();
        self.subfacets.sort_unstable();
        self.subfacets.dedup();
    }

    pub fn clear(&mut self) {
        self.subsegments.clear();
        self.subfacets.clear();
    }

    /// Adds a subsegment, which a point crosses if it does so wherever a search comes to it.
    /// `places`: subsegment -> its place among those that were added since the search began, if it
    /// is one; any number otherwise.
    #[inline]
    pub fn note_subsegment(
        &mut self,
        subsegment: u32,
        is_crossed: bool,
        places: &mut [u32],
    ) -> AllocResult<()> {
        let place = &mut places[subsegment as usize];
        match self.subsegments.get_mut(*place as usize) {
            Some(known) if known.0 == subsegment => known.1 &= is_crossed,
            _ => {
                *place = self.subsegments.len() as u32;
                self.subsegments.try_push((subsegment, is_crossed))?;
            }
        }
        Ok(())
    }
}
