//! Level 2: triangles that have nothing to keep where crossings are split. They are no wider than
//! an edge may be bent and have no subfacets: an edge of theirs goes along the two others, or only
//! they have it and it is not there.

use super::super::chains::Nearness;
use super::given::Facet;
use super::groups::sides;
use super::tiling;
use super::ways::Ways;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::validate::report::Findings;

/// Takes their balances from triangles that are no wider than roundings and have no subfacets: the
/// chain along an edge goes through the opposite vertex, and chains lead along all three edges.
pub(super) fn leave_out_needles(
    triangles: &[[u32; 3]],
    balances: &mut [Option<i64>],
    ways: &mut Ways<'_>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let kept = (0u32..).zip(triangles).zip(balances).filter(|(_, balance)| balance.is_some());
    for ((number, &[a, b, c]), balance) in kept {
        if !ways.splits(number) || !tiling::range(ways.view, number).is_empty() {
            continue;
        }
        let edges = [[a, b], [b, c], [c, a]];
        let (mut is_needle, mut is_whole) = (false, true);
        for (edge, opposite) in edges.into_iter().zip([c, a, b]) {
            let is_found = ways.find(edge, true)?;
            is_whole &= is_found;
            is_needle |= is_found && ways.vertices_on_way().contains(&opposite);
        }
        if is_needle && is_whole {
            for edge in edges {
                ways.check_edge(number, edge, findings)?;
            }
            *balance = None;
        }
    }
    Ok(())
}

/// Returns the triangles that have a balance.
pub(super) fn kept_of(balances: &[Option<i64>]) -> AllocResult<Vec<u32>> {
    let kept = (0u32..).zip(balances).filter(|(_, balance)| balance.is_some());
    collected(kept.map(|(triangle, _)| triangle))
}

/// Takes their balances from triangles that are no wider than an edge may be bent and have nothing
/// to keep. Returns true if there are such.
pub(super) fn leave_out_narrow(
    triangles: &[[u32; 3]],
    kept: &[u32],
    balances: &mut [Option<i64>],
    ways: &mut Ways<'_>,
) -> AllocResult<bool> {
    let mut is_narrow = filled(triangles.len(), false)?;
    for &triangle in kept {
        let own = triangles[triangle as usize];
        is_narrow[triangle as usize] =
            ways.splits(triangle) && ways.is_needle(own, Nearness::Bent)?;
    }
    if !is_narrow.contains(&true) {
        return Ok(false);
    }
    let is_any = leave_out_ends(triangles, kept, &is_narrow, balances, ways)?;
    Ok(leave_out_between(triangles, &kept_of(balances)?, &is_narrow, balances, ways)? || is_any)
}

/// Takes their balances from narrow triangles of which nobody else has an edge, and no chain leads
/// along that, and from those of which this holds without them. Returns true if there are such.
fn leave_out_ends(
    triangles: &[[u32; 3]],
    kept: &[u32],
    is_narrow: &[bool],
    balances: &mut [Option<i64>],
    ways: &mut Ways<'_>,
) -> AllocResult<bool> {
    let sides = sides(triangles, kept)?;
    let beside = |edge: [u32; 2]| {
        let from = sides.partition_point(|side| side.0 < edge);
        sides[from..].iter().take_while(move |side| side.0 == edge).map(|side| side.1)
    };
    let view = ways.view;
    let is_asked = |&at: &u32| is_narrow[at as usize] && tiling::range(view, at).is_empty();
    let mut waiting = collected(kept.iter().copied().filter(is_asked))?;
    let mut is_any = false;
    while let Some(triangle) = waiting.pop() {
        if balances[triangle as usize].is_none() {
            continue;
        }
        let [a, b, c] = triangles[triangle as usize];
        let edges = [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]);
        let is_own = |&edge: &[u32; 2]| {
            beside(edge).all(|at| at == triangle || balances[at as usize].is_none())
        };
        let mut is_end = false;
        for edge in edges.into_iter().filter(is_own) {
            is_end = is_end || !ways.find(edge, true)?;
        }
        if is_end {
            (balances[triangle as usize], is_any) = (None, true);
            let others = edges.into_iter().flat_map(beside);
            others.filter(is_asked).try_for_each(|at| waiting.try_push(at))?;
        }
    }
    Ok(is_any)
}

/// Takes their balances from narrow triangles that stand between others which are one facet
/// without them: along some of their edges leads no chain, and each of these has two other
/// triangles, or none. Returns true if there are such.
fn leave_out_between(
    triangles: &[[u32; 3]],
    kept: &[u32],
    is_narrow: &[bool],
    balances: &mut [Option<i64>],
    ways: &mut Ways<'_>,
) -> AllocResult<bool> {
    // Triangle -> of its edges without a chain, how many have two other triangles or none, and how
    // many have not.
    let mut open = filled(triangles.len(), [0u8; 2])?;
    for same in sides(triangles, kept)?.chunk_by(|a, b| a.0 == b.0) {
        let narrow = || same.iter().filter(|side| is_narrow[side.1 as usize]);
        if narrow().next().is_none() || ways.find(same[0].0, true)? {
            continue;
        }
        let others = same.len() - narrow().count();
        let needs_it = usize::from(others != 0 && others != 2);
        narrow().for_each(|side| open[side.1 as usize][needs_it] += 1);
    }
    let mut is_any = false;
    for &triangle in kept {
        let [spared, needed] = open[triangle as usize];
        if spared > 0 && needed == 0 {
            balances[triangle as usize] = None;
            is_any = true;
        }
    }
    Ok(is_any)
}

/// Returns true if a facet has nothing to keep since crossings are split: it has no subfacets, all
/// its triangles are no wider than an edge may be bent, and along one of its edges leads no chain,
/// as nobody else has that; or they are no wider than an edge is bent that goes through inputs near
/// it alone, and the subfacets of others do not tile it.
pub(super) fn is_left_out(
    facet: &Facet,
    triangles: &[[u32; 3]],
    group: &[(u32, u32)],
    ways: &mut Ways<'_>,
) -> AllocResult<bool> {
    if !tiling::range(ways.view, facet.parent).is_empty() {
        return Ok(false);
    }
    let mut is_near = true;
    for &(_, triangle) in group {
        let own = triangles[triangle as usize];
        if !ways.splits(triangle) || !ways.is_needle(own, Nearness::Bent)? {
            return Ok(false);
        }
        is_near = is_near && ways.is_needle(own, Nearness::Near)?;
    }
    for &edge in &facet.rim {
        if !ways.find(edge, true)? {
            return Ok(true);
        }
    }
    Ok(is_near && !tiling::is_tiled(facet, ways)?)
}
