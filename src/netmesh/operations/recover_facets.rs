//! Recovery of facets: every subfacet becomes a face of the mesh, and stays one. It needs not be
//! empty of other vertices in its smallest ball, as a Gabriel face is: a face of the Delaunay
//! triangulation is enough, and needs far fewer vertices.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;
use crate::netmesh::questions::subfacets::OnSheet;
use crate::netmesh::state::facets::floors::Guard;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::in_diametral_ball;

/// Four vertices of a facet are on one circle, as far as a sheet has to care, if the sine of
/// [`State::diagonal`] is below this: then the mesh says which diagonal is an edge.
const COCIRCULAR: f64 = 1e-7;

/// Part of the boundary that is to be split.
#[derive(Clone, Copy)]
pub(super) enum Split {
    Subsegment(u32),
    /// A subfacet, and the place of a vertex for it.
    Subfacet(u32, [f64; 3]),
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Splits one subfacet that is no face of the mesh, or the subsegment that is in its way. False
    /// if none waits.
    pub(super) fn recover_next_subfacet(&mut self, cavity: &mut Cavity) -> Result<bool> {
        if self.state.facets.is_empty() {
            return Ok(false);
        }
        let Some(subfacet) = self.next_missing()? else { return Ok(false) };
        let Some(state) = self.state.in_space() else { return Ok(false) };
        let split = state.split_for(subfacet)?;
        let is_split = self.split_boundary(split, Guard::Open, cavity)?;
        if let Some(state) = self.state.in_space() {
            match is_split {
                // What was split may have been something in its way.
                true => state.queue_subfacet(subfacet)?,
                false => state.limit_subfacet(subfacet),
            }
        }
        Ok(true)
    }

    /// Returns the next subfacet that is no face of the mesh, after the sheets have followed the
    /// mesh where vertices are on one circle.
    fn next_missing(&mut self) -> Result<Option<u32>> {
        while let Some(subfacet) = self.state.facets.next() {
            self.watch.poll_after(8)?;
            let Some(state) = self.state.in_space() else { break };
            let vertices = state.facets.get(subfacet).vertices;
            if !state.has_face(&vertices)? && !state.follow(subfacet)? {
                return Ok(Some(subfacet));
            }
        }
        Ok(None)
    }

    /// Splits a part of the boundary; false where doubles have no room for a vertex on it, or where
    /// a subsegment would have to be split that `guard` keeps.
    pub(super) fn split_boundary(
        &mut self,
        split: Split,
        guard: Guard,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        match split {
            Split::Subsegment(subsegment) => {
                Ok(self.state.may_split(subsegment, guard)? && self.split(subsegment, cavity)?)
            }
            Split::Subfacet(subfacet, x) => self.split_subfacet(subfacet, &x, guard, cavity),
        }
    }

    /// Inserts a vertex at `x` into a facet, or splits the subsegments that it would encroach;
    /// false where doubles have no room for either, or `guard` keeps such a subsegment.
    fn split_subfacet(
        &mut self,
        subfacet: u32,
        x: &[f64; 3],
        guard: Guard,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let Some(state) = self.state.in_space() else { return Ok(false) };
        if x.iter().any(|x| !x.is_finite()) {
            return Ok(false);
        }
        if !matches!(guard, Guard::Open) && state.is_kept_by_shield(subfacet, x) {
            return Ok(false);
        }
        let near = state.facets.get(subfacet).vertices[0];
        let start = state.delaunay.complex().incident(near);
        if state.delaunay.vertex_at(start, x).is_some() {
            return Ok(false);
        }
        let Some(start) = state.delaunay.locate(start, x) else { return Ok(false) };
        state.delaunay.find_cavity(start, x, cavity)?;
        state.find_encroached_in_space(x, cavity)?;
        if state.crosses_protected(subfacet, guard)? {
            return Ok(false);
        }
        let mut encroached = std::mem::take(&mut state.facets.near.subsegments);
        let (mut is_any, mut is_guarded) = (false, false);
        for &(subsegment, _) in &encroached {
            match self.state.may_split(subsegment, guard)? {
                true => is_any |= self.split(subsegment, cavity)?,
                false => is_guarded = true,
            }
        }
        let has_searched = !encroached.is_empty() || !matches!(guard, Guard::Open);
        encroached.clear();
        let Some(state) = self.state.in_space() else { return Ok(false) };
        state.facets.near.subsegments = encroached;
        if is_any || is_guarded {
            return Ok(is_any);
        }
        if has_searched {
            // The splits that failed have changed nothing, but have searched cavities of their own,
            // and the guard for local feature sizes.
            state.delaunay.find_cavity(start, x, cavity)?;
        }
        self.split_facet_at(subfacet, x, cavity)
    }
}

