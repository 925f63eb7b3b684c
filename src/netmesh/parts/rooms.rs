//! Parts that become the whole grow in its spare room, so that nothing has to be copied when they join.

use super::Part;
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
    pub(super) fn lend_room(&mut self, parts: &mut [Part<D>]) -> AllocResult<()> {
        let bound = self.delaunay.complex().simplex_bound();
        let inputs = |part: &Part<D>| part.location.remaining() as f64;
        let share = self.delaunay.spare_simplices() as f64 / parts.iter().map(inputs).sum::<f64>();
        let fraction = if parts.len() > 1 { USUAL } else { ALL };
        let rooms = collected(parts.iter().map(|part| (fraction * share * inputs(part)) as usize))?;
        let Some(delaunay) = self.delaunay.lend(&rooms) else { return Ok(()) };
        for (part, room) in parts.iter_mut().zip(delaunay) {
            part.delaunay.move_to(room)?;
        }
        let Some(homes) = self.location.lend(&rooms, bound) else { return Ok(()) };
        for (part, room) in parts.iter_mut().zip(homes) {
            part.location.move_to(room)?;
        }
        let Some(flags) = self.refine.lend(&rooms, bound) else { return Ok(()) };
        for (part, room) in parts.iter_mut().zip(flags) {
            part.refine.move_to(room)?;
        }
        Ok(())
    }
}
