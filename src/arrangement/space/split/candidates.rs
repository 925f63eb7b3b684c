//! Points that become vertices where none is near.

use crate::arrangement::near::Near;
use crate::arrangement::reach::{NEAR, Reach};
use crate::memory::{AllocResult, TryGrow, copied, with_capacity};
use crate::mesh::NONE;
use std::array::from_fn;
use std::collections::BTreeMap;

/// Point that becomes a vertex, unless one is there.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    pub x: [f64; 3],
    /// Units in the last place of the largest coordinates that it was computed from; zeros where
    /// these are too close to each other for rounding to explain a gap.
    pub units: [f64; 3],
    /// Edges of facets or segments, or [`NONE`], that the point is on, by their ends: as far from
    /// them as a vertex of another piece may be, it is not that vertex.
    pub edges: [[u32; 2]; 2],
    /// The three facets that go through the point, if that is known: wherever it is computed, it is
    /// one vertex.
    pub facets: Option<[u32; 3]>,
}

/// Returns for each candidate its vertex: one that rounding explains to be there, or a new one that
/// is appended to `points`. O(n log n), where few are close to each other.
pub(super) fn vertices_of(
    points: &mut Vec<[f64; 3]>,
    candidates: &[Candidate],
) -> AllocResult<Vec<u32>> {
    let known = points.len();
    let mut all = copied(points)?;
    for candidate in candidates {
        all.try_push(candidate.x)?;
    }
    let mut near = Near::new(&all)?;
    let widest = candidates.iter().fold([0.0f64; 3], |widest, candidate| {
        from_fn(|k| widest[k].max(NEAR * candidate.units[k]))
    });
    let mut vertices: Vec<u32> = with_capacity(candidates.len())?;
    let mut of_facets = BTreeMap::new();
    for (number, candidate) in candidates.iter().enumerate() {
        let mut vertex = candidate.facets.and_then(|facets| of_facets.get(&facets).copied());
        if vertex.is_none() {
            near.each_in_box(&candidate.x, &widest, |at, _| {
                // A vertex, or a candidate that has become one.
                let (there, units) = match (at as usize).checked_sub(known) {
                    None => (at, [0.0; 3]),
                    Some(other) if other < number => (vertices[other], candidates[other].units),
                    Some(_) => return Ok(true),
                };
                let y = &points[there as usize];
                let is_close = |k: usize| {
                    (y[k] - candidate.x[k]).abs() <= NEAR * units[k].max(candidate.units[k])
                };
                let may_be = |edge: &[u32; 2]| {
                    edge[0] == NONE
                        || Reach::of(edge.map(|end| &points[end as usize])).may_go_through(y)
                };
                if (0..3).all(is_close) && candidate.edges.iter().all(may_be) {
                    vertex = Some(vertex.map_or(there, |first: u32| first.min(there)));
                }
                Ok(true)
            })?;
        }
        let vertex = match vertex {
            Some(vertex) => vertex,
            None => {
                points.try_push(candidate.x)?;
                points.len() as u32 - 1
            }
        };
        if let Some(facets) = candidate.facets {
            of_facets.insert(facets, vertex);
        }
        vertices.push(vertex);
    }
    Ok(vertices)
}
