//! The plain Delaunay triangulation of the plane: edges flip until every circle is empty (Lawson
//! 1977).
//!
//! - `triangles`: triangles and their edges, split and flipped.
//! - `signs`: the sides of lines and circles that points are on.
//! - `insertion`: the triangle of a point, and the flips after it.

mod insertion;
mod signs;
#[cfg(test)]
mod tests;
mod triangles;

use super::Ordered;
use super::output::Simplices;
use crate::error::Result;
use crate::memory::{filled, with_capacity};
use crate::mesh::{NONE, Stats};
use crate::netmesh::state::order::InputId;
use crate::netmesh::state::watch::Watch;
use crate::options::Phase;
use insertion::Plain;
use signs::counterclockwise;
use triangles::{INFINITE, Triangle, Triangles, next};

/// Largest number of points whose edges have ids: some six for each.
pub(super) const MOST: usize = u32::MAX as usize / 6 - 2;

/// Triangulates points.
pub(super) fn triangulate(
    ordered: Ordered<2, 3>,
    watch: &mut Watch<'_, '_>,
    stats: &mut Stats,
) -> Result<Simplices> {
    let Ordered { points, order, first, rounds } = ordered;
    let mut plain = Plain::new(&points, counterclockwise(first, &points))?;
    stats.rounds = rounds.len() as u64;
    stats.passes = stats.rounds;
    for (inserted, vertex) in (first.len()..).zip(rounds.into_iter().flatten()) {
        if watch.is_due(8) {
            let done = inserted as f64 / points.len() as f64;
            let simplices = plain.triangles.count() as u64;
            watch.note(Phase::Insert, done, [inserted as u64, inserted as u64, simplices]);
            watch.report()?;
        }
        plain.insert(vertex)?;
    }
    plain.count_into(stats);
    finite(&plain.triangles, &order, watch)
}

/// Returns the finite triangles.
fn finite(
    triangles: &Triangles,
    order: &[InputId],
    watch: &mut Watch<'_, '_>,
) -> Result<Simplices> {
    let mut numbers = filled(triangles.count(), NONE)?;
    let mut finite = 0;
    for (number, triangle) in numbers.iter_mut().zip(triangles.all()) {
        if !triangle.corners.contains(&INFINITE) {
            *number = finite;
            finite += 1;
        }
    }
    let rows = 3 * finite as usize;
    let (mut vertices, mut neighbors) = (with_capacity(rows)?, with_capacity(rows)?);
    for (&number, Triangle { corners, twins }) in numbers.iter().zip(triangles.all()) {
        watch.poll_after(1)?;
        if number != NONE {
            vertices.extend(corners.map(|corner| order[corner as usize].index() as u32));
            // The neighbour opposite a corner is beyond the edge after it.
            let opposite = |corner: u32| numbers[(twins[next(corner) as usize] / 3) as usize];
            neighbors.extend([0, 1, 2].map(opposite));
        }
    }
    Ok(Simplices { vertices, neighbors })
}
