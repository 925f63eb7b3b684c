//! Places of simplices in the star of a vertex.

use crate::memory::{AllocResult, filled};
use crate::mesh::NONE;

/// The place of each simplex in the star of the vertex that was turned to last.
pub struct Places {
    of: Vec<u32>,
    /// The number of simplices in the star.
    count: u32,
}

impl Places {
    /// Makes places for so many simplices, before any star.
    pub fn new(simplices: usize) -> AllocResult<Self> {
        Ok(Self { of: filled(simplices, 0)?, count: 0 })
    }

    /// Turns to the star of a vertex. O(star).
    pub fn turn_to(&mut self, star: &[u32]) {
        self.count = star.len() as u32;
        for (at, &simplex) in (0..).zip(star) {
            self.of[simplex as usize] = at;
        }
    }

    /// Returns the place of a simplex that the star has; that after all for [`NONE`].
    pub fn of(&self, simplex: u32) -> u32 {
        if simplex == NONE { self.count } else { self.of[simplex as usize] }
    }
}
