//! The plain Delaunay triangulation of space: a cavity for each point. Threads insert in boxes of
//! their own, and leave to the next pass, with boxes across another axis, what reaches out of them.
//! The result does not depend on the boxes, since points on one sphere are told apart by their
//! numbers ([`ties`](super::ties)).
//!
//! - `tetrahedra`: tetrahedra and their faces; `room` their places.
//! - `signs`: the sides of planes and spheres that points are on.
//! - `insertion`: the tetrahedron of a point, its cavity and its star, whose faces meet by `links`.
//! - `region`: boxes for threads; `passes` what they insert.
//! - `sorted`: the finite tetrahedra in an order that the points alone determine.

mod insertion;
mod links;
mod passes;
mod region;
mod room;
mod signs;
mod sorted;
#[cfg(test)]
mod tests;
mod tetrahedra;

use super::Ordered;
use super::output::Simplices;
use crate::error::Result;
use crate::mesh::Stats;
use crate::netmesh::state::watch::Watch;
use crate::numerics::{Sign, orientation};
use passes::Passes;

/// Largest number of points whose faces have ids: some seven tetrahedra of four faces each.
pub(super) const MOST: usize = u32::MAX as usize / 32;

/// Triangulates points.
pub(super) fn triangulate(
    ordered: Ordered<3, 4>,
    threads: usize,
    watch: &mut Watch<'_, '_>,
    stats: &mut Stats,
) -> Result<Simplices> {
    let Ordered { points, order, first, rounds } = ordered;
    let mut passes = Passes::new(&points, positive(first, &points), threads, watch)?;
    stats.rounds = rounds.len() as u64;
    for round in rounds {
        passes.insert(round, watch)?;
    }
    passes.count_into(stats);
    passes.tetrahedra.sorted(&order, threads, watch)
}

/// Returns four corners with positive orientation.
fn positive([a, b, c, d]: [u32; 4], points: &[[f64; 3]]) -> [u32; 4] {
    match orientation(&[a, b, c, d].map(|corner| &points[corner as usize])) {
        Sign::Negative => [b, a, c, d],
        _ => [a, b, c, d],
    }
}
