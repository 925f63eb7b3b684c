//! Marks of simplices, by which a search knows where it has been.
//!
//! A search for a cavity or a star leaves no mark: it clears those of the simplices that it has
//! found, which it knows anyway. Those of a caller's search are listed, and cleared when the next
//! one begins. So a byte holds a mark. The number of a search, which needs no clearing, takes four.

use super::{Complex, SimplexId};
use crate::memory::{AllocResult, Array, TryGrow};

#[derive(Default)]
pub(crate) struct Marks {
    /// Simplex -> its mark. Simplices that were made after the search began have none.
    of: Array<Mark>,
    /// Simplices that a caller's search has marked.
    marked: Array<SimplexId>,
}

/// Mark of a simplex.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mark {
    None,
    Inside,
    Outside,
}

impl Mark {
    #[inline(always)]
    pub fn is_inside(&self) -> bool {
        *self == Self::Inside
    }

    /// Marks a simplex as inside, or removes its mark.
    #[inline(always)]
    pub fn set_inside(&mut self, is_inside: bool) {
        *self = if is_inside { Self::Inside } else { Self::None };
    }
}

impl Marks {
    /// Clears the marks of a caller's search, and covers the simplices below `bound`.
    pub fn begin(&mut self, bound: usize) -> AllocResult<()> {
        for &simplex in &self.marked {
            self.of[simplex] = Mark::None;
        }
        self.marked.clear();
        self.of.cover(bound, Mark::None)
    }

    /// Reserves memory for the marks of `simplices` simplices, if the system grants it.
    pub fn expect(&mut self, simplices: usize) {
        self.of.expect(simplices);
    }

    /// Returns the mark of a simplex that is covered.
    #[inline(always)]
    pub fn of(&mut self, simplex: SimplexId) -> &mut Mark {
        &mut self.of[simplex]
    }
}

/// Searches of callers, whose marks stay until the next search begins.
impl<const D: usize> Complex<D> {
    /// Starts a search: afterwards no simplex is marked, neither inside nor outside.
    pub fn begin_marks(&mut self) -> AllocResult<()> {
        self.marks.begin(self.simplex_bound())
    }

    #[inline]
    pub fn mark_inside(&mut self, simplex: SimplexId) -> AllocResult<()> {
        self.mark_either(simplex, true)
    }

    #[inline]
    pub fn is_inside(&self, simplex: SimplexId) -> bool {
        self.marks.of.get(simplex.index()).is_some_and(Mark::is_inside)
    }

    #[inline]
    pub fn is_marked(&self, simplex: SimplexId) -> bool {
        self.marks.of.get(simplex.index()).is_some_and(|&mark| mark != Mark::None)
    }

    /// Marks `simplex` as inside, or else as outside.
    #[inline]
    pub fn mark_either(&mut self, simplex: SimplexId, is_inside: bool) -> AllocResult<()> {
        if !self.is_marked(simplex) {
            self.marks.marked.try_push(simplex)?;
        }
        *self.marks.of(simplex) = if is_inside { Mark::Inside } else { Mark::Outside };
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::VertexId;

    #[test]
    fn a_search_begins_without_the_marks_of_the_one_before() {
        let mut complex = Complex::<3>::new(4).unwrap();
        complex.begin(&VertexId::below(4).collect::<Vec<_>>()).unwrap();
        let [one, four] = [1, 4].map(SimplexId::new);
        for _ in 0..3 {
            complex.begin_marks().unwrap();
            assert!(complex.simplices().all(|simplex| !complex.is_marked(simplex)));
            for (simplex, is_inside) in [(one, true), (four, false), (four, true), (one, false)] {
                complex.mark_either(simplex, is_inside).unwrap();
                assert!(complex.is_marked(simplex) && complex.is_inside(simplex) == is_inside);
            }
            assert_eq!(*complex.marks.marked, [one, four]);
        }
        assert!(!complex.is_marked(SimplexId::new(99)) && !complex.is_inside(SimplexId::new(99)));
    }
}
