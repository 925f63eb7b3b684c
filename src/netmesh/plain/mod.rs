//! The plain Delaunay triangulation of the plane and of space. It needs nothing of what a mesh
//! does, neither D-balls nor conflict lists (§6.1): inputs go in one by one, in rounds that grow
//! fourfold, each along a curve, so that a walk from the last one finds the next ("biased
//! randomized insertion order", Amenta, Choi and Rote 2003).
//!
//! - `rounds`: the order of the inputs.
//! - `plane`: edges that flip; `space`: cavities.
//! - `bits`: coordinates of which doubles make exact determinants.
//! - `ties`: which of the triangulations of points on one sphere is made.
//! - `output`: the arrays of the result.

mod bits;
mod output;
mod plane;
mod rounds;
mod space;
#[cfg(test)]
mod testing;
mod ties;

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocError, collected, with_capacity};
use crate::mesh::{Inputs, Stats, Triangulation};
use crate::netmesh::state::limit;
use crate::netmesh::state::order::{InputId, by_locality};
use crate::netmesh::state::watch::Watch;
use crate::numerics::affine_basis;
use crate::options::NetOrdering;
use crate::parameters::Parameters;
use crate::threads::usable;
use rounds::rounds;
use std::time::Instant;

/// Least number of inputs that threads share.
const MANY: usize = 20_000;

/// Returns true if points of so many dimensions are triangulated here.
pub(in crate::netmesh) fn is_for(dim: usize) -> bool {
    dim <= 3
}

/// Makes the Delaunay triangulation of inputs in the plane or in space.
///
/// # Errors
/// `DegenerateInput`: all inputs are on one line or plane; `Limit`, `Cancelled`, `OutOfMemory`.
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
    let most = if inputs.dim() == 2 { plane::MOST } else { space::MOST };
    if count > most {
        return Err(AllocError::Ids.into());
    }
    let threads = if count < MANY { 1 } else { usable(parameters.threads) };
    let seed = match parameters.ordering {
        NetOrdering::SampledNet => parameters.seed,
        NetOrdering::DeterministicNet => 0,
    };
    let mut stats = Stats::default();
    let simplices = match inputs.dim() {
        2 => plane::triangulate(ordered(inputs, threads, seed, watch)?, watch, &mut stats)?,
        _ => {
            space::triangulate(ordered(inputs, threads, seed, watch)?, threads, watch, &mut stats)?
        }
    };
    output::triangulation(inputs, simplices, parameters, stats, (begun, watch))
}

/// Points in the order of locality. A simplex has `N` corners, one more than dimensions.
struct Ordered<const D: usize, const N: usize> {
    points: Vec<[f64; D]>,
    /// Point -> the input that it is.
    order: Vec<InputId>,
    /// Points that are not on one line or plane: the corners of the first simplex.
    first: [u32; N],
    /// The others, in the order in which they go in.
    rounds: Vec<Vec<u32>>,
}

/// Orders inputs by locality and in rounds.
fn ordered<const D: usize, const N: usize>(
    inputs: &Inputs,
    threads: usize,
    seed: u64,
    watch: &mut Watch<'_, '_>,
) -> Result<Ordered<D, N>> {
    let order = by_locality::<D>(inputs, threads, watch)?;
    let mut points = with_capacity(order.len())?;
    for input in &order {
        watch.poll_after(1)?;
        points.push(inputs.distinct_point(input.index()).try_into().expect("inputs have D"));
    }
    let first = first_simplex(&points)?;
    let rounds = rounds(points.len(), seed, &first)?;
    Ok(Ordered { points, order, first, rounds })
}

/// Returns points that are not on one line or plane.
fn first_simplex<const D: usize, const N: usize>(points: &[[f64; D]]) -> Result<[u32; N]> {
    let basis = affine_basis::<D>(points.len(), |at| points[at]);
    let found = collected(basis.iter().map(|&at| at as u32))?;
    found.try_into().map_err(|found: Vec<u32>| {
        let message = message!(
            "the points have affine rank {}; a Delaunay triangulation in dimension {D} needs rank \
             {D}",
            found.len() as i64 - 1
        );
        Error::new(ErrorKind::DegenerateInput, message)
    })
}
