//! Level 3: cages stand where they should (§4) and nothing encroaches them (Definition 2).

use super::hierarchy::ROUNDING;
use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, filled};
use crate::mesh::{NONE, VertexKind};
use crate::quality::cells::Cells;
use crate::quality::length::Length;
use crate::quality::precision_limited_cages;
use crate::quality::tree::DomainTree;
use crate::quality::view::View;

/// Largest number of ancestors that may be tried for inner encroachment per vertex on average once
/// something is wrong; in a hierarchy that holds, radii fall too fast for chains of that length.
const CLIMBS_PER_VERTEX: usize = 64;

/// Checks cages of a hierarchy whose ids are in range, with the cells of the same mesh.
pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
    cells: &Cells,
    findings: &mut Findings,
) -> AllocResult<()> {
    check_membership(view, tree, findings);
    check_positions(view, findings)?;
    check_hull(view, findings)?;
    check_outer(view, tree, cells, findings);
    check_inner(view, tree, findings)?;
    Ok(())
}

fn check_membership<const D: usize>(view: View<'_, D>, tree: &DomainTree, findings: &mut Findings) {
    for (v, &cage) in view.mesh.cage_of.iter().enumerate() {
        let (kind, label) = (view.mesh.kinds[v], view.mesh.vertex_domains[v]);
        let fits = match kind {
            VertexKind::Input => true,
            VertexKind::Steiner => cage == NONE,
            VertexKind::Cage => cage != NONE,
        };
        let inside = cage == NONE || tree.holds(cage, label);
        findings.check(fits && inside, || {
            let message =
                message!("vertex {v} of kind {kind:?} in domain {label} has cage_of {cage}");
            Violation::new(ViolationKind::CageOf, message).vertex(v)
        });
    }
}

/// Checks that each cage vertex is near its sphere (§4, nearness), and that there are enough of
/// them; the root's cage is a matter of taste.
fn check_positions<const D: usize>(view: View<'_, D>, findings: &mut Findings) -> AllocResult<()> {
    let mut sizes = filled(view.mesh.domains.len(), 0usize)?;
    for (v, &cage) in view.mesh.cage_of.iter().enumerate().filter(|(_, cage)| **cage != NONE) {
        sizes[cage as usize] += 1;
        if cage != 0 {
            check_nearness(view, v, cage as usize, findings);
        }
    }
    let limited = precision_limited_cages(view.mesh)?;
    for (i, &size) in sizes.iter().enumerate().filter(|&(i, _)| !limited[i]) {
        findings.check(size > D, || {
            let message =
                message!("the cage of domain {i} has {size} vertices, fewer than {}", D + 1);
            Violation::new(ViolationKind::CageIncomplete, message).domain(i)
        });
    }
    Ok(())
}

fn check_nearness<const D: usize>(
    view: View<'_, D>,
    v: usize,
    cage: usize,
    findings: &mut Findings,
) {
    let (domain, parameters) = (&view.mesh.domains[cage], &view.mesh.parameters);
    let (point, center) = (view.point(v as u32), view.point(domain.center));
    let distance = Length::between(point, center);
    let sphere = Length::new(domain.radius).times(parameters.cage_scale);
    // A vertex is rounded to the grid of its coordinates.
    let largest = point.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let rounding = Length::new(largest).times(D as f64 * f64::EPSILON);
    let tolerance = sphere.times(parameters.gamma + ROUNDING).plus(rounding);
    let near = distance <= sphere.plus(tolerance) && sphere <= distance.plus(tolerance);
    findings.check(near, || {
        let (found, wanted) = (distance.to_f64(), sphere.to_f64());
        let message = message!(
            "cage vertex {v} is {found:e} from the centre of domain {cage}, its sphere is at \
             {wanted:e}"
        );
        Violation::new(ViolationKind::CageRadius, message).vertex(v).domain(cage)
    });
}

fn check_hull<const D: usize>(view: View<'_, D>, findings: &mut Findings) -> AllocResult<()> {
    for (v, &on_hull) in view.hull_vertices()?.iter().enumerate() {
        let cage = view.mesh.cage_of[v];
        findings.check(!on_hull || cage == 0, || {
            let message = message!("hull vertex {v} has cage_of {cage}, not the root's");
            Violation::new(ViolationKind::HullVertex, message).vertex(v)
        });
    }
    Ok(())
}

