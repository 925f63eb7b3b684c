//! The plain Delaunay triangulation of the plane. It needs nothing of what a mesh does, neither
//! D-balls nor conflict lists (§6.1): inputs go in one by one, in rounds that double, each along a
//! curve, so that a walk from the last one finds the next ("biased randomized insertion order",
//! Amenta, Choi and Rote 2003), and edges flip until every circle is empty (Lawson 1977).
//!
//! - `rounds`: the order of the inputs.
//! - `triangles`: triangles and their edges, split and flipped.
//! - `signs`: the sides of lines and circles that points are on.
//! - `insertion`: the triangle of a point, and the flips after it.
//! - `output`: the arrays of the result.

mod insertion;
mod output;
mod rounds;
mod signs;
#[cfg(test)]
mod tests;
mod triangles;

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocError, collected, with_capacity};
use crate::mesh::{Inputs, Stats, Triangulation};
use crate::netmesh::plain::insertion::Plain;
use crate::netmesh::plain::rounds::rounds;
use crate::netmesh::state::limit;
use crate::netmesh::state::order::{InputId, by_locality};
use crate::netmesh::state::parameters::usable_threads;
use crate::netmesh::state::watch::Watch;
use crate::numerics::affine_basis;
use crate::options::{NetOrdering, Phase};
use crate::parameters::Parameters;
use std::time::Instant;

/// Largest number of inputs whose edges have ids: some six for each.
const MOST: usize = u32::MAX as usize / 6 - 2;

/// Makes the Delaunay triangulation of inputs in the plane.
///
/// # Errors
/// `DegenerateInput`: all inputs are on one line; `Limit`, `Cancelled`, `OutOfMemory`.
pub(in crate::netmesh) fn triangulate(
    inputs: &Inputs,
    parameters: Parameters,
    watch: &mut Watch<'_, '_>,
) -> Result<Triangulation> {
    let begun = Instant::now();
    let count = inputs.distinct();
    if count as u64 > parameters.max_vertices {
        return Err(limit(parameters.max_vertices, count));
    }
    if count > MOST {
        return Err(AllocError::Ids.into());
    }
    let order = by_locality::<2>(inputs, usable_threads::<2>(&parameters, count), watch)?;
    let mut points = with_capacity(count)?;
    for &input in &order {
        watch.poll_after(1)?;
        points.push(*point(inputs, input));
    }
    let first = first_triangle(&points)?;
    let mut plain = Plain::new(&points, first)?;
    let seed = match parameters.ordering {
        NetOrdering::SampledNet => parameters.seed,
        NetOrdering::DeterministicNet => 0,
    };
    let rounds = rounds(count, seed, &first)?;
    let mut stats = Stats { rounds: rounds.len() as u64, ..Stats::default() };
    let mut inserted = first.len();
    for round in &rounds {
        for &vertex in round {
            if watch.is_due(8) {
                let done = inserted as f64 / count as f64;
                let simplices = plain.triangles.count() as u64;
                watch.note(Phase::Insert, done, [inserted as u64, inserted as u64, simplices]);
                watch.report()?;
            }
            plain.insert(vertex)?;
            inserted += 1;
        }
    }
    stats.passes = stats.rounds;
    plain.count_into(&mut stats);
    let Plain { triangles, .. } = plain;
    output::triangulation(inputs, &order, &triangles, parameters, stats, (begun, watch))
}

fn point(inputs: &Inputs, input: InputId) -> &[f64; 2] {
    inputs.distinct_point(input.index()).try_into().expect("inputs in the plane")
}

/// Returns three points that are not on one line, counterclockwise.
fn first_triangle(points: &[[f64; 2]]) -> Result<[u32; 3]> {
    let basis = affine_basis::<2>(points.len(), |at| points[at]);
    if basis.len() < 3 {
        let message = message!(
            "the points have affine rank {}; a Delaunay triangulation in dimension 2 needs rank 2",
            basis.len() - 1
        );
        return Err(Error::new(ErrorKind::DegenerateInput, message));
    }
    let found = collected(basis.iter().map(|&at| at as u32))?;
    Ok(signs::counterclockwise([found[0], found[1], found[2]], points))
}
