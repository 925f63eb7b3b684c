//! A set of ids with a mark each, emptied in the time of its size.

use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::NONE;

/// Ids in the order in which they came, and an open hash table of them, at most half full.
#[derive(Default)]
pub(super) struct MarkedIds {
    members: Vec<Member>,
    /// Places in `members`, or [`NONE`].
    table: Vec<u32>,
}

#[derive(Clone, Copy)]
pub(super) struct Member {
    pub id: u32,
    pub mark: bool,
    slot: u32,
}

impl MarkedIds {
    pub fn clear(&mut self) {
        self.members.iter().for_each(|member| self.table[member.slot as usize] = NONE);
        self.members.clear();
    }

    /// Returns the members in the order in which they came.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// Returns the position of `id` among the members.
    pub fn position(&self, id: u32) -> Option<usize> {
        let at = *self.table.get(self.slot(id))?;
        (at != NONE).then_some(at as usize)
    }

    /// Returns the mark of `id`, if it is a member.
    pub fn mark(&self, id: u32) -> Option<bool> {
        self.position(id).map(|at| self.members[at].mark)
    }

    /// Adds an id that is not here.
    pub fn add(&mut self, id: u32, mark: bool) -> AllocResult<()> {
        if 2 * (self.members.len() + 1) > self.table.len() {
            self.grow()?;
        }
        let slot = self.slot(id);
        self.table[slot] = self.members.len() as u32;
        self.members.try_push(Member { id, mark, slot: slot as u32 })
    }

    #[cold]
    fn grow(&mut self) -> AllocResult<()> {
        self.table = filled((2 * self.table.len()).max(64), NONE)?;
        for at in 0..self.members.len() {
            let slot = self.slot(self.members[at].id);
            self.table[slot] = at as u32;
            self.members[at].slot = slot as u32;
        }
        Ok(())
    }

    /// Returns the slot of `id`, or the free one that it would have; 0 if there is no table.
    fn slot(&self, id: u32) -> usize {
        let mask = self.table.len().wrapping_sub(1);
        let mut slot = (id.wrapping_mul(0x9e37_79b9) >> 7) as usize & mask;
        while let Some(&at) = self.table.get(slot) {
            if at == NONE || self.members[at as usize].id == id {
                return slot;
            }
            slot = (slot + 1) & mask;
        }
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_added_since_it_was_emptied() {
        let mut set = MarkedIds::default();
        for round in 0..3u32 {
            assert_eq!(set.mark(round), None);
            for i in 0..500 {
                let id = (i * 64 + round).wrapping_mul(0x0100_0001);
                assert_eq!(set.mark(id), None);
                set.add(id, i % 3 == 0).unwrap();
                assert_eq!(set.mark(id), Some(i % 3 == 0));
            }
            let marked = set.members().iter().filter(|member| member.mark).count();
            assert_eq!((set.members().len(), marked), (500, 167));
            assert!(set.members().iter().all(|m| set.mark(m.id) == Some(m.mark)));
            set.clear();
        }
    }
}
