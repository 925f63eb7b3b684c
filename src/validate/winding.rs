//! Level 2: the exact winding of the simplices round every face of codimension two. It certifies
//! that the mesh covers its convex hull once, which sums of volumes cannot: for a coherently
//! oriented complex, simplices and a fan over the hull add up to the same volume whatever it covers
//! twice.
//!
//! Round an interior face the simplices must turn once. Then the ball maps to space as a local
//! homeomorphism: it cannot branch at faces of codimension two, and spheres of dimension two and
//! more have no proper coverings, so neither at smaller faces. At a hull ridge they must turn by
//! at most pi. A compact ball that is mapped so, locally convex everywhere, is embedded and convex
//! (Tietze and Nakajima).
//!
//! Interior faces need not be walked round where the hull tells as much. Let it be convex at its
//! ridges, all of its facets turn the same side to a point o, and one ray from o meet one of them.
//! Seen from o the hull then covers every direction once: it is the boundary of a convex body.
//! Simplices are positive and facets between them cancel, so as many simplices cover a point as the
//! hull winds round it, one within the body and none outside.

use super::report::{Findings, Violation, ViolationKind};
use super::signs::{Adaptive, Signs};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::mesh::{MAX_DIM, NONE};
use crate::quality::view::View;
use std::cmp::Ordering;

/// A simplex seen in the walk round a face: the two vertices that are not in the face, by their
/// slots; the walk turns from `from` to `to`.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Step {
    simplex: usize,
    from: usize,
    to: usize,
}

impl Step {
    fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, ..self }
    }

    /// Returns the bit of the face in the simplex's mask.
    fn bit(self) -> u64 {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        1 << (high * (high - 1) / 2 + low)
    }
}

/// Checks the winding round all faces of codimension two, or of those at the hull where these tell
/// enough. Level 1 must hold, and all simplices be positively oriented and unfolded. O(simplices
/// D^2) orientation tests, or O(hull D^2).
pub(super) fn check<const D: usize, A: Adaptive>(
    view: View<'_, D>,
    signs: &mut Signs<A>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut done = filled(view.simplex_count(), 0u64)?;
    let mut of_hull = Findings::default();
    let facets = hull_facets(view)?;
    for &[simplex, to] in &facets {
        for from in (0..View::<D>::VERTICES).filter(|&from| from != to) {
            let step = Step { simplex, from, to };
            if done[simplex] & step.bit() == 0 {
                check_face(view, step, false, &mut done, signs, &mut of_hull)?;
            }
        }
    }
    let is_convex = of_hull.clean();
    findings.merge(of_hull);
    if is_convex && surrounds(view, &facets, signs)? {
        return Ok(());
    }
    for simplex in 0..view.simplex_count() {
        for to in 1..View::<D>::VERTICES {
            for from in 0..to {
                let step = Step { simplex, from, to };
                if done[simplex] & step.bit() == 0 {
                    let (start, closed) = first_step(view, step);
                    check_face(view, start, closed, &mut done, signs, findings)?;
                }
            }
        }
    }
    Ok(())
}

/// Returns the facets of the hull, each as a simplex and the slot of the vertex opposite.
fn hull_facets<const D: usize>(view: View<'_, D>) -> AllocResult<Vec<[usize; 2]>> {
    let mut facets = Vec::new();
    for simplex in (0..view.simplex_count()).filter(|&s| view.neighbors(s).contains(&NONE)) {
        let slots = view.neighbors(simplex).iter().enumerate();
        for (slot, _) in slots.filter(|&(_, &neighbor)| neighbor == NONE) {
            facets.try_push([simplex, slot])?;
        }
    }
    Ok(facets)
}

/// Returns true if all facets of the hull turn their inner side to a point and a ray from there
/// meets one of them: then the hull winds once round that point. False says nothing.
fn surrounds<const D: usize, A: Adaptive>(
    view: View<'_, D>,
    facets: &[[usize; 2]],
    signs: &mut Signs<A>,
) -> AllocResult<bool> {
    let Some(&[first, apex]) = facets.first() else {
        return Ok(false);
    };
    // A simplex in the middle of the array is most often away from the hull.
    let center = mean(view, view.simplex(view.simplex_count() / 2), None);
    let target = mean(view, view.simplex(first), Some(apex));
    if !center.iter().chain(&target).all(|x| x.is_finite()) {
        return Ok(false);
    }
    let mut met = 0;
    for &[simplex, apex] in facets {
        let mut points = view.points_of(view.simplex(simplex));
        points[apex] = &center;
        if signs.orientation(&points[..View::<D>::VERTICES])? != Ordering::Greater {
            return Ok(false);
        }
        // The least of the target's coordinates at the vertices of the facet, seen from the centre.
        let mut least = Ordering::Greater;
        for slot in (0..View::<D>::VERTICES).filter(|&slot| slot != apex) {
            let mut points = points;
            points[slot] = &target;
            least = least.min(signs.orientation(&points[..View::<D>::VERTICES])?);
            if least == Ordering::Less {
                break;
            }
        }
        match least {
            Ordering::Less => {}
            // The ray may go from facet to facet.
            Ordering::Equal => return Ok(false),
            Ordering::Greater => met += 1,
        }
    }
    Ok(met == 1)
}

