//! The distance from an end of lines to the nearest vertex, line or facet of the input that does
//! not go through it: the local feature size there, but for the lines and facets at that end.

use crate::complex::{SimplexId, VertexId};
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::state::State;
use crate::netmesh::state::facets::faces::{EDGES, FACES};
use crate::numerics::{distance, distance_to_edge, distance_to_triangle};

impl State<3> {
    /// Returns the local feature size at an end of lines in a mesh that conforms to the boundary.
    /// It is searched for once for each end. The marks of earlier searches are gone.
    pub(in crate::netmesh) fn feature_size(&mut self, end: VertexId) -> AllocResult<f64> {
        if let Some(known) = self.facets.feature_size(end) {
            return Ok(known);
        }
        let size = self.search_feature(end)?;
        self.facets.set_feature_size(end, size)?;
        Ok(size)
    }

    /// Searches through the simplices that are nearer to an end than what is found so far.
    fn search_feature(&mut self, end: VertexId) -> AllocResult<f64> {
        let x = *self.delaunay.point(end);
        let mut star = std::mem::take(&mut self.facets.star);
        self.delaunay.star(end, &mut star)?;
        let mut reached: Vec<SimplexId> = Vec::new();
        reached.try_extend(&star)?;
        self.facets.star = star;
        self.delaunay.begin_marks()?;
        for &simplex in &reached {
            self.delaunay.mark(simplex)?;
        }
        let mut least = f64::INFINITY;
        while let Some(simplex) = reached.pop() {
            if self.delaunay.complex().is_infinite(simplex) {
                continue;
            }
            least = least.min(self.feature_in(simplex, end));
            for (index, face) in FACES.iter().enumerate() {
                let complex = self.delaunay.complex();
                let beyond = complex.neighbors(simplex)[index];
                let face = face.map(|at| complex.vertices(simplex)[at]);
                if !complex.is_inside(beyond)
                    && distance_to_triangle(&x, self.points_of(face)) < least
                {
                    self.delaunay.mark(beyond)?;
                    reached.try_push(beyond)?;
                }
            }
        }
        Ok(least)
    }

    /// Returns the distance from an end of lines to the nearest vertex, edge or face of a simplex
    /// that is a part of the input and of no line or facet at that end; infinite without any.
    fn feature_in(&self, simplex: SimplexId, end: VertexId) -> f64 {
        let vertices = self.delaunay.complex().vertices(simplex);
        let x = self.delaunay.point(end);
        let (chains, facets) = (&self.segments.chains, &self.facets);
        let inputs = vertices.iter().filter(|&&vertex| vertex != end && facets.is_first(vertex));
        let to_inputs = inputs.map(|&vertex| distance(x, self.delaunay.point(vertex)));
        let to_lines = EDGES.iter().filter_map(|edge| {
            let [a, b] = edge.map(|at| vertices[at]);
            let line = chains.get(chains.edge_between(a, b)?).line;
            let is_own = chains.lines[line as usize].ends.contains(&end);
            let points = [a, b].map(|vertex| self.delaunay.point(vertex));
            (!is_own).then(|| distance_to_edge(x, points))
        });
        let to_facets = FACES.iter().filter_map(|face| {
            let face = face.map(|at| vertices[at]);
            let facet = facets.get(facets.face(&face)?).facet;
            let is_own = facets.facets_at(end).contains(&facet);
            (!is_own).then(|| distance_to_triangle(x, self.points_of(face)))
        });
        to_inputs.chain(to_lines).chain(to_facets).fold(f64::INFINITY, f64::min)
    }
}
