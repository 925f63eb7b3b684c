//! The sides of the surface on which the simplices are.
//!
//! Two kinds of evidence, both in [-1, 1]. Balls on the same side of a surface that is sampled well
//! intersect deeply, balls on different sides shallowly (N. Amenta, S. Choi and R. Kolluri, "The
//! power crust", 2001); and the two poles of a vertex on the surface are on different sides. The
//! strongest evidence counts first, and what contradicts stronger evidence does not count: a
//! maximum spanning forest of a graph with signs. No threshold says what is deep, and each simplex
//! gets a side.

use super::balls::Balls;
use super::forest::SignedForest;
use super::poles::Poles;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::mesh::NONE;

/// Number of steps between no evidence and the strongest.
const STEPS: f64 = (1u32 << 30) as f64;

/// Bit of the evidence of a vertex, beside that of a facet.
const IS_VERTEX: u64 = 1 << 32;

/// Returns for each simplex whether it is inside. O(simplices log simplices).
///
/// # Errors
/// `Limit` (more than 2^30 simplices), `OutOfMemory`.
pub fn sides<const D: usize>(balls: &Balls<'_, D>, poles: &[Poles]) -> Result<Vec<bool>> {
    let count = balls.view.mesh.simplex_count();
    if count >= SignedForest::CAPACITY / 2 {
        let message = message!("a surface of {count} simplices; there may be 2^30");
        return Err(Error::new(ErrorKind::Limit, message));
    }
    let beyond = count as u32;
    let node = |simplex: u32| if simplex == NONE { beyond } else { simplex };
    let mut forest = SignedForest::new(count + 1)?;
    for key in evidence(balls, poles)? {
        let at = key as u32;
        if key & IS_VERTEX != 0 {
            let Poles { first, second, .. } = poles[at as usize];
            forest.join(node(first), node(second), true);
        } else {
            let simplex = at / (D as u32 + 1);
            forest.join(simplex, node(balls.view.mesh.neighbors[at as usize]), false);
        }
    }
    let (_, outside) = forest.side(beyond);
    Ok(collected((0..beyond).map(|simplex| forest.side(simplex).1 != outside))?)
}

/// Returns all evidence, the strongest first: in the upper 31 bits how weak it is, then
/// [`IS_VERTEX`], in the lower 32 bits a place in `neighbors` or a vertex.
fn evidence<const D: usize>(balls: &Balls<'_, D>, poles: &[Poles]) -> AllocResult<Vec<u64>> {
    let neighbors = &balls.view.mesh.neighbors;
    let mut keys = with_capacity(neighbors.len() / 2 + poles.len())?;
    let key = |strength: f64, at: u64| (((1.0 - strength) * STEPS) as u64) << 33 | at;
    for (at, &neighbor) in neighbors.iter().enumerate() {
        let (simplex, corner) = ((at / (D + 1)) as u32, at % (D + 1));
        // Of the two places of a facet the first.
        if simplex < neighbor {
            keys.try_push(key(balls.depth(simplex, corner), at as u64))?;
        }
    }
    for (vertex, poles) in poles.iter().enumerate().filter(|(_, poles)| poles.second != NONE) {
        keys.try_push(key(poles.opposition, IS_VERTEX | vertex as u64))?;
    }
    keys.sort_unstable();
    Ok(keys)
}
