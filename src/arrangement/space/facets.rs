//! The facets of an arrangement: a surface's triangles, merged where they are plane, polygons, and
//! the sides of a box or hull. Of a facet that shares areas with others, the parts with different
//! balances are facets of their own.

use super::TaskInSpace;
use super::fit::Fitted;
use super::merge::{Pairs, Surface, merged};
use super::pieces::{Piece, Pieces};
use super::sides::{Side, Sides};
use super::turned::refuse_turned;
use crate::arrangement::poll::{LONG, Poll};
use crate::error::Result;
use crate::memory::{AllocResult, Lists, TryGrow, collected, filled, with_capacity};
use crate::mesh::{ArrangedFacet, Arrangement, FacetTriangle, NONE};
use crate::options::Crossings;

/// Number of polls' units of work for one edge or facet.
const WORK: u32 = 1;

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
    let given = collected(task.triangles())?;
    let pairs = match task.crossings {
        Crossings::Refuse => None,
        Crossings::Split => Some(Pairs::new(&given, &of, pieces, poll)?),
    };
    let surface =
        Surface { triangles: &triangles, kinds: &kinds, origins: &of, given: &given, pairs };
    let firsts = merged(points, &surface, task.coplanar, poll)?;
    refuse_turned(points, &surface, &firsts)?;
    poll(LONG)?;
    // The first of the caller's triangles, by the first one of a group.
    let mut parents = collected(of.iter().copied())?;
    for (&first, &parent) in firsts.iter().zip(&of) {
        let known = &mut parents[first as usize];
        *known = parent.min(*known);
    }
    let parent = |at: usize| parents[firsts[at] as usize];
    let found = collected(own.enumerate().map(|(at, piece)| (parent(at), *piece)))?;
    let rest = firsts.len() - pieces.borrowed.len();
    let borrowed = (rest..).zip(&pieces.borrowed).map(|(at, piece)| (parent(at), *piece));
    add_facets(&found, &collected(borrowed)?, arrangement, poll)?;
    let spurs = spurs_of(pieces)?;
    let mut lines = ends_of_groups(&surface, &firsts, &spurs, poll)?;
    lines.try_extend(&lone_spurs(&surface, &firsts, &spurs)?)?;
    pieces.lines = lines;
    Ok(())
}

/// Returns the edges along which two edges of one of the caller's triangles go, each with the
/// triangle, sorted: no more is there of a corner that is no wider than roundings.
fn spurs_of(pieces: &Pieces) -> AllocResult<Vec<([u32; 2], u32)>> {
    let of_piece = |piece: &Piece| match (piece.facet(), piece.vertices()) {
        (Some(facet), &[a, b]) => Some(([a.min(b), a.max(b)], facet)),
        _ => None,
    };
    let mut spurs = collected(pieces.all.iter().filter_map(of_piece))?;
    spurs.sort_unstable();
    Ok(spurs)
}

/// Returns the spurs along which no triangle of their group has an edge.
fn lone_spurs(
    surface: &Surface<'_>,
    groups: &[u32],
    spurs: &[([u32; 2], u32)],
) -> AllocResult<Vec<[u32; 2]>> {
    if spurs.is_empty() {
        return Ok(Vec::new());
    }
    let mut group_of = filled(surface.given.len(), NONE)?;
    let mut sides: Vec<([u32; 2], u32)> = Vec::new();
    for (at, &[a, b, c]) in surface.triangles.iter().enumerate() {
        group_of[surface.origins[at] as usize] = groups[at];
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let ends = [from.min(to), from.max(to)];
            if spurs.binary_search_by_key(&ends, |spur| spur.0).is_ok() {
                sides.try_push((ends, groups[at]))?;
            }
        }
    }
    sides.sort_unstable();
    let is_lone = |&&(ends, origin): &&([u32; 2], u32)| {
        sides.binary_search(&(ends, group_of[origin as usize])).is_err()
    };
    collected(spurs.iter().filter(is_lone).map(|spur| spur.0))
}

/// Returns the edges at which groups of triangles end: where one of the caller's triangles ends,
/// and no neighbour goes on, nor has a spur there.
fn ends_of_groups(
    surface: &Surface<'_>,
    groups: &[u32],
    spurs: &[([u32; 2], u32)],
    poll: Poll<'_>,
) -> Result<Vec<[u32; 2]>> {
    let mut ends = Vec::new();
    // Groups, the caller's triangles, and the sides' own.
    let mut own: Vec<[u32; 3]> = Vec::new();
    for sides in Sides::of_triangles(surface.triangles, poll)?.groups() {
        poll(WORK)?;
        own.clear();
        for &Side { triangle, .. } in sides {
            let at = triangle as usize;
            own.try_push([groups[at], surface.origins[at], triangle])?;
        }
        own.sort_unstable();
        let ends_here = sides[0].ends;
        let first_spur = spurs.partition_point(|spur| spur.0 < ends_here);
        let spurs_here = spurs[first_spur..].iter().take_while(|spur| spur.0 == ends_here);
        let has_end = |same: &[[u32; 3]]| {
            // Two parts of a triangle are on both sides of an edge in it.
            let parts = same.chunk_by(|a, b| a[1] == b[1]).filter(|parts| parts.len() != 2);
            let ending = || parts.clone().map(|parts| parts[0][2]);
            let goes_on = |own: u32| {
                let origin = surface.origins[own as usize];
                let mut spurs = spurs_here.clone().map(|spur| spur.1);
                ending().any(|other| other != own && surface.are_neighbors([own, other]))
                    || spurs.any(|other| surface.are_neighbors_as_given([origin, other]))
            };
            !ending().all(goes_on)
        };
        if own.chunk_by(|a, b| a[0] == b[0]).any(has_end) {
            ends.try_push(ends_here)?;
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
pub(super) fn add_polygons(
    pieces: &Pieces,
    arrangement: &mut Arrangement,
    poll: Poll<'_>,
) -> Result<()> {
    let [found, borrowed] = [&pieces.all, &pieces.borrowed].map(|all| {
        let own = all.iter().filter(|piece| piece.triangle().is_some());
        collected(own.filter_map(|piece| Some((piece.facet()?, *piece))))
    });
    add_facets(&found?, &borrowed?, arrangement, poll)
}

/// Adds triangles, each with the number of the caller's facet, by facets: those of one number and
/// one balance. Borrowed ones are of none.
fn add_facets(
    found: &[(u32, Piece)],
    borrowed: &[(u32, Piece)],
    arrangement: &mut Arrangement,
    poll: Poll<'_>,
) -> Result<()> {
    for (parent, piece) in borrowed {
        if let Some(vertices) = piece.triangle() {
            arrangement.borrowed.try_push((vertices, *parent))?;
        }
    }
    arrangement.borrowed.sort_unstable_by_key(|&(vertices, parent)| (parent, vertices));
    poll(LONG)?;
    let kinds = numbered(found.iter().map(|(parent, piece)| (*parent, piece.balance)))?;
    poll(LONG)?;
    let of_facets = Lists::of_pairs(found.len(), || kinds.iter().copied().zip(0u32..))?;
    arrangement.triangles = with_capacity(found.len())?;
    for own in of_facets.iter().filter(|own| !own.is_empty()) {
        poll(WORK)?;
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
