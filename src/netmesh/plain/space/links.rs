//! Faces that wait for the other face at their edge: how the tetrahedra of a star find each other.

use super::tetrahedra::Face;
use crate::memory::{AllocResult, TryGrow};

/// A table of edges, open addressing.
pub(super) struct Links {
    slots: Vec<Slot>,
    /// Stamp of the slots of this star.
    stamp: u32,
    /// Bits of a hash that are not used.
    shift: u32,
}

#[derive(Clone, Copy, Default)]
struct Slot {
    edge: u64,
    face: Face,
    stamp: u32,
}

impl Links {
    pub fn new() -> Self {
        Self { slots: Vec::new(), stamp: 0, shift: u64::BITS }
    }

    /// Forgets all, and makes room for the edges of so many triangles that enclose a star.
    pub fn begin(&mut self, triangles: usize) -> AllocResult<()> {
        let wanted = (4 * triangles).next_power_of_two().max(256);
        if self.slots.len() < wanted || self.stamp == u32::MAX {
            self.slots.clear();
            self.slots.cover(wanted, Slot::default())?;
            self.shift = u64::BITS - wanted.trailing_zeros();
            self.stamp = 0;
        }
        self.stamp += 1;
        Ok(())
    }

    /// Returns the other face at an edge if it was here; otherwise this one will wait.
    #[inline]
    pub fn meet(&mut self, a: u32, b: u32, face: Face) -> Option<Face> {
        const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
        let edge = if a < b {
            u64::from(a) << 32 | u64::from(b)
        } else {
            u64::from(b) << 32 | u64::from(a)
        };
        let mask = self.slots.len() - 1;
        let mut at = (edge.wrapping_mul(GOLDEN) >> self.shift) as usize;
        loop {
            let slot = &mut self.slots[at & mask];
            if slot.stamp != self.stamp {
                *slot = Slot { edge, face, stamp: self.stamp };
                return None;
            }
            if slot.edge == edge {
                return Some(slot.face);
            }
            at += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::SplitMix;

    #[test]
    fn faces_meet_at_edges() {
        let mut links = Links::new();
        for star in [3, 500, 40] {
            links.begin(star).unwrap();
            // So many that some begin at the same slot.
            let mut random = SplitMix(star as u64);
            let edges: Vec<(u32, u32)> = (0..star)
                .map(|_| random.next_word())
                .map(|word| (word as u32, (word >> 32) as u32))
                .collect();
            for (&(a, b), face) in edges.iter().zip(7..) {
                assert_eq!(links.meet(a, b, face), None);
            }
            for (&(a, b), face) in edges.iter().zip(7..) {
                assert_eq!(links.meet(b, a, 0), Some(face));
            }
        }
    }
}
