//! Triangles of a surface that share edges, lie in one plane and are of one kind, as one facet.

use super::bends::{Hinge, ROUNDING, normal, normalized, sine_of};
use super::pieces::Pieces;
use super::projection::Projection;
use super::sides::Sides;
use crate::arrangement::poll::{LONG, Poll};
use crate::error::Result;
use crate::memory::{
    AllocResult, Lists, Sets, TryGrow, collected, copied, enqueue, filled, with_capacity,
};
use crate::mesh::NONE;
use crate::numerics::norm;
use std::cmp::Reverse;
use std::collections::VecDeque;

/// Number of polls' units of work for one pair of neighbours, most of which are plainly bent.
const WORK: u32 = 20;

/// Number of polls' units of work for one triangle of a facet that grows.
const STEP_WORK: u32 = 2;

/// Number of polls' units of work for one exact normal.
const NORMAL_WORK: u32 = 24;

/// Triangles of which some are one facet.
pub(super) struct Surface<'a> {
    pub triangles: &'a [[u32; 3]],
    /// Triangle -> its kind: those of one facet are of one kind.
    pub kinds: &'a [u32],
    /// Triangle -> the caller's one that it is a part of.
    pub origins: &'a [u32],
    /// The caller's triangles.
    pub given: &'a [[u32; 3]],
    /// Pairs of the caller's triangles, if crossings are split; `None` if all meet in edges that
    /// they share alone.
    pub pairs: Option<Pairs<'a>>,
}

/// Pairs of the caller's triangles.
pub(super) struct Pairs<'a> {
    /// Pairs that are known to be neighbours, the lower number first; sorted.
    neighbors: Vec<[u32; 2]>,
    /// Triangles from here on are borrowed from those in `lenders`.
    first_borrowed: u32,
    lenders: &'a [u32],
    /// Triangle of the caller's -> true if it has several parts. Where others cross it counts where
    /// it is: in a bent facet it would be elsewhere.
    is_divided: Vec<bool>,
}

impl Surface<'_> {
    /// Returns true if two triangles that share an edge may be one facet, apart from their planes.
    fn may_join(&self, pair: [u32; 2]) -> bool {
        let [a, b] = pair.map(|triangle| self.kinds[triangle as usize]);
        a == b && self.are_neighbors(pair)
    }

    /// Returns true if two triangles that share an edge are parts of one of the caller's, or of two
    /// that are known to be neighbours.
    pub fn are_neighbors(&self, pair: [u32; 2]) -> bool {
        self.are_neighbors_as_given(pair.map(|triangle| self.origins[triangle as usize]))
    }

    /// Returns true if two of the caller's triangles are one, or known to be neighbours.
    pub fn are_neighbors_as_given(&self, [a, b]: [u32; 2]) -> bool {
        let pair = [a.min(b), a.max(b)];
        let is_listed = |pairs: &Pairs<'_>| pairs.neighbors.binary_search(&pair).is_ok();
        a == b || self.pairs.as_ref().is_none_or(is_listed)
    }

    /// Returns true if a part of a triangle of the caller's that has others is in a pair.
    fn has_divided(&self, pair: [u32; 2]) -> bool {
        let is_divided = |pairs: &Pairs<'_>| {
            pair.iter().any(|&own| pairs.is_divided[self.origins[own as usize] as usize])
        };
        self.pairs.as_ref().is_some_and(is_divided)
    }

    /// Returns the triangle that has the area of one: itself, unless it is borrowed.
    fn lender(&self, triangle: u32) -> u32 {
        let of = |pairs: &Pairs<'_>| {
            let borrowed = triangle.checked_sub(pairs.first_borrowed)?;
            Some(pairs.lenders[borrowed as usize])
        };
        self.pairs.as_ref().and_then(of).unwrap_or(triangle)
    }
}

impl<'a> Pairs<'a> {
    /// Finds the pairs of the caller's triangles, of which those in `origins` have parts. O(n log
    /// n).
    pub fn new(
        given: &[[u32; 3]],
        origins: &[u32],
        pieces: &'a Pieces,
        poll: Poll<'_>,
    ) -> Result<Self> {
        let mut kept = copied(origins)?;
        kept.sort_unstable();
        let mut is_divided = filled(given.len(), false)?;
        for two in kept.windows(2).filter(|two| two[0] == two[1]) {
            is_divided[two[0] as usize] = true;
        }
        kept.dedup();
        Ok(Self {
            neighbors: neighbors_among(given, &kept, poll)?,
            first_borrowed: (origins.len() - pieces.borrowed.len()) as u32,
            lenders: &pieces.lenders,
            is_divided,
        })
    }
}

