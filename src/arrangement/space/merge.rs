//! Triangles of a surface that share edges, lie in one plane and are of one kind, as one facet.

use super::TaskInSpace;
use super::bends::{Hinge, ROUNDING, normal, normalized, sine_of};
use super::projection::Projection;
use super::sides::Sides;
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{
    AllocResult, Lists, TryGrow, collected, copied, enqueue, filled, with_capacity,
};
use crate::mesh::NONE;
use crate::numerics::norm;
use std::cmp::Reverse;
use std::collections::VecDeque;

/// Number of polls' units of work for one pair of neighbours.
const WORK: u32 = 2;

/// Triangles of which some are one facet.
pub(super) struct Surface<'a> {
    pub triangles: &'a [[u32; 3]],
    /// Triangle -> its kind: those of one facet are of one kind.
    pub kinds: &'a [u32],
    /// Triangle -> the caller's one that it is a part of.
    pub origins: &'a [u32],
    /// Pairs of the caller's triangles that may be one facet, sorted; `None` if all may.
    pub pairs: Option<Vec<[u32; 2]>>,
}

impl Surface<'_> {
    /// Returns true if two triangles may be one facet, apart from their planes.
    fn may_join(&self, [one, other]: [u32; 2]) -> bool {
        let [a, b] = [one, other].map(|triangle| self.origins[triangle as usize]);
        let is_listed = |pairs: &Vec<[u32; 2]>| pairs.binary_search(&[a.min(b), a.max(b)]).is_ok();
        self.kinds[one as usize] == self.kinds[other as usize]
            && self.pairs.as_ref().is_none_or(is_listed)
    }
}

/// Returns the pairs of the caller's triangles, those among `origins`, that share an edge which no
/// third one has, sorted: where surfaces overlap, only these are known to be neighbours. O(n log
/// n).
pub(super) fn pairs_alone(task: &TaskInSpace<'_>, origins: &[u32]) -> AllocResult<Vec<[u32; 2]>> {
    let mut kept = copied(origins)?;
    kept.sort_unstable();
    kept.dedup();
    let vertices = |&triangle: &u32| {
        let own = &task.facets.inputs[3 * triangle as usize..][..3];
        [own[0], own[1], own[2]].map(|input| task.inputs.vertices()[input as usize])
    };
    let triangles = collected(kept.iter().map(vertices))?;
    let mut pairs = Vec::new();
    for group in Sides::of_triangles(&triangles)?.groups() {
        if let [one, other] = group {
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
/// from. Parts of one triangle, which go through inputs beside it, are of one facet whatever their
/// angle. Facets grow from their first triangles, or with an angle from their largest. O(n log n).
pub(super) fn merged(
    points: &[[f64; 3]],
    surface: &Surface<'_>,
    coplanar: f64,
    poll: Poll<'_>,
) -> Result<Vec<u32>> {
    let Surface { triangles, origins, .. } = *surface;
    let sine = sine_of(coplanar);
    let neighbors = flat_neighbors(points, surface, sine, poll)?;
    let corners = |triangle: u32| triangles[triangle as usize].map(|v| &points[v as usize]);
    let size = |triangle: u32| {
        let (normal, exponent) = normalized(normal(corners(triangle)));
        (exponent, (norm(&normal) * 1e6) as u64)
    };
    let has_angle = sine > ROUNDING;
    let sized = |triangle: u32| (if has_angle { size(triangle) } else { (0, 0) }, triangle);
    let mut seeds = collected((0..triangles.len() as u32).map(sized))?;
    seeds.sort_unstable_by_key(|&(size, triangle)| (Reverse(size), triangle));
    let mut facets = filled(triangles.len(), NONE)?;
    let (mut members, mut waiting) = (Vec::new(), VecDeque::new());
    for (_, seed) in seeds {
        if facets[seed as usize] != NONE {
            continue;
        }
        let Some(frame) = Frame::of(corners(seed), sine) else { continue };
        facets[seed as usize] = seed;
        members.clear();
        enqueue(&mut waiting, seed)?;
        while let Some(triangle) = waiting.pop_front() {
            members.try_push(triangle)?;
            for &next in neighbors.of(triangle as usize) {
                let is_part = origins[triangle as usize] == origins[next as usize];
                if facets[next as usize] == NONE && frame.contains(corners(next), is_part) {
                    facets[next as usize] = seed;
                    enqueue(&mut waiting, next)?;
                }
            }
        }
        let first = members.iter().copied().min().unwrap_or(seed);
        members.iter().for_each(|&member| facets[member as usize] = first);
    }
    Ok(facets)
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

impl Frame {
    fn of(corners: [&[f64; 3]; 3], sine: f64) -> Option<Self> {
        let projection = Projection::of_triangle(corners)?;
        Some(Self {
            projection,
            is_positive: projection.turn(corners).is_positive(),
            normal: (sine > ROUNDING).then(|| unit_normal(corners)),
            cosine: (1.0 - sine * sine).max(0.0).sqrt(),
        })
    }

    /// Returns true if a triangle turns as the facet does in its projection, exactly, and is not
    /// turned from its plane by more than the angle, or is a part of one in it.
    fn contains(&self, corners: [&[f64; 3]; 3], is_part: bool) -> bool {
        let turn = self.projection.turn(corners);
        let is_alike = if self.is_positive { turn.is_positive() } else { turn.is_negative() };
        let is_turned = |normal: [f64; 3]| {
            let other = unit_normal(corners);
            (0..3).map(|k| normal[k] * other[k]).sum::<f64>() < self.cosine
        };
        is_alike && (is_part || !self.normal.is_some_and(is_turned))
    }
}

fn unit_normal(corners: [&[f64; 3]; 3]) -> [f64; 3] {
    let (normal, _) = normalized(normal(corners));
    let length = norm(&normal);
    normal.map(|x| x / length)
}

/// Returns for each triangle those beyond an edge at which the two are flat and of one kind, or are
/// parts of one.
fn flat_neighbors(
    points: &[[f64; 3]],
    surface: &Surface<'_>,
    sine: f64,
    poll: Poll<'_>,
) -> Result<Lists> {
    let Surface { triangles, origins, .. } = *surface;
    let sides = Sides::of_triangles(triangles)?;
    let point = |vertex: u32| &points[vertex as usize];
    let mut pairs = with_capacity(triangles.len())?;
    for group in sides.groups() {
        poll(WORK)?;
        for (at, one) in group.iter().enumerate() {
            for other in &group[at + 1..] {
                let (edge, c) = one.within(triangles);
                let ([to, from], d) = other.within(triangles);
                let [t, u] = [one, other].map(|side| side.triangle);
                let hinge = Hinge { edge: edge.map(point), apexes: [c, d].map(point) };
                let are_parts = origins[t as usize] == origins[u as usize];
                let are_flat = are_parts || surface.may_join([t, u]) && hinge.is_flat(sine);
                if edge == [from, to] && are_flat {
                    pairs.try_push([t, u])?;
                }
            }
        }
    }
    let both = || pairs.iter().flat_map(|&[t, u]| [(t, u), (u, t)]);
    Ok(Lists::of_pairs(triangles.len(), both)?)
}
