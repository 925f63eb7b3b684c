//! The times at which stars changed, and at which nothing helped their vertices. A time is the
//! number of simplices that were made until then.

use crate::complex::VertexId;
use crate::memory::{AllocResult, Array, TryGrow};

/// Times of the stars of vertices.
pub(super) struct Stars {
    /// Vertex -> when its star changed last.
    changed: Array<u64>,
    /// Vertex -> one more than the time when no place was found for it last.
    settled: Array<u64>,
}

impl Stars {
    /// Returns the times of `count` vertices whose stars have not changed yet.
    pub fn new(count: usize) -> AllocResult<Self> {
        Ok(Self { changed: Array::filled(count, 0)?, settled: Array::filled(count, 0)? })
    }

    /// Makes room for `count` vertices.
    pub fn cover(&mut self, count: usize) -> AllocResult<()> {
        self.changed.cover(count, 0)?;
        self.settled.cover(count, 0)
    }

    /// Notes that the star of `vertex` is another `now`.
    pub fn change(&mut self, vertex: VertexId, now: u64) {
        self.changed[vertex] = now;
    }

    /// Notes that no place is found for `vertex` `now`.
    pub fn settle(&mut self, vertex: VertexId, now: u64) {
        self.settled[vertex] = now + 1;
    }

    /// Returns true if no place was found for `vertex`, and its star is as it was then.
    pub fn is_settled(&self, vertex: VertexId) -> bool {
        self.settled[vertex] > self.changed[vertex]
    }

    /// Returns true if the star of `vertex`, unless that is the infinite one, changed after `time`.
    pub fn has_changed_since(&self, time: u64, vertex: VertexId) -> bool {
        vertex.is_valid() && self.changed[vertex] > time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_is_settled_until_its_star_changes() {
        let [first, second] = [0, 1].map(VertexId::new);
        let mut stars = Stars::new(1).unwrap();
        stars.cover(2).unwrap();
        assert!(!stars.is_settled(first) && !stars.is_settled(second));
        // The same simplices are there still: nothing came between.
        stars.change(first, 8);
        stars.settle(first, 8);
        assert!(stars.is_settled(first) && !stars.is_settled(second));
        stars.change(first, 9);
        assert!(!stars.is_settled(first));
        assert!(stars.has_changed_since(8, first) && !stars.has_changed_since(9, first));
        assert!(!stars.has_changed_since(0, second));
        assert!(!stars.has_changed_since(0, VertexId::INFINITE));
    }
}