impl State<3> {
    /// Flips an edge of a subfacet that is missing if the mesh has the other diagonal, and the four
    /// vertices are on one circle within roundings or the mesh has both triangles.
    fn follow(&mut self, subfacet: u32) -> AllocResult<bool> {
        for edge in 0..3 {
            let own = *self.facets.get(subfacet);
            if own.subsegments[edge] != NONE {
                continue;
            }
            let (sine, is_convex) = self.diagonal(subfacet, edge);
            let (apex, beyond) = (own.vertices[edge], self.opposite(subfacet, edge));
            let [a, b] = own.ends(edge);
            if !is_convex || !self.has_edge(apex, beyond)? || self.has_edge(a, b)? {
                continue;
            }
            let has_both =
                self.has_face(&[apex, a, beyond])? && self.has_face(&[apex, beyond, b])?;
            if (sine.abs() < COCIRCULAR || has_both) && !self.would_repeat(subfacet, edge) {
                for changed in self.facets.flip(subfacet, edge)? {
                    self.queue_subfacet(changed)?;
                }
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Returns what is to be split for a subfacet: its facet at the image of a vertex beside it,
    /// otherwise at the centre of its circle; or a subsegment that is between it and the centre, or
    /// that such a vertex would encroach.
    pub(super) fn split_for(&mut self, subfacet: u32) -> AllocResult<Split> {
        if let Some((at, x)) = self.image_to_split_at(subfacet)? {
            return self.split_to_insert(at, x);
        }
        let (center, _) = self.circle_of(subfacet);
        let x = self.facets.point_at(self.facets.get(subfacet).facet, &center);
        if x.iter().any(|x| !x.is_finite()) {
            return Ok(Split::Subfacet(subfacet, x));
        }
        match self.walk_in_sheet(subfacet, &x) {
            OnSheet::Beyond(subsegment) => Ok(Split::Subsegment(subsegment)),
            OnSheet::At { subfacet: at, .. } => self.split_to_insert(at, x),
        }
    }

    /// Returns what is to be split for a vertex at `x`, which is in a subfacet: a subsegment that
    /// it would encroach, or the subfacet.
    fn split_to_insert(&mut self, subfacet: u32, x: [f64; 3]) -> AllocResult<Split> {
        let (subfacet, x) = self.off_shields(subfacet, x);
        let encroached = self.encroached_in_sheet(subfacet, &x)?;
        Ok(encroached.map_or(Split::Subfacet(subfacet, x), Split::Subsegment))
    }

    /// Returns a subsegment that is encroached by `x`, which is in a subfacet, among those at the
    /// subfacets that a vertex there would replace in the sheet.
    fn encroached_in_sheet(&mut self, at: u32, x: &[f64; 3]) -> AllocResult<Option<u32>> {
        let mut found = std::mem::take(&mut self.facets.found);
        found.clear();
        found.try_push(at)?;
        let (mut next, mut encroached) = (0, None);
        while next < found.len() && encroached.is_none() {
            let own = *self.facets.get(found[next]);
            next += 1;
            for edge in 0..3 {
                let beyond = own.neighbors[edge];
                if own.subsegments[edge] == NONE {
                    if !found.contains(&beyond) && self.is_in_circle(beyond, x) {
                        found.try_push(beyond)?;
                    }
                } else if encroached.is_none() {
                    let [a, b] = own.ends(edge).map(|end: VertexId| self.delaunay.point(end));
                    let is_encroached = in_diametral_ball(a, b, x).is_positive()
                        && !self.segments.chains.is_limited(own.subsegments[edge]);
                    encroached = is_encroached.then_some(own.subsegments[edge]);
                }
            }
        }
        self.facets.found = found;
        Ok(encroached)
    }

    /// Leaves a subfacet as it is for which doubles are too coarse.
    fn limit_subfacet(&mut self, subfacet: u32) {
        self.facets.limit(subfacet);
        let vertices = self.facets.get(subfacet).vertices;
        vertices.into_iter().for_each(|vertex| self.precision_limited[vertex] = true);
    }
}
