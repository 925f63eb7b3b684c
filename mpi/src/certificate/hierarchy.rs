//! Level 3: the domains that a rank knows are a tree of balls, each in the one around it, and every
//! vertex is labelled with one that holds it (§4). That it is the innermost one, and that balls
//! beside each other are disjoint, follows where no cage is encroached ([`super::cages`]).

use super::complex::Complex;
use super::exchange::Outbox;
use super::report::{Findings, Violation};
use crate::comm::Communicator;
use crate::distributed::{DistributedMesh, Domain, NO_ID};
use netmesh::distributed::memory::{collected, filled, with_capacity};
use netmesh::validate::ViolationKind;
use netmesh::validate::parts::{Length, Tree};
use netmesh::{NONE, Result};

/// Relative error allowed where the builder compared rounded lengths.
pub const ROUNDING: f64 = 1e-9;

/// The domains that a rank knows, by falling radius: so each comes after the one around it.
pub struct Hierarchy<const D: usize> {
    pub tree: Tree,
    pub balls: Vec<Ball<D>>,
    /// Vertex -> the ball that it is labelled with.
    pub labels: Vec<u32>,
    /// Vertex -> the ball whose cage it is part of, or [`NONE`].
    pub cages: Vec<u32>,
}

pub struct Ball<const D: usize> {
    pub id: u64,
    /// The id of the vertex at the centre.
    pub vertex: u64,
    pub center: [f64; D],
    pub radius: Length,
}

impl<const D: usize> Ball<D> {
    pub fn distance(&self, point: &[f64; D]) -> Length {
        Length::between(point, &self.center)
    }
}

impl<const D: usize> Hierarchy<D> {
    /// Returns the ball of an index that [`Self::labels`] or the tree has.
    pub fn ball(&self, at: u32) -> &Ball<D> {
        &self.balls[at as usize]
    }

    /// Returns true if the ball at `at` or one in it is the label of the vertex.
    pub fn holds(&self, at: u32, vertex: u32) -> bool {
        self.tree.holds(at, self.labels[vertex as usize])
    }
}

/// Collective. Checks the domains and the labels. Returns them where they hold on all ranks, and
/// nothing where there are no domains.
pub fn check<const D: usize>(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    findings: &mut Findings,
) -> Result<Option<Hierarchy<D>>> {
    let mesh = complex.mesh;
    let hierarchy = read(mesh, findings)?;
    if !findings.clean_everywhere(comm)? || mesh.totals.domains == 0 {
        return Ok(None);
    }
    // Without a violation it could be read.
    let Some(hierarchy) = hierarchy else { return Ok(None) };
    check_centers(comm, complex, &hierarchy, findings)?;
    for at in 1..hierarchy.balls.len() as u32 {
        check_nesting(mesh, &hierarchy, at, findings);
    }
    for vertex in (0..mesh.own_vertices).filter(|&vertex| complex.is_owned(vertex)) {
        let ball = hierarchy.ball(hierarchy.labels[vertex]);
        let distance = ball.distance(complex.point(vertex as u32));
        findings.check(distance < ball.radius.times(1.0 + ROUNDING), || {
            let (id, domain) = (mesh.vertex_ids[vertex], ball.id);
            let (found, radius) = (distance.to_f64(), ball.radius.to_f64());
            let message = format!(
                "vertex {id} is {found:e} from the centre of its domain {domain} of radius \
                 {radius:e}"
            );
            Violation::new(ViolationKind::VertexDomain, mesh.rank, message).vertex(id)
        });
    }
    Ok(findings.clean_everywhere(comm)?.then_some(hierarchy))
}

