//! From pieces to a rank's part of the mesh: ids in the whole mesh, what lies across interfaces,
//! ghosts, domains.
//!
//! Ranks find each other through a directory: what two ranks have in common goes to a rank that its
//! names alone choose, which tells both. Only what lies at interfaces between ranks goes there; the
//! numbers of vertices that are no inputs follow from all their names in order.

mod directory;
mod domains;
mod facets;
mod ghosts;
mod merged;
mod names;

use crate::comm::Communicator;
use crate::comm::Operation;
use crate::distributed::{DistributedMesh, NO_ID, Totals};
use crate::piece::{ADDED, Piece};
use directory::Shared;
use merged::Merged;
use netmesh::distributed::memory::{collected, copied, with_capacity};
use netmesh::{Error, ErrorKind, Result};

/// Collective. Makes the part of this rank. `inputs` are those that it has given.
pub fn number(
    comm: &dyn Communicator,
    dim: usize,
    inputs: &[f64],
    pieces: Vec<Piece>,
) -> Result<DistributedMesh> {
    let (first_input, input_count) = comm.exclusive_sum((inputs.len() / dim) as u64)?;
    let (_, piece_count) = comm.exclusive_sum(pieces.len() as u64)?;
    let mut merged = Merged::new(dim, pieces)?;
    let (first_simplex, simplex_count) = comm.exclusive_sum(merged.simplex_count() as u64)?;
    let open = facets::join_own(&mut merged)?;
    let crossings = directory::join_facets(comm, &merged, &open, first_simplex)?;
    let shared = Shared::find(comm, &merged, &open)?;

    let added = merged.names.partition_point(|name| name & ADDED == 0);
    let added_names = domains::with_centers(&merged.names[added..], &merged.copies)?;
    let (added_ids, added_count) = names::number(comm, &added_names)?;
    let (domain_ids, domain_count) = names::number(comm, &merged.domains)?;
    let vertex_id = |name: u64| match added_names.binary_search(&name) {
        Ok(index) if name & ADDED != 0 => input_count + added_ids[index],
        _ => name,
    };
    let vertex_ids = collected(merged.names.iter().map(|&name| vertex_id(name)))?;
    let owners = shared.owners(comm.rank() as u32, merged.names.len())?;
    let own = |vertices: std::ops::Range<usize>| {
        owners[vertices].iter().filter(|&&owner| owner == comm.rank() as u32).count() as u64
    };
    let mut owned = [own(0..added), own(added..merged.names.len())];
    comm.all_reduce_integers(&mut owned, Operation::Sum)?;
    if owned[1] != added_count || owned[0] > input_count {
        return Err(defect("vertices at interfaces have no single owner"));
    }
    let domain_id = |name: u64| match merged.domains.binary_search(&name) {
        Ok(index) => domain_ids[index],
        Err(_) => NO_ID,
    };
    let copies = merged.copies.iter().map(|copy| domains::record(copy, domain_id, vertex_id));
    let copies = collected(copies)?;
    let mut mesh = DistributedMesh {
        dim,
        rank: comm.rank(),
        ranks: comm.size(),
        totals: Totals {
            inputs: input_count,
            duplicates: input_count - owned[0],
            vertices: owned[0] + owned[1],
            vertex_ids: input_count + added_count,
            simplices: simplex_count,
            domains: domain_count,
            pieces: piece_count,
        },
        first_input,
        inputs: copied(inputs)?,
        own_vertices: vertex_ids.len(),
        vertex_ids,
        vertex_owners: owners,
        vertex_domains: collected(merged.vertex_domains.iter().map(|&name| domain_id(name)))?,
        vertex_cages: collected(merged.vertex_cages.iter().map(|&name| domain_id(name)))?,
        first_simplex,
        neighbors: with_capacity(merged.neighbors.len())?,
        ..DistributedMesh::default()
    };
    mesh.neighbors.extend(merged.neighbors.iter().map(|&neighbor| match neighbor {
        // What is across an interface between ranks is told below.
        merged::HULL | merged::OPEN => NO_ID,
        neighbor => first_simplex + neighbor,
    }));
    Merged { points: mesh.points, kinds: mesh.kinds, simplices: mesh.simplices, .. } = merged;
    ghosts::exchange(comm, &mut mesh, &shared)?;
    ghosts::cross(&mut mesh, &crossings)?;
    domains::exchange(comm, &mut mesh, &copies)?;
    mesh.bytes_sent = comm.bytes_sent();
    Ok(mesh)
}

/// Returns the error of pieces that do not fit together.
fn defect(what: &str) -> Error {
    Error::new(ErrorKind::Panic, format!("internal error: {what}; please report it"))
}
