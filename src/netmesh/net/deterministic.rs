//! The round of the deterministic ordering: NET(1/(2d), inputs) of every home, or of smaller parts
//! where that did not halve the homes. No random number is used, here or elsewhere in such a run.

use super::greedy::Net;
use crate::error::Result;
use crate::memory::{TryGrow, collected};
use crate::netmesh::Mesher;

impl<const D: usize> Mesher<'_, '_, D> {
    /// The net of every home's inputs for eps = 2^-pass / (2 D). Homes with 1 / eps inputs or fewer
    /// are exhausted.
    pub(super) fn select_nets(&mut self, pass: u32) -> Result<Vec<u32>> {
        let share = (2 * D as u32) << pass.min(24);
        let mut net = Net::new()?;
        let (mut inputs, mut points) = (Vec::new(), Vec::new());
        let mut selected = Vec::new();
        for home in 0..self.delaunay.complex().simplex_bound() as u32 {
            self.watch.tick(1)?;
            let threshold = self.location.count(home).div_ceil(share);
            if threshold == 0 {
                continue;
            }
            inputs.clear();
            for input in self.location.inhabitants(home) {
                self.watch.tick(1)?;
                inputs.try_push(input)?;
            }
            if threshold == 1 {
                selected.try_extend(&inputs)?;
                continue;
            }
            points.clear();
            for &input in &inputs {
                points.try_push(*self.delaunay.point(input))?;
            }
            let finite = self.delaunay.finite_near(home);
            let corners = self.delaunay.complex().vertices(finite);
            let anchors = collected(corners.iter().map(|&v| *self.delaunay.point(v)))?;
            for &i in net.choose(&anchors, &points, threshold, &mut self.watch)? {
                selected.try_push(inputs[i as usize])?;
            }
        }
        Ok(selected)
    }
}
