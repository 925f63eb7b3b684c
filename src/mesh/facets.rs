//! Facets in space: polygons between inputs, and the triangles of a surface.

/// Facets as the caller gave them. A facet has one or more loops of inputs; a point of its plane is
/// in it if a ray from there crosses its loops an odd number of times. A loop of two inputs is a
/// segment in the facet, a loop of one input a vertex in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Facets {
    /// Facet -> its first loop, then the number of loops. Empty without facets.
    pub loop_starts: Vec<u32>,
    /// Loop -> its first input among `inputs`, then the number of those. Empty without facets.
    pub input_starts: Vec<u32>,
    /// Inputs of the loops, in the caller's numbers.
    pub inputs: Vec<u32>,
    /// Number that the caller gave each facet.
    pub markers: Vec<i32>,
    /// True if the facets are the triangles of a surface. Those that share an edge, lie in one plane
    /// and have one marker are one facet of the mesh.
    pub are_triangles: bool,
}

impl Facets {
    /// Returns the number of facets.
    pub fn count(&self) -> usize {
        self.markers.len()
    }

    /// Returns the loops of a facet.
    pub fn loops(&self, facet: usize) -> impl Iterator<Item = &[u32]> + Clone {
        let [first, last] = [facet, facet + 1].map(|at| self.loop_starts[at] as usize);
        self.input_starts[first..=last]
            .windows(2)
            .map(|range| &self.inputs[range[0] as usize..range[1] as usize])
    }
}

/// Triangle of a facet: three vertices of an arrangement, counterclockwise where the normal of the
/// facet points to the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FacetTriangle {
    /// Distinct inputs.
    pub vertices: [u32; 3],
    /// Number of the facet in [`super::Arrangement::facets`].
    pub facet: u32,
}

/// Facet of an arrangement: a polygon in a plane, or triangles of the caller's that lie in one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ArrangedFacet {
    /// Facet of the caller's, the first of those that it is made of; [`NONE`](super::NONE) for a
    /// side of a hull or box.
    pub parent: u32,
    /// Number by which the winding number of what is behind the facet, where its normal does not
    /// point to, is larger than of what is before it.
    pub balance: i64,
}
