//! Level 1: the parts follow each other, and the sizes of the whole are theirs.

use super::report::{Findings, Violation};
use crate::comm::{Communicator, Operation};
use crate::distributed::{DistributedMesh, Totals};
use netmesh::Result;
use netmesh::validate::ViolationKind;

/// Collective. Checks where the ids of this rank begin, and the totals that all ranks must have of
/// the whole.
pub fn check_ids(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    findings: &mut Findings,
) -> Result<()> {
    let (first_input, inputs) = comm.exclusive_sum((mesh.inputs.len() / mesh.dim) as u64)?;
    let (first_simplex, simplices) = comm.exclusive_sum(mesh.simplex_count() as u64)?;
    let rows = [
        ("the first input", mesh.first_input, first_input),
        ("the first simplex", mesh.first_simplex, first_simplex),
    ];
    for (what, found, needed) in rows {
        findings.check(found == needed, || {
            let message = format!("{what} has id {found}, the ranks before leave {needed}");
            Violation::new(ViolationKind::Ids, mesh.rank, message)
        });
    }
    let rows =
        [("inputs", mesh.totals.inputs, inputs), ("simplices", mesh.totals.simplices, simplices)];
    for (what, found, needed) in rows {
        findings.check(found == needed, || wrong_total(mesh, what, found, needed));
    }
    let Totals { inputs, duplicates, vertices, vertex_ids, simplices, domains, pieces } =
        mesh.totals;
    let own = [inputs, duplicates, vertices, vertex_ids, simplices, domains, pieces];
    let mut first = if mesh.rank == 0 { own } else { [0; 7] };
    comm.all_reduce_integers(&mut first, Operation::Max)?;
    findings.check(own == first, || {
        let message = format!("rank {} has other totals than rank 0", mesh.rank);
        Violation::new(ViolationKind::Totals, mesh.rank, message)
    });
    Ok(())
}

/// Collective. Checks the vertices of the whole, of which this rank keeps some.
pub fn check_vertices(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    mut kept: super::vertices::Kept,
    findings: &mut Findings,
) -> Result<()> {
    comm.all_reduce_integers(&mut kept, Operation::Sum)?;
    let [vertices, inputs] = kept;
    let totals = &mesh.totals;
    let rows = [
        ("vertices", totals.vertices, vertices),
        ("distinct inputs", totals.inputs.wrapping_sub(totals.duplicates), inputs),
        // So that their ids have no gap.
        (
            "ids of vertices that are no inputs",
            totals.vertex_ids.wrapping_sub(totals.inputs),
            vertices - inputs,
        ),
    ];
    // All ranks have the same totals.
    for (what, found, needed) in rows.into_iter().filter(|_| mesh.rank == 0) {
        findings.check(found == needed, || wrong_total(mesh, what, found, needed));
    }
    Ok(())
}

/// Returns the violation of totals that are not what all ranks have.
pub fn wrong_total(mesh: &DistributedMesh, what: &str, found: u64, needed: u64) -> Violation {
    let message = format!("totals say {found} {what}, the ranks have {needed}");
    Violation::new(ViolationKind::Totals, mesh.rank, message)
}
