//! The boundary in a mesh that conforms to facets and segments of space: no change takes a subfacet
//! or a subsegment from the mesh. A subsegment or subfacet need not be Gabriel for that.

use crate::complex::{SimplexId, VertexId};
use crate::netmesh::slivers::cone::Cone;
use crate::netmesh::slivers::view::View;
use crate::netmesh::state::State;
use crate::netmesh::state::facets::faces::{EDGES, FACES};

impl State<3> {
    /// Returns true if `vertex` is on a segment or a facet.
    pub(super) fn is_on_boundary(&self, vertex: VertexId) -> bool {
        self.segments.chains.holds(vertex) || self.facets.holds(vertex)
    }
}

impl View<'_> {
    /// Returns true if the subsegments and subfacets of `destroyed` simplices stay in the mesh, as
    /// edges and faces of the `cone` that comes in their place.
    pub fn keeps_boundary(&self, destroyed: &[SimplexId], cone: &Cone) -> bool {
        let complex = self.delaunay.complex();
        !self.has_boundary
            || destroyed.iter().all(|&simplex| {
                let vertices = complex.vertices(simplex);
                let on: [bool; 4] = std::array::from_fn(|at| self.is_on_boundary(vertices[at]));
                on.iter().filter(|&&on| on).count() < 2
                    || self.keeps_subsegments_of(vertices, on, cone)
                        && self.keeps_subfacets_of(vertices, on, cone)
            })
    }

    fn is_on_boundary(&self, vertex: VertexId) -> bool {
        self.chains.holds(vertex) || self.facets.holds(vertex)
    }

    fn keeps_subsegments_of(&self, vertices: &[VertexId], on: [bool; 4], cone: &Cone) -> bool {
        EDGES.iter().filter(|edge| edge.iter().all(|&at| on[at])).all(|edge| {
            let ends = edge.map(|at| vertices[at]);
            self.chains.edge_between(ends[0], ends[1]).is_none() || cone.has(&ends)
        })
    }

    fn keeps_subfacets_of(&self, vertices: &[VertexId], on: [bool; 4], cone: &Cone) -> bool {
        FACES.iter().filter(|face| face.iter().all(|&at| on[at])).all(|face| {
            let face = face.map(|at| vertices[at]);
            self.facets.face(&face).is_none() || cone.has(&face)
        })
    }
}
