//! Triangles of a surface that are there several times, of which one is a facet.

use super::TaskInSpace;
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::{Facets, Inputs};
use crate::options::Crossings;

/// Returns for each triangle its balance: by how much the winding number grows behind it, which is
/// 1 for a triangle that is there once. If crossings are split, the first of several with the same
/// vertices has the sum of all, those that run the other way round counted negatively, and the
/// others have none. O(n log n).
pub(super) fn balances(task: &TaskInSpace<'_>) -> AllocResult<Vec<Option<i64>>> {
    let facets = task.facets;
    let mut balances = filled(facets.count(), Some(1))?;
    if task.crossings == Crossings::Refuse || !facets.are_triangles {
        return Ok(balances);
    }
    for same in sorted(task.inputs, facets)?.chunk_by(|a, b| a.vertices == b.vertices) {
        let turn = |own: &Turned| if own.is_upwards == same[0].is_upwards { 1 } else { -1 };
        let sum = same.iter().map(turn).sum();
        for (at, own) in same.iter().enumerate() {
            balances[own.number as usize] = (at == 0).then_some(sum);
        }
    }
    Ok(balances)
}

/// Returns the number of triangles with the vertices of an earlier one; 0 for polygons. O(n log n).
pub fn count_duplicates(inputs: &Inputs, facets: &Facets) -> AllocResult<usize> {
    if !facets.are_triangles {
        return Ok(0);
    }
    let all = sorted(inputs, facets)?;
    Ok(all.windows(2).filter(|two| two[0].vertices == two[1].vertices).count())
}

/// Triangle by its vertices in their order.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Turned {
    vertices: [u32; 3],
    number: u32,
    /// True if it runs through its vertices in their order.
    is_upwards: bool,
}

/// Returns all triangles, sorted by their vertices and then by their numbers.
fn sorted(inputs: &Inputs, facets: &Facets) -> AllocResult<Vec<Turned>> {
    let turned = |(own, number): (&[u32], u32)| {
        let own = [own[0], own[1], own[2]].map(|input| inputs.vertices()[input as usize]);
        let mut vertices = own;
        vertices.sort_unstable();
        let least = own.iter().position(|&vertex| vertex == vertices[0]).unwrap_or(0);
        Turned { vertices, number, is_upwards: own[(least + 1) % 3] == vertices[1] }
    };
    let mut all = collected(facets.inputs.chunks_exact(3).zip(0u32..).map(turned))?;
    all.sort_unstable();
    Ok(all)
}
