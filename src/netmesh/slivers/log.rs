//! The log of changes that may be undone.

use crate::complex::VertexId;
use crate::netmesh::slivers::queue::Sliver;

/// Changes since something was begun.
#[derive(Default)]
pub(super) struct Log<const D: usize> {
    pub steps: Vec<Step<D>>,
    /// Slivers that came with them, which are not queued; and those of them that moves did not
    /// mend.
    pub fresh: Vec<Sliver>,
    pub failed: Vec<Sliver>,
}

#[derive(Clone, Copy)]
pub(super) enum Step<const D: usize> {
    Inserted(VertexId),
    /// The vertex moved away from this point.
    Moved(VertexId, [f64; D]),
    /// A neighbour of the vertex.
    Removed(VertexId, VertexId),
}
