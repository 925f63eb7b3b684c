//! Disjoint sets of items, of which it is known whether they are on the same side or not.

use crate::memory::{AllocResult, collected};

/// Items in trees. Each item knows whether it is on the side of the item above it.
pub struct SignedForest {
    /// Twice the item above, plus 1 if that is on the other side; a root is above itself.
    above: Vec<u32>,
}

impl SignedForest {
    /// Largest number of items.
    pub const CAPACITY: usize = 1 << 31;

    /// Makes a tree of each of `count` items.
    pub fn new(count: usize) -> AllocResult<Self> {
        Ok(Self { above: collected((0..count as u32).map(|item| item << 1))? })
    }

    /// Returns the root of an item's tree, and true if the item is on the other side than the root.
    pub fn side(&mut self, item: u32) -> (u32, bool) {
        let (mut item, mut is_other) = (item, 0);
        loop {
            let link = self.above[item as usize];
            if link >> 1 == item {
                return (item, is_other == 1);
            }
            // Path halving: the item moves up to its grandparent.
            let halved = self.above[(link >> 1) as usize] ^ (link & 1);
            self.above[item as usize] = halved;
            (item, is_other) = (halved >> 1, is_other ^ (halved & 1));
        }
    }

    /// Makes one tree of those of two items, on the same side or not; false if it is known already
    /// that they lie otherwise.
    pub fn join(&mut self, a: u32, b: u32, are_opposite: bool) -> bool {
        let ((a, a_is_other), (b, b_is_other)) = (self.side(a), self.side(b));
        let sign = a_is_other ^ b_is_other ^ are_opposite;
        self.above[a.max(b) as usize] = match a == b {
            true => return !sign,
            false => a.min(b) << 1 | u32::from(sign),
        };
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::SplitMix;

    #[test]
    fn sides_agree_with_a_colouring() {
        let mut random = SplitMix(1);
        let colours: Vec<bool> = (0..200).map(|_| random.next_word() % 2 == 0).collect();
        let mut forest = SignedForest::new(colours.len()).unwrap();
        for _ in 0..1000 {
            let [a, b] = [0, 1].map(|_| (random.next_word() % 200) as usize);
            assert!(forest.join(a as u32, b as u32, colours[a] != colours[b]));
        }
        let (root, _) = forest.side(0);
        for item in 0..200 {
            let (of_item, is_other) = forest.side(item);
            assert_eq!(
                (of_item, is_other),
                (root, colours[item as usize] != colours[root as usize])
            );
        }
        assert!(!forest.join(3, 3, true) && forest.join(3, 3, false));
    }
}
