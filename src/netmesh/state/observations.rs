//! Data that the instruments keep between two insertions.

use crate::complex::{IdSet, SimplexId, VertexId, VertexSet};
use crate::memory::{AllocResult, Array};
use crate::netmesh::state::hierarchy::OfDomain;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::time::Duration;

/// Memory of the instruments during a run.
#[derive(Default)]
pub(in crate::netmesh) struct Instruments {
    pub search: Search,
    /// Cage vertices to which only one input counts so far.
    pub pending: Vec<Pending>,
    /// The time that they took, which is not the run's.
    pub spent: Duration,
}

/// A vertex of a cage whose domain has one input yet, its centre.
pub(in crate::netmesh) struct Pending {
    pub vertex: VertexId,
    pub insertion_radius: f64,
}

/// The buffers of a search.
#[derive(Default)]
pub(in crate::netmesh) struct Search {
    /// Distances, as bits, of vertices to go on from, and of children's centres (`true`).
    pub queue: BinaryHeap<Reverse<(u64, VertexId, bool)>>,
    pub seen: VertexSet,
    pub children: IdSet<OfDomain>,
    pub star: Array<SimplexId>,
    /// Simplices visited in all searches.
    pub work: u64,
}

impl Search {
    pub fn restart(&mut self, vertices: usize, domains: usize) -> AllocResult<()> {
        self.queue.clear();
        self.seen.restart(vertices)?;
        self.children.restart(domains)
    }

    pub fn push(&mut self, distance: f64, vertex: VertexId, is_center: bool) -> AllocResult<()> {
        if self.queue.len() == self.queue.capacity() {
            self.queue.try_reserve(1)?;
        }
        self.queue.push(Reverse((distance.to_bits(), vertex, is_center)));
        Ok(())
    }

    pub fn pop(&mut self) -> Option<(f64, VertexId, bool)> {
        let Reverse((bits, vertex, is_center)) = self.queue.pop()?;
        Some((f64::from_bits(bits), vertex, is_center))
    }
}
