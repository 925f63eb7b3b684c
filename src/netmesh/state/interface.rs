//! The interface of a partition: what it must leave as it is. Locked are the simplices at the
//! interface. Domains that the partition does not own are neither grown nor released; vertices
//! beside them may lower their clearance, and narrow the gaps of their cages. An operation asks
//! before it begins. The partition defers what is not allowed, and the global mesh does it later.
//! The global mesh has no interface.
//!
//! ```text
//!    partition 1    |    partition 2      Simplices beside the line are locked. Each partition
//!      /\    /\     |     /\    /\        keeps them as they are, so both sides still fit
//!     /  \  /  \ *  |  * /  \  /  \       together when they join. An input whose cavity has
//!    /____\/____\ . | . /____\/____\      a locked simplex (*) is deferred.
//! ```

use crate::complex::{SimplexId, VertexId};
use crate::memory::{AllocResult, TryGrow, filled};
use crate::netmesh::state::hierarchy::DomainId;

#[derive(Default)]
pub(in crate::netmesh) struct Interface {
    /// Simplex -> true if it is locked. Simplices beyond the end are not.
    pub locked: Vec<bool>,
    /// Domain -> true if another partition owns it. Domains beyond the end are owned.
    non_owned: Vec<bool>,
    /// Domain -> true if something is left to do there that the partition may not, or its
    /// clearance fell here, though others have simplices at it. Domains beyond the end are not.
    wanted: Vec<bool>,
    /// Simplex -> true if one of its inputs was deferred. Its other inputs would be deferred too,
    /// usually.
    skipped: Vec<bool>,
    /// Cages and inputs that went into them, where the input encroaches a non-owned domain around
    /// the cage.
    pub deferred: Vec<(DomainId, VertexId)>,
    /// Bad simplices that the interface did not let the partition mend. Ids of dead ones among them
    /// may have been taken by others.
    pub blocked: Vec<SimplexId>,
}

impl Interface {
    pub fn new(non_owned: Vec<bool>) -> AllocResult<Self> {
        Ok(Self { wanted: filled(non_owned.len(), false)?, non_owned, ..Self::default() })
    }

    /// Returns true if the inputs of `simplex` may be tried.
    #[inline]
    pub fn is_eligible(&self, simplex: SimplexId) -> bool {
        self.skipped.get(simplex.index()).is_none_or(|&is_skipped| !is_skipped)
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

    /// Returns true if this is the interface of a partition.
    pub fn is_some(&self) -> bool {
        !self.non_owned.is_empty()
    }

    #[inline]
    pub fn is_locked(&self, simplex: SimplexId) -> bool {
        self.locked.get(simplex.index()).is_some_and(|&is_locked| is_locked)
    }

    pub fn has_work_left(&self, domain: DomainId) -> bool {
        self.wanted.get(domain.index()).is_some_and(|&has_work_left| has_work_left)
    }

    /// Notes that something is left to do at `domain`, in a partition.
    pub fn want(&mut self, domain: DomainId) -> AllocResult<()> {
        if self.is_some() {
            self.wanted.cover(domain.index() + 1, false)?;
            self.wanted[domain.index()] = true;
        }
        Ok(())
    }

    /// Notes that something is left to do at `domain` if another partition owns it. Returns true if
    /// one does.
    pub fn want_non_owned(&mut self, domain: DomainId) -> bool {
        let is_non_owned = self.is_non_owned(domain);
        if is_non_owned {
            self.wanted[domain.index()] = true;
        }
        is_non_owned
    }

    #[inline]
    pub fn is_non_owned(&self, domain: DomainId) -> bool {
        self.non_owned.get(domain.index()).is_some_and(|&is_non_owned| is_non_owned)
    }
}
