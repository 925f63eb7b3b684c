//! Where the mesh is cut. An input next to a simplex at a rim waits for the whole, and the simplices of
//! the coarse mesh are large. So the inputs at the walls between parts go in before the mesh is
//! cut, until the simplices there are as small as they get.

use super::{FEW, Mesher};
use crate::complex::Anchored;
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow, collected, with_room};

impl<const D: usize> Mesher<'_, '_, D> {
    /// The inputs at which parts begin, but for the first: each has as many inputs as the others. A
    /// simplex is of the part of its anchor.
    pub(super) fn walls(&self, count: usize) -> AllocResult<Vec<u32>> {
        collected((1..count).map(|part| (part * self.inputs / count) as u32))
    }

    /// All simplices, those between two walls together, in an order of locality.
    pub(super) fn between(&mut self, walls: &[u32]) -> Result<Vec<Array<u32>>> {
        let anchored = self.anchored()?;
        let mut runs = with_room(walls.len() + 1)?;
        let mut begin = 0;
        for &wall in walls.iter().chain([&(self.inputs as u32)]) {
            let mut run = Array::new();
            for anchor in begin..wall {
                self.watch.poll_after(1)?;
                run.try_extend(anchored.of(anchor))?;
            }
            if !run.is_empty() {
                runs.push(run);
            }
            begin = wall;
        }
        Ok(runs)
    }

    fn anchored(&mut self) -> Result<Anchored> {
        let watch = &mut self.watch;
        self.delaunay.complex().order_by_anchor(self.inputs, || watch.poll_after(1))
    }

    /// Passes over the homes at walls alone.
    pub(super) fn insert_at_walls(&mut self, walls: &[u32]) -> Result<()> {
        let begun = self.location.remaining();
        loop {
            let before = self.location.remaining();
            self.hold_all_but(walls)?;
            self.insert_pass(0, 0)?;
            let after = self.location.remaining();
            if before - after <= (begun - after) / FEW {
                break;
            }
        }
        self.rim.admit_all();
        Ok(())
    }

    /// Lets no inputs in but those at walls.
    fn hold_all_but(&mut self, walls: &[u32]) -> Result<()> {
        self.rim.admit_all();
        for simplex in 0..self.delaunay.complex().simplex_bound() as u32 {
            self.watch.poll_after(1)?;
            if self.location.count(simplex) > 0 && !self.is_at_wall(simplex, walls) {
                self.rim.hold(simplex)?;
            }
        }
        Ok(())
    }

    /// Whether the home `simplex` is at a wall, or next to one that is.
    fn is_at_wall(&self, simplex: u32, walls: &[u32]) -> bool {
        let neighbors = |simplex: u32| self.delaunay.complex().neighbors(simplex).iter().copied();
        let near = neighbors(simplex).flat_map(neighbors);
        let mut parts = near.filter_map(|other| self.part_of(other, walls));
        let first = parts.next();
        parts.any(|part| Some(part) != first)
    }

    /// The number of the part that a simplex is in, if it has an input.
    fn part_of(&self, simplex: u32, walls: &[u32]) -> Option<usize> {
        let vertices = self.delaunay.complex().vertices(simplex).iter().copied();
        let anchor = vertices.filter(|&vertex| self.is_input(vertex)).min()?;
        Some(walls.partition_point(|&wall| wall <= anchor))
    }
}
