//! The plain Delaunay triangulation of the plane: edges flip until every circle is empty (Lawson
//! 1977).
//!
//! - `triangles`: triangles and their edges, split and flipped.
//! - `signs`: the sides of lines and circles that points are on.
//! - `insertion`: the triangle of a point, and the flips after it.
//! - `sorted`: the result in an order of its own.
//!
//! Four points on one circle have two triangulations; which one is made is told by their numbers
//! ([`ties`](super::ties)).

mod insertion;
mod signs;
mod sorted;
#[cfg(test)]
mod tests;
mod triangles;

use super::Ordered;
use super::output::Simplices;
use crate::error::Result;
use crate::mesh::Stats;
use crate::netmesh::state::watch::Watch;
use crate::options::Phase;
use insertion::Plain;
use signs::counterclockwise;

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
    plain.triangles.sorted(&order, watch)
}
