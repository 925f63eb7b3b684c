//! Level 1: a subfacet names the simplices that have it, and a domain has the subsegments and
//! subfacets of its simplices.

use super::super::edges::at_vertices;
use super::faces::{edges, walls};
use crate::error::message;
use crate::memory::AllocResult;
use crate::mesh::{NONE, Triangulation};
use crate::quality::view::View;
use crate::validate::report::{Findings, Violation, ViolationKind};

/// Checks `result`, which is cropped from `whole` or equal to it. Ids are in range.
pub(in super::super) fn check(
    result: &Triangulation,
    whole: View<'_, 3>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let boundary = &whole.mesh.boundary;
    if boundary.subfacets.is_empty() && boundary.subsegments.is_empty() {
        check_none(result, findings);
        return Ok(());
    }
    let walls = walls(whole)?;
    // The boundary of the first simplex runs along the subfacet: it is behind it.
    let pairs = walls.sides.iter().zip(&boundary.subfacet_simplices);
    for (at, (&[behind, before], &given)) in pairs.enumerate() {
        findings.check(given == [before, behind], || {
            let message = message!(
                "subfacet {at} has the simplices {given:?}, and is a face of {before} before it \
                 and of {behind} behind it, or is there twice"
            );
            let violation = Violation::new(ViolationKind::SubfacetSimplices, message);
            violation.vertex(boundary.subfacets[at][0] as usize)
        });
    }
    if result.boundary.whole.is_some() {
        check_kept_edges(result, whole, findings)?;
        check_kept_faces(result, whole, findings);
    }
    Ok(())
}

/// Checks that a domain has no boundary where the whole has none.
fn check_none(result: &Triangulation, findings: &mut Findings) {
    let own = &result.boundary;
    let count = own.subsegments.len() + own.parents.len() + own.subfacets.len();
    let more = own.subfacet_parents.len() + own.subfacet_simplices.len();
    findings.check(count + more == 0, || refused("subsegments or subfacets"));
}

/// Checks that the subsegments of the domain are those of the whole that are edges of its
/// simplices, in the same order.
fn check_kept_edges(
    result: &Triangulation,
    whole: View<'_, 3>,
    findings: &mut Findings,
) -> AllocResult<()> {
    let (own, all) = (&result.boundary, &whole.mesh.boundary);
    let is_edge = edges(whole, &at_vertices(whole)?, result.simplex_count())?;
    let kept = all.subsegments.iter().zip(&all.parents).zip(&is_edge);
    let kept = kept.filter(|&(_, &is_edge)| is_edge).map(|(pair, _)| pair);
    let holds = kept.eq(own.subsegments.iter().zip(&own.parents));
    findings.check(holds && own.parents.len() == own.subsegments.len(), || refused("subsegments"));
    Ok(())
}

/// Checks that the subfacets of the domain are those of the whole with one of its simplices on a
/// side, in the same order, and that nothing is where it ends.
fn check_kept_faces(result: &Triangulation, whole: View<'_, 3>, findings: &mut Findings) {
    let (own, all) = (&result.boundary, &whole.mesh.boundary);
    let is_inside = |&side: &u32| (side as usize) < result.simplex_count();
    let cropped = |side: u32| if is_inside(&side) { side } else { NONE };
    let kept = all.subfacets.iter().zip(&all.subfacet_parents).zip(&all.subfacet_simplices);
    let kept = kept
        .filter(|(_, sides)| sides.iter().any(is_inside))
        .map(|((vertices, parent), sides)| (vertices, parent, sides.map(cropped)));
    let found = own.subfacets.iter().zip(&own.subfacet_parents).zip(&own.subfacet_simplices);
    let found = found.map(|((vertices, parent), &sides)| (vertices, parent, sides));
    let count = own.subfacets.len();
    let fits = own.subfacet_parents.len() == count && own.subfacet_simplices.len() == count;
    findings.check(kept.eq(found) && fits, || refused("subfacets"));
}

fn refused(what: &str) -> Violation {
    let message = message!("{what} of the domain are not those of the whole that are its own");
    Violation::new(ViolationKind::DomainArrays, message)
}
