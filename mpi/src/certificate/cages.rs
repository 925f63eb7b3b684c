//! Level 3: cages stand where they should (§4), nothing encroaches them (Definition 2), and their
//! union cells are bounded (§5). What several ranks have of a cage meets at a keeper, which the
//! domain's id chooses.

use super::complex::Complex;
use super::exchange::Outbox;
use super::hierarchy::{Hierarchy, ROUNDING};
use super::limits::SLACK;
use super::report::{Findings, Violation};
use crate::comm::Communicator;
use crate::distributed::DistributedMesh;
use netmesh::distributed::memory::filled;
use netmesh::validate::ViolationKind;
use netmesh::validate::parts::{Length, Simplex};
use netmesh::{Criterion, NONE, Result, VertexKind};

/// Largest number of domains that the walks up the hierarchy may visit, for each simplex on
/// average, and for each vertex once something is wrong: D-balls span few domains that are not
/// encroached.
const CLIMBS: usize = 64;

/// Vertices and union cell of a cage, as far as a rank has them.
#[derive(Clone, Copy)]
struct CageShare {
    /// The distance of the centre to the nearest vertex outside of the domain.
    nearest: Length,
    /// The out-radius of the union cell.
    farthest: Length,
    /// Vertices of the cage.
    vertices: u64,
    /// True if precision limits one of them, or the centre.
    is_limited: bool,
}

impl Default for CageShare {
    fn default() -> Self {
        let (nearest, farthest) = (Length::INFINITE, Length::ZERO);
        Self { nearest, farthest, vertices: 0, is_limited: false }
    }
}

/// Collective. Checks the cages of a hierarchy that holds. `is_limited` tells by vertex what
/// [`super::limits`] found.
pub fn check<const D: usize>(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    is_limited: &[bool],
    findings: &mut Findings,
) -> Result<()> {
    let mut parts = filled(hierarchy.balls.len(), CageShare::default())?;
    let hull = complex.hull_facets()?;
    for vertex in (0..complex.mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
        check_membership(complex, hierarchy, vertex, hull[vertex] > 0, findings);
        let cage = hierarchy.cages[vertex];
        if cage != NONE {
            check_nearness(complex, hierarchy, vertex, findings);
            let part = &mut parts[cage as usize];
            part.vertices += 1;
            part.is_limited |= is_limited[vertex];
        }
    }
    for (ball, part) in hierarchy.balls.iter().zip(&mut parts) {
        let center = complex.own_vertex(ball.vertex);
        part.is_limited |= center.is_some_and(|center| is_limited[center]);
    }
    check_outer(complex, hierarchy, &mut parts, findings)?;
    check_inner(complex, hierarchy, findings)?;
    check_whole(comm, complex.mesh, hierarchy, &parts, findings)
}

/// Checks that a cage's own vertices are of its kind, and in its domain; the hull is the root's.
fn check_membership<const D: usize>(
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    vertex: usize,
    is_on_hull: bool,
    findings: &mut Findings,
) {
    let mesh = complex.mesh;
    let (id, kind) = (mesh.vertex_ids[vertex], mesh.kinds[vertex]);
    let (cage, label) = (hierarchy.cages[vertex], hierarchy.labels[vertex]);
    let fits = match kind {
        kind if kind == VertexKind::Steiner as u8 => cage == NONE,
        kind if kind == VertexKind::Cage as u8 => cage != NONE,
        _ => true,
    };
    let is_inside = cage == NONE || hierarchy.tree.holds(cage, label);
    let (domain, cage_id) = (mesh.vertex_domains[vertex], mesh.vertex_cages[vertex]);
    findings.check(fits && is_inside, || {
        let message =
            format!("vertex {id} of kind {kind} in domain {domain} is in the cage of {cage_id}");
        Violation::new(ViolationKind::CageOf, mesh.rank, message).vertex(id)
    });
    findings.check(!is_on_hull || cage_id == 0, || {
        let message =
            format!("vertex {id} on the hull is in the cage of {cage_id}, not the root's");
        Violation::new(ViolationKind::HullVertex, mesh.rank, message).vertex(id)
    });
}

