//! A partition of the mesh.

use crate::complex::LocalToGlobal;
use crate::netmesh::state::State;
use crate::netmesh::state::hierarchy::partition::DomainsToGlobal;

/// A partition of the mesh, and all that it takes to go on with it.
pub(super) struct Partition<const D: usize> {
    pub local_to_global: LocalToGlobal,
    pub domains: DomainsToGlobal,
    /// Vertex -> true if other partitions have simplices at it. Vertices that are made later are
    /// not there.
    pub shared: Vec<bool>,
    pub state: State<D>,
}
