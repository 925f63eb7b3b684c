//! Level 2: exact signs on every simplex and every interior facet.

use super::report::{Findings, Violation, ViolationKind};
use super::signs::{Adaptive, Signs};
use crate::error::message;
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::NONE;
use crate::quality::cells::{PIECE, pieces};
use crate::quality::view::View;
use crate::threads::share;
use std::cmp::Ordering;

/// Checks orientations, folds and local Delaunay-ness, on as many threads as there are sources of
/// signs; level 1 must hold. Returns whether all simplices are positively oriented and none is
/// folded onto a neighbour.
pub(super) fn check<const D: usize, A: Adaptive + Send>(
    view: View<'_, D>,
    signs: &mut [Signs<A>],
    findings: &mut Findings,
) -> AllocResult<bool> {
    let pieces = || pieces(view.simplex_count());
    let mut positive = filled(view.simplex_count(), false)?;
    let mut parts = collected(pieces().map(|_| Findings::default()))?;
    let work = pieces().zip(positive.chunks_mut(PIECE)).zip(&mut parts);
    share(work, signs, |signs, ((piece, positive), findings)| {
        for (s, positive) in piece.zip(positive) {
            *positive = check_orientation(view, s, signs, findings)?;
        }
        Ok(())
    })?;
    parts.drain(..).for_each(|part| findings.merge(part));
    let mut parts = collected(pieces().map(|_| (Findings::default(), true)))?;
    share(pieces().zip(&mut parts), signs, |signs, (piece, (findings, unfolded))| {
        for s in piece {
            *unfolded &= check_facets(view, s, &positive, signs, findings)?;
        }
        Ok(())
    })?;
    let unfolded = parts.iter().all(|(_, unfolded)| *unfolded);
    parts.into_iter().for_each(|(part, _)| findings.merge(part));
    Ok(unfolded && positive.iter().all(|&positive| positive))
}

/// Checks the facets of a simplex with neighbours of higher ids; returns whether none of these is
/// folded onto it.
fn check_facets<const D: usize, A: Adaptive>(
    view: View<'_, D>,
    s: usize,
    positive: &[bool],
    signs: &mut Signs<A>,
    findings: &mut Findings,
) -> AllocResult<bool> {
    let mut unfolded = true;
    for slot in 0..View::<D>::VERTICES {
        let neighbor = view.neighbors(s)[slot];
        if neighbor == NONE || (neighbor as usize) < s {
            continue;
        }
        unfolded &= check_fold(view, s, slot, findings);
        if positive[s] && positive[neighbor as usize] {
            check_delaunay(view, s, slot, signs, findings)?;
        }
    }
    Ok(unfolded)
}

fn check_orientation<const D: usize, A: Adaptive>(
    view: View<'_, D>,
    s: usize,
    signs: &mut Signs<A>,
    findings: &mut Findings,
) -> AllocResult<bool> {
    let points = view.points_of(view.simplex(s));
    let sign = signs.orientation(&points[..View::<D>::VERTICES])?;
    Ok(findings.check(sign == Ordering::Greater, || {
        let word = if sign == Ordering::Equal { "flat" } else { "negatively oriented" };
        Violation::new(ViolationKind::Orientation, message!("simplex {s} is {word}")).simplex(s)
    }))
}

/// Returns the vertex of the neighbour at `slot` that is not in `s`.
fn opposite<const D: usize>(view: View<'_, D>, s: usize, slot: usize) -> u32 {
    let neighbor = view.neighbors(s)[slot] as usize;
    let back = view.neighbors(neighbor).iter().position(|&n| n as usize == s);
    view.simplex(neighbor)[back.expect("level 1 holds")]
}

/// Checks that two positively oriented simplices lie on different sides of their facet: replacing
/// the apex of one by that of the other must give an odd permutation of the other. No coordinates
/// are needed.
fn check_fold<const D: usize>(
    view: View<'_, D>,
    s: usize,
    slot: usize,
    findings: &mut Findings,
) -> bool {
    let neighbor = view.neighbors(s)[slot] as usize;
    let mut replaced = [NONE; 9];
    replaced[..View::<D>::VERTICES].copy_from_slice(view.simplex(s));
    replaced[slot] = opposite(view, s, slot);
    let even = parity(&replaced[..View::<D>::VERTICES]) == parity(view.simplex(neighbor));
    findings.check(!even, || {
        let message = message!("neighbours {s} and {neighbor} lie on the same side of their facet");
        Violation::new(ViolationKind::FoldedFacet, message).simplex(s)
    })
}

/// Returns true if the number of inversions is odd.
fn parity(ids: &[u32]) -> bool {
    let later = |(i, a): (usize, &u32)| ids[i + 1..].iter().filter(|&b| b < a).count();
    ids.iter().enumerate().map(later).sum::<usize>() % 2 == 1
}

/// Checks that a facet is locally Delaunay. The exact sign seen from the other side is the same
/// determinant, so one side is enough.
fn check_delaunay<const D: usize, A: Adaptive>(
    view: View<'_, D>,
    s: usize,
    slot: usize,
    signs: &mut Signs<A>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let points = view.points_of(view.simplex(s));
    let vertex = opposite(view, s, slot);
    let sign = signs.in_ball(&points[..View::<D>::VERTICES], view.point(vertex))?;
    findings.check(sign != Ordering::Greater, || {
        let neighbor = view.neighbors(s)[slot];
        let message = message!(
            "vertex {vertex} of simplex {neighbor} is inside the circumball of simplex {s}"
        );
        let violation = Violation::new(ViolationKind::Delaunay, message);
        violation.simplex(s).vertex(vertex as usize)
    });
    Ok(())
}
