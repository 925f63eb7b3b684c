//! The subsegments and subfacets around a point that is to go into a mesh of space. One that is a
//! part of the mesh stays one unless all simplices at it are in the cavity: then the point *crosses*
//! it. A point *encroaches* it if it is in the smallest ball through its vertices.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::state::State;
use crate::netmesh::state::facets::faces::{EDGES, FACES};
use crate::numerics::in_diametral_ball;

impl State<3> {
    /// Finds the subsegments and subfacets of the simplices in `cavity`, and which of them a point
    /// with that cavity crosses.
    pub(in crate::netmesh) fn find_boundary_in(&mut self, cavity: &Cavity) -> AllocResult<()> {
        let Self { delaunay, segments, facets, .. } = self;
        let mut near = std::mem::take(&mut facets.near);
        near.clear();
        let complex = delaunay.complex();
        for (at, &simplex) in cavity.simplices.iter().enumerate() {
            let vertices = complex.vertices(simplex);
            let on: [bool; 4] = std::array::from_fn(|i| {
                segments.chains.holds(vertices[i]) || facets.holds(vertices[i])
            });
            if on.iter().filter(|&&on| on).count() < 2 {
                continue;
            }
            for [i, j] in EDGES {
                if on[i] && on[j] {
                    if let Some(subsegment) = segments.chains.edge_between(vertices[i], vertices[j])
                    {
                        if !near.subsegments.iter().any(|&(other, _)| other == subsegment) {
                            near.subsegments.try_push((subsegment, true))?;
                        }
                    }
                }
            }
            let first = cavity.starts[at] as usize;
            let last =
                cavity.starts.get(at + 1).map_or(cavity.boundary.len(), |&next| next as usize);
            let outer = &cavity.boundary[first..last];
            for (index, face) in FACES.iter().enumerate() {
                let Some(subfacet) = facets.face(&face.map(|i| vertices[i])) else { continue };
                let is_crossed = !outer.iter().any(|facet| facet.index as usize == index);
                if !near.subfacets.iter().any(|&(other, _)| other == subfacet) {
                    near.subfacets.try_push((subfacet, is_crossed))?;
                }
            }
        }
        for (subsegment, is_crossed) in &mut near.subsegments {
            let ends = segments.chains.get(*subsegment).ends;
            *is_crossed = !cavity.boundary.iter().any(|facet| {
                let vertices = complex.vertices(facet.simplex);
                let opposite = vertices[facet.index as usize];
                ends.iter().all(|&end| end != opposite && vertices.contains(&end))
            });
        }
        self.facets.near = near;
        Ok(())
    }

    /// Notes that a vertex goes in with `cavity`: what it crosses is queued. Regions stay known where
    /// it crosses nothing and nothing waits.
    pub(super) fn note_insertion_near_facets(&mut self, cavity: &Cavity) -> AllocResult<()> {
        self.find_boundary_in(cavity)?;
        let near = std::mem::take(&mut self.facets.near);
        let mut is_any = false;
        for &(subsegment, _) in near.subsegments.iter().filter(|&&(_, is_crossed)| is_crossed) {
            is_any = true;
            self.segments.chains.wait_although_limited(subsegment)?;
        }
        for &(subfacet, _) in near.subfacets.iter().filter(|&&(_, is_crossed)| is_crossed) {
            is_any = true;
            self.queue_subfacet(subfacet)?;
        }
        self.facets.near = near;
        let is_waiting = self.segments.chains.waiting_count() + self.facets.waiting_count() > 0;
        self.segments.regions.note_insertion(cavity, is_any || is_waiting)
    }

    /// Finds the subsegments and subfacets that a point with `cavity` would encroach or cross, and
    /// returns true if there are any. [`NearBoundary`] has them, the others are gone from it.
    ///
    /// [`NearBoundary`]: crate::netmesh::state::facets::NearBoundary
    pub(in crate::netmesh) fn find_encroached_in_space(
        &mut self,
        x: &[f64; 3],
        cavity: &Cavity,
    ) -> AllocResult<bool> {
        self.find_boundary_in(cavity)?;
        let mut near = std::mem::take(&mut self.facets.near);
        near.subsegments.retain(|&(subsegment, is_crossed)| {
            let [a, b] = self.segments.chains.get(subsegment).ends;
            let [a, b] = [a, b].map(|end: VertexId| self.delaunay.point(end));
            is_crossed || in_diametral_ball(a, b, x).is_positive()
        });
        near.subfacets
            .retain(|&(subfacet, is_crossed)| is_crossed || self.is_in_circle(subfacet, x));
        let is_any = !near.is_empty();
        self.facets.near = near;
        Ok(is_any)
    }
}
