//! The domains of a rank's part. What pieces know of a domain differs by age, and the latest holds:
//! all tell it to a keeper, which the id chooses. From the keepers a rank gets the domains that
//! hold its vertices, and those around them.

use super::defect;
use crate::comm::{Communicator, Operation};
use crate::distributed::{DistributedMesh, Domain, NO_ID};
use crate::piece::{ADDED, PieceDomain};
use crate::words::{append, distinct, empty_messages, words_of};
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, collected};

/// Data of a domain: id, version, parent, centre, radius and the centre's coordinates.
pub type Record = [u64; 8];

const ID: usize = 0;
const VERSION: usize = 1;
const PARENT: usize = 2;
const CENTER: usize = 3;

/// Returns the names of vertices that are no inputs, which rise, and those at the centres of
/// domains, which another rank may have.
pub fn with_centers(names: &[u64], copies: &[PieceDomain]) -> Result<Vec<u64>> {
    let centers = copies.iter().map(|copy| copy.center).filter(|name| name & ADDED != 0);
    distinct(names.iter().copied().chain(centers))
}

/// Returns what a piece knows of a domain. `domain_id` and `vertex_id` turn names into ids.
pub fn record(
    copy: &PieceDomain,
    domain_id: impl Fn(u64) -> u64,
    vertex_id: impl Fn(u64) -> u64,
) -> Record {
    let parent = copy.parent.map_or(NO_ID, &domain_id);
    let (center, radius) = (vertex_id(copy.center), copy.radius.to_bits());
    let [x, y, z] = copy.position.map(f64::to_bits);
    [domain_id(copy.name), copy.version, parent, center, radius, x, y, z]
}

/// Collective. Gives the mesh the domains that hold its vertices.
pub fn exchange(
    comm: &dyn Communicator,
    mesh: &mut DistributedMesh,
    copies: &[Record],
) -> Result<()> {
    let kept = deliver(comm, copies)?;
    let mut known: Vec<Domain> = Vec::new();
    let mut wanted = distinct(mesh.vertex_domains.iter().chain(&mesh.vertex_cages).copied())?;
    // What is around a domain is known when the domain is.
    loop {
        let mut waiting = [wanted.len() as u64];
        comm.all_reduce_integers(&mut waiting, Operation::Max)?;
        if waiting == [0] {
            break;
        }
        let first = known.len();
        ask(comm, &kept, &wanted)?.iter().try_for_each(|record| known.try_push(domain(record)))?;
        wanted = distinct(known[first..].iter().map(|domain| domain.parent))?;
        known.sort_unstable_by_key(|domain| domain.id);
        wanted.retain(|id| known.binary_search_by_key(id, |domain| domain.id).is_err());
    }
    mesh.domains = known;
    Ok(())
}

fn keeper(id: u64, ranks: usize) -> usize {
    (id % ranks as u64) as usize
}

/// Collective. Delivers copies of domains; returns the latest of those that this rank keeps, by
/// rising id.
fn deliver(comm: &dyn Communicator, copies: &[Record]) -> Result<Vec<Record>> {
    let mut messages = empty_messages(comm.size())?;
    for copy in copies {
        append(&mut messages[keeper(copy[ID], comm.size())], copy)?;
    }
    let mut kept = records_of(&comm.all_to_all(messages)?)?;
    kept.sort_unstable_by_key(|record| (record[ID], u64::MAX - record[VERSION]));
    kept.dedup_by_key(|record| record[ID]);
    Ok(kept)
}

/// Collective. Asks for the records of the domains that this rank wants.
fn ask(comm: &dyn Communicator, kept: &[Record], wanted: &[u64]) -> Result<Vec<Record>> {
    let mut questions = empty_messages(comm.size())?;
    for &id in wanted {
        append(&mut questions[keeper(id, comm.size())], &[id])?;
    }
    let mut answers = empty_messages(comm.size())?;
    for (answer, question) in answers.iter_mut().zip(comm.all_to_all(questions)?) {
        for id in words_of(&question) {
            let at = kept.binary_search_by_key(&id, |record| record[ID]);
            let at = at.map_err(|_| defect("a domain that no piece knows"))?;
            append(answer, &kept[at])?;
        }
    }
    records_of(&comm.all_to_all(answers)?)
}

fn records_of(messages: &[Vec<u8>]) -> Result<Vec<Record>> {
    let mut records = Vec::new();
    for message in messages {
        let words: Vec<u64> = collected(words_of(message))?;
        for words in words.chunks_exact(8) {
            records.try_push(std::array::from_fn(|at| words[at]))?;
        }
    }
    Ok(records)
}

fn domain(record: &Record) -> Domain {
    let [radius, x, y, z] = [4, 5, 6, 7].map(|at| f64::from_bits(record[at]));
    Domain {
        id: record[ID],
        parent: record[PARENT],
        center: record[CENTER],
        radius,
        position: [x, y, z],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::threads;

    /// Exchanges a chain of domains, of which each rank knows some, one in an old state: each gets
    /// the latest of those that hold its vertices, and no others.
    #[test]
    fn a_rank_gets_the_latest_of_its_domains_and_of_those_around_them() {
        let record = |id, version, parent, radius: f64| -> Record {
            [id, version, parent, 100 + id, radius.to_bits(), 0, 0, 0]
        };
        let meshes = threads::run(3, |comm| {
            let copies = match comm.rank() {
                0 => vec![record(4, 1, 0, 1.0), record(0, 0, NO_ID, 64.0)],
                1 => vec![record(4, 2, 3, 2.0), record(3, 0, 2, 8.0), record(2, 0, 0, 16.0)],
                _ => vec![record(1, 5, 0, 4.0), record(0, 0, NO_ID, 64.0)],
            };
            let vertex_domains = [vec![4, 0, 4], vec![], vec![NO_ID, 1]];
            let vertex_cages = [vec![NO_ID; 3], vec![], vec![1, NO_ID]];
            let mut mesh = DistributedMesh {
                vertex_domains: vertex_domains[comm.rank()].clone(),
                vertex_cages: vertex_cages[comm.rank()].clone(),
                ..DistributedMesh::default()
            };
            exchange(comm, &mut mesh, &copies).unwrap();
            mesh
        });
        let known = |rank: usize| -> Vec<[u64; 4]> {
            let domains = meshes[rank].domains.iter();
            domains.map(|d| [d.id, d.parent, d.center, d.radius as u64]).collect()
        };
        let root = [0, NO_ID, 100, 64];
        assert_eq!(known(0), [root, [2, 0, 102, 16], [3, 2, 103, 8], [4, 3, 104, 2]]);
        assert_eq!(known(1), [[0; 4]; 0]);
        assert_eq!(known(2), [root, [1, 0, 101, 4]]);
    }
}
