//! Disjoint sets of items with numbers, such as triangles that a surface connects.

use super::{AllocResult, collected};

/// Disjoint sets with path halving. A set is called by its least item.
pub struct Sets {
    parents: Vec<u32>,
}

impl Sets {
    /// Returns the sets of `count` items, each alone in one.
    pub fn new(count: usize) -> AllocResult<Self> {
        Ok(Self { parents: collected(0..count as u32)? })
    }

    /// Returns the least item of the set that an item is in.
    pub fn find(&mut self, mut item: usize) -> usize {
        while self.parents[item] as usize != item {
            let above = self.parents[item] as usize;
            self.parents[item] = self.parents[above];
            item = above;
        }
        item
    }

    /// Makes one of the sets that two items are in.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.parents[a.max(b)] = a.min(b) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_called_by_its_least_item() {
        let mut sets = Sets::new(6).unwrap();
        [(5, 3), (4, 2), (3, 4)].into_iter().for_each(|(a, b)| sets.join(a, b));
        let found: Vec<_> = (0..6).map(|item| sets.find(item)).collect();
        assert_eq!(found, [0, 1, 2, 2, 2, 2]);
    }
}
