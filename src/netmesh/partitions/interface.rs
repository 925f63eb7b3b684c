//! The interface of a partition: what it must leave as it is. Locked are the simplices at the
//! interface and those where an insertion would change a domain that the partition does not own. An
//! operation asks before it begins. The partition defers what is not allowed, and the global mesh
//! does it later. The global mesh has no interface.
//!
//! ```text
//!    partition 1    |    partition 2      Simplices beside the line are locked. Each partition
//!      /\    /\     |     /\    /\        keeps them as they are, so both sides still fit
//!     /  \  /  \ *  |  * /  \  /  \       together when they join. An input whose cavity has
//!    /____\/____\ . | . /____\/____\      a locked simplex (*) is deferred.
//! ```

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::Mesher;
use crate::netmesh::cages::domains::{DomainId, ROOT};
use crate::netmesh::cages::site::CageSite;

/// The number of simplices that are examined around a wanted cage. A cage that meets more is left
/// to the global mesh.
const MOST_ROUND_CAGE: usize = 1 << 13;

/// How much farther than the cage sphere a partition must extend: cage vertices and D-balls are
/// rounded.
const MARGIN: f64 = 1.0 + 1e-6;

#[derive(Default)]
pub(in crate::netmesh) struct Interface {
    /// Simplex -> whether it is locked. Simplices beyond the end are not.
    locked: Vec<bool>,
    /// Domain -> whether another partition owns it. Domains beyond the end are owned.
    non_owned: Vec<bool>,
    /// Simplex -> whether one of its inputs was deferred. Its other inputs would be deferred too,
    /// usually.
    skipped: Vec<bool>,
    /// Cages and inputs that went into them, where the input encroaches a non-owned domain around
    /// the cage.
    pub deferred: Vec<(DomainId, VertexId)>,
}

impl Interface {
    pub fn new(non_owned: Vec<bool>) -> Self {
        Self { non_owned, ..Self::default() }
    }

    /// Whether the inputs of `simplex` may be tried.
    #[inline]
    pub fn is_eligible(&self, simplex: SimplexId) -> bool {
        self.skipped.get(simplex.index()).is_none_or(|&is_skipped| !is_skipped)
    }

    /// Makes all inputs eligible.
    pub fn clear_skipped(&mut self) {
        self.skipped.clear();
    }

    /// Makes the inputs of `simplex` not eligible until the simplex is replaced.
    pub fn skip(&mut self, simplex: SimplexId) -> AllocResult<()> {
        self.skipped.cover(simplex.index() + 1, false)?;
        self.skipped[simplex] = true;
        Ok(())
    }

    /// Forgets what was known of ids that new simplices have taken.
    pub fn forget(&mut self, created: &[SimplexId]) {
        if self.skipped.is_empty() {
            return;
        }
        for &simplex in created {
            if let Some(is_skipped) = self.skipped.get_mut(simplex.index()) {
                *is_skipped = false;
            }
        }
    }

    /// Whether this is the interface of a partition.
    pub fn is_some(&self) -> bool {
        !self.non_owned.is_empty()
    }

    #[inline]
    pub fn is_locked(&self, simplex: SimplexId) -> bool {
        self.locked.get(simplex.index()).is_some_and(|&is_locked| is_locked)
    }

