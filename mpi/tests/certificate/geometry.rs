//! Level 2, where simplices of two ranks meet.

use super::made::{assert_broken, certify, move_vertex, parts, uniform};
use super::whole::Whole;
use netmesh::Options;
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::certificate::ViolationKind;
use netmesh_mpi::distributed::InterfaceFacet;

/// Returns the facet between ranks whose opposite vertices are both no inputs and off the hull.
fn inner_interface(part: &DistributedMesh) -> (usize, usize) {
    let is_inner = |vertex: u32| part.kinds[vertex as usize] == 1;
    let own = |facet: &InterfaceFacet| part.simplex(facet.simplex)[facet.facet as usize];
    let other = |facet: &InterfaceFacet| {
        let vertices = part.ghost(facet.ghost);
        *vertices.iter().find(|v| !part.simplex(facet.simplex).contains(v)).unwrap()
    };
    let fits = |facet: &&InterfaceFacet| is_inner(own(facet));
    let facet = part.interface.iter().find(fits).expect("an inner facet");
    (own(facet) as usize, other(facet) as usize)
}

#[test]
fn geometry_is_checked_across_ranks() {
    for dim in [2, 3] {
        // A simplex and all ghosts of it turned inside out.
        assert_broken(dim, ViolationKind::Orientation, 1, |parts| {
            let id = parts[0].first_simplex + parts[0].interface[0].simplex as u64;
            turn(parts, id);
        });
        // A vertex next to an interface is moved just towards the vertex on the other side, on all
        // ranks alike, until a facet is not Delaunay: the topology holds, and what is found is
        // found where the ranks meet.
        let report = assert_broken(dim, ViolationKind::Delaunay, 1, |parts| {
            let (own, other) = inner_interface(&parts[0]);
            let (id, steps) = (parts[0].vertex_ids[own], 200);
            let (from, to) =
                (parts[0].point(own as u32).to_vec(), parts[0].point(other as u32).to_vec());
            for step in 1..steps {
                let share = step as f64 / steps as f64;
                let point: Vec<f64> =
                    from.iter().zip(&to).map(|(a, b)| a + share * (b - a)).collect();
                move_vertex(parts, id, &point);
                let report = certify(parts, 2);
                if report.level < 2 {
                    break;
                }
            }
        });
        assert_eq!(report.first.unwrap().message.split(' ').next(), Some("vertex"));
    }
}

/// Swaps two vertices of a simplex, and what is across from them, on all ranks that have it.
fn turn(parts: &mut [DistributedMesh], id: u64) {
    for part in parts {
        let size = part.dim + 1;
        let own = id.wrapping_sub(part.first_simplex) as usize;
        if own < part.simplex_count() {
            part.simplices.swap(own * size, own * size + 1);
            part.neighbors.swap(own * size, own * size + 1);
            for facet in part.interface.iter_mut().filter(|facet| facet.simplex == own) {
                facet.facet = [1, 0].get(facet.facet as usize).copied().unwrap_or(facet.facet);
            }
            part.interface.sort_by_key(|facet| (facet.simplex, facet.facet));
        }
        if let Ok(ghost) = part.ghosts.binary_search_by_key(&id, |ghost| ghost.id) {
            part.ghost_simplices.swap(ghost * size, ghost * size + 1);
        }
    }
}

/// Replaces the two triangles at a facet between ranks by those at the other diagonal: the
/// quadrilateral is strictly convex, so all holds but that they are not Delaunay.
#[test]
fn a_facet_flipped_across_ranks_is_found_by_both() {
    let parts = parts(2, &uniform(2, 200), 2, &Options::default());
    let facet = parts[0].interface.iter().copied().find(|facet| is_convex(&parts[0], facet));
    let facet = facet.expect("a facet to flip");
    let ids = quadrilateral(&parts[0], facet.simplex, facet.facet as usize, facet.ghost);
    let [a, b, c, d] = ids.map(|vertex| parts[0].vertex_ids[vertex as usize]);
    let mut whole = Whole::of(&parts);
    whole.simplices[parts[0].first_simplex as usize + facet.simplex] = vec![a, b, d];
    whole.simplices[parts[0].ghosts[facet.ghost].id as usize] = vec![a, d, c];
    let begins: Vec<usize> = parts.iter().map(|part| part.first_simplex as usize).collect();
    let parts = whole.parts(&begins, &parts);
    let report = certify(&parts, 3);
    let first = report.first.clone().unwrap();
    assert_eq!((first.kind, report.level), (ViolationKind::Delaunay, 1), "{first:?}");
    // The new facet, from each of its sides.
    assert!(report.violations >= 2, "{report:?}");
}

fn turns_left(a: &[f64], b: &[f64], c: &[f64]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 1e-9
}

/// Returns own a, b, c with the facet b, c and the ghost's d beyond it.
fn quadrilateral(part: &DistributedMesh, simplex: usize, slot: usize, ghost: usize) -> [u32; 4] {
    let own = part.simplex(simplex);
    let d = *part.ghost(ghost).iter().find(|v| !own.contains(v)).unwrap();
    [own[slot], own[(slot + 1) % 3], own[(slot + 2) % 3], d]
}

fn is_convex(part: &DistributedMesh, facet: &InterfaceFacet) -> bool {
    let [a, b, c, d] = quadrilateral(part, facet.simplex, facet.facet as usize, facet.ghost)
        .map(|vertex| part.point(vertex).to_vec());
    turns_left(&a, &b, &d) && turns_left(&a, &d, &c)
}
