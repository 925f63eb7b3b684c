//! Triangles that facets consist of, and those that close their holes.

/// Triangles that close holes of a surface.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HoleFilling {
    /// Three inputs for each triangle, counterclockwise where the surface's normal points to.
    pub triangles: Vec<[u32; 3]>,
    /// Marker of each triangle: that of the facets round its hole if they have one, otherwise 0.
    pub markers: Vec<i32>,
    /// Number of holes that they close.
    pub holes: usize,
    /// Number of edges at which the surface stays open.
    pub open_edges: usize,
}

/// Triangles that facets consist of, between the caller's inputs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FacetTriangulation {
    /// Three inputs for each triangle, facet by facet.
    pub triangles: Vec<[u32; 3]>,
    /// Triangle -> its facet.
    pub parents: Vec<u32>,
    /// Number of facets without an area, each of which is one triangle without one.
    pub without_area: usize,
}
