//! Pieces without what making them took. A domain may have been dissolved where others did not see
//! it.

use crate::comm::{Communicator, agreed};
use crate::piece::{self, HULL, INTERFACE, Piece, PieceDomain};
use crate::words::{all_words, bytes_of};
use netmesh::distributed::memory::{collected, with_capacity};
use netmesh::distributed::{self, MADE, NO_DOMAIN, PlainPiece};
use netmesh::{Result, VertexKind};

/// Collective. Returns the pieces of this rank with the domains that there are in the end.
pub fn finish<const D: usize>(
    comm: &dyn Communicator,
    pieces: Vec<distributed::Piece<D>>,
) -> Result<Vec<Piece>> {
    let plain = agreed(comm, || {
        let mut plain = with_capacity(pieces.len())?;
        for piece in pieces {
            plain.push(piece.into_plain()?);
        }
        Ok(plain)
    })?;
    let own: Vec<u64> =
        collected(plain.iter().flat_map(|piece| piece.released.iter().flatten().copied()))?;
    let names = all_words(&comm.all_gather(&bytes_of(&own)?)?)?;
    let mut released: Vec<[u64; 2]> =
        collected(names.chunks_exact(2).map(|pair| [pair[0], pair[1]]))?;
    released.sort_unstable();
    released.dedup();
    agreed(comm, || {
        let mut pieces = with_capacity(plain.len())?;
        for piece in plain {
            pieces.push(finished::<D>(piece, &released)?);
        }
        Ok(pieces)
    })
}

fn finished<const D: usize>(piece: PlainPiece, released: &[[u64; 2]]) -> Result<Piece> {
    let taken_by = |mut name: u64| {
        while let Ok(at) = released.binary_search_by_key(&name, |&[name, _]| name) {
            name = released[at][1];
        }
        name
    };
    // The cage of a domain that was dissolved is a cage no more.
    let cage = |&name: &u64| match name {
        name if name != NO_DOMAIN && taken_by(name) == name => name,
        _ => piece::NO_DOMAIN,
    };
    let cages = collected(piece.cages.iter().map(cage))?;
    let kind = |(&name, &cage): (&u64, &u64)| match () {
        () if name & MADE == 0 => VertexKind::Input,
        () if cage != piece::NO_DOMAIN => VertexKind::Cage,
        () => VertexKind::Steiner,
    };
    let domains = piece.domains.iter().zip(piece.centers.chunks_exact(D));
    let living = domains.filter(|(domain, _)| taken_by(domain.name) == domain.name);
    let neighbors = piece.neighbors.iter().map(|&neighbor| match neighbor {
        distributed::HULL => HULL,
        distributed::INTERFACE => INTERFACE,
        neighbor => neighbor,
    });
    Ok(Piece {
        dim: D,
        kinds: collected(piece.names.iter().zip(&cages).map(|pair| kind(pair) as u8))?,
        neighbors: collected(neighbors)?,
        domains: collected(living.map(|(domain, center)| PieceDomain {
            center: domain.center,
            parent: (domain.parent != NO_DOMAIN).then(|| taken_by(domain.parent)),
            name: domain.name,
            version: domain.version,
            radius: domain.radius,
            position: std::array::from_fn(|axis| center.get(axis).copied().unwrap_or(0.0)),
        }))?,
        vertex_cages: cages,
        vertex_domains: collected(piece.vertex_domains.iter().map(|&name| taken_by(name)))?,
        names: piece.names,
        points: piece.points,
        simplices: piece.simplices,
    })
}
