//! Slivers that wait, the worst first; and those that nothing has helped yet.

use crate::complex::{SimplexId, VertexId};
use crate::memory::{AllocResult, TryGrow};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A sliver as it was when it was queued.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sliver {
    /// Penalty of the sliver in the objective.
    pub penalty: f32,
    pub simplex: SimplexId,
    /// Vertices in rising order.
    pub vertices: [VertexId; 4],
}

impl Eq for Sliver {}

impl PartialOrd for Sliver {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The worse one is greater, then that with smaller ids.
impl Ord for Sliver {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_id = || (other.vertices, other.simplex).cmp(&(self.vertices, self.simplex));
        self.penalty.total_cmp(&other.penalty).then_with(by_id)
    }
}

/// Time of slivers for which no point was tried yet.
pub(super) const UNTRIED: u64 = 0;

/// A sliver that nothing has helped yet, and when it was tried last: the number of simplices that
/// had been made by then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Failed {
    pub sliver: Sliver,
    pub time: u64,
}

#[derive(Default)]
pub(super) struct Queue {
    waiting: BinaryHeap<Sliver>,
    failed: Vec<Failed>,
}

impl Queue {
    pub fn push(&mut self, sliver: Sliver) -> AllocResult<()> {
        if self.waiting.len() == self.waiting.capacity() {
            self.waiting.try_reserve(1)?;
        }
        self.waiting.push(sliver);
        Ok(())
    }

    /// Returns the worst of those that wait.
    pub fn pop(&mut self) -> Option<Sliver> {
        self.waiting.pop()
    }

    /// Keeps `sliver`, which was tried at `time`, for another pass.
    pub fn fail(&mut self, sliver: Sliver, time: u64) -> AllocResult<()> {
        self.failed.try_push(Failed { sliver, time })
    }

    /// Takes the slivers that were kept for another pass.
    pub fn take_failed(&mut self) -> Vec<Failed> {
        std::mem::take(&mut self.failed)
    }

    /// Returns the number of those kept for another pass, stale ones too.
    pub fn failed(&self) -> usize {
        self.failed.len()
    }

    /// Returns the number of those that wait or have failed, stale ones too.
    pub fn len(&self) -> usize {
        self.waiting.len() + self.failed.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_comes_first_and_equals_by_ids() {
        let sliver = |penalty, first: usize| {
            let vertices = [first, 7, 8, 9].map(VertexId::new);
            Sliver { penalty, simplex: SimplexId::new(first), vertices }
        };
        let mut queue = Queue::default();
        for (penalty, first) in [(1.5, 3), (1.25, 0), (2.0, 6), (1.5, 2)] {
            queue.push(sliver(penalty, first)).unwrap();
        }
        let all = std::iter::from_fn(|| queue.pop()).map(|sliver| sliver.vertices[0].index());
        assert_eq!(all.collect::<Vec<_>>(), [6, 2, 3, 0]);
        let failed = [4, 5].map(|first| Failed { sliver: sliver(1.0, first), time: 7 });
        for Failed { sliver, time } in failed {
            queue.fail(sliver, time).unwrap();
        }
        assert!(queue.pop().is_none() && queue.len() == 2);
        assert_eq!(queue.take_failed(), failed);
        assert_eq!(queue.len(), 0);
    }
}