/// Returns the domains as a tree, with the labels and cages of all vertices, if they are such.
fn read<const D: usize>(
    mesh: &DistributedMesh,
    findings: &mut Findings,
) -> Result<Option<Hierarchy<D>>> {
    let mut order: Vec<usize> = collected(0..mesh.domains.len())?;
    order.sort_by(|&a, &b| mesh.domains[b].radius.total_cmp(&mesh.domains[a].radius));
    let mut index = filled(order.len(), NONE)?;
    order.iter().zip(0u32..).for_each(|(&domain, at)| index[domain] = at);
    let at = |id: u64| {
        let domain = mesh.domains.binary_search_by_key(&id, |domain| domain.id);
        domain.map_or(NONE, |domain| index[domain])
    };
    let mut balls = with_capacity(order.len())?;
    for domain in order.iter().map(|&domain| &mesh.domains[domain]) {
        check_ball(mesh, domain, findings);
        balls.push(Ball {
            id: domain.id,
            vertex: domain.center,
            center: std::array::from_fn(|axis| domain.position[axis]),
            radius: Length::new(domain.radius.abs()),
        });
    }
    let parents: Vec<u32> = collected(order.iter().map(|&domain| at(mesh.domains[domain].parent)))?;
    let is_rooted = order.first().is_none_or(|&first| {
        let Domain { id, parent, .. } = mesh.domains[first];
        (id, parent) == (0, NO_ID)
    });
    // A rank without vertices has no domains.
    let tree = if parents.is_empty() { Tree::new(&[NONE])? } else { Tree::new(&parents)? };
    findings.check(is_rooted && tree.is_some(), || {
        let message = "the domains of the rank are no tree of balls in larger ones, with root 0";
        Violation::new(ViolationKind::DomainTree, mesh.rank, message.to_owned())
    });
    let labels: Vec<u32> = collected(mesh.vertex_domains.iter().map(|&id| at(id)))?;
    let cages: Vec<u32> = collected(mesh.vertex_cages.iter().map(|&id| at(id)))?;
    for (vertex, &id) in mesh.vertex_ids.iter().enumerate() {
        let label = mesh.vertex_domains[vertex];
        findings.check(
            labels[vertex] != NONE || mesh.totals.domains == 0 && label == NO_ID,
            || {
                let message =
                    format!("vertex {id} is labelled with domain {label}, which the rank has not");
                Violation::new(ViolationKind::VertexDomain, mesh.rank, message).vertex(id)
            },
        );
        let cage = mesh.vertex_cages[vertex];
        findings.check(cages[vertex] != NONE || cage == NO_ID, || {
            let message =
                format!("vertex {id} is in the cage of domain {cage}, which the rank has not");
            Violation::new(ViolationKind::CageOf, mesh.rank, message).vertex(id)
        });
    }
    Ok(tree.map(|tree| Hierarchy { tree, balls, labels, cages }))
}

fn check_ball(mesh: &DistributedMesh, domain: &Domain, findings: &mut Findings) {
    let is_finite = domain.position.iter().all(|x| x.is_finite()) && domain.radius.is_finite();
    findings.check(is_finite && domain.radius > 0.0, || {
        let Domain { id, radius, position, .. } = domain;
        let message = format!("domain {id} has radius {radius:e} and its centre at {position:?}");
        Violation::new(ViolationKind::DomainBall, mesh.rank, message)
    });
}

/// Collective. Checks that the vertex at a domain's centre is there, and in the domain. Its owner
/// says so to a keeper, which the domain's id chooses.
fn check_centers<const D: usize>(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    hierarchy: &Hierarchy<D>,
    findings: &mut Findings,
) -> Result<()> {
    let mesh = complex.mesh;
    let mut outbox = Outbox::new(comm.size())?;
    for (ball, at) in hierarchy.balls.iter().zip(0u32..) {
        let vertex = complex.own_vertex(ball.vertex);
        let vertex = vertex.filter(|&vertex| complex.is_owned(vertex));
        outbox.put_by_names(1, [ball.id, vertex.is_some().into()])?;
        let Some(vertex) = vertex.map(|vertex| vertex as u32) else { continue };
        let is_there = *complex.point::<D>(vertex) == ball.center;
        findings.check(is_there && hierarchy.holds(at, vertex), || {
            let (domain, id) = (ball.id, ball.vertex);
            let message =
                format!("the centre of domain {domain}, vertex {id}, is elsewhere or not in it");
            Violation::new(ViolationKind::DomainCenter, mesh.rank, message).vertex(id)
        });
    }
    for group in outbox.deliver(comm)?.chunk_by(|a, b| a.0[0] == b.0[0]) {
        findings.check(group.iter().any(|(record, _)| record[1] != 0), || {
            let ([id, _], rank) = group[0];
            let message = format!("no rank that has the centre of domain {id} knows the domain");
            Violation::new(ViolationKind::DomainCenter, rank, message)
        });
    }
    Ok(())
}

fn check_nesting<const D: usize>(
    mesh: &DistributedMesh,
    hierarchy: &Hierarchy<D>,
    at: u32,
    findings: &mut Findings,
) {
    let (ball, around) = (hierarchy.ball(at), hierarchy.ball(hierarchy.tree.parent(at)));
    let reach = around.distance(&ball.center).plus(ball.radius);
    findings.check(reach <= around.radius.times(1.0 + ROUNDING), || {
        let message = format!(
            "the ball of domain {} reaches {:e} from the centre of domain {} of radius {:e}",
            ball.id,
            reach.to_f64(),
            around.id,
            around.radius.to_f64()
        );
        Violation::new(ViolationKind::DomainOutsideParent, mesh.rank, message)
    });
}
