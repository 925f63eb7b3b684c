//! Partitions grow in the spare memory of the global mesh, so that nothing has to be copied when
//! they join.

use crate::memory::{AllocResult, collected};
use crate::netmesh::partitions::partition::Partition;
use crate::netmesh::state::Mesher;

/// The share of the spare memory that several partitions get. The last of them gets the rest as
/// well (`Array::split_reserve`).
const USUAL: f64 = 0.95;

/// The share that a single partition gets, since products are rounded up.
const ALL: f64 = 0.999;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Splits the spare memory for simplices among `partitions`, in proportion to their inputs.
    /// Where that is not enough a partition moves to memory of its own as it grows.
    pub(super) fn split_reserves(&mut self, partitions: &mut [Partition<D>]) -> AllocResult<()> {
        let bound = self.state.delaunay.complex().simplex_bound();
        let inputs = |partition: &Partition<D>| partition.state.conflict_lists.remaining() as f64;
        let share = self.state.delaunay.spare_simplices() as f64
            / partitions.iter().map(inputs).sum::<f64>();
        let fraction = if partitions.len() > 1 { USUAL } else { ALL };
        let reserves = collected(
            partitions.iter().map(|partition| (fraction * share * inputs(partition)) as usize),
        )?;
        let Some(delaunay) = self.state.delaunay.split_reserve(&reserves) else { return Ok(()) };
        for (partition, reserve) in partitions.iter_mut().zip(delaunay) {
            partition.state.delaunay.move_to(reserve)?;
        }
        let Some(lists) = self.state.conflict_lists.split_reserve(&reserves, bound) else {
            return Ok(());
        };
        for (partition, reserve) in partitions.iter_mut().zip(lists) {
            partition.state.conflict_lists.move_to(reserve)?;
        }
        let Some(flags) = self.state.refine_list.split_reserve(&reserves, bound) else {
            return Ok(());
        };
        for (partition, reserve) in partitions.iter_mut().zip(flags) {
            partition.state.refine_list.move_to(reserve)?;
        }
        Ok(())
    }
}