/// Returns the pairs of some of the caller's triangles that run in opposite directions through an
/// edge which no third one has, sorted: where surfaces overlap, only these are known to be
/// neighbours. O(n log n).
fn neighbors_among(given: &[[u32; 3]], kept: &[u32], poll: Poll<'_>) -> Result<Vec<[u32; 2]>> {
    let triangles = collected(kept.iter().map(|&triangle| given[triangle as usize]))?;
    let mut pairs = Vec::new();
    for group in Sides::of_triangles(&triangles, poll)?.groups() {
        let &[one, other] = group else { continue };
        if one.runs_up(&triangles) != other.runs_up(&triangles) {
            // Kept triangles are in order, and so are the sides of an edge.
            pairs.try_push([one, other].map(|side| kept[side.triangle as usize]))?;
        }
    }
    pairs.sort_unstable();
    Ok(pairs)
}

/// Returns for each triangle the first triangle of its facet. Triangles are of one facet if a way
/// leads from one to the other over edges at which they bend by at most `coplanar` degrees (0: by
/// no more than rounding explains), and if none is turned by more from the one that the facet grew
/// from. All turn alike where the caller's triangle that this is a part of is largest: the part may
/// be no wider than roundings. Parts of one triangle, which go through inputs beside it, are of one
/// facet whatever their angle. Facets grow from their first triangles, or with an angle from their
/// largest. Over an edge at which one is borrowed, two are of one facet if those are that have
/// their areas: the mesh shows no more of them than that. O(n log n), where few facets are borrowed
/// from.
pub(super) fn merged(
    points: &[[f64; 3]],
    surface: &Surface<'_>,
    coplanar: f64,
    poll: Poll<'_>,
) -> Result<Vec<u32>> {
    let Surface { triangles, origins, .. } = *surface;
    let sine = sine_of(coplanar);
    let (neighbors, borrowed) = flat_neighbors(points, surface, sine, poll)?;
    let corners = |triangle: u32| triangles[triangle as usize].map(|v| &points[v as usize]);
    let has_angle = sine > ROUNDING;
    let normals = if has_angle { normals_of(points, triangles, poll)? } else { Vec::new() };
    let normal = |triangle: u32| normals.get(triangle as usize);
    let sized = |triangle: u32| (normal(triangle).map_or((0, 0), |own| own.size), triangle);
    let mut seeds = collected((0..triangles.len() as u32).map(sized))?;
    seeds.sort_unstable_by_key(|&(size, triangle)| (Reverse(size), triangle));
    poll(LONG)?;
    let mut facets = filled(triangles.len(), NONE)?;
    let (mut members, mut waiting) = (Vec::new(), VecDeque::new());
    for (_, seed) in seeds {
        if facets[seed as usize] != NONE {
            continue;
        }
        let given = surface.given[origins[seed as usize] as usize].map(|v| &points[v as usize]);
        let Some(frame) = Frame::of(given, normal(seed), sine) else { continue };
        facets[seed as usize] = seed;
        members.clear();
        enqueue(&mut waiting, seed)?;
        while let Some(triangle) = waiting.pop_front() {
            members.try_push(triangle)?;
            poll(STEP_WORK)?;
            for &next in neighbors.of(triangle as usize) {
                let is_part = origins[triangle as usize] == origins[next as usize];
                if facets[next as usize] == NONE
                    && frame.contains(corners(next), normal(next), is_part)
                {
                    facets[next as usize] = seed;
                    enqueue(&mut waiting, next)?;
                }
            }
        }
        let first = members.iter().copied().min().unwrap_or(seed);
        members.iter().for_each(|&member| facets[member as usize] = first);
    }
    join_borrowed(surface, &borrowed, &mut facets)?;
    Ok(facets)
}

/// Joins the facets of pairs of triangles of which the lenders are of one facet.
fn join_borrowed(surface: &Surface<'_>, pairs: &[[u32; 2]], facets: &mut [u32]) -> AllocResult<()> {
    if pairs.is_empty() {
        return Ok(());
    }
    let mut sets = Sets::new(facets.len())?;
    for (triangle, &first) in facets.iter().enumerate().filter(|(_, first)| **first != NONE) {
        sets.join(triangle, first as usize);
    }
    let mut is_done = false;
    while !is_done {
        is_done = true;
        for &pair in pairs {
            let [a, b] = pair.map(|own| own as usize);
            let [from, other] = pair.map(|own| surface.lender(own) as usize);
            if sets.find(a) != sets.find(b) && sets.find(from) == sets.find(other) {
                sets.join(a, b);
                is_done = false;
            }
        }
    }
    // The first of each set, which its own root may not be.
    let mut firsts = filled(facets.len(), NONE)?;
    for triangle in (0..facets.len()).rev() {
        firsts[sets.find(triangle)] = triangle as u32;
    }
    for (triangle, own) in facets.iter_mut().enumerate().filter(|(_, own)| **own != NONE) {
        *own = firsts[sets.find(triangle)];
    }
    Ok(())
}

