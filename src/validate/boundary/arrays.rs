//! Level 1: the arrays of segments, facets and regions fit the mesh, and those of a domain that is
//! cropped are the first parts of those of the whole.

use super::Outline;
use super::edges::Edges;
use crate::error::message;
use crate::memory::AllocResult;
use crate::mesh::{Boundary, NONE, Triangulation};
use crate::options::Extent;
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Checks the arrays of `result`, which is cropped from `whole` or equal to it.
pub(super) fn check(
    outline: Option<Outline<'_>>,
    result: &Triangulation,
    whole: &Triangulation,
    findings: &mut Findings,
) {
    if check_lengths(whole, findings) {
        check_ids(outline, whole, findings);
        check_facet_ids(outline, whole, findings);
        let Boundary { forced, flat, .. } = &whole.boundary;
        check_ascending("forced", forced, result.simplex_count(), findings);
        check_ascending("flat", flat, whole.simplex_count(), findings);
    }
    if result.boundary.whole.is_some() {
        check_parts(result, whole, findings);
        check_neighbors(result, whole, findings);
    }
}

/// Checks that the subsegments of the domain are those of the whole that are edges of its
/// simplices, in the same order. Level 1 holds otherwise.
pub(super) fn check_kept(
    result: &Triangulation,
    whole: View<'_, 2>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let edges = Edges::new(whole)?;
    let (own, all) = (&result.boundary, &whole.mesh.boundary);
    let is_inside = |&side: &u32| (side as usize) < result.simplex_count();
    // Of subsegments between the same vertices the first has the sides of all.
    let is_kept = |ends: &[u32; 2]| {
        let first = edges.between(whole, *ends);
        first.is_some_and(|(first, _)| edges.walls.sides[first as usize].iter().any(is_inside))
    };
    let kept = all.subsegments.iter().zip(&all.parents).filter(|(ends, _)| is_kept(ends));
    let holds = kept.eq(own.subsegments.iter().zip(&own.parents));
    findings.check(holds && own.parents.len() == own.subsegments.len(), || {
        let message =
            message!("subsegments of the domain are not those of the whole that are its edges");
        Violation::new(ViolationKind::DomainArrays, message)
    });
    Ok(())
}

fn check_lengths(mesh: &Triangulation, findings: &mut Findings) -> bool {
    let boundary = &mesh.boundary;
    let has_segments = !boundary.subsegments.is_empty();
    let subfacets = boundary.subfacets.len();
    let has_facets = subfacets > 0;
    let labels = if has_segments || has_facets { mesh.simplex_count() } else { 0 };
    let is_misplaced = !boundary.forced.is_empty() && !has_segments && !has_facets;
    let rows = [
        ("parents", boundary.parents.len(), boundary.subsegments.len()),
        ("subfacet_parents", boundary.subfacet_parents.len(), subfacets),
        ("subfacet_simplices", boundary.subfacet_simplices.len(), subfacets),
        ("simplex_regions", boundary.simplex_regions.len(), labels),
        ("a whole of the whole", usize::from(boundary.whole.is_some()), 0),
        ("segments beyond space", usize::from(has_segments && mesh.dim > 3), 0),
        ("facets out of space", usize::from(has_facets && mesh.dim != 3), 0),
        ("forced simplices without segments or facets", usize::from(is_misplaced), 0),
        ("flat simplices without facets", usize::from(!boundary.flat.is_empty() && !has_facets), 0),
    ];
    let mut holds = true;
    for (what, found, needed) in rows {
        holds &= findings.check(found == needed, || {
            let message = message!("{what}: {found}, but the mesh needs {needed}");
            Violation::new(ViolationKind::BoundaryArrays, message)
        });
    }
    holds
}

/// Checks that subsegments name two vertices and a segment, and stand by segments. An extent has a
/// boundary of no segment.
fn check_ids(outline: Option<Outline<'_>>, mesh: &Triangulation, findings: &mut Findings) {
    let vertices = mesh.vertex_count();
    let segments = outline.map_or(NONE as usize, |outline| outline.segments.count());
    let has_frame = matches!(mesh.parameters.extent, Extent::Hull | Extent::Box);
    let mut last = 0;
    for (at, (&[a, b], &parent)) in
        mesh.boundary.subsegments.iter().zip(&mesh.boundary.parents).enumerate()
    {
        let names_two = a != b && (a.max(b) as usize) < vertices;
        findings.check(names_two, || {
            let message = message!("subsegment {at} is from vertex {a} to {b} of {vertices}");
            Violation::new(ViolationKind::BoundaryArrays, message)
        });
        // In space edges of facets are subsegments, too.
        let may_be_none = has_frame || mesh.dim == 3;
        let is_known = if parent == NONE { may_be_none } else { (parent as usize) < segments };
        findings.check(is_known && parent >= last, || {
            let message =
                message!("subsegment {at} is of segment {parent}, after one of segment {last}");
            Violation::new(ViolationKind::BoundaryArrays, message)
        });
        last = parent;
    }
}

