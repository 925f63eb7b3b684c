//! Points that become vertices where none is near.

use super::roundings::Roundings;
use crate::arrangement::near::Near;
use crate::arrangement::reach::NEAR;
use crate::memory::{AllocResult, TryGrow, collected, copied, with_capacity};
use crate::mesh::NONE;
use std::array::from_fn;

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
    roundings: &Roundings,
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
    let firsts = first_of_facets(candidates)?;
    for (number, candidate) in candidates.iter().enumerate() {
        let first = firsts[number] as usize;
        let mut vertex = (first < number).then(|| vertices[first]);
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
                    edge[0] == NONE || roundings.reach(points, *edge).may_go_through(y)
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
        vertices.push(vertex);
    }
    Ok(vertices)
}

/// Returns for each candidate the first one of the same three facets, which is itself where these
/// are not known.
fn first_of_facets(candidates: &[Candidate]) -> AllocResult<Vec<u32>> {
    let known = (0u32..).zip(candidates);
    let known = known.filter_map(|(number, one)| Some((one.facets?, number)));
    let mut known = collected(known)?;
    known.sort_unstable();
    let mut firsts = collected(0..candidates.len() as u32)?;
    for same in known.chunk_by(|a, b| a.0 == b.0) {
        same.iter().for_each(|one| firsts[one.1 as usize] = same[0].1);
    }
    Ok(firsts)
}
