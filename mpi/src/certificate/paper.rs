//! Level 3: kinds, domains and the quality of cells, as far as the parts tell. Distances here are
//! doubles, as the bounds are, with a relative error of at most about 1e-10.

use super::complex::Complex;
use super::report::{Findings, Rule, Violation};
use crate::distributed::NO_ID;
use crate::memory::filled;
use netmesh::validate::parts::{Cell, enter};
use netmesh::{Criterion, Result, VertexKind};

/// The builder compares rounded radii; so does this, with other roundings.
const SLACK: f64 = 1e-7;

/// Relative to the largest coordinate, an edge that is not longer may leave no room for a corner: what
/// limits the precision of the cells there is not told in the parts.
const LEAST_EDGE: f64 = 1.0 / (1u64 << 40) as f64;

/// And where ratios drown in the rounding of subnormals.
const SUBNORMAL: f64 = f64::from_bits(1 << 30);

pub fn check<const D: usize>(complex: &Complex<'_>, findings: &mut Findings) -> Result<()> {
    check_vertices(complex, findings)?;
    let mesh = complex.mesh;
    if mesh.rank == 0 {
        let domains = mesh.totals.domains;
        findings.check(!mesh.promise.is_finished || domains == 1, || {
            let message = format!("a finished mesh has {domains} domains, not the root alone");
            Violation::new(Rule::NotFinished, mesh.rank, message)
        });
    }
    // Which corners count in other domains follows from their balls, which the parts do not have.
    if mesh.promise.counts_all_corners || mesh.totals.domains <= 1 {
        check_cells::<D>(complex, findings)?;
    }
    Ok(())
}

fn check_vertices(complex: &Complex<'_>, findings: &mut Findings) -> Result<()> {
    let mesh = complex.mesh;
    let hull = complex.hull_facets()?;
    for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
        let (id, kind) = (mesh.vertex_ids[vertex], mesh.kinds[vertex]);
        let fits = kind <= VertexKind::Cage as u8
            && (id < mesh.totals.inputs) == (kind == VertexKind::Input as u8);
        findings.check(fits, || {
            let message = format!("vertex {id} of {} inputs has kind {kind}", mesh.totals.inputs);
            Violation::new(Rule::VertexKind, mesh.rank, message).vertex(id)
        });
        let (domain, domains) = (mesh.vertex_domains[vertex], mesh.totals.domains);
        findings.check(domain < domains || domain == NO_ID && domains == 0, || {
            let message = format!("vertex {id} is labelled with domain {domain} of {domains}");
            Violation::new(Rule::VertexDomain, mesh.rank, message).vertex(id)
        });
        // A point of a cage may yield to an input.
        findings.check(hull[vertex] == 0 || kind != VertexKind::Steiner as u8, || {
            let message = format!("vertex {id} on the hull is of no cage");
            Violation::new(Rule::HullVertex, mesh.rank, message).vertex(id)
        });
    }
    Ok(())
}

/// What else is known of a cell.
#[derive(Clone, Copy, Default)]
struct Place {
    is_limited: bool,
    /// Whether its simplices are of several domains.
    is_between: bool,
}

fn check_cells<const D: usize>(complex: &Complex<'_>, findings: &mut Findings) -> Result<()> {
    let mesh = complex.mesh;
    let bound = mesh.promise.quality_bound;
    let most = bound * (1.0 + SLACK);
    let mut cells = filled(mesh.vertex_ids.len(), Cell::default())?;
    let mut places = filled(mesh.vertex_ids.len(), Place::default())?;
    for simplex in 0..complex.count() {
        let (corners, points) = (complex.simplex(simplex), complex.points::<D>(simplex));
        let ratio = enter(&mut cells, corners, &points[..=D])?;
        let domain = |vertex: u32| mesh.vertex_domains[vertex as usize];
        let place = Place {
            is_limited: is_limited(&points[..=D]),
            is_between: corners.iter().any(|&vertex| domain(vertex) != domain(corners[0])),
        };
        for &vertex in corners {
            let known = &mut places[vertex as usize];
            known.is_limited |= place.is_limited;
            known.is_between |= place.is_between;
        }
        let is_bounded = mesh.promise.criterion == Criterion::RadiusEdge
            && simplex < complex.own
            && !place.is_limited
            && !place.is_between;
        findings.check(!is_bounded || ratio <= most, || {
            let id = complex.id(simplex);
            let message = format!(
                "simplex {id} has circumradius / shortest edge {ratio}, the bound is {bound}"
            );
            Violation::new(Rule::RadiusEdge, mesh.rank, message).simplex(id)
        });
    }
    if mesh.promise.criterion == Criterion::VoronoiAspect {
        for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
            check_cell(complex, vertex, &cells[vertex], places[vertex], findings);
        }
    }
    Ok(())
}

fn is_limited<const D: usize>(points: &[&[f64; D]]) -> bool {
    let magnitude = |point: &[f64; D]| point.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let largest = points.iter().map(|point| magnitude(point)).fold(0.0, f64::max);
    let least = (largest * LEAST_EDGE).max(SUBNORMAL);
    points.iter().enumerate().any(|(at, p)| {
        let is_near = |q: &&[f64; D]| magnitude(&std::array::from_fn(|k| p[k] - q[k])) <= least;
        points[at + 1..].iter().any(is_near)
    })
}

/// The cell of an owned vertex, whose star is complete.
fn check_cell(
    complex: &Complex<'_>,
    vertex: usize,
    cell: &Cell,
    place: Place,
    findings: &mut Findings,
) {
    let mesh = complex.mesh;
    // Which inputs are in cages the parts do not tell; those have neighbours in two domains.
    let is_caged = match mesh.kinds[vertex] {
        kind if kind == VertexKind::Cage as u8 => true,
        kind => kind == VertexKind::Input as u8 && place.is_between,
    };
    let (aspect, bound) = (cell.aspect(), mesh.promise.quality_bound);
    let is_bounded = !is_caged && !place.is_limited;
    findings.check(!is_bounded || aspect <= bound * (1.0 + SLACK), || {
        let id = mesh.vertex_ids[vertex];
        let message = format!("the cell of vertex {id} has aspect {aspect}, the bound is {bound}");
        Violation::new(Rule::VertexAspect, mesh.rank, message).vertex(id)
    });
}
