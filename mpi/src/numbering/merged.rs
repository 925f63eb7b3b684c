//! The pieces of a rank as one, with every vertex once.

use super::defect;
use crate::piece::{self, Piece, PieceDomain};
use crate::words::distinct;
use netmesh::Result;
use netmesh::distributed::memory::{TryGrow, filled, with_capacity};

/// Value for nothing across a facet: the hull of the whole mesh.
pub const HULL: u64 = u64::MAX;

/// Value for another piece across a facet, not yet known which.
pub const OPEN: u64 = u64::MAX - 1;

#[derive(Default)]
pub struct Merged {
    pub dim: usize,
    /// Names of the vertices, rising, so inputs come first; by vertex, as `points` and the arrays
    /// after it.
    pub names: Vec<u64>,
    pub points: Vec<f64>,
    pub kinds: Vec<u8>,
    /// Names of domains.
    pub vertex_domains: Vec<u64>,
    pub vertex_cages: Vec<u64>,
    /// Piece after piece.
    pub simplices: Vec<u32>,
    /// Simplices of this rank, [`HULL`] or [`OPEN`].
    pub neighbors: Vec<u64>,
    /// The names of all domains that are named, rising.
    pub domains: Vec<u64>,
    /// Domains that pieces know, each once or more.
    pub copies: Vec<PieceDomain>,
}

impl Merged {
    pub fn new(dim: usize, pieces: Vec<Piece>) -> Result<Self> {
        let vertices = pieces.iter().map(Piece::vertex_count).sum();
        let mut names = with_capacity(vertices)?;
        pieces.iter().for_each(|piece| names.extend_from_slice(&piece.names));
        names.sort_unstable();
        names.dedup();
        let entries = pieces.iter().map(|piece| piece.simplices.len()).sum();
        let mut merged = Self {
            dim,
            points: filled(names.len() * dim, f64::NAN)?,
            kinds: filled(names.len(), 0)?,
            vertex_domains: filled(names.len(), u64::MAX)?,
            vertex_cages: filled(names.len(), u64::MAX)?,
            simplices: with_capacity(entries)?,
            neighbors: with_capacity(entries)?,
            domains: Vec::new(),
            copies: Vec::new(),
            names,
        };
        // Each piece goes as soon as it is taken over.
        pieces.into_iter().try_for_each(|piece| merged.add(&piece))?;
        merged.domains = merged.domain_names()?;
        Ok(merged)
    }

    /// Returns the names of all domains. A label or a parent may be a domain of which the rank
    /// knows nothing else.
    fn domain_names(&self) -> Result<Vec<u64>> {
        let of_copies = self.copies.iter().flat_map(|copy| [Some(copy.name), copy.parent]);
        let of_vertices = self.vertex_domains.iter().chain(&self.vertex_cages).copied();
        distinct(of_vertices.chain(of_copies.flatten()))
    }

    fn add(&mut self, piece: &Piece) -> Result<()> {
        let (dim, first) = (self.dim, self.simplex_count() as u64);
        if piece.dim != dim || piece.neighbors.len() != piece.simplices.len() {
            return Err(defect("a piece's arrays do not fit together"));
        }
        let mut vertices = with_capacity(piece.names.len())?;
        for (local, name) in piece.names.iter().enumerate() {
            let vertex = self.names.binary_search(name).map_err(|_| defect("a name is lost"))?;
            let point = &mut self.points[vertex * dim..][..dim];
            let is_new = point[0].is_nan();
            if !is_new && *point != *piece.point(local) {
                return Err(defect("two pieces have a vertex at different places"));
            }
            point.copy_from_slice(piece.point(local));
            self.kinds[vertex] = piece.kinds[local];
            self.vertex_domains[vertex] = piece.vertex_domains[local];
            self.vertex_cages[vertex] = piece.vertex_cages[local];
            vertices.push(vertex as u32);
        }
        self.simplices.extend(piece.simplices.iter().map(|&local| vertices[local as usize]));
        self.neighbors.extend(piece.neighbors.iter().map(|&neighbor| match neighbor {
            piece::HULL => HULL,
            piece::INTERFACE => OPEN,
            neighbor => first + u64::from(neighbor),
        }));
        Ok(self.copies.try_extend(&piece.domains)?)
    }

    pub fn simplex_count(&self) -> usize {
        self.simplices.len() / (self.dim + 1)
    }

    /// Returns the vertices of the facet at a position of `neighbors`, rising; as many as the
    /// dimension.
    pub fn facet(&self, slot: usize) -> [u32; netmesh::mesh::MAX_DIM] {
        let size = self.dim + 1;
        let simplex = &self.simplices[slot / size * size..][..size];
        let mut vertices = [u32::MAX; netmesh::mesh::MAX_DIM];
        let others = simplex.iter().enumerate().filter(|(at, _)| *at != slot % size);
        vertices.iter_mut().zip(others).for_each(|(vertex, (_, other))| *vertex = *other);
        vertices[..self.dim].sort_unstable();
        vertices
    }
}
