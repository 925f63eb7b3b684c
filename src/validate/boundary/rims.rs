//! Rims of the subfacets of facets, to which a search for a chain may keep: of several chains that
//! may lead along an edge of a facet, the one at the rim of its own subfacets is the edge's.

use crate::memory::{AllocResult, filled};
use crate::mesh::NONE;

/// Ways for a chain to keep to a rim.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// The chain is of the rim alone, and in its direction.
    Directed,
    /// The chain is of the rim alone.
    Along,
    /// The chain keeps to the rim, in its direction, as far as that leads.
    AsFar,
    /// The chain keeps to the rim so, and is bent as far as one may be. Chains nearer to the edge
    /// leave the rim where that goes through an input farther off.
    Bent,
}

impl Keep {
    /// Returns true if the chain leads on beside the rim where that does not.
    pub fn leaves_rim(self) -> bool {
        matches!(self, Self::AsFar | Self::Bent)
    }
}

/// Subsegments at rims, and what a search keeps to.
#[derive(Default)]
pub(super) struct Rims {
    /// Subsegment -> the facet at the rim of whose own subfacets it was noted last, or [`NONE`],
    /// and true if that runs from its lower end; those beyond were not noted.
    of: Vec<(u32, bool)>,
    keeps: Option<(u32, Keep)>,
    /// True if searches go against the rim.
    is_backwards: bool,
}

impl Rims {
    /// Notes those of so many subsegments that are at the rim of a facet's own subfacets, each with
    /// its direction.
    pub fn note(&mut self, count: usize, facet: u32, rim: &[(u32, bool)]) -> AllocResult<()> {
        if self.of.is_empty() {
            self.of = filled(count, (NONE, false))?;
        }
        rim.iter().for_each(|&(at, is_upward)| self.of[at as usize] = (facet, is_upward));
        Ok(())
    }

    /// Lets searches keep to the rim of a facet from now on; to none without one.
    pub fn keep(&mut self, keeps: Option<(u32, Keep)>) {
        (self.keeps, self.is_backwards) = (keeps, false);
    }

    /// Lets searches go against the rim to which they keep.
    pub fn turn_round(&mut self) {
        self.is_backwards = !self.is_backwards;
    }

    /// Returns true if a chain may lead along a subsegment, from its lower end if `is_upward`.
    pub fn allow(&self, subsegment: u32, is_upward: bool) -> bool {
        let leaves_rim = self.keeps.is_none_or(|(_, keep)| keep.leaves_rim());
        leaves_rim || self.hold(subsegment, is_upward)
    }

    /// Returns true if a search keeps to no rim, or if a subsegment leads along it.
    pub fn hold(&self, subsegment: u32, is_upward: bool) -> bool {
        self.keeps.is_none_or(|(facet, keep)| {
            let own = self.of.get(subsegment as usize);
            let leads = |along: bool| along == (is_upward != self.is_backwards);
            let is_along = |along: bool| keep == Keep::Along || leads(along);
            own.is_some_and(|&(of, along)| of == facet && is_along(along))
        })
    }
}