/// Checks that no vertex is in annulus(c, r, outf r / epsilon). It is enough to look at the nearest
/// vertex outside the subtree's ball; that the others are inside is checked with the labels.
fn check_outer<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
    cells: &Cells,
    findings: &mut Findings,
) {
    findings.check(cells.cages_complete, || {
        let message = "simplices span more domains than un-encroached cages allow";
        Violation::new(ViolationKind::DomainSpan, message)
    });
    let parameters = &view.mesh.parameters;
    let factor = parameters.encroachment / parameters.epsilon * (1.0 - ROUNDING);
    for (i, domain) in view.mesh.domains.iter().enumerate().skip(1) {
        let nearest = cells.cage_nearest(i);
        findings.check(nearest >= Length::new(domain.radius).times(factor), || {
            let (v, radius) = (nearest_outside(view, tree, i), domain.radius);
            let nearest = nearest.to_f64();
            let message = message!(
                "domain {i} of radius {radius:e} is outer-encroached: vertex {v} is {nearest:e} \
                 from its centre"
            );
            Violation::new(ViolationKind::OuterEncroachment, message).vertex(v).domain(i)
        });
    }
}

/// Returns the vertex outside a domain's subtree that is nearest to its centre, by trying all.
fn nearest_outside<const D: usize>(view: View<'_, D>, tree: &DomainTree, domain: usize) -> usize {
    let center = view.point(view.mesh.domains[domain].center);
    let labels = view.mesh.vertex_domains.iter().enumerate();
    let mut best = (NONE as usize, Length::INFINITE);
    for (v, _) in labels.filter(|&(_, &label)| !tree.holds(domain as u32, label)) {
        let distance = Length::between(view.point(v as u32), center);
        if distance < best.1 {
            best = (v, distance);
        }
    }
    best.0
}

/// Checks that no input, cage vertices apart, is in annulus(c, epsilon r, r) of an ancestor of its
/// domain.
fn check_inner<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
    findings: &mut Findings,
) -> AllocResult<()> {
    let sheltered = sheltered_domains(view, tree)?;
    let mut climbs = view.vertex_count().saturating_mul(CLIMBS_PER_VERTEX);
    let inputs = |&v: &usize| view.mesh.kinds[v] == VertexKind::Input;
    for v in (0..view.vertex_count()).filter(inputs) {
        let mut domain = view.mesh.vertex_domains[v];
        // The root's ball is larger than the input: nothing encroaches it from inside.
        while domain != 0 {
            check_input(view, v, domain as usize, findings);
            if sheltered[domain as usize] || (climbs == 0 && !findings.clean()) {
                break;
            }
            climbs = climbs.saturating_sub(1);
            domain = tree.parent(domain);
        }
    }
    Ok(())
}

fn check_input<const D: usize>(
    view: View<'_, D>,
    v: usize,
    domain: usize,
    findings: &mut Findings,
) {
    let ball = &view.mesh.domains[domain];
    let distance = Length::between(view.point(v as u32), view.point(ball.center));
    let limit = view.mesh.parameters.epsilon * (1.0 + ROUNDING);
    let far = distance > Length::new(ball.radius).times(limit);
    findings.check(!far || view.mesh.cage_of[v] as usize == domain, || {
        let (distance, radius) = (distance.to_f64(), ball.radius);
        let message = message!(
            "domain {domain} of radius {radius:e} is inner-encroached: the input at vertex {v} is \
             {distance:e} from its centre"
        );
        Violation::new(ViolationKind::InnerEncroachment, message).vertex(v).domain(domain)
    });
}

/// Returns for each domain whether its whole ball is within epsilon r of the centre of every
/// ancestor but the root, so that its vertices encroach none of them.
fn sheltered_domains<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
) -> AllocResult<Vec<bool>> {
    let domains = &view.mesh.domains;
    let mut sheltered = filled(domains.len(), true)?;
    for i in 1..domains.len() {
        let parent = tree.parent(i as u32) as usize;
        if parent == 0 {
            continue;
        }
        let (ball, outer) = (&domains[i], &domains[parent]);
        let apart = Length::between(view.point(ball.center), view.point(outer.center));
        let reach = apart.plus(Length::new(ball.radius));
        let fits = reach <= Length::new(outer.radius).times(view.mesh.parameters.epsilon);
        sheltered[i] = fits && sheltered[parent];
    }
    Ok(sheltered)
}