    #[inline]
    pub fn is_non_owned(&self, domain: DomainId) -> bool {
        self.non_owned.get(domain.index()).is_some_and(|&is_non_owned| is_non_owned)
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Locks the simplices that must stay as they are. Cells are not refined at the corners of such
    /// simplices.
    pub(in crate::netmesh) fn lock(&mut self) -> Result<()> {
        let bound = self.state.delaunay.complex().simplex_bound();
        self.state.refine_list.forget(&[], bound)?;
        for simplex in SimplexId::below(bound) {
            self.watch.poll_after(1)?;
            let is_locked = (0..=D)
                .any(|index| self.state.delaunay.complex().is_interface(simplex, index))
                || self.spans_non_owned_domain(simplex);
            self.state.interface.locked.try_push(is_locked)?;
            if is_locked {
                self.state.refine_list.limit(simplex);
                self.state.interface.skip(simplex)?;
            }
        }
        Ok(())
    }

    /// Defers `input`, in a partition, and the others of its simplex.
    pub(in crate::netmesh) fn defer(&mut self, input: VertexId) -> AllocResult<()> {
        if self.state.interface.is_some() {
            self.state.interface.skip(self.state.conflict_lists.simplex_of(input))
        } else {
            Ok(())
        }
    }

    /// Locks the simplices that still have inputs: these are not redistributed any more.
    pub(in crate::netmesh) fn lock_crowded(&mut self) -> Result<()> {
        let bound = self.state.delaunay.complex().simplex_bound();
        self.state.interface.locked.cover(bound, false)?;
        for simplex in SimplexId::below(bound) {
            self.watch.poll_after(1)?;
            if self.state.conflict_lists.count(simplex) > 0 {
                self.state.interface.locked[simplex] = true;
                self.state.refine_list.limit(simplex);
            }
        }
        Ok(())
    }

    /// Whether `simplex` has vertices inside and outside of a non-owned domain. The clearance of
    /// that domain would change with them.
    fn spans_non_owned_domain(&mut self, simplex: SimplexId) -> bool {
        !self.state.delaunay.complex().is_infinite(simplex)
            && self
                .spanned_domain(simplex, |mesher, domain, _| {
                    mesher.state.interface.is_non_owned(domain)
                })
                .is_some()
    }

    /// Whether no simplex of `cavity` is locked.
    pub(in crate::netmesh) fn may_replace_cavity(&self, cavity: &Cavity) -> bool {
        !self.state.interface.is_some()
            || !cavity.simplices.iter().any(|&simplex| self.state.interface.is_locked(simplex))
    }

    /// Whether `x`, whose cavity is given, may be inserted, and the cages that it encroaches from
    /// outside released.
    pub(in crate::netmesh) fn may_insert(&mut self, x: &[f64; D], cavity: &Cavity) -> bool {
        if !self.state.interface.is_some() {
            return true;
        }
        if !self.may_replace_cavity(cavity) {
            return false;
        }
        if let Some(domain) = self.common_domain(cavity) {
            if self.state.hierarchy.contains(domain, x) {
                return true;
            }
        }
        for at in 0..cavity.vertices.ids.len() {
            let mut domain = self.state.hierarchy.domain_of(cavity.vertices.ids[at]);
            while !self.state.hierarchy.contains(domain, x) {
                if self.state.interface.is_non_owned(domain) {
                    return false;
                }
                domain = self.state.hierarchy.parent(domain);
            }
        }
        true
    }

    /// Whether a cage may be made at `site`: no locked simplex is in conflict with a point of its
    /// sphere, and the partition owns all domains between there and the parent.
    pub(in crate::netmesh) fn may_make_cage(&mut self, site: &CageSite) -> AllocResult<bool> {
        if !self.state.interface.is_some() {
            return Ok(true);
        }
        let max_distance = MARGIN * self.state.parameters.cage_scale * site.radius;
        let mut near = std::mem::take(&mut self.scratch.near);
        let is_all = self.state.delaunay.meeting_ball(
            site.center,
            max_distance,
            MOST_ROUND_CAGE,
            &mut near,
        )?;
        let is_free = is_all
            && near.iter().all(|&simplex| {
                !self.state.interface.is_locked(simplex)
                    && (0..=D).all(|index| {
                        let vertex = self.state.delaunay.complex().vertices(simplex)[index];
                        vertex.is_valid() && self.is_own_below(site.parent, vertex)
                    })
            });
        self.scratch.near = near;
        Ok(is_free)
    }

    /// Whether the partition owns all domains from that of `vertex` up to `parent`, or to one as
    /// large.
    fn is_own_below(&mut self, parent: DomainId, vertex: VertexId) -> bool {
        let mut domain = self.state.hierarchy.domain_of(vertex);
        while domain != ROOT
            && domain != parent
            && self.state.hierarchy.node(domain).radius < self.state.hierarchy.node(parent).radius
        {
            if self.state.interface.is_non_owned(domain) {
                return false;
            }
            domain = self.state.hierarchy.parent(domain);
        }
        true
    }
}
