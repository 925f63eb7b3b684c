//! The lines of an arrangement: segments, and edges at which facets end.

use super::sides::{Side, Sides};
use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{TryGrow, collected, sorted_in_buckets, with_capacity};
use crate::mesh::{FacetTriangle, NONE, Subsegment};

/// Number of polls' units of work for one edge.
const WORK: u32 = 1;

/// Returns the lines: first the caller's segments, which are given as pieces in their order, of
/// those between the same vertices the first; then by their vertices all other edges at which more
/// or fewer than two triangles of one facet meet, and `lines` that facets have besides. O(n log n).
pub(super) fn lines(
    triangles: &[FacetTriangle],
    segments: &[([u32; 2], u32)],
    lines: &[[u32; 2]],
    poll: Poll<'_>,
) -> Result<Vec<Subsegment>> {
    let ordered = |[x, y]: [u32; 2]| [x.min(y), x.max(y)];
    let own = segments.iter().map(|&(ends, _)| ordered(ends));
    let mut own: Vec<([u32; 2], u32)> = collected(own.zip(0u32..))?;
    own.sort_unstable();
    own.dedup_by_key(|(ends, _)| *ends);
    let is_own = |ends: &[u32; 2]| own.binary_search_by_key(ends, |(ends, _)| *ends).is_ok();
    let mut others = collected(lines.iter().map(|&ends| ordered(ends)))?;
    let vertices = collected(triangles.iter().map(|triangle| triangle.vertices))?;
    for group in Sides::of_triangles(&vertices, poll)?.groups() {
        poll(WORK)?;
        let facet = |side: &Side| triangles[side.triangle as usize].facet;
        let is_inner = matches!(group, [a, b] if facet(a) == facet(b));
        if !is_inner {
            others.try_push(group[0].ends)?;
        }
    }
    let mut others = sorted_in_buckets(&others, |ends| ends[0], &mut *poll)?;
    others.dedup();
    others.retain(|ends| !is_own(ends));
    own.sort_unstable_by_key(|&(_, at)| at);
    let mut all = with_capacity(own.len() + others.len())?;
    for (_, at) in own {
        let (ends, segment) = segments[at as usize];
        all.push(Subsegment { ends, segment, balance: 0 });
    }
    all.extend(others.into_iter().map(|ends| Subsegment { ends, segment: NONE, balance: 0 }));
    Ok(all)
}

/// Returns the number of segments without a line of their own, given all lines in their order.
pub(super) fn covered(segments: usize, lines: &[Subsegment]) -> u64 {
    let own = lines.iter().filter(|line| line.segment != NONE);
    let (kept, _) = own.fold((0, NONE), |(kept, last), line| {
        (kept + usize::from(line.segment != last), line.segment)
    });
    (segments - kept) as u64
}
