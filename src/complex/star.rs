//! The star of a vertex.

use super::{Complex, SimplexId, VertexId, index_of};
use crate::memory::{AllocResult, Array, TryGrow};

impl<const D: usize> Complex<D> {
    /// Collects the live simplices at `vertex` into `star` (cleared first), infinite ones included.
    /// Uses the marks, and leaves none.
    pub fn star(&mut self, vertex: VertexId, star: &mut Array<SimplexId>) -> AllocResult<()> {
        self.search_star(vertex, star, |_| false).map(|_| ())
    }

    /// Returns true if a live simplex at `vertex` has all of `others`. Takes time linear in the
    /// star of `vertex`, and mostly less if there is one. `star` is a place for the search. Uses
    /// the marks, and leaves none.
    pub fn star_has(
        &mut self,
        vertex: VertexId,
        others: &[VertexId],
        star: &mut Array<SimplexId>,
    ) -> AllocResult<bool> {
        self.search_star(vertex, star, |own| others.iter().all(|other| own.contains(other)))
    }

    /// Collects live simplices at `vertex` into `star` (cleared first): all, and returns false; or
    /// those up to the first whose vertices `are_sought`, and returns true.
    #[inline(always)]
    fn search_star(
        &mut self,
        vertex: VertexId,
        star: &mut Array<SimplexId>,
        are_sought: impl Fn(&[VertexId]) -> bool,
    ) -> AllocResult<bool> {
        star.clear();
        self.begin_marks()?;
        let first = self.incident(vertex);
        self.marks.of(first).set_inside(true);
        star.try_push(first)?;
        let (mut next, mut is_found) = (0, false);
        while next < star.len() {
            let simplex = star[next];
            if are_sought(self.vertices(simplex)) {
                is_found = true;
                break;
            }
            next += 1;
            star.reserve(D)?;
            // All but that opposite the vertex.
            let opposite = index_of(self.vertices(simplex), vertex);
            for index in (0..D).map(|i| i + usize::from(i >= opposite)) {
                let neighbor = self.neighbors(simplex)[index];
                let mark = self.marks.of(neighbor);
                star.push_if(!mark.is_inside(), neighbor);
                mark.set_inside(true);
            }
        }
        for &simplex in &*star {
            self.marks.of(simplex).set_inside(false);
        }
        Ok(is_found)
    }
}
