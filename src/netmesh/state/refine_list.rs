//! REFINELIST (§6.4): simplices that were bad when they were queued. Most are gone when their turn
//! comes, for the points that mend one cell mend others beside it, and their ids are soon taken by
//! new simplices: entries tell the one from the other by a generation. Whether a simplex that is
//! still there is bad is tested when it comes up.
//!
//! While inputs go in, CLEAN runs after every insertion, the list is short, and first in is first
//! out. At the end, when many are bad at once, the one with the shortest edge comes first (as in
//! Shewchuk, "Triangle", 1996), or with the vertex that has the smallest cell: points are then
//! placed outward from where the mesh is fine, at the spacing that the bound asks for there.
//! Lengths are told apart in eight steps between powers of two, which is as good as sorting. The
//! list then has the simplices of one tile at a time (`final_refinement`).

use crate::complex::SimplexId;
use crate::memory::{AllocResult, Array, TryGrow, enqueue, with_capacity};
use std::collections::VecDeque;

const QUEUED: u8 = 1;

const LIMITED: u8 = 2;

/// The other bits of a simplex's byte count the simplices that had its id. After 64 an entry may be
/// taken for one of its successor, which does no harm.
const GENERATION: u8 = 4;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::netmesh) struct Entry {
    pub simplex: SimplexId,
    generation: u8,
}

/// Lengths with the same exponent and first three bits of the mantissa are in one bucket.
const KEPT_BITS: u32 = 49;

const BUCKETS: usize = 1 << (63 - KEPT_BITS);

#[derive(Default)]
pub(in crate::netmesh) struct RefineList {
    /// First in, first out, in each bucket; one bucket while order does not matter.
    buckets: Vec<VecDeque<Entry>>,
    /// Bit b of word w: whether bucket 64 w + b may have simplices.
    occupied: Vec<u64>,
    /// No word before this one has a bit.
    first: usize,
    flags: Array<u8>,
    /// Number of simplices queued.
    waiting: usize,
}

impl RefineList {
    pub fn new() -> AllocResult<Self> {
        let mut list = Self::default();
        list.make_buckets(1)?;
        Ok(list)
    }

    /// Splits the spare memory: `reserves` has the number of simplices for each share. `None` if it
    /// is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize], bound: usize) -> Option<Vec<Array<u8>>> {
        self.flags.cover(bound, 0).ok()?;
        self.flags.split_reserve(reserves)
    }

    /// Moves to `reserve`, which is empty.
    pub fn move_to(&mut self, reserve: Array<u8>) -> AllocResult<()> {
        self.flags.move_into(reserve)
    }

    /// Makes the last `count` of `bound` simplices those of a partition that has joined; nothing is
    /// known of them.
    pub fn join(&mut self, mut partition: Self, count: usize, bound: usize) -> AllocResult<()> {
        partition.flags.fill(0);
        partition.flags.cover(count, 0)?;
        self.flags.cover(bound - count, 0)?;
        self.flags.absorb(partition.flags)
    }

    /// Orders the list by length from now on: the simplex with the smallest one comes first. The
    /// list must be empty.
    pub fn sort_by_length(&mut self) -> AllocResult<()> {
        debug_assert!(self.is_empty());
        self.make_buckets(BUCKETS)
    }

    fn make_buckets(&mut self, count: usize) -> AllocResult<()> {
        let mut buckets = with_capacity(count)?;
        buckets.extend((0..count).map(|_| VecDeque::new()));
        self.buckets = buckets;
        self.occupied.clear();
        self.first = 0;
        self.occupied.cover(count.div_ceil(64), 0)
    }

    /// Returns true if [`Self::push`] uses lengths.
    pub fn is_sorted(&self) -> bool {
        self.buckets.len() > 1
    }

    /// Reserves memory for `simplices` simplices if the system gives it.
    pub fn expect(&mut self, simplices: usize) {
        self.flags.expect(simplices);
    }

    /// Forgets what was known of ids that new simplices have taken.
    pub fn forget(&mut self, created: &[SimplexId], bound: usize) -> AllocResult<()> {
        self.flags.cover(bound, 0)?;
        for &simplex in created {
            let flags = &mut self.flags[simplex];
            *flags = generation(*flags).wrapping_add(GENERATION);
        }
        Ok(())
    }

    /// Queues `simplex`, which has the given `length`, unless it is queued.
    pub fn push(&mut self, simplex: SimplexId, length: f64) -> AllocResult<()> {
        let flags = &mut self.flags[simplex];
        if *flags & QUEUED != 0 {
            return Ok(());
        }
        *flags |= QUEUED;
        let bucket = (length.to_bits() >> KEPT_BITS) as usize & (self.buckets.len() - 1);
        self.occupied[bucket / 64] |= 1 << (bucket % 64);
        self.first = self.first.min(bucket / 64);
        self.waiting += 1;
        let entry = Entry { simplex, generation: generation(*flags) };
        enqueue(&mut self.buckets[bucket], entry)
    }

    pub fn is_empty(&self) -> bool {
        self.waiting == 0
    }

    /// Returns the next simplex that is live, or was not replaced since it died.
    pub fn pop(&mut self) -> Option<Entry> {
        loop {
            let word = self.first;
            if *self.occupied.get(word)? == 0 {
                self.first += 1;
                continue;
            }
            let bit = self.occupied[word].trailing_zeros();
            match self.buckets[64 * word + bit as usize].pop_front() {
                Some(entry) => {
                    self.waiting -= 1;
                    if self.is_current(entry) {
                        self.flags[entry.simplex] &= !QUEUED;
                        return Some(entry);
                    }
                }
                None => self.occupied[word] &= !(1 << bit),
            }
        }
    }

    /// Returns true if no new simplex has taken the id since `entry` was queued.
    pub fn is_current(&self, entry: Entry) -> bool {
        generation(self.flags[entry.simplex]) == entry.generation
    }

    /// Returns true if the corner of `simplex` cannot be inserted for want of precision.
    pub fn is_limited(&self, simplex: SimplexId) -> bool {
        self.flags.get(simplex.index()).is_some_and(|flags| flags & LIMITED != 0)
    }

    pub fn limit(&mut self, simplex: SimplexId) {
        self.flags[simplex] |= LIMITED;
    }
}

