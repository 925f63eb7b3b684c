//! Sets of vertices, or of other things with ids.

use super::{Vertex, VertexId};
use crate::memory::{AllocResult, Array, Id, TryGrow};

/// Set of ids that is emptied in constant time, and numbers its members in the order of insertion.
pub(crate) struct IdSet<Of> {
    pub ids: Array<Id<Of>>,
    /// Id -> its number plus `base`; less than `base` if it is not in the set.
    marks: Vec<u32>,
    base: u32,
}

pub(crate) type VertexSet = IdSet<Vertex>;

impl<Of> Default for IdSet<Of> {
    fn default() -> Self {
        // A new id's mark is 0, which must not be in the set.
        Self { ids: Array::new(), marks: Vec::new(), base: 1 }
    }
}

impl<Of> IdSet<Of> {
    /// Empties the set, and reserves memory for the marks of the ids below `bound`.
    pub fn restart(&mut self, bound: usize) -> AllocResult<()> {
        self.marks.cover(bound, 0)?;
        self.base += self.ids.len() as u32;
        self.ids.clear();
        if (u32::MAX - self.base) as usize <= self.marks.len() {
            self.marks.fill(0);
            self.base = 1;
        }
        Ok(())
    }

    // A call would cost as much as what is done.
    #[inline(always)]
    pub fn insert(&mut self, id: Id<Of>) -> AllocResult<()> {
        self.ids.reserve(1)?;
        let mark = &mut self.marks[id];
        // Without a branch on `is_new`, as `Array::push_if`.
        let is_new = *mark < self.base;
        let next = self.base + self.ids.len() as u32;
        *mark = if is_new { next } else { *mark };
        self.ids.push_if(is_new, id);
        Ok(())
    }
}

impl VertexSet {
    /// Inserts a vertex of a simplex, unless it is the infinite one, which is in no set.
    #[inline(always)]
    pub fn insert_finite(&mut self, vertex: VertexId) -> AllocResult<()> {
        match vertex.index() < self.marks.len() {
            true => self.insert(vertex),
            false => Ok(()),
        }
    }

    /// Returns the number of a member, from 1 on; 0 for the infinite vertex.
    #[inline(always)]
    pub fn number(&self, vertex: VertexId) -> u32 {
        // It is beyond all marks.
        self.marks.get(vertex.index()).map_or(0, |mark| mark.wrapping_sub(self.base) + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_numbered_as_they_come() {
        let mut set = VertexSet::default();
        let infinite = VertexId::INFINITE;
        for first in [3, 0, 5] {
            let [first, one, seven] = [first, 1, 7].map(VertexId::new);
            set.restart(8).unwrap();
            for id in [first, one, first, infinite, seven, one] {
                set.insert_finite(id).unwrap();
            }
            assert_eq!(*set.ids, [first, one, seven]);
            assert_eq!([first, one, seven, infinite].map(|id| set.number(id)), [1, 2, 3, 0]);
        }
    }

    #[test]
    fn marks_begin_anew_before_they_run_out() {
        let mut set = VertexSet::default();
        set.restart(4).unwrap();
        let [zero, two] = [0, 2].map(VertexId::new);
        set.insert(two).unwrap();
        set.base = u32::MAX - 6;
        set.marks[2] = set.base;
        set.restart(4).unwrap();
        assert!(set.base == u32::MAX - 5 && set.ids.is_empty());
        for id in [two, zero, two] {
            set.insert(id).unwrap();
        }
        assert_eq!(*set.ids, [two, zero]);
        set.restart(4).unwrap();
        assert_eq!((set.base, &set.marks[..]), (1, &[0; 4][..]));
        set.insert(zero).unwrap();
        assert_eq!(set.number(zero), 1);
    }
}
