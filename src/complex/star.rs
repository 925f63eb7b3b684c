//! The star of a vertex.

use super::{Complex, SimplexId, VertexId, index_of};
use crate::memory::{AllocResult, Array, TryGrow};

impl<const D: usize> Complex<D> {
    /// Collects the live simplices at `vertex` into `star` (cleared first), infinite ones included.
    /// Uses the marks, and leaves none.
    pub fn star(&mut self, vertex: VertexId, star: &mut Array<SimplexId>) -> AllocResult<()> {
        star.clear();
        self.begin_marks()?;
        let first = self.incident(vertex);
        self.marks.of(first).set_inside(true);
        star.try_push(first)?;
        let mut next = 0;
        while next < star.len() {
            let simplex = star[next];
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
        Ok(())
    }
}
