//! Level 1: what ranks know of a vertex. All tell it to a keeper, which its id alone chooses, and
//! which compares.

use super::complex::Complex;
use super::exchange::{Outbox, bits};
use super::report::{Findings, Violation};
use crate::comm::Communicator;
use netmesh::Result;
use netmesh::distributed::memory::filled;
use netmesh::validate::ViolationKind;

/// Vertices that this rank keeps, and those of them that are inputs by their ids.
pub type Kept = [u64; 2];

/// Data of a vertex: id, coordinates, kind, domain, cage, owner, own simplices there, and all that
/// the rank knows there; and the rank.
type Record = ([u64; 10], usize);

const ID: usize = 0;
/// Up to here all ranks must say the same.
const SAME: std::ops::Range<usize> = 1..7;
const OWNER: usize = 7;
const OWN: usize = 8;
const STAR: usize = 9;

/// Collective. Checks that all ranks have equal data of each vertex, its owner, and that each rank
/// that has a simplex there has all of them.
pub fn check(
    comm: &dyn Communicator,
    complex: &Complex<'_>,
    findings: &mut Findings,
) -> Result<Kept> {
    let mesh = complex.mesh;
    let mut own = filled(mesh.vertex_ids.len(), 0u64)?;
    let mut star = filled(mesh.vertex_ids.len(), 0u64)?;
    mesh.simplices.iter().for_each(|&vertex| own[vertex as usize] += 1);
    mesh.ghost_simplices.iter().for_each(|&vertex| star[vertex as usize] += 1);
    let mut outbox = Outbox::new(comm.size())?;
    for (at, &id) in mesh.vertex_ids.iter().enumerate() {
        let [x, y, z] = bits(mesh.point(at as u32));
        let (kind, owner) = (mesh.kinds[at].into(), mesh.vertex_owners[at].into());
        let (domain, cage) = (mesh.vertex_domains[at], mesh.vertex_cages[at]);
        let record = [id, x, y, z, kind, domain, cage, owner, own[at], own[at] + star[at]];
        outbox.put_by_names(1, record)?;
    }
    drop((own, star));
    let mut kept = [0; 2];
    for group in outbox.deliver(comm)?.chunk_by(|a, b| a.0[ID] == b.0[ID]) {
        kept[0] += 1;
        kept[1] += u64::from(group[0].0[ID] < mesh.totals.inputs);
        check_group(group, findings);
    }
    Ok(kept)
}

fn check_group(group: &[Record], findings: &mut Findings) {
    let id = group[0].0[ID];
    let holders = || group.iter().filter(|record| record.0[OWN] > 0);
    let owner = holders().min_by_key(|record| record.1);
    let (first, rank) = *owner.unwrap_or(&group[0]);
    findings.check(owner.is_some(), || {
        let message = format!("vertex {id} is in ghosts only");
        Violation::new(ViolationKind::UnusedVertex, rank, message).vertex(id)
    });
    let all: u64 = group.iter().map(|record| record.0[OWN]).sum();
    for (record, other) in group {
        findings.check(record[SAME] == first[SAME], || {
            let at = SAME.start + (0..6).take_while(|at| record[1 + at] == first[1 + at]).count();
            let what = match at {
                1..=3 => format!("coordinate {}", at - 1),
                4 => "kind".to_owned(),
                5 => "domain".to_owned(),
                _ => "cage".to_owned(),
            };
            let message = format!("{what} of vertex {id} differs on ranks {rank} and {other}");
            Violation::new(ViolationKind::SharedVertex, *other, message).vertex(id)
        });
        findings.check(record[OWNER] == rank as u64, || {
            let message =
                format!("vertex {id} has owner {} on rank {other}, not {rank}", record[OWNER]);
            Violation::new(ViolationKind::VertexOwner, *other, message).vertex(id)
        });
        findings.check(record[OWN] == 0 || record[STAR] == all, || {
            let found = record[STAR];
            let message =
                format!("rank {other} knows {found} of the {all} simplices at vertex {id}");
            Violation::new(ViolationKind::MissingGhost, *other, message).vertex(id)
        });
    }
}
