//! Simplices of other ranks that share a vertex with an own one.

use super::defect;
use super::directory::{Crossing, Shared};
use crate::comm::Communicator;
use crate::distributed::{DistributedMesh, Ghost, InterfaceFacet};
use crate::words::{Words, append, empty_messages};
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, collected, copied, with_capacity};

/// Collective. Sends the others those simplices that share a vertex with theirs.
pub fn exchange(
    comm: &dyn Communicator,
    mesh: &mut DistributedMesh,
    shared: &Shared,
) -> Result<()> {
    let mut wanted = Vec::new();
    for simplex in 0..mesh.simplex_count() {
        let start = wanted.len();
        for &vertex in mesh.simplex(simplex) {
            shared.of(vertex).try_for_each(|rank| wanted.try_push((rank, simplex)))?;
        }
        wanted[start..].sort_unstable();
    }
    wanted.sort_unstable();
    wanted.dedup();
    let mut messages = empty_messages(comm.size())?;
    for group in wanted.chunk_by(|a, b| a.0 == b.0) {
        messages[group[0].0 as usize] = message(mesh, group)?;
    }
    drop(wanted);
    let messages = comm.all_to_all(messages)?;
    Received::read(mesh.dim, &messages)?.add_to(mesh)
}

/// Returns a message of the vertices of some simplices, then the simplices.
fn message(mesh: &DistributedMesh, simplices: &[(u32, usize)]) -> Result<Vec<u8>> {
    let mut vertices = with_capacity(simplices.len() * (mesh.dim + 1))?;
    simplices.iter().for_each(|(_, simplex)| vertices.extend(mesh.simplex(*simplex)));
    vertices.sort_unstable();
    vertices.dedup();
    let mut bytes = Vec::new();
    append(&mut bytes, &[vertices.len() as u64])?;
    for &vertex in &vertices {
        let at = vertex as usize;
        let owner_and_kind = u64::from(mesh.vertex_owners[at]) << 8 | u64::from(mesh.kinds[at]);
        let (domain, cage) = (mesh.vertex_domains[at], mesh.vertex_cages[at]);
        append(&mut bytes, &[mesh.vertex_ids[at], owner_and_kind, domain, cage])?;
        mesh.point(vertex).iter().try_for_each(|x| append(&mut bytes, &[x.to_bits()]))?;
    }
    for (_, simplex) in simplices {
        append(&mut bytes, &[mesh.first_simplex + *simplex as u64])?;
        for vertex in mesh.simplex(*simplex) {
            let at = vertices.binary_search(vertex).map_err(|_| defect("a vertex is lost"))?;
            append(&mut bytes, &[at as u64])?;
        }
    }
    Ok(bytes)
}

/// Vertices and simplices that others have sent.
struct Received {
    vertices: Vec<Vertex>,
    /// Ghosts, and where the ids of their vertices begin in `vertex_ids`.
    ghosts: Vec<(Ghost, usize)>,
    vertex_ids: Vec<u64>,
}

#[derive(Clone, Copy)]
struct Vertex {
    id: u64,
    owner: u32,
    kind: u8,
    domain: u64,
    cage: u64,
    point: [f64; netmesh::mesh::MAX_DIM],
}

impl Received {
    fn read(dim: usize, messages: &[Vec<u8>]) -> Result<Self> {
        let mut received =
            Self { vertices: Vec::new(), ghosts: Vec::new(), vertex_ids: Vec::new() };
        for (rank, message) in messages.iter().enumerate().filter(|(_, bytes)| !bytes.is_empty()) {
            let mut words = Words::new(message);
            let first = received.vertices.len();
            for _ in 0..words.next()? {
                received.vertices.try_push(Vertex::read(dim, &mut words)?)?;
            }
            while !words.is_empty() {
                let ghost = Ghost { id: words.next()?, owner: rank as u32 };
                received.ghosts.try_push((ghost, received.vertex_ids.len()))?;
                for _ in 0..=dim {
                    let at = first + words.next()? as usize;
                    let vertex = received.vertices.get(at);
                    let vertex = vertex.ok_or_else(|| defect("a vertex is missing"))?;
                    received.vertex_ids.try_push(vertex.id)?;
                }
            }
        }
        Ok(received)
    }

    fn add_to(mut self, mesh: &mut DistributedMesh) -> Result<()> {
        let own = copied(&mesh.vertex_ids)?;
        self.vertices.sort_unstable_by_key(|vertex| vertex.id);
        self.vertices.dedup_by_key(|vertex| vertex.id);
        self.vertices.retain(|vertex| own.binary_search(&vertex.id).is_err());
        for vertex in &self.vertices {
            mesh.vertex_ids.try_push(vertex.id)?;
            mesh.vertex_owners.try_push(vertex.owner)?;
            mesh.kinds.try_push(vertex.kind)?;
            mesh.vertex_domains.try_push(vertex.domain)?;
            mesh.vertex_cages.try_push(vertex.cage)?;
            mesh.points.try_extend(&vertex.point[..mesh.dim])?;
        }
        let index = |id: &u64| match own.binary_search(id) {
            Ok(at) => Ok(at as u32),
            Err(_) => match self.vertices.binary_search_by_key(id, |vertex| vertex.id) {
                Ok(at) => Ok((own.len() + at) as u32),
                Err(_) => Err(defect("a vertex is missing")),
            },
        };
        self.ghosts.sort_unstable_by_key(|(ghost, _)| ghost.id);
        mesh.ghosts = collected(self.ghosts.iter().map(|(ghost, _)| *ghost))?;
        for (_, start) in &self.ghosts {
            let vertex_ids = &self.vertex_ids[*start..][..=mesh.dim];
            for id in vertex_ids {
                mesh.ghost_simplices.try_push(index(id)?)?;
            }
        }
        Ok(())
    }
}

impl Vertex {
    fn read(dim: usize, words: &mut Words<'_>) -> Result<Self> {
        let (id, owner_and_kind) = (words.next()?, words.next()?);
        let (domain, cage) = (words.next()?, words.next()?);
        let mut point = [0.0; netmesh::mesh::MAX_DIM];
        for x in &mut point[..dim] {
            *x = f64::from_bits(words.next()?);
        }
        Ok(Self {
            id,
            owner: (owner_and_kind >> 8) as u32,
            kind: owner_and_kind as u8,
            domain,
            cage,
            point,
        })
    }
}

/// Names what is across the facets between this rank and others.
pub fn cross(mesh: &mut DistributedMesh, crossings: &[Crossing]) -> Result<()> {
    let size = mesh.dim + 1;
    mesh.interface = with_capacity(crossings.len())?;
    for crossing in crossings {
        let ghost = mesh.ghosts.binary_search_by_key(&crossing.other, |ghost| ghost.id);
        let ghost = ghost.map_err(|_| defect("a neighbour that is no ghost"))?;
        if mesh.ghosts[ghost].owner != crossing.rank {
            return Err(defect("a neighbour of two ranks"));
        }
        mesh.neighbors[crossing.slot] = crossing.other;
        let (simplex, facet) = (crossing.slot / size, (crossing.slot % size) as u32);
        mesh.interface.push(InterfaceFacet { simplex, facet, ghost });
    }
    Ok(())
}