fn generation(flags: u8) -> u8 {
    flags & !(GENERATION - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pop_all(list: &mut RefineList) -> Vec<usize> {
        std::iter::from_fn(|| list.pop()).map(|entry| entry.simplex.index()).collect()
    }

    #[test]
    fn first_in_is_first_out_until_the_shortest_edge_is_asked_for() {
        let mut list = RefineList::new().unwrap();
        list.forget(&[], 8).unwrap();
        let lengths = [4.0, 1e-300, 1e300, 0.5, 4.1, f64::from_bits(1)];
        let push_all = |list: &mut RefineList| {
            for (simplex, &length) in lengths.iter().enumerate() {
                list.push(SimplexId::new(simplex), length).unwrap();
                list.push(SimplexId::new(simplex), 1.0).unwrap();
            }
        };
        push_all(&mut list);
        assert_eq!(pop_all(&mut list), [0, 1, 2, 3, 4, 5]);
        assert!(list.is_empty() && !list.is_sorted());
        list.sort_by_length().unwrap();
        push_all(&mut list);
        assert!(!list.is_empty() && list.is_sorted());
        assert_eq!(pop_all(&mut list), [5, 1, 3, 0, 4, 2]);
        let [six, seven] = [6, 7].map(SimplexId::new);
        list.push(seven, 2.0).unwrap();
        list.push(six, 1.0).unwrap();
        assert_eq!(list.pop().unwrap().simplex, six);
        list.push(six, 1e-9).unwrap();
        assert_eq!(pop_all(&mut list), [6, 7]);
        assert!(list.is_empty());
    }

    #[test]
    fn an_entry_ends_with_its_simplex() {
        let mut list = RefineList::new().unwrap();
        list.forget(&[], 4).unwrap();
        let [zero, one, two, three] = [0, 1, 2, 3].map(SimplexId::new);
        [zero, one, two, three].iter().for_each(|&simplex| list.push(simplex, 1.0).unwrap());
        let first = list.pop().unwrap();
        assert!(first.simplex == zero && list.is_current(first));
        list.limit(two);
        list.forget(&[zero, two, three], 4).unwrap();
        assert!(!list.is_current(first) && !list.is_limited(two));
        // The new 3 is queued on its own account, and once.
        list.push(three, 1.0).unwrap();
        list.push(three, 1.0).unwrap();
        assert_eq!(pop_all(&mut list), [1, 3]);
        assert!(list.is_empty());
        (0..64).for_each(|_| list.forget(&[zero], 4).unwrap());
        assert!(!list.is_limited(zero) && !list.is_limited(one));
        list.push(zero, 1.0).unwrap();
        assert_eq!(pop_all(&mut list), [0]);
    }
}
