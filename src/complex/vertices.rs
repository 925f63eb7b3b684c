//! Sets of vertices.

use crate::memory::{AllocResult, Array, TryGrow};

/// A set of vertex ids that is emptied in constant time, and numbers its members in the order in
/// which they came.
pub(crate) struct VertexSet {
    pub ids: Array<u32>,
    /// Vertex -> its number and `base`; less than `base` if it is not in the set.
    marks: Vec<u32>,
    base: u32,
}

impl Default for VertexSet {
    fn default() -> Self {
        // A new id's mark is 0, which must not be in the set.
        Self { ids: Array::new(), marks: Vec::new(), base: 1 }
    }
}

impl VertexSet {
    /// Empties the set, and makes room for the marks of `vertices` vertices.
    pub fn restart(&mut self, vertices: usize) -> AllocResult<()> {
        self.marks.cover(vertices, 0)?;
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
    pub fn insert(&mut self, id: u32) -> AllocResult<()> {
        self.ids.make_room(1)?;
        let mark = &mut self.marks[id as usize];
        // Without a branch on `is_new`, as `Array::push_if`.
        let is_new = *mark < self.base;
        let next = self.base + self.ids.len() as u32;
        *mark = if is_new { next } else { *mark };
        self.ids.push_if(is_new, id);
        Ok(())
    }

    /// The same for a vertex of a simplex, which may be at infinity: that is in no set.
    #[inline(always)]
    pub fn insert_finite(&mut self, vertex: u32) -> AllocResult<()> {
        match (vertex as usize) < self.marks.len() {
            true => self.insert(vertex),
            false => Ok(()),
        }
    }

    /// The number of a member, from 1 on; 0 for the infinite vertex.
    #[inline(always)]
    pub fn number(&self, vertex: u32) -> u32 {
        // It is beyond all marks.
        self.marks.get(vertex as usize).map_or(0, |mark| mark.wrapping_sub(self.base) + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::INFINITE;

    #[test]
    fn members_are_numbered_as_they_come() {
        let mut set = VertexSet::default();
        for first in [3, 0, 5] {
            set.restart(8).unwrap();
            for id in [first, 1, first, INFINITE, 7, 1] {
                set.insert_finite(id).unwrap();
            }
            assert_eq!(*set.ids, [first, 1, 7]);
            assert_eq!([first, 1, 7, INFINITE].map(|id| set.number(id)), [1, 2, 3, 0]);
        }
    }

    #[test]
    fn marks_begin_anew_before_they_run_out() {
        let mut set = VertexSet::default();
        set.restart(4).unwrap();
        set.insert(2).unwrap();
        set.base = u32::MAX - 6;
        set.marks[2] = set.base;
        set.restart(4).unwrap();
        assert!(set.base == u32::MAX - 5 && set.ids.is_empty());
        for id in [2, 0, 2] {
            set.insert(id).unwrap();
        }
        assert_eq!(*set.ids, [2, 0]);
        set.restart(4).unwrap();
        assert_eq!((set.base, &set.marks[..]), (1, &[0; 4][..]));
        set.insert(0).unwrap();
        assert_eq!(set.number(0), 1);
    }
}
