//! K of the feature size invariant (Definition 7) and of the insertion radius invariant (Definition
//! 8): the largest ratios that were observed.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::instruments::probes::stride;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::observations::Pending;
use std::time::Instant;

/// The most vertices at which feature sizes are compared in the complete mesh.
const FEATURE_PROBES: usize = 20_000;

/// Number of insertions that are all observed; of each doubling of it half as many are.
const INSERTION_PROBES: usize = 1 << 12;

/// Probes end when all of them together visited this number of simplices: a vertex of a finished
/// mesh may have thousands of others between itself and the inputs.
const WORK: u64 = 1 << 26;

/// The number of sweeps over the vertices that take the probes. Where work is cut off early, the
/// probes taken are still inputs, Steiner points and vertices of cages alike.
const SWEEPS: usize = 16;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Measures the largest f_P^Omega(v) / f_M^Omega(v) over domains and vertices of them.
    pub(super) fn measure_feature_size_constant(&mut self) -> Result<()> {
        let count = self.state.delaunay.point_count();
        let step = stride(count, FEATURE_PROBES);
        let sweep = |first: usize| (first * step..count).step_by(SWEEPS * step);
        self.instruments.search.work = 0;
        for vertex in (0..SWEEPS).flat_map(sweep) {
            if self.instruments.search.work > WORK {
                break;
            }
            if self.state.is_inserted(VertexId::new(vertex)) {
                self.compare_feature_sizes_at(VertexId::new(vertex))?;
            }
        }
        Ok(())
    }

    /// Compares the feature sizes at `vertex` in every domain that has it.
    fn compare_feature_sizes_at(&mut self, vertex: VertexId) -> Result<()> {
        let mut omega = self.state.hierarchy.domain_of(vertex);
        loop {
            self.compare_feature_sizes(vertex, omega)?;
            // The centre of a domain is a vertex of the enclosing one too.
            if self.state.hierarchy.node(omega).center != vertex {
                return Ok(());
            }
            omega = self.state.hierarchy.parent(omega);
            if !omega.is_valid() {
                return Ok(());
            }
        }
    }

    fn compare_feature_sizes(&mut self, vertex: VertexId, omega: DomainId) -> Result<()> {
        let Some(sizes) = self.feature_sizes(vertex, omega)? else { return Ok(()) };
        if let (Some(mesh), Some(inputs)) = (sizes.mesh, sizes.inputs) {
            let constant = &mut self.state.stats.feature_size_constant;
            *constant = constant.max(inputs / mesh);
        }
        Ok(())
    }

    /// Observes f_P^Omega(v) / lambda_v of `vertex`, which has just gone in, if it is one of those
    /// to be observed.
    pub(in crate::netmesh) fn observe_insertion(&mut self, vertex: VertexId) -> Result<()> {
        let is_cage_vertex = self.state.hierarchy.cage_of(vertex).is_valid();
        let settles = !is_cage_vertex && !self.instruments.pending.is_empty();
        let inserted = self.state.delaunay.point_count() - self.state.conflict_lists.remaining();
        let rarity = (inserted / INSERTION_PROBES + 1).next_power_of_two();
        let is_probe = inserted % rarity == 0;
        if !(settles || is_probe) || self.instruments.search.work > WORK {
            return Ok(());
        }
        let begun = Instant::now();
        if settles {
            self.settle_pending(self.state.is_input(vertex))?;
        }
        if is_probe {
            self.compare_insertion_radius(vertex, is_cage_vertex)?;
        }
        self.instruments.spent += begun.elapsed();
        Ok(())
    }

    fn compare_insertion_radius(&mut self, vertex: VertexId, is_cage_vertex: bool) -> Result<()> {
        let omega = self.state.hierarchy.domain_of(vertex);
        let sizes = self.feature_sizes(vertex, omega)?.unwrap_or_default();
        let Some(insertion_radius) = sizes.mesh else { return Ok(()) };
        let constant = match (is_cage_vertex, self.state.is_input(vertex)) {
            (true, _) => &mut self.state.stats.insertion_constant_cage,
            (false, true) => &mut self.state.stats.insertion_constant_input,
            (false, false) => &mut self.state.stats.insertion_constant_corner,
        };
        if let Some(inputs) = sizes.inputs {
            *constant = constant.max(inputs / insertion_radius);
        } else if is_cage_vertex {
            self.instruments.pending.try_push(Pending { vertex, insertion_radius })?;
        }
        Ok(())
    }

    /// Compares the vertices of new cages whose domains have a second input by now. A new cage has
    /// its centre for an input, and the one that it is made for goes in after it; so the proof of
    /// Lemma 7 has it. That input, or another vertex that went in, may be the second one. If `last`
    /// there is no use in waiting for another.
    fn settle_pending(&mut self, last: bool) -> Result<()> {
        let mut pending = std::mem::take(&mut self.instruments.pending);
        let mut kept = 0;
        for at in 0..pending.len() {
            let Pending { vertex, insertion_radius } = pending[at];
            let omega = self.state.hierarchy.domain_of(vertex);
            let sizes = self.feature_sizes(vertex, omega)?.unwrap_or_default();
            if let Some(inputs) = sizes.inputs {
                let constant = &mut self.state.stats.insertion_constant_cage;
                *constant = constant.max(inputs / insertion_radius);
            } else if !last {
                pending.swap(kept, at);
                kept += 1;
            }
        }
        pending.truncate(kept);
        self.instruments.pending = pending;
        Ok(())
    }
}