/// Checks that subfacets name three vertices and a facet, and stand by facets.
fn check_facet_ids(outline: Option<Outline<'_>>, mesh: &Triangulation, findings: &mut Findings) {
    let vertices = mesh.vertex_count();
    let facets = outline.map_or(NONE as usize, |outline| outline.facets.count());
    let has_frame = matches!(mesh.parameters.extent, Extent::Hull | Extent::Box);
    let Boundary { subfacets, subfacet_parents, .. } = &mesh.boundary;
    let mut last = 0;
    for (at, (&[a, b, c], &parent)) in subfacets.iter().zip(subfacet_parents).enumerate() {
        let is_triangle = a != b && b != c && c != a;
        findings.check(is_triangle && (a.max(b).max(c) as usize) < vertices, || {
            let message = message!("subfacet {at} has the vertices {a}, {b}, {c} of {vertices}");
            Violation::new(ViolationKind::BoundaryArrays, message)
        });
        let is_known = if parent == NONE { has_frame } else { (parent as usize) < facets };
        findings.check(is_known && parent >= last, || {
            let message = message!("subfacet {at} is of facet {parent}, after one of facet {last}");
            Violation::new(ViolationKind::BoundaryArrays, message)
        });
        last = parent;
    }
}

/// Checks that a list names some of the first `count` simplices, by rising id.
fn check_ascending(what: &str, list: &[u32], count: usize, findings: &mut Findings) {
    let ascends = list.windows(2).all(|pair| pair[0] < pair[1]);
    let last = list.last().copied();
    findings.check(ascends && last.is_none_or(|last| (last as usize) < count), || {
        let message = message!(
            "{what} simplices, the last of them {last:?}, are not {count} simplices' by rising id"
        );
        Violation::new(ViolationKind::BoundaryArrays, message)
    });
}

/// Returns true if `whole` begins with `part`.
fn begins<T: PartialEq>(part: &[T], whole: &[T]) -> bool {
    whole.starts_with(part)
}

fn bits(values: &[f64], others: &[f64]) -> bool {
    let pairs = values.iter().zip(others);
    values.len() <= others.len() && pairs.into_iter().all(|(a, b)| a.to_bits() == b.to_bits())
}

fn check_parts(result: &Triangulation, whole: &Triangulation, findings: &mut Findings) {
    let (own, all) = (&result.boundary, &whole.boundary);
    let (vertices, simplices) = (result.vertex_count(), result.simplex_count());
    let rows = [
        ("dim", result.dim == whole.dim),
        ("points", result.points.len() == vertices * whole.dim),
        ("points", bits(&result.points, &whole.points)),
        ("kinds", begins(&result.kinds, &whole.kinds)),
        ("vertex_domains", begins(&result.vertex_domains, &whole.vertex_domains)),
        ("vertex_domains", result.vertex_domains.len() == vertices),
        ("cage_of", begins(&result.cage_of, &whole.cage_of) && result.cage_of.len() == vertices),
        ("precision_limited", begins(&result.precision_limited, &whole.precision_limited)),
        ("precision_limited", result.precision_limited.len() == vertices),
        ("sizes", bits(&result.sizes, &whole.sizes)),
        ("sizes", result.sizes.len() == whole.sizes.len().min(vertices)),
        ("simplices", begins(&result.simplices, &whole.simplices)),
        ("simplices", result.simplices.len() == simplices * (whole.dim + 1)),
        ("domains", result.domains == whole.domains),
        ("simplex_regions", begins(&own.simplex_regions, &all.simplex_regions)),
        ("simplex_regions", own.simplex_regions.len() == simplices),
        ("forced", own.forced == all.forced),
        ("flat", own.flat == all.flat[..all.flat.partition_point(|&id| (id as usize) < simplices)]),
        ("parameters", result.parameters == whole.parameters),
    ];
    for (what, holds) in rows {
        findings.check(holds, || {
            let message = message!("{what} of the domain are not the first of the whole's");
            Violation::new(ViolationKind::DomainArrays, message)
        });
    }
}

/// Checks that neighbours are those of the whole, but none where the domain ends.
fn check_neighbors(result: &Triangulation, whole: &Triangulation, findings: &mut Findings) {
    let count = result.simplex_count();
    let end = result.simplices.len().min(whole.neighbors.len());
    let cropped = |&id: &u32| if (id as usize) < count { id } else { NONE };
    let expected = whole.neighbors[..end].iter().map(cropped);
    let differs = match result.neighbors.len() == end {
        true => expected.zip(&result.neighbors).position(|(a, &b)| a != b),
        false => Some(0),
    };
    findings.check(differs.is_none(), || {
        let at = differs.unwrap_or(0) / (whole.dim + 1);
        let message = message!("neighbours of simplex {at} are not those in the domain");
        Violation::new(ViolationKind::DomainArrays, message).simplex(at)
    });
}
