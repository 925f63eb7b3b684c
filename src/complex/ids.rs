//! Types of the ids of vertices and simplices.

use crate::memory::Id;

/// Id of a point of the mesh, inserted or not. The first vertices are the distinct inputs in an
/// order of locality; arrays made of a mesh refer to an input by the id of its vertex.
pub(crate) type VertexId = Id<Vertex>;

/// Id of a simplex, live or dead. The id of a dead simplex is soon reused for another.
pub(crate) type SimplexId = Id<Simplex>;

/// Type parameter that makes an [`Id`] a [`VertexId`].
pub(crate) enum Vertex {}

/// Type parameter that makes an [`Id`] a [`SimplexId`].
pub(crate) enum Simplex {}

impl VertexId {
    /// Vertex at infinity, which closes the hull. A simplex that has it stands for the half-space
    /// beyond a facet.
    pub const INFINITE: Self = Self::NONE;
}
