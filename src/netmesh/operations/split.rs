//! Splits of the boundary: a vertex goes on a line, or into a facet.

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::state::Mesher;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::netmesh::state::segments::chain::Fraction;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Splits `subsegment` at a place of its line, where `x` is; false if a vertex is there.
    pub(super) fn split_line_at(
        &mut self,
        subsegment: u32,
        place: Fraction,
        x: [f64; D],
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let a = self.state.segments.chains.get(subsegment).ends[0];
        let near = self.state.delaunay.complex().incident(a);
        if self.state.delaunay.vertex_at(near, &x).is_some() {
            return Ok(false);
        }
        let Some(start) = self.state.delaunay.locate(near, &x) else { return Ok(false) };
        self.state.delaunay.find_cavity(start, &x, cavity)?;
        let domain = self.enter_from_segment(&x, cavity)?;
        let vertex = self.state.add_vertex(x)?;
        self.state.stats.segment_points += 1;
        self.state.hierarchy.set_domain(vertex, domain);
        let second = self.state.segments.chains.len() as u32;
        self.state.segments.chains.split(subsegment, vertex, place)?;
        if let Some(state) = self.state.in_space() {
            state.split_in_sheets(subsegment, second, vertex)?;
        }
        self.insert_into_cavity(vertex, cavity)?;
        self.refuse_crowding(vertex)?;
        Ok(true)
    }

    /// Splits a facet at `x`, which has this cavity, and is in a subfacet or near one; false if it
    /// is beyond a subsegment, or beyond the facet.
    pub(super) fn split_facet_at(
        &mut self,
        subfacet: u32,
        x: &[f64; 3],
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let facets = &self.state.facets;
        if !facets.is_in_box(facets.get(subfacet).facet, x) {
            return Ok(false);
        }
        let place: [f64; D] = std::array::from_fn(|axis| x[axis]);
        let domain = self.enter_from_segment(&place, cavity)?;
        let vertex = self.state.add_vertex(place)?;
        self.state.hierarchy.set_domain(vertex, domain);
        let Some(state) = self.state.in_space() else { return Ok(false) };
        if !state.put_in_sheet(subfacet, vertex)? {
            state.removed.try_push(vertex)?;
            return Ok(false);
        }
        self.state.stats.segment_points += 1;
        self.insert_into_cavity(vertex, cavity)?;
        self.refuse_crowding(vertex)?;
        Ok(true)
    }

    /// Releases all cages that `x`, which is on a segment, is too close to from either side.
    /// Returns the innermost domain that then holds it.
    pub(in crate::netmesh) fn enter_from_segment(
        &mut self,
        x: &[f64; D],
        cavity: &Cavity,
    ) -> AllocResult<DomainId> {
        let mut domain = self.enter(x, cavity)?;
        while let Some(encroached) = self.state.inner_encroached_from(domain, x) {
            self.release_cage(encroached)?;
            domain = self.state.hierarchy.find(domain);
        }
        debug_assert!(domain == ROOT || self.state.hierarchy.contains(domain, x));
        Ok(domain)
    }
}
