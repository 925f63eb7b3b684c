//! The work on slivers: all that it needs beside the mesh.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::memory::Array;
use crate::netmesh::slivers::candidates::Candidates;
use crate::netmesh::slivers::cone::Cone;
use crate::netmesh::slivers::log::Log;
use crate::netmesh::slivers::queue::Queue;
use crate::netmesh::slivers::shape::Measure;
use crate::netmesh::slivers::stars::Stars;
use crate::netmesh::slivers::vacancy::Vacancy;
use crate::netmesh::state::State;

/// Least gain of a change that keeps the bound.
pub(super) const LEAST_GAIN: f64 = 0.001;

/// Least gain of a change for which the bound gives way: about a sliver.
pub(super) const LEAST_GAIN_BEYOND: f64 = 0.999;

/// Work on slivers: the objective, the slivers that wait, and the buffers of changes.
pub(super) struct Slivers {
    pub measure: Measure,
    /// Least gain of a change.
    pub least_gain: f64,
    /// Simplex -> its penalty in the objective; stale for a dead one.
    pub penalties: Array<f32>,
    pub stars: Stars,
    pub queue: Queue,
    pub candidates: Candidates,
    /// The number of slivers that the mesh had at first.
    pub found: usize,
    /// Number of exact tests after which the work ends.
    pub most_exact: u64,
    pub vacancy: Vacancy,
    pub cone: Cone,
    /// The conflicts of the point that is judged or goes in.
    pub cavity: Cavity,
    /// The simplices that filled a hole.
    pub filled: Vec<SimplexId>,
    /// Ids of vertices that were removed.
    pub free: Vec<VertexId>,
    /// Changes that may be undone, while there are such.
    pub log: Option<Log>,
}

/// Points that are tried for a sliver with the least effort.
pub(super) const POINTS: usize = 12;

impl State<3> {
    pub(super) fn is_exhausted(&self, slivers: &Slivers) -> bool {
        self.delaunay.exact_fallbacks() > slivers.most_exact
    }
}
