//! The log of changes that may be undone.

use crate::complex::VertexId;
use crate::netmesh::slivers::queue::Sliver;

/// Changes since something was begun.
#[derive(Default)]
pub(super) struct Log {
    pub steps: Vec<Step>,
    /// Slivers that came with them, which are not queued; and those of them that moves did not
    /// mend.
    pub fresh: Vec<Sliver>,
    pub failed: Vec<Sliver>,
}

#[derive(Clone, Copy)]
pub(super) enum Step {
    Inserted(VertexId),
    /// The vertex moved away from this point.
    Moved(VertexId, [f64; 3]),
    /// A neighbour of the vertex.
    Removed(VertexId, VertexId),
}
