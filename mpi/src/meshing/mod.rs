//! A stand-in for the distributed algorithm: every rank makes the whole mesh and keeps its share.

use crate::comm::Communicator;
use crate::memory::{collected, copied, filled, with_capacity};
use crate::piece::{ADDED, HULL, INTERFACE, Piece, PieceDomain};
use crate::words::{bytes_of, words_of};
use netmesh::options::ProgressFn;
use netmesh::{Mesh, NONE, Options, Result, Triangulation};

/// More than one, for interfaces between pieces of one rank.
const PIECES_OF_A_RANK: usize = 3;

/// Collective: the mesh of what all ranks have; each answers its pieces. `points` of all ranks are
/// finite and of one dimension, the options equal.
pub fn mesh(
    comm: &dyn Communicator,
    dim: usize,
    points: &[f64],
    options: &Options,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Vec<Piece>> {
    let local: Vec<u64> = collected(points.iter().map(|x| x.to_bits()))?;
    let mut all = Vec::new();
    for bytes in comm.all_gather(&bytes_of(&local)?)? {
        let numbers: Vec<f64> = collected(words_of(&bytes).map(f64::from_bits))?;
        all.extend_from_slice(&numbers);
    }
    let mut mesh = Mesh::new(dim, all.len() / dim, &all, 0)?;
    mesh.run(options, progress)?;
    let names = |vertex| mesh.inputs().first_input(vertex).map_or(ADDED | vertex as u64, u64::from);
    let Some(triangulation) = mesh.triangulation() else { return Ok(Vec::new()) };
    let parts = comm.size() * PIECES_OF_A_RANK;
    let own = comm.rank() * PIECES_OF_A_RANK..(comm.rank() + 1) * PIECES_OF_A_RANK;
    own.map(|part| piece(triangulation, &names, part, parts)).collect()
}

/// The simplices of one of so many shares, in their order.
fn piece(
    mesh: &Triangulation,
    names: &dyn Fn(usize) -> u64,
    part: usize,
    parts: usize,
) -> Result<Piece> {
    let size = mesh.dim + 1;
    let (start, end) =
        (mesh.simplex_count() * part / parts, mesh.simplex_count() * (part + 1) / parts);
    let simplices = &mesh.simplices[start * size..end * size];
    let mut vertices = copied(simplices)?;
    vertices.sort_unstable();
    vertices.dedup();
    let mut local = filled(mesh.vertex_count(), NONE)?;
    vertices.iter().enumerate().for_each(|(new, &old)| local[old as usize] = new as u32);
    let mut points = with_capacity(vertices.len() * mesh.dim)?;
    vertices.iter().for_each(|&vertex| points.extend_from_slice(mesh.point(vertex)));
    let neighbors =
        mesh.neighbors[start * size..end * size].iter().map(|&neighbor| match neighbor as usize {
            _ if neighbor == NONE => HULL,
            other if (start..end).contains(&other) => (other - start) as u32,
            _ => INTERFACE,
        });
    let name_of = |vertex: u32| names(vertex as usize);
    let domains = mesh.domains.iter().enumerate().map(|(name, domain)| PieceDomain {
        center: name_of(domain.center),
        parent: (domain.parent != NONE).then(|| domain.parent.into()),
        name: name as u64,
        radius: domain.radius,
    });
    let at = |vertex: &u32| *vertex as usize;
    Ok(Piece {
        dim: mesh.dim,
        names: collected(vertices.iter().map(|&vertex| name_of(vertex)))?,
        points,
        kinds: collected(vertices.iter().map(|vertex| mesh.kinds[at(vertex)] as u8))?,
        simplices: collected(simplices.iter().map(|vertex| local[at(vertex)]))?,
        neighbors: collected(neighbors)?,
        domains: collected(domains)?,
        vertex_domains: collected(
            vertices.iter().map(|vertex| u64::from(mesh.vertex_domains[at(vertex)])),
        )?,
    })
}
