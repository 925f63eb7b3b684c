//! The triangles of a triangulation in an order that depends on nothing but their corners.

use super::super::output::Simplices;
use super::triangles::{INFINITE, Triangles};
use crate::error::Result;
use crate::memory::{filled, prefetch_at, with_capacity};
use crate::mesh::NONE;
use crate::netmesh::state::order::InputId;
use crate::netmesh::state::watch::Watch;

/// Triangles that are fetched while others are written.
const AHEAD: usize = 16;

impl Triangles {
    /// Returns the finite triangles, sorted by their corners, of which the least comes first.
    /// `order`: the input that each vertex is. O(triangles).
    pub fn sorted(&self, order: &[InputId], watch: &mut Watch<'_, '_>) -> Result<Simplices> {
        let sorted = self.by_least_corner(order.len(), watch)?;
        let mut numbers = filled(self.count(), NONE)?;
        for (&(_, triangle), number) in sorted.iter().zip(0..) {
            watch.poll_after(1)?;
            numbers[triangle as usize] = number;
        }
        let rows = 3 * sorted.len();
        let (mut vertices, mut neighbors) = (with_capacity(rows)?, with_capacity(rows)?);
        for (at, &(_, triangle)) in sorted.iter().enumerate() {
            watch.poll_after(1)?;
            if let Some(&(_, later)) = sorted.get(at + AHEAD) {
                prefetch_at(self.all(), later as usize, 1);
            }
            let triangle = &self.all()[triangle as usize];
            let [first, second, third] = from_least(&triangle.corners);
            let input = |place: usize| order[triangle.corners[place] as usize].index() as u32;
            vertices.extend([first, second, third].map(input));
            // The neighbour opposite a corner is beyond the edge after it.
            let beyond = |edge: usize| numbers[(triangle.twins[edge] / 3) as usize];
            neighbors.extend([second, third, first].map(beyond));
        }
        Ok(Simplices { vertices, neighbors })
    }

    /// Returns the finite triangles by their least corners, and those of one by the corner after
    /// it, which they have beside them: of one edge a single triangle is on the left.
    fn by_least_corner(
        &self,
        vertices: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Vec<(u32, u32)>> {
        // One place further on until the lists are filled, which moves each to where it ends.
        let mut starts = filled(vertices + 2, 0u32)?;
        for triangle in self.all() {
            watch.poll_after(1)?;
            if let Some(least) = least_corner(&triangle.corners) {
                starts[least as usize + 2] += 1;
            }
        }
        for at in 1..starts.len() {
            starts[at] += starts[at - 1];
        }
        let mut sorted = filled(starts[vertices + 1] as usize, (0, 0))?;
        for (triangle, number) in self.all().iter().zip(0..) {
            watch.poll_after(1)?;
            if let Some(least) = least_corner(&triangle.corners) {
                let [_, second, _] = from_least(&triangle.corners);
                let at = &mut starts[least as usize + 1];
                sorted[*at as usize] = (triangle.corners[second], number);
                *at += 1;
            }
        }
        for ends in starts.windows(2) {
            watch.poll_after(1)?;
            sorted[ends[0] as usize..ends[1] as usize].sort_unstable();
        }
        Ok(sorted)
    }
}

/// Returns the least corner of a finite triangle.
#[inline]
fn least_corner(&[a, b, c]: &[u32; 3]) -> Option<u32> {
    (a.max(b).max(c) != INFINITE).then(|| a.min(b).min(c))
}

/// Returns the places of the corners in their direction, from the least one on.
#[inline]
fn from_least(&[a, b, c]: &[u32; 3]) -> [usize; 3] {
    match (a < b, b < c, a < c) {
        (true, _, true) => [0, 1, 2],
        (false, true, _) => [1, 2, 0],
        _ => [2, 0, 1],
    }
}