/// Checks that a cage vertex is near its cage's sphere (§4, nearness); the root's cage is a matter
/// of taste.
fn check_nearness<const D: usize>(
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    vertex: usize,
    findings: &mut Findings,
) {
    let mesh = complex.mesh;
    let ball = hierarchy.ball(hierarchy.cages[vertex]);
    if ball.id == 0 {
        return;
    }
    let point = complex.point::<D>(vertex as u32);
    let distance = ball.distance(point);
    let sphere = ball.radius.times(mesh.promise.cage_scale);
    // A vertex is rounded to the grid of its coordinates.
    let largest = point.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let rounding = Length::new(largest).times(D as f64 * f64::EPSILON);
    let tolerance = sphere.times(mesh.promise.gamma + ROUNDING).plus(rounding);
    let is_near = distance <= sphere.plus(tolerance) && sphere <= distance.plus(tolerance);
    findings.check(is_near, || {
        let (id, domain) = (mesh.vertex_ids[vertex], ball.id);
        let (found, wanted) = (distance.to_f64(), sphere.to_f64());
        let message = format!(
            "vertex {id} of the cage of domain {domain} is {found:e} from its centre, not \
             {wanted:e}"
        );
        Violation::new(ViolationKind::CageRadius, mesh.rank, message).vertex(id)
    });
}

/// Checks that no vertex is in annulus(c, r, outf r / epsilon). The Delaunay graph is connected
/// within every ball, so the nearest vertex outside has a neighbour inside: own simplices with
/// vertices of both are enough.
fn check_outer<const D: usize>(
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    parts: &mut [CageShare],
    findings: &mut Findings,
) -> Result<()> {
    let mut climbs = complex.own.saturating_mul(CLIMBS);
    for simplex in 0..complex.own {
        let (vertices, points) = (complex.simplex(simplex), complex.points::<D>(simplex));
        let label = |vertex: &u32| hierarchy.labels[*vertex as usize];
        if vertices.iter().all(|vertex| label(vertex) == label(&vertices[0])) {
            continue;
        }
        let cell = Simplex::new(&points[..=D])?;
        let is_spanned =
            |domain: u32| vertices.iter().any(|&vertex| !hierarchy.holds(domain, vertex));
        for (at, vertex) in vertices.iter().enumerate() {
            let mut domain = label(vertex);
            if vertices[..at].iter().any(|other| label(other) == domain) {
                continue;
            }
            while is_spanned(domain) && climbs > 0 {
                climbs -= 1;
                let part = &mut parts[domain as usize];
                part.farthest = part.farthest.max(cell.reach(&hierarchy.ball(domain).center));
                part.nearest =
                    part.nearest.min(check_outside(complex, hierarchy, domain, vertices, findings));
                domain = hierarchy.tree.parent(domain);
            }
        }
    }
    findings.check(climbs > 0 || complex.own == 0, || {
        let message = "simplices span more domains than un-encroached cages allow";
        Violation::new(ViolationKind::DomainSpan, complex.mesh.rank, message.to_owned())
    });
    Ok(())
}

/// Checks that each of the `vertices` that is outside of a domain is far enough from the domain's
/// centre.
fn check_outside<const D: usize>(
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    domain: u32,
    vertices: &[u32],
    findings: &mut Findings,
) -> Length {
    let (mesh, ball) = (complex.mesh, hierarchy.ball(domain));
    let factor = mesh.promise.encroachment / mesh.promise.epsilon * (1.0 - ROUNDING);
    let mut nearest = Length::INFINITE;
    for &vertex in vertices.iter().filter(|&&vertex| !hierarchy.holds(domain, vertex)) {
        let distance = ball.distance(complex.point(vertex));
        nearest = nearest.min(distance);
        findings.check(distance >= ball.radius.times(factor), || {
            let (id, domain) = (mesh.vertex_ids[vertex as usize], ball.id);
            let (found, radius) = (distance.to_f64(), ball.radius.to_f64());
            let message = format!(
                "domain {domain} of radius {radius:e} is outer-encroached: vertex {id} is \
                 {found:e} from its centre"
            );
            Violation::new(ViolationKind::OuterEncroachment, mesh.rank, message).vertex(id)
        });
    }
    nearest
}

