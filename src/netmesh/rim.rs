//! What a part of the mesh must leave as it is (`parts`): the simplices at its rim, and those where an
//! insertion would change a domain that is not the part's own. An operation asks before it begins;
//! what may not be done stays undone, and the whole does it later. The whole has no rim.

use super::Mesher;
use super::domains::ROOT;
use super::site::CageSite;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;

/// So many simplices are looked at round a cage that is wanted. One that meets more is the whole's.
const MOST_ROUND_CAGE: usize = 1 << 13;

/// How much farther than the cage sphere a part must reach: cage vertices and D-balls are rounded.
const MARGIN: f64 = 1.0 + 1e-6;

#[derive(Default)]
pub(super) struct Rim {
    /// Simplex -> whether it must stay; those that are not there need not.
    frozen: Vec<bool>,
    /// Domain -> whether it must stay; likewise.
    foreign: Vec<bool>,
    /// Simplex -> whether an input at home in it could not be inserted. Others there cannot either,
    /// usually.
    held: Vec<bool>,
    /// Cages, and inputs that went into them, which encroach a domain around them that must stay.
    pub postponed: Vec<(u32, u32)>,
}

impl Rim {
    pub fn new(foreign: Vec<bool>) -> Self {
        Self { foreign, ..Self::default() }
    }

    /// Whether to try and insert the inputs of `simplex`.
    #[inline]
    pub fn admits(&self, simplex: u32) -> bool {
        self.held.get(simplex as usize).is_none_or(|&is_held| !is_held)
    }

    /// Holds no inputs back any more.
    pub fn admit_all(&mut self) {
        self.held.clear();
    }

    /// An input of `simplex` could not be inserted, or is to wait.
    pub fn hold(&mut self, simplex: u32) -> AllocResult<()> {
        self.held.cover(simplex as usize + 1, false)?;
        self.held[simplex as usize] = true;
        Ok(())
    }

    /// Forgets what was known of ids that new simplices have taken.
    pub fn forget(&mut self, created: &[u32]) {
        if self.held.is_empty() {
            return;
        }
        for &simplex in created {
            if let Some(is_held) = self.held.get_mut(simplex as usize) {
                *is_held = false;
            }
        }
    }

    /// Whether this is the rim of a part.
    pub fn is_some(&self) -> bool {
        !self.foreign.is_empty()
    }

    #[inline]
    pub fn is_frozen(&self, simplex: u32) -> bool {
        self.frozen.get(simplex as usize).is_some_and(|&is_frozen| is_frozen)
    }

    #[inline]
    pub fn is_foreign(&self, domain: u32) -> bool {
        self.foreign.get(domain as usize).is_some_and(|&is_foreign| is_foreign)
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Freezes what must stay. Cells are not refined at the corners of such simplices.
    pub(super) fn freeze(&mut self) -> Result<()> {
        let bound = self.delaunay.complex().simplex_bound();
        self.refine.forget(&[], bound)?;
        for simplex in 0..bound as u32 {
            self.watch.poll_after(1)?;
            let is_frozen = (0..=D).any(|index| self.delaunay.complex().is_rim(simplex, index))
                || self.divides_foreign_domain(simplex);
            self.rim.frozen.try_push(is_frozen)?;
            if is_frozen {
                self.refine.limit(simplex);
                self.rim.hold(simplex)?;
            }
        }
        Ok(())
    }

    /// Leaves the inputs of the home of `input` alone, in a part, until the home is replaced.
    pub(super) fn postpone(&mut self, input: u32) -> AllocResult<()> {
        if self.rim.is_some() { self.rim.hold(self.location.home(input)) } else { Ok(()) }
    }

    /// Freezes the homes of inputs, too: those that are left need not be looked after any more.
    pub(super) fn freeze_homes(&mut self) -> Result<()> {
        let bound = self.delaunay.complex().simplex_bound();
        self.rim.frozen.cover(bound, false)?;
        for simplex in 0..bound as u32 {
            self.watch.poll_after(1)?;
            if self.location.count(simplex) > 0 {
                self.rim.frozen[simplex as usize] = true;
                self.refine.limit(simplex);
            }
        }
        Ok(())
    }

    /// Whether `simplex` has vertices inside and outside of a domain that must stay: its clearance would
    /// change with them.
    fn divides_foreign_domain(&mut self, simplex: u32) -> bool {
        !self.delaunay.complex().is_infinite(simplex)
            && self
                .divided_domain(simplex, |mesher, domain, _| mesher.rim.is_foreign(domain))
                .is_some()
    }

    /// Whether no simplex of the scratch cavity must stay.
    pub(super) fn may_replace_cavity(&self) -> bool {
        !self.rim.is_some()
            || !self.scratch.cavity.simplices.iter().any(|&simplex| self.rim.is_frozen(simplex))
    }

    /// Whether `x`, whose conflicts are the scratch cavity, may be inserted, and
    /// release the cages that it encroaches from outside.
    pub(super) fn may_insert(&mut self, x: &[f64; D]) -> bool {
        if !self.rim.is_some() {
            return true;
        }
        if !self.may_replace_cavity() {
            return false;
        }
        if let Some(domain) = self.common_domain() {
            if self.hierarchy.contains(domain, x) {
                return true;
            }
        }
        for at in 0..self.scratch.cavity.corners.ids.len() {
            let mut domain = self.hierarchy.domain_of(self.scratch.cavity.corners.ids[at]);
            while !self.hierarchy.contains(domain, x) {
                if self.rim.is_foreign(domain) {
                    return false;
                }
                domain = self.hierarchy.parent(domain);
            }
        }
        true
    }

    /// Whether a cage may be made at `site`: nothing that must stay is in conflict with a point of its
    /// sphere, and no domain between there and the parent must stay.
    pub(super) fn may_make_cage(&mut self, site: &CageSite) -> AllocResult<bool> {
        if !self.rim.is_some() {
            return Ok(true);
        }
        let reach = MARGIN * self.parameters.cage_scale * site.radius;
        let mut near = std::mem::take(&mut self.scratch.near);
        let is_all = self.delaunay.meeting_ball(site.center, reach, MOST_ROUND_CAGE, &mut near)?;
        let is_free = is_all
            && near.iter().all(|&simplex| {
                !self.rim.is_frozen(simplex)
                    && (0..=D).all(|index| {
                        let vertex = self.delaunay.complex().vertices(simplex)[index];
                        vertex != NONE && self.is_own_below(site.parent, vertex)
                    })
            });
        self.scratch.near = near;
        Ok(is_free)
    }

    /// Whether no domain from that of `vertex` up to `parent`, or as large, must stay.
    fn is_own_below(&mut self, parent: u32, vertex: u32) -> bool {
        let mut domain = self.hierarchy.domain_of(vertex);
        while domain != ROOT
            && domain != parent
            && self.hierarchy.node(domain).radius < self.hierarchy.node(parent).radius
        {
            if self.rim.is_foreign(domain) {
                return false;
            }
            domain = self.hierarchy.parent(domain);
        }
        true
    }
}
