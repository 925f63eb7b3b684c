//! Level 1: array lengths and ids. What holds here lets everything else index without a fear.

use super::report::{Findings, Violation};
use crate::distributed::{DistributedMesh, InterfaceFacet, NO_ID};
use netmesh::Result;
use netmesh::distributed::memory::{collected, filled};
use netmesh::validate::ViolationKind;

/// Checks lengths, coordinates and ids of this rank's part.
pub fn check(mesh: &DistributedMesh, findings: &mut Findings) -> Result<()> {
    if !check_lengths(mesh, findings) {
        return Ok(());
    }
    check_coordinates(mesh, findings);
    check_vertex_ids(mesh, findings);
    check_domain_ids(mesh, findings);
    check_simplex_ids(mesh, findings);
    if check_vertices(mesh, findings)? {
        check_neighbors(mesh, findings)?;
    }
    Ok(())
}

fn check_lengths(mesh: &DistributedMesh, findings: &mut Findings) -> bool {
    let (vertices, size) = (mesh.vertex_ids.len(), mesh.dim + 1);
    let simplices = (mesh.simplices.len() + mesh.ghost_simplices.len()) / size;
    let rows = [
        ("points", mesh.points.len(), vertices * mesh.dim),
        ("kinds", mesh.kinds.len(), vertices),
        ("vertex_owners", mesh.vertex_owners.len(), vertices),
        ("vertex_domains", mesh.vertex_domains.len(), vertices),
        ("vertex_cages", mesh.vertex_cages.len(), vertices),
        ("neighbors", mesh.neighbors.len(), mesh.simplices.len()),
        ("simplices beyond a multiple of dim + 1", mesh.simplices.len() % size, 0),
        ("ghost_simplices", mesh.ghost_simplices.len(), mesh.ghosts.len() * size),
        ("inputs beyond a multiple of dim", mesh.inputs.len() % mesh.dim, 0),
        ("own_vertices beyond all", mesh.own_vertices.saturating_sub(vertices), 0),
        ("vertices beyond 32 bits", vertices.saturating_sub(u32::MAX as usize), 0),
        ("simplices beyond 32 bits", simplices.saturating_sub(u32::MAX as usize), 0),
    ];
    let mut holds = true;
    for (what, found, needed) in rows {
        holds &= findings.check(found == needed, || {
            let message = format!("{what}: {found}, but {vertices} vertices need {needed}");
            Violation::new(ViolationKind::ArrayLength, mesh.rank, message)
        });
    }
    holds
}

fn check_coordinates(mesh: &DistributedMesh, findings: &mut Findings) {
    for (at, x) in mesh.points.iter().enumerate() {
        findings.check(x.is_finite(), || {
            let (vertex, axis) = (mesh.vertex_ids[at / mesh.dim], at % mesh.dim);
            let message = format!("coordinate {axis} of vertex {vertex} is {x}, not finite");
            Violation::new(ViolationKind::NonFinite, mesh.rank, message).vertex(vertex)
        });
    }
}

/// Checks that ids rise among the vertices of own simplices and among the others, and that none is
/// there twice.
fn check_vertex_ids(mesh: &DistributedMesh, findings: &mut Findings) {
    let (own, others) = mesh.vertex_ids.split_at(mesh.own_vertices);
    let rises = |ids: &[u64], at: usize| at == 0 || ids[at - 1] < ids[at];
    for (ids, first) in [(own, 0), (others, own.len())] {
        for (at, &id) in ids.iter().enumerate() {
            let is_new = first == 0 || own.binary_search(&id).is_err();
            findings.check(id < mesh.totals.vertex_ids && rises(ids, at) && is_new, || {
                let limit = mesh.totals.vertex_ids;
                let message = format!("vertex id {id} is not below {limit}, or does not rise");
                Violation::new(ViolationKind::Ids, mesh.rank, message).vertex(id)
            });
            let owner = mesh.vertex_owners[first + at];
            findings.check((owner as usize) < mesh.ranks, || {
                let message = format!("vertex {id} has owner {owner} of {} ranks", mesh.ranks);
                Violation::new(ViolationKind::VertexOwner, mesh.rank, message).vertex(id)
            });
        }
    }
}

/// Checks that ids of domains rise, and that the domain around each is there too.
fn check_domain_ids(mesh: &DistributedMesh, findings: &mut Findings) {
    let domains = &mesh.domains;
    let is_known = |id: u64| domains.binary_search_by_key(&id, |domain| domain.id).is_ok();
    for (at, domain) in domains.iter().enumerate() {
        let rises = at == 0 || domains[at - 1].id < domain.id;
        let fits = domain.id < mesh.totals.domains && rises;
        findings.check(fits && (domain.parent == NO_ID || is_known(domain.parent)), || {
            let (id, parent) = (domain.id, domain.parent);
            let message = format!(
                "domain {id} of {}, in {parent}, does not rise, or what it is in is not there",
                mesh.totals.domains
            );
            Violation::new(ViolationKind::Ids, mesh.rank, message)
        });
    }
}

