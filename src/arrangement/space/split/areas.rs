//! Facets that share an area. Each gets the edges and vertices of the other there, so that a
//! triangle of one is within the other or beside it; then the area is left to the first facet.

use super::super::crossed::point_over;
use super::super::meet::{Face, corner, meet};
use super::super::pieces::{Piece, Pieces};
use super::super::projection::Projection;
use super::corners::{Corner, Corners, edge_of};
use super::finest::finest;
use super::owners::Owners;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::NONE;

/// Areas that pairs of triangles share, and what their facets have to take over from each other.
#[derive(Default)]
pub(super) struct Areas {
    /// Pairs of pieces, the smaller number first.
    pub pairs: Vec<[u32; 2]>,
    /// Corners of the areas, apart from those at edges between triangles of one facet.
    pub corners: Vec<Corner>,
    /// Edges of a facet that go through another, by parts with the smaller vertex first.
    within: Vec<([u32; 2], u32)>,
    /// Edges among these that a vertex, or an edge of the other facet, divides: that comes first.
    divided: Vec<([u32; 2], u32)>,
}

/// Edges of a triangle, as faces.
const EDGES: [Face; 3] = [0b011, 0b110, 0b101];

impl Areas {
    /// Returns true if triangles are within facets that they share an area with.
    pub fn are_tiled(&self) -> bool {
        self.within.is_empty() && self.divided.is_empty()
    }

    /// Returns edges that are lines of another facet, too, each with the facet. O(n log n).
    pub fn lines(&mut self) -> impl Iterator<Item = (u32, [u32; 2])> {
        self.divided.sort_unstable();
        let divided = &self.divided;
        let is_whole = |own: &&([u32; 2], u32)| divided.binary_search(own).is_err();
        self.within.iter().filter(is_whole).map(|&(edge, facet)| (facet, edge))
    }
}

impl Corners {
    /// Adds the meeting of two pieces of facets that share an area, as their images show it.
    pub(super) fn add_area(
        &mut self,
        [points, images]: [&[[f64; 3]]; 2],
        pieces: &Pieces,
        owners: &Owners,
        both: [u32; 2],
    ) -> AllocResult<()> {
        let own = both.map(|piece| &pieces.all[piece as usize]);
        let vertices = own.map(Piece::vertices);
        let Some(meeting) = meet(images, vertices[0], vertices[1]) else { return Ok(()) };
        let pair = self.areas.corners.len() as u32;
        if meeting.is_area() {
            self.areas.pairs.try_push(both)?;
        }
        // Edges between triangles of one facet count for nothing.
        let is_owned = |which: usize, face: Face| {
            face.count_ones() == 2 && owners.has(edge_of(own[which].vertices(), face))
        };
        let is_real = |faces: &[Face; 2]| {
            faces.iter().any(|face| face.count_ones() == 1)
                || (0..2).all(|which| is_owned(which, faces[which]))
        };
        for &faces in meeting.corners().iter().filter(|faces| is_real(faces)) {
            let place = || {
                let edges = [0, 1].map(|which: usize| edge_of(vertices[which], faces[which]));
                let image = corner(images, vertices, faces);
                let on = |edge: [u32; 2]| {
                    let [at, seen] = [points, images].map(|all| edge.map(|end| &all[end as usize]));
                    point_over(at, seen, &image)
                };
                finest(points, edges, on(edges[0]), || on(edges[1]))
            };
            let vertex = self.vertex_at(points, owners, vertices, faces, place)?;
            self.areas.corners.try_push(Corner { pair, pieces: both, faces, vertex })?;
        }
        for (which, other) in [(0, 1), (1, 0)] {
            let Some(facet) = own[other].triangle().and(own[other].facet()) else { continue };
            let edges = if own[which].triangle().is_some() { &EDGES[..] } else { &EDGES[..1] };
            for &edge in edges.iter().filter(|&&edge| is_owned(which, edge)) {
                let [from, to] = edge_of(own[which].vertices(), edge);
                let part = ([from.min(to), from.max(to)], facet);
                let on_it = || meeting.corners().iter().filter(|faces| faces[which] & !edge == 0);
                let beyond = on_it().fold(0, |all, faces| all | faces[other]);
                let is_along = EDGES.iter().any(|own| beyond & !own == 0 && is_owned(other, *own));
                if on_it().count() > 1 && !is_along {
                    self.areas.within.try_push(part)?;
                }
                if on_it().any(|faces| faces[which] == edge && is_real(faces)) {
                    self.areas.divided.try_push(part)?;
                }
            }
        }
        Ok(())
    }
}

