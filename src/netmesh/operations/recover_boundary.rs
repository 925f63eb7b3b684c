//! Recovery of all of the boundary: subsegments first, then subfacets, until none is missing; and
//! what comes of a Steiner point that would encroach some of it.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::facets::floors::{Guard, Purpose};
use crate::netmesh::state::facets::near::NearBoundary;

/// Subsegments and subfacets that a Steiner point would encroach, and what became of them.
pub(super) enum Encroachment {
    /// The point encroaches none.
    None,
    /// Some of them have been split.
    Split,
    /// Doubles have no room for a vertex on any of them.
    TooShort,
    /// They are too small beside the simplex that asks for the point.
    Refused,
}

/// Number of subsegments or subfacets encroached by a point for each one of them that is split at a
/// time.
const PART: usize = 32;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Splits subsegments and subfacets until all that wait are recovered.
    ///
    /// # Errors
    /// Fails as [`Self::recover_segments`] does.
    pub(in crate::netmesh) fn recover_boundary(&mut self, cavity: &mut Cavity) -> Result<()> {
        loop {
            self.recover_segments(cavity)?;
            if !self.recover_next_subfacet(cavity)? {
                return Ok(());
            }
        }
    }

    /// Splits the subsegments that a Steiner point at `x` for a simplex would encroach, and
    /// recovers all.
    pub(super) fn split_encroached(
        &mut self,
        simplex: SimplexId,
        x: &[f64; D],
        purpose: Purpose,
        cavity: &mut Cavity,
    ) -> Result<Encroachment> {
        if !self.state.segments.is_active() {
            return Ok(Encroachment::None);
        }
        if self.state.in_space().is_some() {
            return self.split_encroached_in_space(simplex, x, purpose, cavity);
        }
        if !self.state.find_encroached(x, cavity)? {
            return Ok(Encroachment::None);
        }
        let mut encroached = std::mem::take(&mut self.state.segments.encroached);
        encroached.sort_unstable();
        encroached.dedup();
        let mut is_any = false;
        for &subsegment in &encroached {
            is_any |= self.split(subsegment, cavity)?;
        }
        self.state.segments.encroached = encroached;
        self.recover_boundary(cavity)?;
        Ok(if is_any { Encroachment::Split } else { Encroachment::TooShort })
    }

    /// Splits what a Steiner point at `x` for a simplex would encroach most in space, subsegments
    /// first.
    fn split_encroached_in_space(
        &mut self,
        simplex: SimplexId,
        x: &[f64; D],
        purpose: Purpose,
        cavity: &mut Cavity,
    ) -> Result<Encroachment> {
        let place = std::array::from_fn(|axis| x[axis]);
        let Some(state) = self.state.in_space() else { return Ok(Encroachment::None) };
        let mut is_any = state.find_encroached_in_space(&place, cavity)?;
        if !is_any && !cavity.is_whole {
            state.delaunay.find_cavity(simplex, &place, cavity)?;
            is_any = state.find_encroached_in_space(&place, cavity)?;
        }
        if !is_any {
            return Ok(Encroachment::None);
        }
        let guard = state.keep_large(simplex, purpose)?;
        if state.facets.near.is_empty() {
            return Ok(Encroachment::Refused);
        }
        state.sort_near_by_depth(&place)?;
        let near = std::mem::take(&mut state.facets.near);
        let is_split = self.split_some_of(&near, guard, cavity)?;
        if let Some(state) = self.state.in_space() {
            state.facets.near = near;
        }
        self.recover_boundary(cavity)?;
        Ok(if is_split { Encroachment::Split } else { Encroachment::Refused })
    }

    /// Splits the first that can be split of some subsegments and subfacets, or a part of them
    /// where there are many: most of the others are encroached no more then. False if doubles or
    /// the guard let none be split.
    fn split_some_of(
        &mut self,
        near: &NearBoundary,
        guard: Guard,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let mut splits = 0;
        for &(subsegment, _) in &near.subsegments {
            splits += usize::from(self.split(subsegment, cavity)?);
            if splits > near.subsegments.len() / PART {
                return Ok(true);
            }
        }
        if splits > 0 {
            return Ok(true);
        }
        for &(subfacet, _) in &near.subfacets {
            let Some(state) = self.state.in_space() else { break };
            if state.facets.is_limited(subfacet) {
                continue;
            }
            let split = state.split_for(subfacet)?;
            splits += usize::from(self.split_boundary(split, guard, cavity)?);
            if splits > near.subfacets.len() / PART {
                break;
            }
        }
        Ok(splits > 0)
    }
}
