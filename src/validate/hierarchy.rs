//! Level 3: the domains are a tree of disjoint balls, and every vertex is labelled with the
//! innermost one that holds it (§4).

use super::boxes::{Bounds, BoxTree};
use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, with_capacity};
use crate::quality::length::Length;
use crate::quality::tree::{DomainTree, first_misplaced};
use crate::quality::view::View;

/// Relative error allowed where the builder compared rounded lengths.
pub(super) const ROUNDING: f64 = 1e-9;

/// Checks the domains and the labels. Returns the tree if it is one and all ids are in range.
pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<Option<DomainTree>> {
    let Some(tree) = check_tree(view, findings)? else { return Ok(None) };
    if !check_balls(view, findings) || !check_labels_exist(view, findings) {
        return Ok(None);
    }
    check_centers(view, &tree, findings);
    let mut siblings = with_capacity(view.mesh.domains.len())?;
    for i in 0..view.mesh.domains.len() as u32 {
        siblings.push(BoxTree::new(view, &view.mesh.domains, tree.children(i))?);
    }
    for i in 1..view.mesh.domains.len() {
        check_nesting(view, &tree, i, findings);
        check_siblings(view, &tree, &siblings, i, findings);
    }
    for v in 0..view.vertex_count() {
        check_label(view, &siblings, v, findings);
    }
    Ok(Some(tree))
}

fn check_tree<const D: usize>(
    view: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<Option<DomainTree>> {
    let domains = &view.mesh.domains;
    let misplaced = first_misplaced(domains);
    findings.check(misplaced.is_none(), || {
        let i = misplaced.unwrap_or(0);
        let message = match domains.get(i) {
            None => message!("there is no root domain"),
            Some(domain) => message!(
                "domain {i} has parent {}; 0 is the only root, parents precede children",
                domain.parent
            ),
        };
        Violation::new(ViolationKind::DomainTree, message).domain(i)
    });
    DomainTree::new(domains)
}

fn check_balls<const D: usize>(view: View<'_, D>, findings: &mut Findings) -> bool {
    let mut holds = true;
    for (i, domain) in view.mesh.domains.iter().enumerate() {
        let exists = (domain.center as usize) < view.vertex_count();
        let proper = domain.radius > 0.0 && domain.radius.is_finite();
        holds &= findings.check(exists && proper, || {
            let (center, radius) = (domain.center, domain.radius);
            let message = message!("domain {i} has centre vertex {center} and radius {radius:e}");
            Violation::new(ViolationKind::DomainBall, message).domain(i)
        });
    }
    holds
}

/// Labels and cages name domains that exist; whether they are the right ones comes later.
fn check_labels_exist<const D: usize>(view: View<'_, D>, findings: &mut Findings) -> bool {
    let count = view.mesh.domains.len();
    let mut holds = true;
    for (v, &label) in view.mesh.vertex_domains.iter().enumerate() {
        holds &= findings.check((label as usize) < count, || {
            let message = message!("vertex {v} is labelled with domain {label} of {count}");
            Violation::new(ViolationKind::VertexDomain, message).vertex(v)
        });
    }
    for (v, &cage) in view.mesh.cage_of.iter().enumerate() {
        let exists = cage == crate::mesh::NONE || (cage as usize) < count;
        holds &= findings.check(exists, || {
            let message = message!("vertex {v} is in the cage of domain {cage} of {count}");
            Violation::new(ViolationKind::CageOf, message).vertex(v)
        });
    }
    holds
}

fn check_centers<const D: usize>(view: View<'_, D>, tree: &DomainTree, findings: &mut Findings) {
    for (i, domain) in view.mesh.domains.iter().enumerate() {
        let label = view.mesh.vertex_domains[domain.center as usize];
        findings.check(tree.holds(i as u32, label), || {
            let center = domain.center;
            let message = message!(
                "the centre of domain {i}, vertex {center}, is labelled with domain {label}"
            );
            let violation = Violation::new(ViolationKind::DomainCenter, message);
            violation.domain(i).vertex(center as usize)
        });
    }
}

/// Returns the distance of the centres of two domains.
fn center_distance<const D: usize>(view: View<'_, D>, a: usize, b: usize) -> Length {
    let center = |i: usize| view.point(view.mesh.domains[i].center);
    Length::between(center(a), center(b))
}

fn check_nesting<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
    i: usize,
    findings: &mut Findings,
) {
    let parent = tree.parent(i as u32) as usize;
    let radius = |i: usize| Length::new(view.mesh.domains[i].radius);
    let reach = center_distance(view, i, parent).plus(radius(i));
    findings.check(reach <= radius(parent).times(1.0 + ROUNDING), || {
        let (reach, radius) = (reach.to_f64(), view.mesh.domains[parent].radius);
        let message = message!(
            "the ball of domain {i} reaches {reach:e} from the centre of its parent {parent}, \
             radius {radius:e}"
        );
        Violation::new(ViolationKind::DomainOutsideParent, message).domain(i)
    });
}

fn check_siblings<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
    siblings: &[BoxTree<D>],
    i: usize,
    findings: &mut Findings,
) {
    let domains = &view.mesh.domains;
    let overlaps = |other: u32| {
        let radii =
            Length::new(domains[i].radius).plus(Length::new(domains[other as usize].radius));
        center_distance(view, i, other as usize) < radii.times(1.0 - ROUNDING)
    };
    let bounds = Bounds::of_ball(view.point(domains[i].center), domains[i].radius);
    let parent = tree.parent(i as u32) as usize;
    let found = siblings[parent].find(&bounds, |other| (other as usize) < i && overlaps(other));
    findings.check(found.is_none(), || {
        let other = found.unwrap_or(0);
        let message =
            message!("the balls of domains {other} and {i}, children of {parent}, overlap");
        Violation::new(ViolationKind::DomainsOverlap, message).domain(i)
    });
}

fn check_label<const D: usize>(
    view: View<'_, D>,
    siblings: &[BoxTree<D>],
    v: usize,
    findings: &mut Findings,
) {
    let domains = &view.mesh.domains;
    let point = view.point(v as u32);
    let label = view.mesh.vertex_domains[v] as usize;
    let distance = |i: usize| Length::between(point, view.point(domains[i].center));
    let within = |i: usize, slack: f64| distance(i) < Length::new(domains[i].radius).times(slack);
    findings.check(within(label, 1.0 + ROUNDING), || {
        let (found, radius) = (distance(label).to_f64(), domains[label].radius);
        let message = message!(
            "vertex {v} is {found:e} from the centre of its domain {label}, whose radius is \
             {radius:e}"
        );
        Violation::new(ViolationKind::VertexDomain, message).vertex(v).domain(label)
    });
    let near = Bounds::of_ball(point, 0.0);
    let inner = siblings[label].find(&near, |child| within(child as usize, 1.0 - ROUNDING));
    findings.check(inner.is_none(), || {
        let inner = inner.unwrap_or(0) as usize;
        let message =
            message!("vertex {v} of domain {label} is inside the ball of its child {inner}");
        Violation::new(ViolationKind::VertexDomain, message).vertex(v).domain(inner)
    });
}
