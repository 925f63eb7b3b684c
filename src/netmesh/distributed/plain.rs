//! A piece of the finished mesh: its finite simplices, without what making it took.

use crate::error::Result;
use crate::memory::{collected, filled, with_capacity};
use crate::netmesh::distributed::names::NOTHING;
use crate::netmesh::distributed::piece::Piece;

/// Entry of a facet in [`PlainPiece::neighbors`] that is on the hull of the mesh.
pub const HULL: u32 = u32::MAX;

/// Entry of a facet in [`PlainPiece::neighbors`] beyond which another piece is, which has the same
/// facet.
pub const INTERFACE: u32 = u32::MAX - 1;

/// No domain.
pub const NO_DOMAIN: u64 = NOTHING;

/// Arrays of a piece of a mesh. Vertices and domains have names that are the same in all pieces.
pub struct PlainPiece {
    /// Vertex -> its name. That of an input is what it was called; others have bit 63.
    pub names: Vec<u64>,
    /// D coordinates each.
    pub points: Vec<f64>,
    pub is_precision_limited: Vec<bool>,
    /// Vertex -> the innermost domain that holds it, or one that was dissolved, as others know.
    pub vertex_domains: Vec<u64>,
    /// Vertex -> the domain whose cage it is part of, as others may know it, or none.
    pub cages: Vec<u64>,
    /// D + 1 vertices each, positively oriented.
    pub simplices: Vec<u32>,
    /// The simplex beyond the facet opposite each vertex, [`HULL`] or [`INTERFACE`].
    pub neighbors: Vec<u32>,
    pub domains: Vec<PlainDomain>,
    /// Their centres, D coordinates each.
    pub centers: Vec<f64>,
    /// Domains that were dissolved, and the domain that took their vertices.
    pub released: Vec<[u64; 2]>,
}

/// A domain as a piece knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlainDomain {
    pub name: u64,
    /// Version of the domain: of all that pieces say of it, the highest version holds.
    pub version: u64,
    /// The domain around it, or one that was dissolved; none for the root.
    pub parent: u64,
    /// The name of the vertex at its centre.
    pub center: u64,
    pub radius: f64,
}

impl<const D: usize> Piece<D> {
    /// Returns the finite simplices of a piece that is settled.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn into_plain(self) -> Result<PlainPiece> {
        debug_assert!(self.waiting.is_empty() && self.outer.is_empty());
        let is_finite = |simplex: usize| !self.vertices_of(simplex).contains(&u32::MAX);
        let mut ids = filled(self.simplex_count(), HULL)?;
        let finite = || (0..self.simplex_count()).filter(|&simplex| is_finite(simplex));
        let mut count = 0;
        for simplex in finite() {
            ids[simplex] = count;
            count += 1;
        }
        let mut simplices = with_capacity(count as usize * Self::PER_SIMPLEX)?;
        let mut neighbors = with_capacity(count as usize * Self::PER_SIMPLEX)?;
        for simplex in finite() {
            simplices.extend_from_slice(self.vertices_of(simplex));
            neighbors.extend(self.neighbors_of(simplex).iter().map(|&neighbor| {
                match neighbor as usize == simplex {
                    true => INTERFACE,
                    false => ids[neighbor as usize],
                }
            }));
        }
        let vertices = &self.vertices;
        let mut points = with_capacity(D * vertices.len())?;
        vertices.iter().for_each(|vertex| points.extend_from_slice(&vertex.point));
        let mut centers = with_capacity(D * self.domains.len())?;
        self.domains.iter().for_each(|domain| centers.extend_from_slice(&domain.point));
        Ok(PlainPiece {
            names: collected(vertices.iter().map(|vertex| vertex.name))?,
            points,
            is_precision_limited: collected(
                vertices.iter().map(|vertex| vertex.is_precision_limited),
            )?,
            vertex_domains: collected(vertices.iter().map(|vertex| vertex.domain))?,
            cages: collected(vertices.iter().map(|vertex| vertex.cage))?,
            simplices,
            neighbors,
            domains: collected(self.domains.iter().map(|domain| PlainDomain {
                name: domain.name,
                version: domain.version,
                parent: domain.parent,
                center: domain.center,
                radius: domain.radius,
            }))?,
            centers,
            released: self.released,
        })
    }
}
