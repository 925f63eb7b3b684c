//! A partition joins the global mesh in the place of what it was cut out of.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::Stats;
use crate::netmesh::partitions::partition::Partition;
use crate::netmesh::state::{Cell, Mesher, limit};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Joins `partition`. `moved`: simplex that became one of a partition -> its new id.
    pub(super) fn join(&mut self, partition: Partition<D>, moved: &mut [SimplexId]) -> Result<()> {
        let Partition { mut local_to_global, mut domains, shared, state } = partition;
        let known = shared.len();
        let count = self.state.delaunay.point_count() + state.delaunay.point_count() - known;
        if count as u64 > self.state.parameters.max_vertices {
            return Err(limit(self.state.parameters.max_vertices, count));
        }
        let taken = std::mem::take(&mut local_to_global.simplices);
        let watch = &mut self.watch;
        self.state.delaunay.join(state.delaunay, &mut local_to_global, || watch.poll_after(1))?;
        for (&old, &new) in taken.iter().zip(&local_to_global.simplices) {
            moved[old] = new;
        }
        self.watch.poll()?;
        self.state.hierarchy.join(
            state.hierarchy,
            &mut domains,
            &local_to_global.vertices,
            &shared,
        )?;
        for (local, (&vertex, &cell)) in
            local_to_global.vertices.iter().zip(&state.cells).enumerate()
        {
            self.watch.poll_after(1)?;
            if local >= known {
                self.state.cells.try_push(cell)?;
                self.state.precision_limited.try_push(state.precision_limited[local])?;
                continue;
            }
            let global = &mut self.state.cells[vertex];
            *global = match shared[local] {
                true => Cell {
                    nearest: global.nearest.min(cell.nearest),
                    farthest: global.farthest.max(cell.farthest),
                },
                false => cell,
            };
            self.state.precision_limited[vertex] |= state.precision_limited[local];
        }
        let bound = self.state.delaunay.complex().simplex_bound();
        self.watch.poll()?;
        self.state.conflict_lists.join(state.conflict_lists, &local_to_global, bound)?;
        self.watch.poll()?;
        self.state.refine_list.join(state.refine_list, local_to_global.simplices.len(), bound)?;
        for &(cage, input) in &state.interface.deferred {
            let input = local_to_global.vertices[input];
            self.state.interface.deferred.try_push((domains.global(cage), input))?;
        }
        add(&mut self.state.stats, &state.stats);
        Ok(())
    }
}

/// Adds what a partition has counted, except its rounds and passes, which ran beside those of
/// others.
fn add(stats: &mut Stats, partition: &Stats) {
    stats.yields += partition.yields;
    stats.far_corners += partition.far_corners;
    stats.off_centers += partition.off_centers;
    stats.cage_points += partition.cage_points;
    stats.closing_points += partition.closing_points;
    stats.cages_created += partition.cages_created;
    stats.cages_grown += partition.cages_grown;
    stats.cages_released += partition.cages_released;
}
