//! The types of ids.

use crate::memory::Id;

/// A point of the mesh, inserted or not. The first vertices are the distinct inputs, in an order of
/// locality: what is made of a mesh knows an input by the id of its vertex.
pub(crate) type VertexId = Id<Vertex>;

/// A simplex, live or dead. The id of a dead one is soon that of another.
pub(crate) type SimplexId = Id<Simplex>;

/// What a [`VertexId`] is the id of.
pub(crate) enum Vertex {}

/// What a [`SimplexId`] is the id of.
pub(crate) enum Simplex {}

impl VertexId {
    /// The vertex that closes the hull. A simplex that has it stands for the half-space beyond a
    /// facet.
    pub const INFINITE: Self = Self::NONE;
}