/// Checks that no input, cage vertices apart, is in annulus(c, epsilon r, r) of a domain around it
/// but the root, whose ball is larger.
fn check_inner<const D: usize>(
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    let is_sheltered = sheltered(mesh, hierarchy)?;
    let mut climbs = mesh.own_vertices.saturating_mul(CLIMBS);
    let is_input =
        |&vertex: &usize| complex.is_owned(vertex) && mesh.kinds[vertex] == VertexKind::Input as u8;
    for vertex in (0..mesh.own_vertices).filter(is_input) {
        let mut domain = hierarchy.labels[vertex];
        while domain != 0 {
            let ball = hierarchy.ball(domain);
            let distance = ball.distance(complex.point(vertex as u32));
            let is_far = distance > ball.radius.times(mesh.promise.epsilon * (1.0 + ROUNDING));
            findings.check(!is_far || hierarchy.cages[vertex] == domain, || {
                let (id, domain) = (mesh.vertex_ids[vertex], ball.id);
                let (found, radius) = (distance.to_f64(), ball.radius.to_f64());
                let message = format!(
                    "domain {domain} of radius {radius:e} is inner-encroached: input {id} is \
                     {found:e} from its centre"
                );
                Violation::new(ViolationKind::InnerEncroachment, mesh.rank, message).vertex(id)
            });
            if is_sheltered[domain as usize] || climbs == 0 && !findings.is_clean() {
                break;
            }
            climbs = climbs.saturating_sub(1);
            domain = hierarchy.tree.parent(domain);
        }
    }
    Ok(())
}

/// Returns for each domain whether its whole ball is within epsilon r of the centre of each domain
/// around it but the root, so that its vertices encroach none of them.
fn sheltered<const D: usize>(
    mesh: &DistributedMesh,
    hierarchy: &Hierarchy<D>,
) -> Result<Vec<bool>> {
    let mut is_sheltered = filled(hierarchy.balls.len(), true)?;
    for at in 1..hierarchy.balls.len() {
        let parent = hierarchy.tree.parent(at as u32);
        if parent == 0 {
            continue;
        }
        let (ball, around) = (&hierarchy.balls[at], hierarchy.ball(parent));
        let reach = around.distance(&ball.center).plus(ball.radius);
        let fits = reach <= around.radius.times(mesh.promise.epsilon);
        is_sheltered[at] = fits && is_sheltered[parent as usize];
    }
    Ok(is_sheltered)
}

/// Collective. Checks that each cage has enough vertices, and its union cell, of which ranks have
/// parts.
fn check_whole<const D: usize>(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    hierarchy: &Hierarchy<D>,
    parts: &[CageShare],
    findings: &mut Findings,
) -> Result<()> {
    let mut outbox = Outbox::new(comm.size())?;
    for (ball, part) in hierarchy.balls.iter().zip(parts) {
        let [nearest, farthest, radius] =
            [part.nearest, part.farthest, ball.radius].map(Length::to_word);
        let is_limited = part.is_limited.into();
        let record = [ball.id, nearest, farthest, radius, part.vertices, is_limited];
        outbox.put_by_names(1, record)?;
    }
    for group in outbox.deliver(comm)?.chunk_by(|a, b| a.0[0] == b.0[0]) {
        let length = |record: &[u64; 6], at| Length::from_word(record[at]);
        let mut whole = CageShare::default();
        for (record, _) in group {
            whole.nearest = whole.nearest.min(length(record, 1));
            whole.farthest = whole.farthest.max(length(record, 2));
            whole.vertices += record[4];
            whole.is_limited |= record[5] != 0;
        }
        let (first, rank) = &group[0];
        if !whole.is_limited {
            check_cage(mesh, first[0], length(first, 3), &whole, *rank, findings);
        }
    }
    Ok(())
}

fn check_cage(
    mesh: &DistributedMesh,
    domain: u64,
    radius: Length,
    cage: &CageShare,
    rank: usize,
    findings: &mut Findings,
) {
    let (found, least) = (cage.vertices, mesh.dim as u64 + 1);
    findings.check(found >= least, || {
        let message = format!("the cage of domain {domain} has {found} vertices, of {least}");
        Violation::new(ViolationKind::CageIncomplete, rank, message)
    });
    let promise = &mesh.promise;
    if domain == 0 || promise.criterion != Criterion::VoronoiAspect || !promise.counts_all_corners()
    {
        return;
    }
    // The in-radius is (d + r) / 2 (§5, approximation by cages).
    let aspect = 2.0 * cage.farthest.ratio(cage.nearest.plus(radius));
    findings.check(aspect <= promise.quality_bound * (1.0 + SLACK), || {
        let bound = promise.quality_bound;
        let message = format!(
            "the union cell of the cage of domain {domain} has aspect {aspect}, the bound is \
             {bound}"
        );
        Violation::new(ViolationKind::CageAspect, rank, message)
    });
}
