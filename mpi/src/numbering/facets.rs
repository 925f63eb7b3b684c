//! Interfaces between pieces of one rank.

use super::defect;
use super::merged::{Merged, OPEN};
use netmesh::Result;
use netmesh::distributed::memory::collected;

/// Joins the pieces of this rank; answers the places in `neighbors` behind which is another rank.
pub fn join_own(merged: &mut Merged) -> Result<Vec<usize>> {
    let size = merged.dim + 1;
    let open = merged.neighbors.iter().enumerate().filter(|(_, neighbor)| **neighbor == OPEN);
    let mut facets = collected(open.map(|(slot, _)| (merged.facet(slot), slot)))?;
    facets.sort_unstable();
    for group in facets.chunk_by(|(a, _), (b, _)| a == b) {
        match *group {
            [_] => {}
            [(_, a), (_, b)] => {
                merged.neighbors[a] = (b / size) as u64;
                merged.neighbors[b] = (a / size) as u64;
            }
            _ => return Err(defect("a facet of more than two simplices")),
        }
    }
    facets.retain(|(_, slot)| merged.neighbors[*slot] == OPEN);
    Ok(collected(facets.into_iter().map(|(_, slot)| slot))?)
}
