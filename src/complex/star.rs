//! The star of a vertex.

use super::Complex;
use crate::memory::{Fallible, TryGrow};

impl<const D: usize> Complex<D> {
    /// Collects the live simplices at `vertex` into `star` (cleared first), infinite ones included.
    /// Uses the marks.
    pub fn star(&mut self, vertex: u32, star: &mut Vec<u32>) -> Fallible<()> {
        star.clear();
        self.begin_marks();
        let first = self.incident(vertex);
        self.mark_inside(first);
        star.try_push(first)?;
        let mut next = 0;
        while next < star.len() {
            let simplex = star[next];
            next += 1;
            for index in 0..=D {
                if self.vertices(simplex)[index] == vertex {
                    continue;
                }
                let neighbor = self.neighbors(simplex)[index];
                if !self.is_inside(neighbor) {
                    self.mark_inside(neighbor);
                    star.try_push(neighbor)?;
                }
            }
        }
        Ok(())
    }
}
