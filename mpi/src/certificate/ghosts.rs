//! Level 1: every ghost is what its owner has under its id. Each rank shows its ghosts to their
//! owners.

use super::arrays::own_index;
use super::exchange::Outbox;
use super::report::{Findings, Violation};
use crate::comm::Communicator;
use crate::distributed::DistributedMesh;
use netmesh::Result;
use netmesh::validate::ViolationKind;

/// Collective. Checks that ghosts are what their owners have; coordinates are compared by vertex.
pub fn check(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    findings: &mut Findings,
) -> Result<()> {
    let ids_of = |vertices: &[u32]| -> [u64; 4] {
        std::array::from_fn(|at| vertices.get(at).map_or(0, |&v| mesh.vertex_ids[v as usize]))
    };
    let mut outbox = Outbox::new(comm.size())?;
    for (at, ghost) in mesh.ghosts.iter().enumerate() {
        let [a, b, c, d] = ids_of(mesh.ghost(at));
        outbox.put(ghost.owner as usize, [ghost.id, a, b, c, d])?;
    }
    for ([id, shown @ ..], rank) in outbox.deliver(comm)? {
        let own = own_index(mesh, id).map(|own| ids_of(mesh.simplex(own)));
        findings.check(own == Some(shown), || {
            let shown = &shown[..=mesh.dim];
            let message = match own {
                None => format!("rank {rank} has a ghost {id}, which rank {} has not", mesh.rank),
                Some(own) => {
                    let own = &own[..=mesh.dim];
                    format!("ghost {id} of rank {rank} has vertices {shown:?}, its owner {own:?}")
                }
            };
            Violation::new(ViolationKind::Ghost, rank, message).simplex(id)
        });
    }
    Ok(())
}
