//! Disjoint sets.

use crate::memory::{AllocResult, collected};

/// Items in disjoint sets, with path halving.
pub(super) struct Components {
    parents: Vec<u32>,
    count: usize,
}

impl Components {
    /// Puts each of `count` items into a set of its own.
    pub fn new(count: usize) -> AllocResult<Self> {
        Ok(Self { parents: collected(0..count as u32)?, count })
    }

    /// Returns the number of sets.
    pub fn count(&self) -> usize {
        self.count
    }

    fn find(&mut self, mut item: u32) -> u32 {
        while self.parents[item as usize] != item {
            let above = self.parents[item as usize];
            self.parents[item as usize] = self.parents[above as usize];
            item = above;
        }
        item
    }

    /// Makes one set of two; false if they are one.
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b) as usize] = a.min(b);
        self.count -= usize::from(a != b);
        a != b
    }
}
