//! Level 3: tau-quality (Definition 4): over all corners where the cage of a domain surrounds its
//! inputs ([`counts_all_corners`]), otherwise over those within the corner
//! restriction.

use super::boundary::Promised;
use super::report::{Findings, Violation, ViolationKind};
use crate::error::message;
use crate::memory::{AllocResult, collected};
use crate::mesh::NONE;
use crate::options::{Criterion, GivesWay};
use crate::parameters::Parameters;
use crate::quality::cells::{Cells, SimplexCell, pieces};
use crate::quality::tree::DomainTree;
use crate::quality::view::View;
use crate::quality::{SLACK, precision_limited_cages};

/// A cage surrounds inputs within this fraction of its sphere's radius.
const SURROUNDED: f64 = 0.8;

/// Surveys the cells of the mesh, checking the bound on simplices on the way if that is the
/// run's criterion. Corners within a rounding of the restriction do not count.
pub(super) fn survey<const D: usize>(
    view: View<'_, D>,
    tree: &DomainTree,
    promised: Promised<'_>,
    findings: &mut Findings,
) -> AllocResult<Cells> {
    let per_simplex = view.mesh.parameters.criterion == Criterion::RadiusEdge;
    let mut parts = collected(pieces(view.simplex_count()).map(|_| Findings::default()))?;
    let cells = Cells::survey(view, Some(tree), 1.0 - SLACK, &mut parts, |findings, cell| {
        if per_simplex && promised.includes(cell.simplex) && is_promised(view, cell) {
            check_simplex(view, cell, findings);
        }
        Ok(())
    })?;
    parts.into_iter().for_each(|part| findings.merge(part));
    Ok(cells)
}

/// Checks the aspect of the cells of vertices and cages if that is the run's criterion.
pub(super) fn check<const D: usize>(
    view: View<'_, D>,
    cells: &Cells,
    findings: &mut Findings,
) -> AllocResult<()> {
    if view.mesh.parameters.criterion == Criterion::VoronoiAspect {
        (0..view.vertex_count())
            .filter(|&v| is_bounded(view, v))
            .for_each(|v| check_vertex(view, cells, v, findings));
        check_cages(view, cells, findings)?;
    }
    Ok(())
}

/// Returns true if the bound is promised for the cell of `v`.
fn is_bounded<const D: usize>(view: View<'_, D>, v: usize) -> bool {
    view.mesh.cage_of[v] == NONE && !view.mesh.precision_limited[v] && !gave_way(view, v)
}

/// Returns true if the run says that the bound gave way to the angle at a cell or a simplex, and
/// was asked to let it.
fn gave_way<const D: usize>(view: View<'_, D>, id: usize) -> bool {
    let Parameters { gives_way, min_dihedral, .. } = view.mesh.parameters;
    gives_way == GivesWay::Bound
        && min_dihedral > 0.0
        && view.mesh.beyond_bound.binary_search(&(id as u32)).is_ok()
}

/// Returns true if the bound is promised for a simplex: in a domain that is closed for every one,
/// in others for those away from cages whose corner counts.
fn is_promised<const D: usize>(view: View<'_, D>, cell: &SimplexCell<'_, D>) -> bool {
    let vertices = view.simplex(cell.simplex);
    let is_limited = |&v: &u32| view.mesh.precision_limited[v as usize];
    let all_corners = cell.domain != NONE && counts_all_corners(view, cell.domain);
    !vertices.iter().any(is_limited)
        && !gave_way(view, cell.simplex)
        && (all_corners
            || cell.counts && vertices.iter().all(|&v| view.mesh.cage_of[v as usize] == NONE))
}

/// Returns true if the bound is promised over all corners of a domain's cells, not only over those
/// within the corner restriction: its cage must surround its inputs, which are within epsilon of
/// its radius. The root's cage always does.
fn counts_all_corners<const D: usize>(view: View<'_, D>, domain: u32) -> bool {
    let parameters = &view.mesh.parameters;
    domain == 0 || parameters.epsilon <= SURROUNDED * parameters.cage_scale
}

fn bound<const D: usize>(view: View<'_, D>) -> f64 {
    view.mesh.parameters.quality_bound * (1.0 + SLACK)
}

fn check_vertex<const D: usize>(
    view: View<'_, D>,
    cells: &Cells,
    v: usize,
    findings: &mut Findings,
) {
    let all_corners = counts_all_corners(view, view.mesh.vertex_domains[v]);
    let aspect = if all_corners { cells.aspect_anywhere(v) } else { cells.aspect(v) };
    findings.check(aspect <= bound(view), || {
        let (label, limit) = (view.mesh.vertex_domains[v], view.mesh.parameters.quality_bound);
        let message = message!("the cell of vertex {v} has aspect {aspect}, the bound is {limit}");
        Violation::new(ViolationKind::VertexAspect, message).vertex(v).domain(label as usize)
    });
}

fn check_cages<const D: usize>(
    view: View<'_, D>,
    cells: &Cells,
    findings: &mut Findings,
) -> AllocResult<()> {
    let limited = precision_limited_cages(view.mesh)?;
    let cages = view.mesh.domains.iter().enumerate().skip(1);
    for (i, domain) in cages.filter(|&(i, _)| !limited[i]) {
        let aspect = match counts_all_corners(view, domain.parent) {
            true => cells.cage_aspect_anywhere(i, domain.radius),
            false => cells.cage_aspect(i, domain.radius),
        };
        findings.check(aspect <= bound(view), || {
            let limit = view.mesh.parameters.quality_bound;
            let message =
                message!("the union cell of cage {i} has aspect {aspect}, the bound is {limit}");
            Violation::new(ViolationKind::CageAspect, message).domain(i)
        });
    }
    Ok(())
}

fn check_simplex<const D: usize>(
    view: View<'_, D>,
    cell: &SimplexCell<'_, D>,
    findings: &mut Findings,
) {
    let s = cell.simplex;
    findings.check(cell.radius_edge <= bound(view), || {
        let (ratio, limit) = (cell.radius_edge, view.mesh.parameters.quality_bound);
        let message =
            message!("simplex {s} has circumradius / shortest edge {ratio}, the bound is {limit}");
        Violation::new(ViolationKind::RadiusEdge, message).simplex(s)
    });
}