/// Plane from which the triangles of a facet are not turned much.
struct Frame {
    projection: Projection,
    is_positive: bool,
    /// Normal of length 1 where triangles may be turned by an angle; `None` where only the edges
    /// between them count.
    normal: Option<[f64; 3]>,
    cosine: f64,
}

/// Normal of a triangle.
struct Normal {
    /// Direction of length 1.
    unit: [f64; 3],
    /// Twice the area, in an order of its own.
    size: (i64, u64),
}

/// Returns the normals of triangles. They are exact but for roundings, which takes its time.
fn normals_of(points: &[[f64; 3]], triangles: &[[u32; 3]], poll: Poll<'_>) -> Result<Vec<Normal>> {
    let mut normals = with_capacity(triangles.len())?;
    for own in triangles {
        poll(NORMAL_WORK)?;
        let (normal, exponent) = normalized(normal(own.map(|v| &points[v as usize])));
        let length = norm(&normal);
        let size = (exponent, (length * 1e6) as u64);
        normals.push(Normal { unit: normal.map(|x| x / length), size });
    }
    Ok(normals)
}

impl Frame {
    fn of(corners: [&[f64; 3]; 3], normal: Option<&Normal>, sine: f64) -> Option<Self> {
        let projection = Projection::of_triangle(corners)?;
        Some(Self {
            projection,
            is_positive: projection.turn(corners).is_positive(),
            normal: normal.map(|own| own.unit),
            cosine: (1.0 - sine * sine).max(0.0).sqrt(),
        })
    }

    /// Returns true if a triangle turns as the facet does in its projection, exactly, and is not
    /// turned from its plane by more than the angle, or is a part of one in it.
    fn contains(&self, corners: [&[f64; 3]; 3], normal: Option<&Normal>, is_part: bool) -> bool {
        let turn = self.projection.turn(corners);
        let is_alike = if self.is_positive { turn.is_positive() } else { turn.is_negative() };
        let is_turned = |(own, other): ([f64; 3], &Normal)| {
            (0..3).map(|k| own[k] * other.unit[k]).sum::<f64>() < self.cosine
        };
        is_alike && (is_part || !self.normal.zip(normal).is_some_and(is_turned))
    }
}

/// Returns for each triangle those beyond an edge at which the two are flat and of one kind, or are
/// parts of one; and such pairs of which one is borrowed, and which are no parts of one.
fn flat_neighbors(
    points: &[[f64; 3]],
    surface: &Surface<'_>,
    sine: f64,
    poll: Poll<'_>,
) -> Result<(Lists, Vec<[u32; 2]>)> {
    let Surface { triangles, origins, .. } = *surface;
    let sides = Sides::of_triangles(triangles, poll)?;
    let point = |vertex: u32| &points[vertex as usize];
    let (mut pairs, mut borrowed) = (with_capacity(triangles.len())?, Vec::new());
    for group in sides.groups() {
        poll(WORK)?;
        for (at, one) in group.iter().enumerate() {
            for other in &group[at + 1..] {
                let (edge, c) = one.within(triangles);
                let ([to, from], d) = other.within(triangles);
                let [t, u] = [one, other].map(|side| side.triangle);
                let hinge = Hinge { edge: edge.map(point), apexes: [c, d].map(point) };
                let are_parts = origins[t as usize] == origins[u as usize];
                let most = if surface.has_divided([t, u]) { ROUNDING } else { sine };
                let are_flat = are_parts || surface.may_join([t, u]) && hinge.is_flat(most);
                if edge != [from, to] || !are_flat {
                    continue;
                }
                let are_own = [t, u].iter().all(|&own| surface.lender(own) == own);
                if are_own || are_parts { &mut pairs } else { &mut borrowed }.try_push([t, u])?;
            }
        }
    }
    let both = || pairs.iter().flat_map(|&[t, u]| [(t, u), (u, t)]);
    Ok((Lists::of_pairs(triangles.len(), both)?, borrowed))
}
