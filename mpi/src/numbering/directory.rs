//! Who else has it: facets between ranks, and vertices that several ranks have.

use super::defect;
use super::merged::Merged;
use crate::comm::Communicator;
use crate::words::{Words, append, empty_messages, hash};
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, filled, with_capacity};
use netmesh::mesh::MAX_DIM;

/// A facet whose other side is another rank's.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Position of the facet among the own neighbours.
    pub slot: usize,
    /// The id of the simplex across.
    pub other: u64,
    /// Whose that is.
    pub rank: u32,
}

/// Returns the rank that knows about something with these names.
fn keeper(names: &[u64], ranks: usize) -> usize {
    (hash(names) % ranks as u64) as usize
}

/// A facet as the directory sees it: the names of its vertices, the place among all neighbours of
/// all ranks, and whose it is.
type Record = ([u64; MAX_DIM], u64, u32);

/// Collective. Finds what is across the facets at the positions `open` of `neighbors`.
pub fn join_facets(
    comm: &dyn Communicator,
    merged: &Merged,
    open: &[usize],
    first_simplex: u64,
) -> Result<Vec<Crossing>> {
    let (dim, size) = (merged.dim, merged.dim as u64 + 1);
    let first_slot = first_simplex * size;
    let mut questions = empty_messages(comm.size())?;
    for &slot in open {
        let names = merged.facet(slot).map(|vertex| match vertex {
            u32::MAX => u64::MAX,
            vertex => merged.names[vertex as usize],
        });
        let question = &mut questions[keeper(&names[..dim], comm.size())];
        append(question, &names[..dim])?;
        append(question, &[first_slot + slot as u64])?;
    }
    let records = read_records(dim, &comm.all_to_all(questions)?)?;
    let mut answers = empty_messages(comm.size())?;
    for group in records.chunk_by(|a, b| a.0 == b.0) {
        let [a, b] = group else {
            return Err(defect("a facet at an interface without a second side"));
        };
        for (one, other) in [(a, b), (b, a)] {
            append(&mut answers[one.2 as usize], &[one.1, other.1 / size, other.2.into()])?;
        }
    }
    let mut crossings = with_capacity(open.len())?;
    for answer in comm.all_to_all(answers)? {
        let mut words = Words::new(&answer);
        while !words.is_empty() {
            let slot = (words.next()? - first_slot) as usize;
            crossings.try_push(Crossing {
                slot,
                other: words.next()?,
                rank: words.next()? as u32,
            })?;
        }
    }
    crossings.sort_unstable_by_key(|crossing| crossing.slot);
    Ok(crossings)
}

fn read_records(dim: usize, messages: &[Vec<u8>]) -> Result<Vec<Record>> {
    let mut records = Vec::new();
    for (rank, message) in messages.iter().enumerate() {
        let mut words = Words::new(message);
        while !words.is_empty() {
            let mut names = [u64::MAX; MAX_DIM];
            names[..dim].iter_mut().try_for_each(|name| words.next().map(|word| *name = word))?;
            records.try_push((names, words.next()?, rank as u32))?;
        }
    }
    records.sort_unstable();
    Ok(records)
}

/// The vertices that other ranks have as well.
pub struct Shared {
    /// Vertex and other rank, rising.
    pub pairs: Vec<(u32, u32)>,
}

impl Shared {
    /// Collective. Finds the vertices that several ranks have. A vertex that two ranks have lies on
    /// facets between ranks, in each of them: the simplices round a vertex are connected through
    /// facets with it.
    pub fn find(comm: &dyn Communicator, merged: &Merged, open: &[usize]) -> Result<Self> {
        let mut vertices: Vec<u32> = with_capacity(open.len() * merged.dim)?;
        open.iter().for_each(|&slot| vertices.extend(&merged.facet(slot)[..merged.dim]));
        vertices.sort_unstable();
        vertices.dedup();
        let mut questions = empty_messages(comm.size())?;
        for &vertex in &vertices {
            let name = [merged.names[vertex as usize]];
            append(&mut questions[keeper(&name, comm.size())], &name)?;
        }
        let mut holders = Vec::new();
        for (rank, message) in comm.all_to_all(questions)?.iter().enumerate() {
            let mut words = Words::new(message);
            while !words.is_empty() {
                holders.try_push((words.next()?, rank as u64))?;
            }
        }
        holders.sort_unstable();
        let mut answers = empty_messages(comm.size())?;
        for group in holders.chunk_by(|a, b| a.0 == b.0) {
            for (name, rank) in group {
                let others = group.iter().filter(|(_, other)| other != rank);
                others.clone().try_for_each(|(_, other)| {
                    append(&mut answers[*rank as usize], &[*name, *other])
                })?;
            }
        }
        let mut pairs = Vec::new();
        for answer in comm.all_to_all(answers)? {
            let mut words = Words::new(&answer);
            while !words.is_empty() {
                let (name, rank) = (words.next()?, words.next()?);
                let vertex = merged.names.binary_search(&name);
                let vertex = vertex.map_err(|_| defect("a name that is not known here"))?;
                pairs.try_push((vertex as u32, rank as u32))?;
            }
        }
        pairs.sort_unstable();
        Ok(Self { pairs })
    }

    /// Returns for each vertex the lowest rank that has it.
    pub fn owners(&self, rank: u32, vertices: usize) -> Result<Vec<u32>> {
        let mut owners = filled(vertices, rank)?;
        for &(vertex, other) in &self.pairs {
            let owner = &mut owners[vertex as usize];
            *owner = other.min(*owner);
        }
        Ok(owners)
    }

    /// Returns the other ranks that have a vertex.
    pub fn of(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let start = self.pairs.partition_point(|pair| pair.0 < vertex);
        let here = self.pairs[start..].iter().take_while(move |pair| pair.0 == vertex);
        here.map(|pair| pair.1)
    }
}
