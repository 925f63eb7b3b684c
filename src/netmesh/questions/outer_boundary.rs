//! The boundary outside of a domain, which must be far from its cage: a vertex of the cage that is
//! in a facet would have no place in the mesh, and one beside it makes the facet be split down to
//! the size of the cage, which is what a cage is there to spare.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::state::facets::faces::{EDGES, FACES};
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::{distance_to_edge, distance_to_triangle};

impl Mesher<'_, '_, 3> {
    /// Returns true if a subsegment or subfacet that is not wholly in a domain is so near to its
    /// centre that a vertex there would encroach the domain. All of the boundary is recovered; the
    /// simplex `start` has a place on the cage sphere.
    ///
    /// The search goes through the simplices that are so near, but for those between vertices of
    /// the domain: these are in its convex hull, and what is left of the ball is connected.
    pub(in crate::netmesh) fn is_near_outer_boundary(
        &mut self,
        domain: DomainId,
        start: SimplexId,
    ) -> Result<bool> {
        let (reach, center) =
            (self.state.outer_reach(domain), self.state.hierarchy.node(domain).point);
        let mut reached: Vec<SimplexId> = Vec::new();
        reached.try_push(start)?;
        self.state.delaunay.begin_marks()?;
        self.state.delaunay.mark(start)?;
        while let Some(simplex) = reached.pop() {
            self.watch.poll_after(4)?;
            if self.state.is_passed_over(simplex, domain) {
                continue;
            }
            if self.state.has_outer_boundary(simplex, domain, reach) {
                return Ok(true);
            }
            for (index, face) in FACES.iter().enumerate() {
                let complex = self.state.delaunay.complex();
                let beyond = complex.neighbors(simplex)[index];
                let face = face.map(|at| complex.vertices(simplex)[at]);
                if !complex.is_inside(beyond)
                    && distance_to_triangle(&center, self.state.points_of(face)) < reach
                {
                    self.state.delaunay.mark(beyond)?;
                    reached.try_push(beyond)?;
                }
            }
        }
        Ok(false)
    }
}

impl State<3> {
    /// Returns true if a simplex has nothing outside of a domain that could be near: all its
    /// vertices are in the domain, or it is infinite.
    fn is_passed_over(&self, simplex: SimplexId, domain: DomainId) -> bool {
        let complex = self.delaunay.complex();
        let is_own = |&vertex| self.hierarchy.contains(domain, self.delaunay.point(vertex));
        complex.is_infinite(simplex) || complex.vertices(simplex).iter().all(is_own)
    }

    /// Returns true if an edge or face of a simplex is a part of the boundary that is not wholly in
    /// a domain, and nearer to its centre than `reach`.
    fn has_outer_boundary(&self, simplex: SimplexId, domain: DomainId, reach: f64) -> bool {
        let vertices = self.delaunay.complex().vertices(simplex);
        let center = &self.hierarchy.node(domain).point;
        let is_outside =
            |&at: &usize| !self.hierarchy.contains(domain, self.delaunay.point(vertices[at]));
        let is_near_line = |edge: &[usize; 2]| {
            let [a, b] = edge.map(|at| vertices[at]);
            self.segments.chains.edge_between(a, b).is_some()
                && edge.iter().any(is_outside)
                && distance_to_edge(center, [a, b].map(|end| self.delaunay.point(end))) < reach
        };
        let is_near_facet = |face: &[usize; 3]| {
            let corners = face.map(|at| vertices[at]);
            self.facets.face(&corners).is_some()
                && face.iter().any(is_outside)
                && distance_to_triangle(center, self.points_of(corners)) < reach
        };
        EDGES.iter().any(is_near_line) || FACES.iter().any(is_near_facet)
    }
}
