//! A part joins the whole in the place of what it was cut out of.

use super::super::{Cell, Mesher, limit};
use super::Part;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::mesh::Stats;

impl<const D: usize> Mesher<'_, '_, D> {
    /// `moved`: simplex that became one of a part -> its new id.
    pub(super) fn join(&mut self, part: Part<D>, moved: &mut [u32]) -> Result<()> {
        let Part { mut names, mut domains, shared, delaunay, hierarchy, .. } = part;
        let known = shared.len();
        let count = self.delaunay.point_count() + delaunay.point_count() - known;
        if count as u64 > self.parameters.max_vertices {
            return Err(limit(self.parameters.max_vertices, count));
        }
        let taken = std::mem::take(&mut names.simplices);
        let watch = &mut self.watch;
        self.delaunay.join(delaunay, &mut names, || watch.poll_after(1))?;
        for (&simplex, &name) in taken.iter().zip(&names.simplices) {
            moved[simplex as usize] = name;
        }
        self.watch.poll()?;
        self.hierarchy.join(hierarchy, &mut domains, &names.vertices, &shared)?;
        for (own, (&vertex, &cell)) in names.vertices.iter().zip(&part.cells).enumerate() {
            self.watch.poll_after(1)?;
            if own >= known {
                self.cells.try_push(cell)?;
                self.precision_limited.try_push(part.precision_limited[own])?;
                continue;
            }
            let whole = &mut self.cells[vertex as usize];
            *whole = match shared[own] {
                true => Cell {
                    nearest: whole.nearest.min(cell.nearest),
                    farthest: whole.farthest.max(cell.farthest),
                },
                false => cell,
            };
            self.precision_limited[vertex as usize] |= part.precision_limited[own];
        }
        let bound = self.delaunay.complex().simplex_bound();
        self.watch.poll()?;
        self.location.join(part.location, &names, bound)?;
        self.watch.poll()?;
        self.refine.join(part.refine, names.simplices.len(), bound)?;
        for &(cage, input) in &part.rim.postponed {
            let input = names.vertices[input as usize];
            self.rim.postponed.try_push((domains.name(cage), input))?;
        }
        add(&mut self.stats, &part.stats);
        Ok(())
    }
}

/// Adds what a part has counted, but for its rounds and passes, which went on beside those of others.
fn add(stats: &mut Stats, part: &Stats) {
    stats.yields += part.yields;
    stats.far_corners += part.far_corners;
    stats.off_centers += part.off_centers;
    stats.cage_points += part.cage_points;
    stats.closing_points += part.closing_points;
    stats.cages_created += part.cages_created;
    stats.cages_grown += part.cages_grown;
    stats.cages_released += part.cages_released;
}
