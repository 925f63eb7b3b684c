//! Candidates: points that wait for their insertion, the best first.

use crate::memory::AllocResult;
use crate::netmesh::slivers::queue::Sliver;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A point for a sliver, and when it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    pub sliver: Sliver,
    pub x: [f64; 3],
    pub class: i32,
    pub time: u64,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The one of a higher class is greater, then that with smaller ids: inputs that are near each
/// other have ids that are, so points of one class go in side by side.
impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let ids = |candidate: &Self| (candidate.sliver.vertices, candidate.sliver.simplex);
        self.class.cmp(&other.class).then_with(|| ids(other).cmp(&ids(self)))
    }
}

/// Returns the class of points that are worth `gain`: twice as much is one class more.
pub(super) fn class(gain: f64) -> i32 {
    gain.log2().floor() as i32
}

/// Candidates, the best first.
#[derive(Default)]
pub(super) struct Candidates(pub BinaryHeap<Candidate>);

impl Candidates {
    pub fn push(&mut self, candidate: Candidate) -> AllocResult<()> {
        if self.0.len() == self.0.capacity() {
            self.0.try_reserve(1)?;
        }
        self.0.push(candidate);
        Ok(())
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::{SimplexId, VertexId};

    #[test]
    fn what_is_worth_more_comes_first_and_equals_by_place() {
        let candidate = |gain, first: usize| {
            let vertices = [first, 7, 8, 9].map(VertexId::new);
            let sliver = Sliver { penalty: 1.5, simplex: SimplexId::new(first), vertices };
            Candidate { sliver, x: [0.0; 3], class: class(gain), time: 0 }
        };
        let mut candidates = Candidates::default();
        for (gain, first) in [(3.9, 3), (2.1, 2), (0.001, 0), (8.0, 6), (7.9, 1)] {
            candidates.push(candidate(gain, first)).unwrap();
        }
        assert_eq!(candidates.len(), 5);
        let all = std::iter::from_fn(|| candidates.0.pop());
        let all: Vec<_> = all.map(|candidate| candidate.sliver.vertices[0].index()).collect();
        assert_eq!(all, [6, 1, 2, 3, 0]);
    }
}
