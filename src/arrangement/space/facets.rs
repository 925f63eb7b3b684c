//! The facets of an arrangement: a surface's triangles, merged where they are plane, polygons, and
//! the sides of a box or hull. Of a facet that shares areas with others, the parts with different
//! balances are facets of their own.

use super::TaskInSpace;
use super::fit::Fitted;
use super::merge::{Surface, merged, pairs_alone};
use super::pieces::{Piece, Pieces};
use super::sides::Sides;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, collected, with_capacity};
use crate::mesh::{ArrangedFacet, Arrangement, FacetTriangle, NONE};
use crate::options::Crossings;

/// Fills an arrangement with the facets of a surface: its triangles, merged where they are plane.
/// The lines of the pieces become the edges at which facets end, those of borrowed triangles too.
pub(super) fn add_surface(
    points: &[[f64; 3]],
    task: &TaskInSpace<'_>,
    pieces: &mut Pieces,
    arrangement: &mut Arrangement,
    poll: Poll<'_>,
) -> Result<()> {
    let own = pieces.all.iter().filter(|piece| piece.triangle().is_some());
    let whole = || own.clone().chain(&pieces.borrowed);
    let triangles = collected(whole().filter_map(Piece::triangle))?;
    let of = collected(whole().filter_map(Piece::facet))?;
    let kind =
        |&facet: &u32| (task.facets.markers[facet as usize], pieces.balances[facet as usize]);
    let kinds = numbered(of.iter().map(kind))?;
    let pairs = match task.crossings {
        Crossings::Refuse => None,
        Crossings::Split => Some(pairs_alone(task, &of)?),
    };
    let surface = Surface { triangles: &triangles, kinds: &kinds, origins: &of, pairs };
    let firsts = merged(points, &surface, task.coplanar, poll)?;
    // The first of the caller's triangles, by the first one of a group.
    let mut parents = collected(of.iter().copied())?;
    for (&first, &parent) in firsts.iter().zip(&of) {
        let known = &mut parents[first as usize];
        *known = parent.min(*known);
    }
    let parent = |at: usize| parents[firsts[at] as usize];
    let found = collected(own.enumerate().map(|(at, piece)| (parent(at), *piece)))?;
    add_facets(&found, arrangement)?;
    pieces.lines = ends_of_groups(&triangles, &firsts)?;
    Ok(())
}

/// Returns the edges that some group of triangles has not just two of.
fn ends_of_groups(triangles: &[[u32; 3]], groups: &[u32]) -> AllocResult<Vec<[u32; 2]>> {
    let mut ends = Vec::new();
    let mut own = Vec::new();
    for sides in Sides::of_triangles(triangles)?.groups() {
        own.clear();
        for side in sides {
            own.try_push(groups[side.triangle as usize])?;
        }
        own.sort_unstable();
        if own.chunk_by(|a, b| a == b).any(|same| same.len() != 2) {
            ends.try_push(sides[0].ends)?;
        }
    }
    Ok(ends)
}

/// Returns the place of each value among those that differ.
fn numbered<T: Copy + Ord>(values: impl Iterator<Item = T> + Clone) -> AllocResult<Vec<u32>> {
    let mut all = collected(values.clone())?;
    all.sort_unstable();
    all.dedup();
    collected(values.map(|value| all.partition_point(|other| *other < value) as u32))
}

/// Fills an arrangement with polygon facets. Those without an area, if crossings are split, have no
/// triangles, nor have those that lie on others.
pub(super) fn add_polygons(pieces: &[Piece], arrangement: &mut Arrangement) -> AllocResult<()> {
    let own = pieces.iter().filter(|piece| piece.triangle().is_some());
    let found = own.filter_map(|piece| Some((piece.facet()?, *piece)));
    add_facets(&collected(found)?, arrangement)
}

/// Adds triangles, each with the number of the caller's facet, by facets: those of one number and
/// one balance.
fn add_facets(found: &[(u32, Piece)], arrangement: &mut Arrangement) -> AllocResult<()> {
    let kinds = numbered(found.iter().map(|(parent, piece)| (*parent, piece.balance)))?;
    let of_facets = Lists::of_pairs(found.len(), || kinds.iter().copied().zip(0u32..))?;
    arrangement.triangles = with_capacity(found.len())?;
    for own in of_facets.iter().filter(|own| !own.is_empty()) {
        let facet = arrangement.facets.len() as u32;
        let (parent, Piece { balance, .. }) = found[own[0] as usize];
        arrangement.facets.try_push(ArrangedFacet { parent, balance })?;
        for &at in own {
            if let Some(vertices) = found[at as usize].1.triangle() {
                arrangement.triangles.try_push(FacetTriangle { vertices, facet })?;
            }
        }
    }
    Ok(())
}

/// Adds the sides of a box or hull, which are facets of none of the caller's.
pub(super) fn add_frame(fitted: &Fitted, arrangement: &mut Arrangement) -> AllocResult<()> {
    fitted.offsets.iter().for_each(|&offset| arrangement.note_offset(offset));
    for own in fitted.triangles.chunk_by(|a, b| a.facet == b.facet) {
        let facet = arrangement.facets.len() as u32;
        arrangement.facets.try_push(ArrangedFacet { parent: NONE, balance: 1 })?;
        let made = own.iter().map(|triangle| FacetTriangle { facet, ..*triangle });
        arrangement.triangles.try_extend(&collected(made)?)?;
    }
    Ok(())
}
