//! Level 1: what ranks have of each other, and their arrays.

use super::made::{assert_broken, ulp_up};
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::certificate::ViolationKind;
use netmesh_mpi::distributed::{Ghost, NO_ID};
use std::collections::BTreeSet;

/// Returns the index of a vertex that is own on one rank, on another that only knows it from
/// ghosts.
fn distant_vertex(part: &DistributedMesh) -> usize {
    assert!(part.own_vertices < part.vertex_ids.len());
    part.own_vertices
}

#[test]
fn what_ranks_have_of_each_other_is_compared() {
    for dim in [2, 3] {
        let report = assert_broken(dim, ViolationKind::SharedVertex, 0, |parts| {
            let at = distant_vertex(&parts[1]) * dim + dim - 1;
            ulp_up(&mut parts[1].points[at]);
        });
        let first = report.first.unwrap();
        assert_eq!((first.rank, report.violations), (1, 1), "a ghost's coordinate by one ulp");
        assert!(first.message.starts_with(&format!("coordinate {} of vertex", dim - 1)));
        assert_ne!(first.vertex, NO_ID);
        // One that is own on both sides, moved on one.
        assert_broken(dim, ViolationKind::SharedVertex, 0, |parts| {
            let vertex = parts[2].vertex_owners.iter().position(|&owner| owner == 0).unwrap();
            ulp_up(&mut parts[2].points[vertex * dim]);
        });
        assert_broken(dim, ViolationKind::SharedVertex, 0, |parts| {
            let vertex = distant_vertex(&parts[0]);
            parts[0].kinds[vertex] ^= 1;
        });
        assert_broken(dim, ViolationKind::SharedVertex, 0, |parts| {
            let vertex = distant_vertex(&parts[0]);
            parts[0].vertex_domains[vertex] = NO_ID;
        });
        assert_broken(dim, ViolationKind::VertexOwner, 0, |parts| {
            let vertex = distant_vertex(&parts[2]);
            parts[2].vertex_owners[vertex] = 2;
        });
        // Vertices of a ghost swapped: its owner has them in another order.
        let report = assert_broken(dim, ViolationKind::Ghost, 0, |parts| {
            parts[1].ghost_simplices.swap(0, 1);
        });
        assert_eq!((report.first.unwrap().rank, report.violations), (1, 1));
        // A ghost whose vertex is another one that the rank knows.
        assert_broken(dim, ViolationKind::Ghost, 0, |parts| {
            let part = &mut parts[0];
            let size = dim + 1;
            let other = (0..part.vertex_ids.len() as u32)
                .find(|vertex| !part.ghost_simplices[..size].contains(vertex))
                .unwrap();
            part.ghost_simplices[size - 1] = other;
        });
        assert_broken(dim, ViolationKind::Ghost, 0, |parts| {
            let ranks = parts.len() as u32;
            let ghost = &mut parts[0].ghosts[0];
            ghost.owner = if ghost.owner + 1 == ranks { 1 } else { ghost.owner + 1 };
        });
    }
}

/// Leaves out a ghost that is not at the interface, with its vertices if no other has them.
fn drop_ghost(part: &mut DistributedMesh) {
    let size = part.dim + 1;
    let at_interface: BTreeSet<usize> = part.interface.iter().map(|facet| facet.ghost).collect();
    let is_needed = |ghost: usize| {
        let others = (0..part.ghosts.len()).filter(|other| *other != ghost);
        let known: BTreeSet<u32> = others.flat_map(|other| part.ghost(other).to_vec()).collect();
        let own = part.own_vertices as u32;
        at_interface.contains(&ghost)
            || part.ghost(ghost).iter().any(|vertex| *vertex >= own && !known.contains(vertex))
    };
    let ghost = (0..part.ghosts.len()).find(|ghost| !is_needed(*ghost)).unwrap();
    part.ghosts.remove(ghost);
    part.ghost_simplices.drain(ghost * size..(ghost + 1) * size);
    part.interface.iter_mut().for_each(|facet| facet.ghost -= usize::from(facet.ghost > ghost));
}

