//! Recovery of all of the boundary: subsegments first, then subfacets, until none is missing; and what
//! comes of a Steiner point that would encroach some of it.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;

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

    /// Splits the subsegments that a Steiner point at `x` for a simplex would encroach, and recovers
    /// all.
    pub(super) fn split_encroached(
        &mut self,
        simplex: SimplexId,
        x: &[f64; D],
        cavity: &mut Cavity,
    ) -> Result<Encroachment> {
        if !self.state.segments.is_active() {
            return Ok(Encroachment::None);
        }
        if self.state.in_space().is_some() {
            return self.split_encroached_in_space(simplex, x, cavity);
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

    /// Splits what a Steiner point at `x` for a simplex would encroach in space, subsegments first.
    fn split_encroached_in_space(
        &mut self,
        simplex: SimplexId,
        x: &[f64; D],
        cavity: &mut Cavity,
    ) -> Result<Encroachment> {
        let place = std::array::from_fn(|axis| x[axis]);
        let Some(state) = self.state.in_space() else { return Ok(Encroachment::None) };
        if !state.find_encroached_in_space(&place, cavity)? {
            return Ok(Encroachment::None);
        }
        let least = state.keep_large(simplex);
        if state.facets.near.is_empty() {
            return Ok(Encroachment::Refused);
        }
        let near = std::mem::take(&mut state.facets.near);
        let mut is_any = false;
        for &(subsegment, _) in &near.subsegments {
            is_any |= self.split(subsegment, cavity)?;
        }
        if !is_any {
            for &(subfacet, _) in &near.subfacets {
                let Some(state) = self.state.in_space() else { break };
                if state.facets.is_limited(subfacet) {
                    continue;
                }
                let split = state.split_for(subfacet)?;
                is_any |= self.split_boundary(split, least, cavity)?;
            }
        }
        if let Some(state) = self.state.in_space() {
            state.facets.near = near;
        }
        self.recover_boundary(cavity)?;
        Ok(if is_any { Encroachment::Split } else { Encroachment::Refused })
    }
}
