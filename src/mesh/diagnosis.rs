//! Diagnosis of facets in space: where they are no closed surface, and where they meet though they
//! must not.

use super::{Intersection, IntersectionKind};

/// All that keeps facets from being a closed surface that a mesh can conform to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagnosis {
    /// Edges that are not one of two facets that run through them in opposite directions, sorted.
    pub edges: Vec<OddEdge>,
    /// Pairs that meet and facets without an area, as [`super::Mesh::intersections`] has them.
    pub intersections: Vec<Intersection>,
    /// Number of triangles with the vertices of an earlier one, or of polygons with its loops,
    /// whatever their order, where they begin and the way round that they run.
    pub duplicates: usize,
}

/// Edge of facets that is not between two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OddEdge {
    /// First inputs at its ends, the smaller one first.
    pub inputs: [u32; 2],
    /// Number of facets, or of triangles of them, that have the edge.
    pub facets: u32,
    /// Fault of the edge.
    pub fault: EdgeFault,
}

/// Fault of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EdgeFault {
    /// One facet ends there: the surface has a hole.
    Open,
    /// Three or more facets meet there.
    Crowded,
    /// Two facets run through it in one direction: their normals point to different sides.
    Turned,
}

impl Diagnosis {
    /// Returns the number of edges with a fault.
    pub fn edges_with(&self, fault: EdgeFault) -> usize {
        self.edges.iter().filter(|edge| edge.fault == fault).count()
    }

    /// Returns the number of pairs that meet in a way, or of facets without an area.
    pub fn intersections_of(&self, kind: IntersectionKind) -> usize {
        self.intersections.iter().filter(|found| found.kind == kind).count()
    }
}
