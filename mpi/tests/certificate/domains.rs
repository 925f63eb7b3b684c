//! The domains of the parts: what ranks have of them (level 1), their balls and cages (level 3).

use super::made::{assert_parts_broken, change_vertex, clusters, parts, ulp_up};
use super::promises::{set_cage, set_kind};
use netmesh::Options;
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::certificate::ViolationKind;
use netmesh_mpi::distributed::{Domain, NO_ID};

fn assert_broken(
    dim: usize,
    rule: ViolationKind,
    level: u32,
    damage: impl FnOnce(&mut [DistributedMesh]),
) {
    let parts = parts(dim, &clusters(dim, 200), 3, &Options::default());
    assert_parts_broken(parts, rule, level, damage);
}

/// Returns a domain in the root, with another centre.
fn inner(parts: &[DistributedMesh]) -> Domain {
    let root = parts[0].domains[0];
    let mut all = parts.iter().flat_map(|part| &part.domains);
    let is_inner = |domain: &&Domain| domain.parent == 0 && domain.center != root.center;
    *all.find(is_inner).expect("clusters have domains")
}

/// Changes a domain on all ranks.
fn change(parts: &mut [DistributedMesh], id: u64, act: impl Fn(&mut Domain)) {
    for part in parts {
        part.domains.iter_mut().filter(|domain| domain.id == id).for_each(&act);
    }
}

fn promise(parts: &mut [DistributedMesh], act: impl Fn(&mut DistributedMesh)) {
    parts.iter_mut().for_each(act);
}

#[test]
fn what_ranks_have_of_a_domain_is_compared() {
    for dim in [2, 3] {
        assert_broken(dim, ViolationKind::SharedDomain, 0, |parts| {
            ulp_up(&mut parts[1].domains[0].radius)
        });
        assert_broken(dim, ViolationKind::SharedDomain, 0, |parts| parts[2].domains[0].center += 1);
        assert_broken(dim, ViolationKind::Ids, 0, |parts| parts[0].domains.swap(0, 1));
        assert_broken(dim, ViolationKind::Ids, 0, |parts| _ = parts[1].domains.remove(0));
        assert_broken(dim, ViolationKind::Totals, 0, |parts| {
            promise(parts, |part| part.totals.domains += 1);
        });
        assert_broken(dim, ViolationKind::ArrayLength, 0, |parts| _ = parts[0].vertex_cages.pop());
        assert_broken(dim, ViolationKind::SharedVertex, 0, |parts| {
            let part = &mut parts[1];
            let at = part.own_vertices;
            part.vertex_cages[at] = if part.vertex_cages[at] == 0 { NO_ID } else { 0 };
        });
    }
}

#[test]
fn domains_are_a_tree_of_balls() {
    for dim in [2, 3] {
        let broken = |rule, act: fn(&mut Domain)| {
            assert_broken(dim, rule, 2, |parts| change(parts, inner(parts).id, act));
        };
        broken(ViolationKind::DomainTree, |domain| domain.parent = NO_ID);
        broken(ViolationKind::DomainTree, |domain| domain.radius *= 1e9);
        broken(ViolationKind::DomainBall, |domain| domain.radius = 0.0);
        broken(ViolationKind::DomainCenter, |domain| ulp_up(&mut domain.position[1]));
        broken(ViolationKind::DomainCenter, |domain| domain.center = 1 << 40);
        assert_broken(dim, ViolationKind::DomainCenter, 2, |parts| {
            let center = inner(parts).center;
            label(parts, center, 0);
        });
        assert_broken(dim, ViolationKind::DomainOutsideParent, 2, |parts| {
            let radius = parts[0].domains[0].radius;
            change(parts, inner(parts).id, |domain| domain.radius = radius.next_down());
        });
    }
}

/// Returns a vertex on the hull, which is outside of all domains but the root.
fn on_hull(part: &DistributedMesh) -> u64 {
    let slot = part.neighbors.iter().position(|neighbor| *neighbor == NO_ID).unwrap();
    let other = (slot + 1) % (part.dim + 1);
    part.vertex_ids[part.simplex(slot / (part.dim + 1))[other] as usize]
}

/// Sets a vertex's domain on all ranks that know it.
fn label(parts: &mut [DistributedMesh], id: u64, domain: u64) {
    change_vertex(parts, id, |part, at| part.vertex_domains[at] = domain);
}

