//! Level 3: kinds, and the quality of cells in their domains.

use super::complex::Complex;
use super::limits::{self, SLACK};
use super::report::{Findings, Violation};
use crate::distributed::NO_ID;
use netmesh::distributed::memory::filled;
use netmesh::validate::ViolationKind;
use netmesh::validate::parts::{Cell, Simplex};
use netmesh::{Criterion, Result, VertexKind};

/// Checks the kinds of vertices, and that a finished mesh is one domain.
pub fn check_kinds(complex: &Complex<'_>, findings: &mut Findings) {
    let mesh = complex.mesh;
    for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
        let (id, kind) = (mesh.vertex_ids[vertex], mesh.kinds[vertex]);
        let fits = kind <= VertexKind::Cage as u8
            && (id < mesh.totals.inputs) == (kind == VertexKind::Input as u8);
        findings.check(fits, || {
            let message = format!("vertex {id} of {} inputs has kind {kind}", mesh.totals.inputs);
            Violation::new(ViolationKind::VertexKind, mesh.rank, message).vertex(id)
        });
    }
    let domains = mesh.totals.domains;
    findings.check(mesh.rank != 0 || !mesh.promise.is_finished || domains == 1, || {
        let message = format!("a finished mesh has {domains} domains, not the root alone");
        Violation::new(ViolationKind::NotFinished, mesh.rank, message)
    });
}

/// Checks the cells of vertices that are in no cage, or the simplices within a domain. `is_limited`
/// tells by vertex what [`limits`] found.
pub fn check_cells<const D: usize>(
    complex: &Complex<'_>,
    is_limited: &[bool],
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    // Other domains are bounded at corners that their balls choose, which is not looked at.
    if !mesh.promise.counts_all_corners() && mesh.totals.domains > 1 {
        return Ok(());
    }
    let bound = mesh.promise.quality_bound;
    let most = bound * (1.0 + SLACK);
    let mut cells = filled(mesh.vertex_ids.len(), Cell::default())?;
    for simplex in 0..complex.count() {
        let (vertices, points) = (complex.simplex(simplex), complex.points::<D>(simplex));
        let entered = Simplex::new(&points[..=D])?;
        entered.enter(&mut cells, vertices);
        let domain = |vertex: u32| mesh.vertex_domains[vertex as usize];
        let is_bounded = mesh.promise.criterion == Criterion::RadiusEdge
            && simplex < complex.own
            && !limits::simplex(&points[..=D])
            && vertices.iter().all(|&vertex| domain(vertex) == domain(vertices[0]));
        let ratio = entered.radius_edge();
        findings.check(!is_bounded || ratio <= most, || {
            let id = complex.id(simplex);
            let message = format!(
                "simplex {id} has circumradius / shortest edge {ratio}, the bound is {bound}"
            );
            Violation::new(ViolationKind::RadiusEdge, mesh.rank, message).simplex(id)
        });
    }
    if mesh.promise.criterion == Criterion::VoronoiAspect {
        for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
            check_cell(complex, vertex, &cells[vertex], is_limited[vertex], findings);
        }
    }
    Ok(())
}

/// Checks the cell of an owned vertex, whose star is complete.
fn check_cell(
    complex: &Complex<'_>,
    vertex: usize,
    cell: &Cell,
    is_limited: bool,
    findings: &mut Findings,
) {
    let mesh = complex.mesh;
    let (aspect, bound) = (cell.aspect(), mesh.promise.quality_bound);
    let is_bounded = mesh.vertex_cages[vertex] == NO_ID && !is_limited;
    findings.check(!is_bounded || aspect <= bound * (1.0 + SLACK), || {
        let id = mesh.vertex_ids[vertex];
        let message = format!("the cell of vertex {id} has aspect {aspect}, the bound is {bound}");
        Violation::new(ViolationKind::VertexAspect, mesh.rank, message).vertex(id)
    });
}
