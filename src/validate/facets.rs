//! Level 1: facets, found by sorting those of each lowest vertex, and compared with the neighbour
//! array.

use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::mesh::NONE;
use crate::quality::view::View;

/// A facet by its sorted vertices, and where it was met: simplex and position of its apex.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Facet<const D: usize> {
    vertices: [u32; D],
    simplex: u32,
    apex: u32,
}

/// Checks that every facet is in one or two simplices, and that the neighbours say so too.
/// Returns the number of distinct facets.
pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    findings: &mut Findings,
) -> AllocResult<usize> {
    let facets = sorted_facets(view)?;
    let groups = facets.chunk_by(|a, b| a.vertices == b.vertices);
    let mut count = 0;
    for group in groups {
        count += 1;
        if check_duplicates(view, group, findings)? && check_overfull(view, group, findings) {
            check_neighbors(view, group, findings);
        }
    }
    check_connected(view, findings)?;
    Ok(count)
}

impl<const D: usize> Facet<D> {
    fn of(view: View<'_, D>, simplex: usize, apex: usize) -> Self {
        let all = view.simplex(simplex);
        let mut vertices: [u32; D] = std::array::from_fn(|k| all[k + usize::from(k >= apex)]);
        vertices.sort_unstable();
        Self { vertices, simplex: simplex as u32, apex: apex as u32 }
    }

    /// Returns the two vertices after the lowest as a number, of which facets seldom share one.
    fn key(&self) -> u64 {
        u64::from(self.vertices[1]) << 32 | u64::from(self.vertices[2.min(D - 1)])
    }
}

/// Returns the facets in the order of their vertices. A counting sort by the lowest leaves few to
/// sort at each.
fn sorted_facets<const D: usize>(view: View<'_, D>) -> AllocResult<Vec<Facet<D>>> {
    let mut starts = filled(view.vertex_count() + 1, 0usize)?;
    let slots = || (0..view.simplex_count()).flat_map(|s| (0..=D).map(move |apex| (s, apex)));
    let lowest = |(simplex, apex): (usize, usize)| {
        let vertices = view.simplex(simplex).iter().enumerate();
        vertices.filter(|&(slot, _)| slot != apex).fold(NONE, |low, (_, &v)| low.min(v)) as usize
    };
    slots().for_each(|slot| starts[lowest(slot) + 1] += 1);
    for vertex in 0..view.vertex_count() {
        starts[vertex + 1] += starts[vertex];
    }
    let none = Facet { vertices: [NONE; D], simplex: NONE, apex: NONE };
    let mut facets = filled(view.mesh.simplices.len(), none)?;
    for (simplex, apex) in slots() {
        let facet = Facet::of(view, simplex, apex);
        let next = &mut starts[facet.vertices[0] as usize];
        facets[*next] = facet;
        *next += 1;
    }
    let mut left = &mut *facets;
    // Each start has moved to the start of the next vertex.
    let mut start = 0;
    for &end in &starts[..view.vertex_count()] {
        let (of_vertex, others) = left.split_at_mut(end - start);
        of_vertex.sort_unstable_by(|a, b| a.key().cmp(&b.key()).then_with(|| a.cmp(b)));
        (left, start) = (others, end);
    }
    Ok(facets)
}

fn apex<const D: usize>(view: View<'_, D>, facet: &Facet<D>) -> u32 {
    view.simplex(facet.simplex as usize)[facet.apex as usize]
}

fn check_duplicates<const D: usize>(
    view: View<'_, D>,
    group: &[Facet<D>],
    findings: &mut Findings,
) -> AllocResult<bool> {
    let mut apexes: Vec<(u32, u32)> = Vec::new();
    if let [a, b] = group {
        if apex(view, a) == apex(view, b) {
            apexes.try_extend(&[(apex(view, a), a.simplex), (apex(view, b), b.simplex)])?;
        }
    } else if group.len() > 2 {
        apexes = collected(group.iter().map(|facet| (apex(view, facet), facet.simplex)))?;
        apexes.sort_unstable();
    }
    let twin = apexes.windows(2).find(|pair| pair[0].0 == pair[1].0);
    let single = findings.check(twin.is_none(), || {
        let (a, b) = twin.map_or((0, 0), |pair| (pair[0].1, pair[1].1));
        let message = message!("simplices {a} and {b} have the same vertices");
        Violation::new(ViolationKind::DuplicateSimplex, message).simplex(b as usize)
    });
    Ok(single)
}

fn check_overfull<const D: usize>(
    view: View<'_, D>,
    group: &[Facet<D>],
    findings: &mut Findings,
) -> bool {
    findings.check(group.len() <= 2, || {
        let (vertices, count) = (group[0].vertices, group.len());
        let message =
            message!("facet {vertices:?} is in {count} simplices, at most 2 may share it");
        let violation = Violation::new(ViolationKind::OverfullFacet, message);
        violation.simplex(group[2].simplex as usize).vertex(apex(view, &group[2]) as usize)
    })
}

/// Compares a facet's one or two simplices with what they name across it.
fn check_neighbors<const D: usize>(view: View<'_, D>, group: &[Facet<D>], findings: &mut Findings) {
    for (i, facet) in group.iter().enumerate() {
        let s = facet.simplex;
        let named = view.neighbors(s as usize)[facet.apex as usize];
        let shares = if group.len() == 2 { group[1 - i].simplex } else { NONE };
        findings.check(named == shares, || {
            let (kind, message) = describe(view, s, named, shares);
            Violation::new(kind, message).simplex(s as usize).vertex(apex(view, facet) as usize)
        });
    }
}

fn describe<const D: usize>(
    view: View<'_, D>,
    s: u32,
    named: u32,
    shares: u32,
) -> (ViolationKind, String) {
    if named == NONE {
        let message =
            message!("simplex {s} names no neighbour across a facet shared with {shares}");
        return (ViolationKind::MissingNeighbor, message);
    }
    if !view.neighbors(named as usize).contains(&s) {
        let message = message!("simplex {s} names neighbour {named}, which does not name it back");
        return (ViolationKind::AsymmetricNeighbor, message);
    }
    let message = match shares {
        NONE => message!("simplex {s} names neighbour {named} across a hull facet"),
        _ => message!("simplex {s} names neighbour {named} across a facet shared with {shares}"),
    };
    (ViolationKind::NeighborFacet, message)
}

fn check_connected<const D: usize>(view: View<'_, D>, findings: &mut Findings) -> AllocResult<()> {
    let mut reached = filled(view.simplex_count(), false)?;
    let mut stack = collected([0])?;
    reached[0] = true;
    while let Some(s) = stack.pop() {
        for &n in view.neighbors(s).iter().filter(|&&n| n != NONE) {
            if !reached[n as usize] {
                reached[n as usize] = true;
                stack.try_push(n as usize)?;
            }
        }
    }
    let missed = reached.iter().position(|&reached| !reached);
    findings.check(missed.is_none(), || {
        let missed = missed.unwrap_or(0);
        let message = message!("simplex {missed} cannot be reached from simplex 0 through facets");
        Violation::new(ViolationKind::Disconnected, message).simplex(missed)
    });
    Ok(())
}
