//! All pairs of facets and segments that meet though they must not.

use super::meet::{Meeting, meet};
use super::pieces::{Piece, Pieces};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, copied, reserve};
use crate::mesh::{Feature, Intersection, IntersectionKind};
use crate::nearest::{Bounds, BoxTree, bounds_of};
use std::cmp::Reverse;

/// Number of polls' units of work for the meeting of two pieces.
const WORK: u32 = 2;

/// Two pieces that meet, and the features of which they are parts.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Found {
    features: [Feature; 2],
    rank: Reverse<u8>,
    pieces: [u32; 2],
    kind: IntersectionKind,
}

/// Returns the pairs of features that meet in more than vertices and edges of both, and the facets
/// that are at fault themselves: sorted, each pair once, with the worst of its kinds. O((n + k) log
/// n) for n pieces and k pairs of pieces whose bounding boxes meet.
pub(super) fn all(
    points: &[[f64; 3]],
    pieces: &Pieces,
    poll: Poll<'_>,
) -> Result<Vec<Intersection>> {
    let mut found: Vec<Found> = Vec::new();
    each_meeting(points, pieces, poll, |pair, meeting| {
        let [a, b] = pair.map(|piece| &pieces.all[piece as usize]);
        let kind = meeting.kind([a.inner, b.inner]);
        let features = [a.feature, b.feature];
        found.try_push(Found { features, rank: Reverse(kind.rank()), pieces: pair, kind })
    })?;
    found.sort_unstable();
    found.dedup_by_key(|found| found.features);
    with_faults(points, pieces, &found)
}

/// Calls `visit` with all pairs of pieces that meet though they must not, of which the first has
/// the smaller number. Triangles of one facet are not tested. O((n + k) log n), as for [`all`].
pub(super) fn each_meeting(
    points: &[[f64; 3]],
    pieces: &Pieces,
    poll: Poll<'_>,
    mut visit: impl FnMut([u32; 2], &Meeting) -> AllocResult<()>,
) -> Result<()> {
    let bounds = |piece: &Piece| -> Bounds {
        bounds_of(piece.vertices().iter().map(|&vertex| &points[vertex as usize]))
    };
    each_pair(&collected(pieces.all.iter().map(bounds))?, pieces, poll, |pair| {
        let own = pair.map(|piece| pieces.all[piece as usize].vertices());
        meet(points, own[0], own[1]).map_or(Ok(()), |meeting| visit(pair, &meeting))
    })
}

/// Calls `visit` with all pairs of pieces of two facets or segments, or of the edges of one facet,
/// whose boxes meet. O((n + k) log n), as for [`all`].
pub(super) fn each_pair(
    boxes: &[Bounds],
    pieces: &Pieces,
    poll: Poll<'_>,
    mut visit: impl FnMut([u32; 2]) -> AllocResult<()>,
) -> Result<()> {
    let all = &pieces.all;
    let mut work = 0;
    let visit = |pair: [u32; 2], poll: Poll<'_>| {
        work += WORK;
        if work >= 64 {
            poll(std::mem::take(&mut work))?;
        }
        let [a, b] = pair.map(|piece| &all[piece as usize]);
        let are_lines = a.triangle().is_none() && b.triangle().is_none();
        match a.feature == b.feature && !are_lines {
            true => Ok(()),
            false => Ok(visit(pair)?),
        }
    };
    match boxes.is_empty() {
        true => Ok(()),
        false => BoxTree::new(boxes)?.each_pair(poll, visit),
    }
}

/// Returns the intersections that were found, with the faults of single facets among them.
fn with_faults(points: &[[f64; 3]], pieces: &Pieces, found: &[Found]) -> Result<Vec<Intersection>> {
    let mut all = copied(&pieces.faults)?;
    reserve(&mut all, found.len())?;
    all.extend(found.iter().map(|found| {
        let [one, other] = found.pieces.map(|piece| pieces.all[piece as usize].vertices());
        let [first, second] = found.features;
        // The pieces meet, so that they have a point.
        let point = meet(points, one, other).map_or([0.0; 3], |met| met.point(points, one, other));
        Intersection { first, second, kind: found.kind, point }
    }));
    Ok(sorted(all)?)
}

fn sorted(mut all: Vec<Intersection>) -> AllocResult<Vec<Intersection>> {
    let key = |one: &Intersection| (one.first, one.second, Reverse(one.kind.rank()));
    // Pairs of features are distinct, but for facets that meet themselves, of which the worst
    // stays.
    all.sort_unstable_by_key(key);
    all.dedup_by_key(|one| (one.first, one.second));
    Ok(all)
}
