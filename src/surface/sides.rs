//! The sides of the surface on which the simplices are.
//!
//! Two kinds of evidence, both in [-1, 1]. Balls on the same side of a surface that is sampled well
//! intersect deeply, balls on different sides shallowly (N. Amenta, S. Choi and R. Kolluri, "The
//! power crust", 2001); and the two poles of a vertex on the surface are on different sides. The
//! strongest evidence counts first, and what contradicts stronger evidence does not count: a
//! maximum spanning forest of a graph with signs. No threshold says what is deep, and each simplex
//! gets a side. The poles of a vertex count less where nobody agrees about its umbrella, as with
//! outliers.

use super::forest::SignedForest;
use super::poles::Poles;
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::mesh::{NONE, Triangulation};

/// Number of steps between no evidence and the strongest.
const STEPS: f64 = (1u32 << 30) as f64;

/// Part of the evidence of a vertex that counts by the agreement about its umbrella.
const AGREED: f64 = 0.3;

/// Bit of the evidence of a vertex, beside that of a facet.
const IS_VERTEX: u64 = 1 << 32;

/// Returns for each simplex whether it is inside. O(simplices log simplices).
///
/// # Errors
/// `Limit` (more than 2^30 simplices), `OutOfMemory`.
pub fn sides<const D: usize>(
    mesh: &Triangulation,
    depths: &[f64],
    poles: &[Poles],
    agreements: &[f64],
) -> Result<Vec<bool>> {
    let count = mesh.simplex_count();
    if count >= SignedForest::CAPACITY / 2 {
        let message = message!("a surface of {count} simplices; there may be 2^30");
        return Err(Error::new(ErrorKind::Limit, message));
    }
    let beyond = count as u32;
    let node = |simplex: u32| if simplex == NONE { beyond } else { simplex };
    let mut forest = SignedForest::new(count + 1)?;
    for key in evidence::<D>(mesh, depths, poles, agreements)? {
        let at = key as u32;
        if key & IS_VERTEX != 0 {
            let Poles { first, second, .. } = poles[at as usize];
            forest.join(node(first), node(second), true);
        } else {
            let simplex = at / (D as u32 + 1);
            forest.join(simplex, node(mesh.neighbors[at as usize]), false);
        }
    }
    let (_, outside) = forest.side(beyond);
    Ok(collected((0..beyond).map(|simplex| forest.side(simplex).1 != outside))?)
}

/// Returns all evidence, the strongest first: in the upper 31 bits how weak it is, then
/// [`IS_VERTEX`], in the lower 32 bits a place in `neighbors` or a vertex.
fn evidence<const D: usize>(
    mesh: &Triangulation,
    depths: &[f64],
    poles: &[Poles],
    agreements: &[f64],
) -> AllocResult<Vec<u64>> {
    let mut keys = with_capacity(depths.len() / 2 + poles.len())?;
    let key = |strength: f64, at: u64| (((1.0 - strength) * STEPS) as u64) << 33 | at;
    for (at, (&neighbor, &depth)) in mesh.neighbors.iter().zip(depths).enumerate() {
        // Of the two places of a facet the first.
        if ((at / (D + 1)) as u32) < neighbor {
            keys.try_push(key(depth, at as u64))?;
        }
    }
    let both = poles.iter().zip(agreements).enumerate();
    for (vertex, (poles, agreement)) in both.filter(|(_, (poles, _))| poles.second != NONE) {
        let strength = poles.opposition * (1.0 - AGREED * (1.0 - agreement));
        keys.try_push(key(strength, IS_VERTEX | vertex as u64))?;
    }
    keys.sort_unstable();
    Ok(keys)
}