/// Gives a domain to all ranks that know a vertex.
fn tell(parts: &mut [DistributedMesh], vertex: u64, domain: Domain) {
    for part in parts.iter_mut().filter(|part| part.vertex_ids.contains(&vertex)) {
        if part.domains.iter().all(|known| known.id != domain.id) {
            part.domains.push(domain);
            part.domains.sort_by_key(|domain| domain.id);
        }
    }
}

#[test]
fn vertices_are_in_their_domains() {
    for dim in [2, 3] {
        // A rank that does not have the domain, and all that know it.
        assert_broken(dim, ViolationKind::VertexDomain, 2, |parts| {
            let vertex = on_hull(&parts[0]);
            label(parts, vertex, 1 << 40);
        });
        assert_broken(dim, ViolationKind::VertexDomain, 2, |parts| {
            let (vertex, domain) = (on_hull(&parts[0]), inner(parts));
            tell(parts, vertex, domain);
            label(parts, vertex, domain.id);
        });
    }
}

/// Returns the vertices of a cage, by their ids.
fn cage(parts: &[DistributedMesh], domain: u64) -> Vec<u64> {
    let of_part = |part: &DistributedMesh| -> Vec<u64> {
        let ids = part.vertex_ids.iter().zip(&part.vertex_cages);
        ids.filter(|(_, cage)| **cage == domain).map(|(id, _)| *id).collect()
    };
    let mut all: Vec<u64> = parts.iter().flat_map(of_part).collect();
    all.sort_unstable();
    all.dedup();
    all
}

#[test]
fn cages_are_checked() {
    for dim in [2, 3] {
        assert_broken(dim, ViolationKind::CageOf, 2, |parts| {
            let vertex = cage(parts, inner(parts).id)[0];
            set_cage(parts, vertex, NO_ID);
        });
        assert_broken(dim, ViolationKind::CageOf, 2, |parts| {
            let vertex = cage(parts, inner(parts).id)[0];
            set_cage(parts, vertex, 1 << 40);
        });
        assert_broken(dim, ViolationKind::CageOf, 2, |parts| {
            let (vertex, domain) = (on_hull(&parts[0]), inner(parts));
            tell(parts, vertex, domain);
            set_cage(parts, vertex, domain.id);
            // It is not near either.
            promise(parts, |part| part.promise.gamma = f64::INFINITY);
        });
        assert_broken(dim, ViolationKind::CageRadius, 2, |parts| {
            promise(parts, |part| {
                part.promise.gamma = 0.05;
                part.promise.cage_scale *= 1.1;
            });
        });
        assert_broken(dim, ViolationKind::CageIncomplete, 2, |parts| {
            promise(parts, |part| part.promise.quality_bound = f64::INFINITY);
            for vertex in cage(parts, inner(parts).id).split_off(dim) {
                set_cage(parts, vertex, NO_ID);
                set_kind(parts, vertex, 1);
            }
        });
        assert_broken(dim, ViolationKind::OuterEncroachment, 2, |parts| {
            promise(parts, |part| part.promise.encroachment = 100.0);
        });
        assert_broken(dim, ViolationKind::InnerEncroachment, 2, |parts| {
            promise(parts, |part| {
                part.promise.epsilon = 0.01;
                part.promise.encroachment = 0.0;
            });
        });
        // No vertex is without a cage, so none is bounded but the union cells.
        assert_broken(dim, ViolationKind::CageAspect, 2, |parts| {
            promise(parts, |part| {
                part.promise.gamma = f64::INFINITY;
                part.promise.quality_bound = 1.0;
                part.vertex_cages.clone_from(&part.vertex_domains);
                part.kinds.iter_mut().filter(|kind| **kind == 1).for_each(|kind| *kind = 2);
            });
        });
    }
}

/// Makes as many domains around one as no mesh has: the certificate gives up, and says so.
#[test]
fn too_many_domains_around_each_other_are_found() {
    assert_broken(2, ViolationKind::DomainSpan, 2, |parts| {
        let domain = inner(parts);
        let most = parts.iter().map(DistributedMesh::simplex_count).max().unwrap() as u64 * 64;
        let first = parts[0].totals.domains;
        for part in parts {
            part.totals.domains += most;
            let Some(at) = part.domains.iter().position(|known| known.id == domain.id) else {
                continue;
            };
            part.domains[at].parent = first;
            part.domains.extend((0..most).map(|step| Domain {
                id: first + step,
                parent: if step + 1 == most { domain.parent } else { first + step + 1 },
                radius: domain.radius * (1.0 + 1e-13 * (step + 1) as f64),
                ..domain
            }));
        }
    });
}