fn check_simplex_ids(mesh: &DistributedMesh, findings: &mut Findings) {
    let total = mesh.totals.simplices;
    let end = mesh.first_simplex.checked_add(mesh.simplex_count() as u64);
    findings.check(end.is_some_and(|end| end <= total), || {
        let (first, count) = (mesh.first_simplex, mesh.simplex_count());
        let message = format!("{count} simplices from id {first} on are more than {total}");
        Violation::new(ViolationKind::Ids, mesh.rank, message).simplex(first)
    });
    for (at, ghost) in mesh.ghosts.iter().enumerate() {
        let rises = at == 0 || mesh.ghosts[at - 1].id < ghost.id;
        let belongs_to_rank = own_index(mesh, ghost.id).is_some();
        findings.check(ghost.id < total && rises && !belongs_to_rank, || {
            let message = format!("ghost {} is own, not below {total} or does not rise", ghost.id);
            Violation::new(ViolationKind::Ids, mesh.rank, message).simplex(ghost.id)
        });
        let owner = ghost.owner as usize;
        findings.check(owner < mesh.ranks && owner != mesh.rank, || {
            let message = format!("ghost {} is of rank {owner} of {}", ghost.id, mesh.ranks);
            Violation::new(ViolationKind::Ghost, mesh.rank, message).simplex(ghost.id)
        });
    }
}

/// Returns the index of an own simplex.
pub fn own_index(mesh: &DistributedMesh, id: u64) -> Option<usize> {
    let index = id.checked_sub(mesh.first_simplex)?;
    (index < mesh.simplex_count() as u64).then_some(index as usize)
}

/// Checks that the vertices of simplices are there, none twice in one, and each in one; ghosts
/// share some.
fn check_vertices(mesh: &DistributedMesh, findings: &mut Findings) -> Result<bool> {
    let mut used = filled(mesh.vertex_ids.len(), false)?;
    let mut holds = true;
    let own = (0..mesh.simplex_count())
        .map(|s| (mesh.first_simplex.wrapping_add(s as u64), mesh.simplex(s), mesh.own_vertices));
    let ghosts =
        (0..mesh.ghosts.len()).map(|g| (mesh.ghosts[g].id, mesh.ghost(g), mesh.vertex_ids.len()));
    for (id, vertices, limit) in own.chain(ghosts) {
        for (slot, &vertex) in vertices.iter().enumerate() {
            holds &= findings.check((vertex as usize) < limit, || {
                let message = format!("simplex {id} names vertex {vertex} of {limit} on the rank");
                Violation::new(ViolationKind::VertexOutOfRange, mesh.rank, message).simplex(id)
            });
            holds &= findings.check(!vertices[..slot].contains(&vertex), || {
                let message = format!("simplex {id} names a vertex twice");
                Violation::new(ViolationKind::RepeatedVertex, mesh.rank, message).simplex(id)
            });
            used.get_mut(vertex as usize).into_iter().for_each(|used| *used = true);
        }
        let touches = vertices.iter().any(|&vertex| (vertex as usize) < mesh.own_vertices);
        findings.check(touches, || {
            let message = format!("ghost {id} shares no vertex with the rank");
            Violation::new(ViolationKind::Ghost, mesh.rank, message).simplex(id)
        });
    }
    for (&id, used) in mesh.vertex_ids.iter().zip(used) {
        findings.check(used, || {
            let message = format!("vertex {id} is in no simplex of the rank's");
            Violation::new(ViolationKind::UnusedVertex, mesh.rank, message).vertex(id)
        });
    }
    Ok(holds)
}

/// Checks that neighbours are own simplices, ghosts or none, and that the interface is the facets
/// to ghosts.
fn check_neighbors(mesh: &DistributedMesh, findings: &mut Findings) -> Result<()> {
    let size = mesh.dim + 1;
    let ghost = |id: u64| mesh.ghosts.binary_search_by_key(&id, |ghost| ghost.id).ok();
    for (slot, &neighbor) in mesh.neighbors.iter().enumerate() {
        let own = own_index(mesh, neighbor);
        let exists = neighbor == NO_ID
            || own.is_some_and(|own| own != slot / size)
            || ghost(neighbor).is_some();
        findings.check(exists, || {
            let id = mesh.first_simplex.wrapping_add((slot / size) as u64);
            let message = format!("simplex {id} names {neighbor}, neither own nor a ghost");
            Violation::new(ViolationKind::NeighborOutOfRange, mesh.rank, message).simplex(id)
        });
    }
    let crossing = |(slot, &id): (usize, &u64)| {
        let ghost = (id != NO_ID && own_index(mesh, id).is_none()).then(|| ghost(id))??;
        Some(InterfaceFacet { simplex: slot / size, facet: (slot % size) as u32, ghost })
    };
    let needed = collected(mesh.neighbors.iter().enumerate().filter_map(crossing))?;
    findings.check(mesh.interface == needed, || {
        let at = mesh.interface.iter().zip(&needed).take_while(|(a, b)| a == b).count();
        let (found, needed) = (mesh.interface.len(), needed.len());
        let message =
            format!("the interface has {found} facets, of {needed} to ghosts, from {at} on others");
        Violation::new(ViolationKind::Interface, mesh.rank, message)
    });
    Ok(())
}
