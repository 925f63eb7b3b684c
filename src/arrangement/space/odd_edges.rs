//! Edges of facets that are not between two facets, with these on different sides.

use super::pieces::Piece;
use super::sides::{Side, Sides};
use super::{pieces_as_given, points_of};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{TryGrow, collected};
use crate::mesh::{EdgeFault, Facets, Inputs, OddEdge, Segments};

/// Number of polls' units of work for one edge.
const WORK: u32 = 1;

/// Returns the edges of facets that are not one of two facets that run through them in opposite
/// directions, sorted. Triangles without an area have no edges. O(n log n).
///
/// # Errors
/// `OutOfMemory`, and those of `poll`.
pub fn find_odd_edges(inputs: &Inputs, facets: &Facets, poll: Poll<'_>) -> Result<Vec<OddEdge>> {
    let points = points_of(inputs)?;
    let pieces = pieces_as_given(&points, inputs, facets, &Segments::default(), poll)?;
    let triangles = collected(pieces.all.iter().filter_map(Piece::triangle))?;
    let facets: Vec<&Piece> = collected(pieces.all.iter().filter(|one| one.triangle().is_some()))?;
    let mut found = Vec::new();
    let mut own = Vec::new();
    for group in Sides::of_triangles(&triangles, poll)?.groups() {
        poll(WORK)?;
        own.clear();
        for side in group.iter().filter(|side| !is_inner(&facets, side)) {
            own.try_push(*side)?;
        }
        let group = &own[..];
        let fault = match group {
            [] => continue,
            [_] => EdgeFault::Open,
            [a, b] if a.runs_up(&triangles) == b.runs_up(&triangles) => EdgeFault::Turned,
            [_, _] => continue,
            _ => EdgeFault::Crowded,
        };
        let input = |vertex: u32| inputs.first_input(vertex as usize).unwrap_or(vertex);
        let [from, to] = group[0].ends.map(input);
        let inputs = [from.min(to), from.max(to)];
        found.try_push(OddEdge { inputs, facets: group.len() as u32, fault })?;
    }
    found.sort_unstable();
    Ok(found)
}

/// Returns true if a side is between two triangles of one facet.
fn is_inner(facets: &[&Piece], side: &Side) -> bool {
    facets[side.triangle as usize].inner >> (0b111 & !(1 << side.opposite)) & 1 == 1
}
