//! Parts that become the whole grow in its spare room, so that nothing has to be copied when they join.

use super::Partition;
use crate::memory::{AllocResult, collected};
use crate::netmesh::Mesher;

/// What parts are lent of the spare room, where there are several: what they leave of that has to be
/// closed up. There is room for half as much again as uniform inputs take.
const USUAL: f64 = 0.67;
/// Products are rounded up.
const ALL: f64 = 0.999;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Divides the spare room for simplices among `parts`, by their inputs. Where that is not enough a part
    /// moves to room of its own as it grows.
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
