//! Pieces of the mesh that the algorithm leaves on a rank, which fit together by the names of their
//! vertices. Plain data.

/// Value for no simplex across a facet: the hull of the whole mesh.
pub const HULL: u32 = u32::MAX;

/// Across a facet is another piece, of this rank or of another.
pub const INTERFACE: u32 = u32::MAX - 1;

/// The vertex is in no cage.
pub const NO_DOMAIN: u64 = u64::MAX;

/// The names of vertices that are no inputs have this bit.
pub const ADDED: u64 = 1 << 63;

/// Simplices that no other piece has, with their vertices.
///
/// The name of a vertex is the same in all pieces that have it: for an input its index among the
/// inputs of all ranks, of equal ones the least; for others [`ADDED`] and what tells them apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Piece {
    pub dim: usize,
    /// Name of each local vertex.
    pub names: Vec<u64>,
    /// Coordinates of the local vertices: `vertices x dim`.
    pub points: Vec<f64>,
    /// Kind of each local vertex, a value of [`netmesh::VertexKind`].
    pub kinds: Vec<u8>,
    /// Vertices of the simplices: `simplices x (dim + 1)` local ones, positively oriented.
    pub simplices: Vec<u32>,
    /// Neighbours of the simplices: `simplices x (dim + 1)` local ones, the i-th opposite vertex i;
    /// [`HULL`] or [`INTERFACE`].
    pub neighbors: Vec<u32>,
    /// Domains that the piece knows, of which other pieces may know more.
    pub domains: Vec<PieceDomain>,
    /// Name of the innermost domain that holds each local vertex.
    pub vertex_domains: Vec<u64>,
    /// Name of the domain whose cage each local vertex is part of, or [`NO_DOMAIN`].
    pub vertex_cages: Vec<u64>,
}

/// A domain of the hierarchy; its name is the same in all pieces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceDomain {
    /// The name of the vertex at its centre.
    pub center: u64,
    /// The name of the enclosing domain, `None` for the root.
    pub parent: Option<u64>,
    pub name: u64,
    /// Version of the domain: of all that pieces know of it, what has the highest version holds.
    pub version: u64,
    pub radius: f64,
    /// Coordinates of the centre; in 2D the last is 0.
    pub position: [f64; 3],
}

impl Piece {
    pub fn vertex_count(&self) -> usize {
        self.names.len()
    }

    pub fn simplex_count(&self) -> usize {
        self.simplices.len() / (self.dim + 1)
    }

    pub fn point(&self, vertex: usize) -> &[f64] {
        &self.points[vertex * self.dim..][..self.dim]
    }
}
