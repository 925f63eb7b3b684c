//! Level 3.

use super::made::{
    assert_broken, assert_parts_broken, change_vertex, duplicates, move_vertex, parts, ulp_up,
};
use netmesh::{Criterion, Options, Output};
use netmesh_mpi::DistributedMesh;
use netmesh_mpi::certificate::ViolationKind;
use netmesh_mpi::distributed::NO_ID;

#[test]
fn promises_are_checked() {
    for dim in [2, 3] {
        assert_broken(dim, ViolationKind::InputVertex, 2, |parts| parts[0].inputs[0] += 0.25);
        // An input that moves by one bit is another point.
        assert_broken(dim, ViolationKind::InputVertex, 2, |parts| ulp_up(&mut parts[1].inputs[0]));
        // Zeros compare equal, and have the bits of the first.
        assert_broken(dim, ViolationKind::InputBits, 2, |parts| {
            let zero = |part: &DistributedMesh| {
                let is_zero = |v: &usize| part.point(*v as u32).iter().all(|x| *x == 0.0);
                (0..part.vertex_ids.len()).find(is_zero).map(|v| part.vertex_ids[v])
            };
            let id = parts.iter().find_map(zero).unwrap();
            move_vertex(parts, id, &vec![-0.0; dim]);
        });
        assert_broken(dim, ViolationKind::VertexKind, 2, |parts| set_kind(parts, 0, 1));
        assert_broken(dim, ViolationKind::VertexDomain, 2, |parts| {
            parts.iter_mut().for_each(|part| part.vertex_domains.fill(1 << 40));
        });
        assert_broken(dim, ViolationKind::HullVertex, 2, |parts| {
            let part = &parts[0];
            let slot = part.neighbors.iter().position(|neighbor| *neighbor == NO_ID).unwrap();
            let (simplex, slot) = (slot / (dim + 1), slot % (dim + 1));
            let vertex = part.simplex(simplex)[(slot + 1) % (dim + 1)] as usize;
            let id = part.vertex_ids[vertex];
            set_kind(parts, id, 1);
            set_cage(parts, id, NO_ID);
        });
        // Without cages, whose union cells would be found first.
        let finished = Options { output: Output::WellSpaced, ..Options::default() };
        let finished = parts(dim, &duplicates(dim, 150), 3, &finished);
        assert_parts_broken(finished, ViolationKind::VertexAspect, 2, |parts| {
            parts.iter_mut().for_each(|part| part.promise.quality_bound = 1.1);
        });
        assert_broken(dim, ViolationKind::RadiusEdge, 2, |parts| {
            for part in parts {
                part.promise.quality_bound = 0.6;
                part.promise.criterion = Criterion::RadiusEdge;
            }
        });
        assert_broken(dim, ViolationKind::NotFinished, 2, |parts| {
            parts.iter_mut().for_each(|part| part.promise.is_finished = true);
        });
    }
}

pub fn set_cage(parts: &mut [DistributedMesh], id: u64, cage: u64) {
    change_vertex(parts, id, |part, at| part.vertex_cages[at] = cage);
}

pub fn set_kind(parts: &mut [DistributedMesh], id: u64, kind: u8) {
    change_vertex(parts, id, |part, at| part.kinds[at] = kind);
}