#[test]
fn neighbors_are_those_that_share_facets() {
    for dim in [2, 3] {
        let size = dim + 1;
        assert_broken(dim, ViolationKind::MissingGhost, 0, |parts| drop_ghost(&mut parts[1]));
        // The neighbour across an interface is another ghost.
        let report = assert_broken(dim, ViolationKind::NeighborFacet, 0, |parts| {
            let part = &mut parts[1];
            let facet = &mut part.interface[0];
            facet.ghost = (facet.ghost + 1) % part.ghosts.len();
            part.neighbors[facet.simplex * size + facet.facet as usize] =
                part.ghosts[facet.ghost].id;
        });
        assert_eq!((report.first.unwrap().rank, report.violations), (1, 1));
        assert_broken(dim, ViolationKind::MissingNeighbor, 0, |parts| {
            let facet = parts[2].interface.remove(0);
            parts[2].neighbors[facet.simplex * size + facet.facet as usize] = NO_ID;
        });
        assert_broken(dim, ViolationKind::Interface, 0, |parts| {
            parts[2].interface.pop();
        });
        assert_broken(dim, ViolationKind::NeighborOutOfRange, 0, |parts| {
            let slot = parts[0].neighbors.iter().position(|neighbor| *neighbor != NO_ID).unwrap();
            parts[0].neighbors[slot] = parts[0].totals.simplices + 7;
        });
        assert_broken(dim, ViolationKind::NeighborFacet, 0, |parts| {
            let slot = parts[0].neighbors.iter().position(|neighbor| *neighbor == NO_ID).unwrap();
            parts[0].neighbors[slot] = parts[0].first_simplex + u64::from(slot < size) * 2;
        });
    }
}

#[test]
fn arrays_fit_each_other() {
    for dim in [2, 3] {
        assert_broken(dim, ViolationKind::ArrayLength, 0, |parts| {
            parts[1].points.pop();
        });
        assert_broken(dim, ViolationKind::NonFinite, 0, |parts| parts[1].points[1] = f64::NAN);
        assert_broken(dim, ViolationKind::VertexOutOfRange, 0, |parts| {
            parts[2].simplices[0] = parts[2].own_vertices as u32;
        });
        assert_broken(dim, ViolationKind::RepeatedVertex, 0, |parts| {
            parts[2].simplices[0] = parts[2].simplices[1];
        });
        assert_broken(dim, ViolationKind::Ids, 0, |parts| parts[0].vertex_ids.swap(0, 1));
        assert_broken(dim, ViolationKind::Ids, 0, |parts| parts[1].first_simplex = u64::MAX);
        assert_broken(dim, ViolationKind::Ids, 0, |parts| parts[2].first_input += 1);
        assert_broken(dim, ViolationKind::Ids, 0, |parts| parts[2].ghosts.swap(0, 1));
        assert_broken(dim, ViolationKind::VertexOwner, 0, |parts| parts[0].vertex_owners[0] = 3);
        assert_broken(dim, ViolationKind::Ghost, 0, |parts| {
            let Ghost { owner, .. } = &mut parts[1].ghosts[0];
            *owner = 1;
        });
        assert_broken(dim, ViolationKind::UnusedVertex, 0, |parts| {
            let part = &mut parts[1];
            let id = part.totals.vertex_ids - 1;
            part.vertex_ids.push(if part.vertex_ids.contains(&id) { id + 1 } else { id });
            part.totals.vertex_ids += 1;
            part.points.extend(vec![0.5; dim]);
            part.kinds.push(1);
            part.vertex_owners.push(1);
            part.vertex_domains.push(0);
            part.vertex_cages.push(NO_ID);
        });
        assert_broken(dim, ViolationKind::Totals, 0, |parts| {
            parts.iter_mut().for_each(|part| part.totals.vertices += 1);
        });
        assert_broken(dim, ViolationKind::Totals, 0, |parts| parts[1].totals.domains += 1);
    }
}
