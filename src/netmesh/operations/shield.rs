//! Shields: vertices on the sphere about an end of lines, for all lines and facets there.

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::collected;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::facets::shields::Shield;

/// Units of work for a line of a shield.
const WORK: u32 = 8;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Gives the end of a line the shield that it needs before a subsegment there is split, which
    /// splits it. False if it needs none.
    pub(super) fn shield_end_of(&mut self, subsegment: u32, cavity: &mut Cavity) -> Result<bool> {
        let Some(state) = self.state.in_space() else { return Ok(false) };
        match state.needed_shield(subsegment)? {
            Some(shield) => self.raise_shield(shield, cavity).map(|()| true),
            None => Ok(false),
        }
    }

    /// Puts a smaller shield in place of the one that a subsegment is in, which is no edge:
    /// something passes the centre there. False if it is in none, or doubles are too coarse.
    pub(super) fn shrink_shield_around(
        &mut self,
        subsegment: u32,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let Some(state) = self.state.in_space() else { return Ok(false) };
        let Some(center) = state.shield_around(subsegment) else { return Ok(false) };
        state.facets.shields.lower(center);
        match state.shield_for(center)? {
            Some(shield) => self.raise_shield(shield, cavity).map(|()| true),
            None => Ok(false),
        }
    }

    /// Splits all lines that end at the centre of a shield on its sphere, and the facets between
    /// them.
    fn raise_shield(&mut self, shield: Shield, cavity: &mut Cavity) -> Result<()> {
        let Some(state) = self.state.in_space() else { return Ok(()) };
        let facets = collected(state.facets.facets_at(shield.center).iter().copied())?;
        state.facets.shields.raise(shield, &facets)?;
        for line in collected(state.segments.chains.lines_at(shield.center))? {
            self.watch.poll_after(WORK)?;
            let Some(state) = self.state.in_space() else { break };
            let place = state.place_on_shield(line, shield);
            let subsegment = state.segments.chains.subsegment_at_end(line, shield.center);
            let x = self.state.point_at(line, place);
            self.split_line_at(subsegment, place, x, cavity)?;
        }
        let Some(state) = self.state.in_space() else { return Ok(()) };
        for on_arc in state.places_on_arcs(shield)? {
            self.watch.poll_after(WORK)?;
            let Some(state) = self.state.in_space() else { break };
            let is_own = |page: &u32| state.facets.get(*page).facet == on_arc.facet;
            let page = state.facets.pages(on_arc.subsegment).find(is_own);
            let at = page.and_then(|page| state.subfacet_at(page, &on_arc.x));
            let Some(subfacet) = at else { continue };
            let near = state.delaunay.complex().incident(shield.center);
            if let Some(start) = state.delaunay.locate(near, &on_arc.x) {
                state.delaunay.find_cavity(start, &on_arc.x, cavity)?;
                self.split_facet_at(subfacet, &on_arc.x, cavity)?;
            }
        }
        Ok(())
    }
}