/// Returns true if the triangles that each facet borrows end where those do that it borrows them
/// of, the first of `pairs`. Two corners that are one in a projection may be two vertices. O(n log
/// n).
pub(super) fn are_lent_whole(pieces: &Pieces, pairs: &[[u32; 2]]) -> AllocResult<bool> {
    let mut is_borrowed = filled(pieces.all.len(), false)?;
    pairs.iter().for_each(|pair| is_borrowed[pair[1] as usize] = true);
    // Facet, and one of the triangles that it borrows or borrows of.
    let mut all = Vec::new();
    for &[one, other] in pairs.iter().filter(|pair| !is_borrowed[pair[0] as usize]) {
        if let Some(facet) = pieces.all[other as usize].facet() {
            all.try_extend(&[(facet, one), (facet, other)])?;
        }
    }
    all.sort_unstable();
    all.dedup();
    let edges = |&(facet, at): &(u32, u32)| {
        let own = pieces.all[at as usize].triangle().unwrap_or_default();
        [[0, 1], [1, 2], [2, 0]].map(|[k, l]| (facet, [own[k].min(own[l]), own[k].max(own[l])]))
    };
    let mut edges = collected(all.iter().flat_map(edges))?;
    edges.sort_unstable();
    Ok(edges.chunk_by(|a, b| a == b).all(|same| same.len() % 2 == 0))
}

/// Leaves the areas of pairs of triangles to the first of each, which has the balances of all that
/// share it: the others are borrowed. O(n log n).
pub(super) fn leave_to_first(
    points: &[[f64; 3]],
    pieces: &mut Pieces,
    pairs: &[[u32; 2]],
) -> AllocResult<()> {
    let mut is_borrowed = filled(pieces.all.len(), false)?;
    pairs.iter().for_each(|pair| is_borrowed[pair[1] as usize] = true);
    let kept = pairs.iter().filter(|pair| !is_borrowed[pair[0] as usize]);
    let step = |&[one, other]: &[u32; 2]| {
        let [own, over] = [one, other].map(|piece| &pieces.all[piece as usize]);
        let sign = if are_turned_alike(points, [own, over]) { 1 } else { -1 };
        (one, over.feature, sign * over.balance)
    };
    // A facet that shares the area of a triangle may have several triangles there.
    let mut steps = collected(kept.map(step))?;
    steps.sort_unstable();
    steps.dedup();
    for (piece, _, step) in steps {
        pieces.all[piece as usize].balance += step;
    }
    let mut firsts = filled(pieces.all.len(), NONE)?;
    for &[one, other] in pairs {
        let first = &mut firsts[other as usize];
        *first = one.min(*first);
    }
    // Piece -> the number that it has among the kept ones, or that its lender has: the first that
    // shares its area comes before it, and may itself be borrowed.
    let (mut kept, mut numbers) = (Vec::new(), filled(pieces.all.len(), NONE)?);
    for (at, piece) in pieces.all.iter().enumerate() {
        if is_borrowed[at] {
            numbers[at] = numbers[firsts[at] as usize];
            pieces.borrowed.try_push(*piece)?;
            pieces.lenders.try_push(numbers[at])?;
        } else {
            numbers[at] = kept.len() as u32;
            kept.try_push(*piece)?;
        }
    }
    pieces.all = kept;
    Ok(())
}

/// Returns true if two triangles in one plane turn in the same direction.
fn are_turned_alike(points: &[[f64; 3]], both: [&Piece; 2]) -> bool {
    let corners = |own: &Piece| own.triangle().map(|own| own.map(|v| &points[v as usize]));
    let [Some(one), Some(other)] = both.map(corners) else { return true };
    let projection = Projection::of_triangle(one);
    projection.is_none_or(|all| (all.turn(one) * all.turn(other)).is_positive())
}
