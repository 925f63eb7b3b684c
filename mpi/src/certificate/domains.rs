//! Level 1: what ranks have of a domain. All tell it to a keeper, which its id alone chooses, and
//! which compares.

use super::exchange::{Outbox, bits};
use super::report::{Findings, Violation};
use super::totals::wrong_total;
use crate::comm::{Communicator, Operation};
use crate::distributed::DistributedMesh;
use netmesh::Result;
use netmesh::validate::ViolationKind;

/// Data of a domain: id, parent, centre, radius and the centre's coordinates; and the rank that has
/// it.
type Record = ([u64; 7], usize);

const ID: usize = 0;

/// Collective. Checks that all ranks have equal data of each domain, and how many there are.
pub fn check(
    comm: &dyn Communicator,
    mesh: &DistributedMesh,
    findings: &mut Findings,
) -> Result<()> {
    let mut outbox = Outbox::new(comm.size())?;
    for domain in &mesh.domains {
        let [x, y, z] = bits(&domain.position);
        let record = [domain.id, domain.parent, domain.center, domain.radius.to_bits(), x, y, z];
        outbox.put_by_names(1, record)?;
    }
    let mut kept = [0];
    for group in outbox.deliver(comm)?.chunk_by(|a, b| a.0[ID] == b.0[ID]) {
        kept[0] += 1;
        check_group(group, findings);
    }
    comm.all_reduce_integers(&mut kept, Operation::Sum)?;
    // All ranks have the same totals.
    let (found, needed) = (mesh.totals.domains, kept[0]);
    findings
        .check(mesh.rank != 0 || found == needed, || wrong_total(mesh, "domains", found, needed));
    Ok(())
}

fn check_group(group: &[Record], findings: &mut Findings) {
    let (first, rank) = group[0];
    for (record, other) in group {
        findings.check(*record == first, || {
            let id = first[ID];
            let message = format!("domain {id} is not the same on ranks {rank} and {other}");
            Violation::new(ViolationKind::SharedDomain, *other, message)
        });
    }
}
