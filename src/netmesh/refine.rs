//! REFINELIST (§6.4): simplices that were bad when they were queued. Whether they still are is tested
//! when they come up, so an id that was reused meanwhile does no harm.
//!
//! While inputs go in, CLEAN runs after every insertion, the list is short, and first in is first out.
//! At the end, when many are bad at once, the one with the shortest edge comes first (as in Shewchuk,
//! "Triangle", 1996): points are then placed outward from where the mesh is fine, at the spacing that
//! the bound asks for there. Edges are told apart by powers of sqrt 2, which is as good as sorting.
//! The list then has the simplices of one tile at a time (`close`).

use crate::memory::{Fallible, TryGrow, enqueue, expect, with_room};
use std::collections::VecDeque;

const QUEUED: u8 = 1;
const LIMITED: u8 = 2;
const FROZEN: u8 = 4;

/// Lengths with the same exponent and first bit of the mantissa are in one bucket.
const KEPT_BITS: u32 = 51;
const BUCKETS: usize = 1 << (63 - KEPT_BITS);

#[derive(Default)]
pub(super) struct RefineList {
    /// First in, first out, in each bucket; one bucket while order does not matter.
    buckets: Vec<VecDeque<u32>>,
    /// Bit b of word w: whether bucket 64 w + b may have simplices.
    occupied: Vec<u64>,
    /// No word before this one has a bit.
    first: usize,
    flags: Vec<u8>,
    /// Number of simplices queued.
    waiting: usize,
}

impl RefineList {
    pub fn new() -> Fallible<Self> {
        let mut list = Self::default();
        list.make_buckets(1)?;
        Ok(list)
    }

    /// From now on the simplex with the shortest edge comes first. The list must be empty.
    pub fn sort_by_length(&mut self) -> Fallible<()> {
        debug_assert!(self.is_empty());
        self.make_buckets(BUCKETS)
    }

    fn make_buckets(&mut self, count: usize) -> Fallible<()> {
        let mut buckets = with_room(count)?;
        buckets.extend((0..count).map(|_| VecDeque::new()));
        self.buckets = buckets;
        self.occupied.clear();
        self.first = 0;
        self.occupied.cover(count.div_ceil(64), 0)
    }

    /// Whether [`Self::push`] looks at lengths.
    pub fn is_sorted(&self) -> bool {
        self.buckets.len() > 1
    }

    /// Makes room for so many simplices if the system gives it.
    pub fn expect(&mut self, simplices: usize) {
        expect(&mut self.flags, simplices);
    }

    /// Forgets what was known of ids that new simplices have taken.
    pub fn forget(&mut self, created: &[u32], bound: usize) -> Fallible<()> {
        self.flags.cover(bound, 0)?;
        for &simplex in created {
            self.flags[simplex as usize] &= QUEUED;
        }
        Ok(())
    }

    /// Queues `simplex`, whose shortest edge has the given `length`, unless it is queued.
    pub fn push(&mut self, simplex: u32, length: f64) -> Fallible<()> {
        let flags = &mut self.flags[simplex as usize];
        if *flags & QUEUED != 0 {
            return Ok(());
        }
        *flags |= QUEUED;
        let bucket = (length.to_bits() >> KEPT_BITS) as usize & (self.buckets.len() - 1);
        self.occupied[bucket / 64] |= 1 << (bucket % 64);
        self.first = self.first.min(bucket / 64);
        self.waiting += 1;
        enqueue(&mut self.buckets[bucket], simplex)
    }

    pub fn is_empty(&self) -> bool {
        self.waiting == 0
    }

    pub fn pop(&mut self) -> Option<u32> {
        loop {
            let word = self.first;
            if *self.occupied.get(word)? == 0 {
                self.first += 1;
                continue;
            }
            let bit = self.occupied[word].trailing_zeros();
            match self.buckets[64 * word + bit as usize].pop_front() {
                Some(simplex) => {
                    self.flags[simplex as usize] &= !QUEUED;
                    self.waiting -= 1;
                    return Some(simplex);
                }
                None => self.occupied[word] &= !(1 << bit),
            }
        }
    }

    /// Whether the corner of `simplex` cannot be inserted, for want of precision or here.
    pub fn is_limited(&self, simplex: u32) -> bool {
        self.flags.get(simplex as usize).is_some_and(|flags| flags & (LIMITED | FROZEN) != 0)
    }

    pub fn limit(&mut self, simplex: u32) {
        self.flags[simplex as usize] |= LIMITED;
    }

    /// Whether `simplex` must stay.
    pub fn is_frozen(&self, simplex: u32) -> bool {
        self.flags[simplex as usize] & FROZEN != 0
    }

    pub fn freeze(&mut self, simplex: u32) {
        self.flags[simplex as usize] |= FROZEN;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pop_all(list: &mut RefineList) -> Vec<u32> {
        std::iter::from_fn(|| list.pop()).collect()
    }

    #[test]
    fn first_in_is_first_out_until_the_shortest_edge_is_asked_for() {
        let mut list = RefineList::new().unwrap();
        list.forget(&[], 8).unwrap();
        let lengths = [4.0, 1e-300, 1e300, 0.5, 4.1, f64::from_bits(1)];
        let push_all = |list: &mut RefineList| {
            for (simplex, &length) in lengths.iter().enumerate() {
                list.push(simplex as u32, length).unwrap();
                list.push(simplex as u32, 1.0).unwrap();
            }
        };
        push_all(&mut list);
        assert_eq!(pop_all(&mut list), [0, 1, 2, 3, 4, 5]);
        assert!(list.is_empty() && !list.is_sorted());
        list.sort_by_length().unwrap();
        push_all(&mut list);
        assert!(!list.is_empty() && list.is_sorted());
        assert_eq!(pop_all(&mut list), [5, 1, 3, 0, 4, 2]);
        list.push(7, 2.0).unwrap();
        list.push(6, 1.0).unwrap();
        assert_eq!(list.pop(), Some(6));
        list.push(6, 1e-9).unwrap();
        assert_eq!(pop_all(&mut list), [6, 7]);
        assert!(list.is_empty());
    }
}
