//! The subsegments and subfacets around a point that is to go into a mesh of space. One that is a
//! part of the mesh stays one unless all simplices at it are in the cavity: then the point
//! *crosses* it. A point *encroaches* it if it is in the smallest ball through its vertices.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::state::State;
use crate::netmesh::state::facets::faces::EDGES;
use crate::netmesh::state::facets::near::NearBoundary;
use crate::numerics::{distance, in_diametral_ball};

impl State<3> {
    /// Finds the subsegments and subfacets of the simplices in `cavity`, and which of them a point
    /// with that cavity crosses. Subfacets that it does not cross are left out if `only_crossed` is
    /// set.
    fn find_boundary_in(&mut self, cavity: &Cavity, only_crossed: bool) -> AllocResult<()> {
        let Self { delaunay, segments, facets, .. } = self;
        let mut near = std::mem::take(&mut facets.near);
        near.clear();
        let mut places = std::mem::take(&mut facets.places);
        places.cover(segments.chains.len(), 0)?;
        let complex = delaunay.complex();
        for (at, &simplex) in cavity.simplices.iter().enumerate() {
            let vertices = complex.vertices(simplex);
            if !segments.chains.may_have_edge(vertices) && !facets.may_have_face(vertices) {
                continue;
            }
            let first = cavity.starts[at] as usize;
            let last =
                cavity.starts.get(at + 1).map_or(cavity.boundary.len(), |&next| next as usize);
            let mut is_outer = [false; 4];
            for facet in &cavity.boundary[first..last] {
                is_outer[facet.index as usize] = true;
            }
            for (at, subsegment) in segments.chains.edges_of(vertices) {
                // The faces at an edge are opposite the other two vertices.
                let is_crossed = EDGES[5 - at].iter().all(|&opposite| !is_outer[opposite]);
                near.note_subsegment(subsegment, is_crossed, &mut places)?;
            }
            // A face inside of a whole cavity comes with the simplex on either side.
            let comes_again =
                |index: usize| cavity.is_whole && complex.neighbors(simplex)[index] < simplex;
            let is_wanted = |index: usize| match is_outer[index] {
                true => !only_crossed,
                false => !comes_again(index),
            };
            for (index, subfacet) in facets.faces_of(vertices, is_wanted) {
                near.subfacets.try_push((subfacet, !is_outer[index]))?;
            }
        }
        (facets.near, facets.places) = (near, places);
        Ok(())
    }

    /// Notes that a vertex goes in with `cavity`: what it crosses is queued. Regions stay known
    /// where it crosses nothing and nothing waits.
    pub(super) fn note_insertion_near_facets(&mut self, cavity: &Cavity) -> AllocResult<()> {
        self.find_boundary_in(cavity, true)?;
        let mut near = std::mem::take(&mut self.facets.near);
        near.retain(|&(_, is_crossed)| is_crossed, |&(_, is_crossed)| is_crossed);
        let is_any = !near.is_empty();
        for &(subsegment, _) in &near.subsegments {
            self.segments.chains.wait_although_limited(subsegment)?;
        }
        for &(subfacet, _) in &near.subfacets {
            self.queue_subfacet(subfacet)?;
        }
        self.facets.near = near;
        let is_waiting = self.segments.chains.waiting_count() + self.facets.waiting_count() > 0;
        self.segments.regions.note_insertion(cavity, is_any || is_waiting)
    }

    /// Finds the subsegments and subfacets that a point with `cavity` would encroach or cross, and
    /// returns true if there are any. [`NearBoundary`] has them, the others are gone from it. Of a
    /// cavity that is not whole what is beyond does not count: whether all simplices at a
    /// subsegment are in conflict is not known then.
    pub(in crate::netmesh) fn find_encroached_in_space(
        &mut self,
        x: &[f64; 3],
        cavity: &Cavity,
    ) -> AllocResult<bool> {
        self.find_boundary_in(cavity, false)?;
        let mut near = std::mem::take(&mut self.facets.near);
        near.retain(
            |&(subsegment, is_crossed)| {
                let [a, b] = self.segments.chains.get(subsegment).ends;
                let [a, b] = [a, b].map(|end: VertexId| self.delaunay.point(end));
                is_crossed && cavity.is_whole || in_diametral_ball(a, b, x).is_positive()
            },
            |&(subfacet, is_crossed)| is_crossed || self.is_in_circle(subfacet, x),
        );
        let is_any = !near.is_empty();
        self.facets.near = near;
        Ok(is_any)
    }

    /// Sorts what a point encroaches by how deep it is in the ball, relative to the ball's radius.
    pub(in crate::netmesh) fn sort_near_by_depth(&mut self, x: &[f64; 3]) -> AllocResult<()> {
        let mut near = std::mem::take(&mut self.facets.near);
        let NearBoundary { subsegments, subfacets, depths } = &mut near;
        sort_by_key(subsegments, depths, |subsegment| {
            let [a, b] = self.segments.chains.get(subsegment).ends;
            let [a, b] = [a, b].map(|end: VertexId| self.delaunay.point(end));
            let middle = std::array::from_fn(|k| 0.5 * a[k] + 0.5 * b[k]);
            distance(x, &middle) / distance(a, b)
        })?;
        sort_by_key(subfacets, depths, |subfacet| {
            let (center, radius) = self.circle_of(subfacet);
            distance(x, &center) / radius
        })?;
        self.facets.near = near;
        Ok(())
    }
}

/// Sorts parts of the boundary by a number that is not negative, and those with the same by their
/// own. The number of each is asked for once.
fn sort_by_key(
    parts: &mut Vec<(u32, bool)>,
    keys: &mut Vec<(u64, (u32, bool))>,
    key: impl Fn(u32) -> f64,
) -> AllocResult<()> {
    keys.clear();
    for &part in parts.iter() {
        keys.try_push((key(part.0).to_bits(), part))?;
    }
    keys.sort_unstable();
    parts.clear();
    keys.iter().try_for_each(|&(_, part)| parts.try_push(part))
}