/// Returns the mean of vertices, less the one in a slot, rounded.
fn mean<const D: usize>(view: View<'_, D>, vertices: &[u32], without: Option<usize>) -> [f64; D] {
    let count = (vertices.len() - usize::from(without.is_some())) as f64;
    let mut mean = [0.0; D];
    for (_, &vertex) in vertices.iter().enumerate().filter(|&(slot, _)| Some(slot) != without) {
        for (sum, x) in mean.iter_mut().zip(view.point(vertex)) {
            *sum += x / count;
        }
    }
    mean
}

/// Returns the next simplex of the walk, across the facet without `from`; `None` beyond the hull.
fn next_step<const D: usize>(view: View<'_, D>, step: Step) -> Option<Step> {
    let neighbor = view.neighbors(step.simplex)[step.from];
    if neighbor == NONE {
        return None;
    }
    let simplex = neighbor as usize;
    let vertex = view.simplex(step.simplex)[step.to];
    let to = view.neighbors(simplex).iter().position(|&n| n as usize == step.simplex);
    let from = view.simplex(simplex).iter().position(|&v| v == vertex);
    Some(Step { simplex, from: from.expect("level 1 holds"), to: to.expect("level 1 holds") })
}

/// Returns where to start round the face of `step`, anywhere if the walk closes, else at the hull;
/// and whether it closes.
fn first_step<const D: usize>(view: View<'_, D>, step: Step) -> (Step, bool) {
    let mut back = step.reversed();
    while let Some(next) = next_step(view, back) {
        if next.simplex == step.simplex {
            return (step, true);
        }
        back = next;
    }
    (back.reversed(), false)
}

/// Walks round one face and checks each vertex met against the plane of the face and the first.
fn check_face<const D: usize, A: Adaptive>(
    view: View<'_, D>,
    start: Step,
    closed: bool,
    done: &mut [u64],
    signs: &mut Signs<A>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let mut points = view.points_of(view.simplex(start.simplex));
    done[start.simplex] |= start.bit();
    let mut last = Ordering::Greater;
    let mut holds = true;
    let mut step = start;
    while let Some(next) = next_step(view, step) {
        if next.simplex == start.simplex {
            break;
        }
        step = next;
        done[step.simplex] |= step.bit();
        let vertex = view.simplex(step.simplex)[step.to];
        // The last step of a closed walk returns to the first vertex.
        if closed && vertex == view.simplex(start.simplex)[start.from] {
            continue;
        }
        points[start.to] = view.point(vertex);
        let sign = signs.orientation(&points[..View::<D>::VERTICES])?;
        holds &= if closed { winds_once(last, sign) } else { last == Ordering::Greater };
        last = sign;
    }
    holds &= closed || last != Ordering::Less;
    findings.check(holds, || describe(view, start, closed));
    Ok(())
}

/// Returns true if the angles from the first vertex grow from 0 to 2 pi: first positive signs, then
/// at most one zero, then negative ones.
fn winds_once(before: Ordering, now: Ordering) -> bool {
    before == Ordering::Greater || now == Ordering::Less
}

fn describe<const D: usize>(view: View<'_, D>, start: Step, closed: bool) -> Violation {
    let vertices = view.simplex(start.simplex).iter().enumerate();
    let mut face = [NONE; MAX_DIM];
    let mut length = 0;
    for (_, &v) in vertices.filter(|&(i, _)| i != start.from && i != start.to) {
        face[length] = v;
        length += 1;
    }
    let face = &face[..length];
    let (kind, message) = if closed {
        (ViolationKind::Winding, message!("the simplices round face {face:?} turn more than once"))
    } else {
        (ViolationKind::NonConvexHull, message!("the hull is not convex at ridge {face:?}"))
    };
    Violation::new(kind, message).simplex(start.simplex).vertex(face[0] as usize)
}
