//! The records of all simplices in one array, for searches.

use super::marks::{Mark, Marks};
use super::{Complex, SimplexId, VertexId, index_of};
use crate::memory::{AllocResult, prefetch_at};

/// Vertices and neighbours of all simplices, to read.
#[derive(Clone, Copy)]
pub(crate) struct Records<'a, const D: usize>(&'a [u32]);

/// Records of all simplices for a search that marks the simplices that it meets.
pub(crate) struct Marking<'a, const D: usize> {
    records: Records<'a, D>,
    marks: &'a mut Marks,
}

impl<'a, const D: usize> Records<'a, D> {
    #[inline]
    pub fn vertices(self, simplex: SimplexId) -> &'a [VertexId] {
        VertexId::from_numbers(&self.record(simplex)[..Complex::<D>::VERTICES])
    }

    #[inline]
    pub fn neighbors(self, simplex: SimplexId) -> &'a [SimplexId] {
        SimplexId::from_numbers(&self.record(simplex)[Complex::<D>::VERTICES..])
    }

    /// Returns the position of `neighbor` among the neighbours of `simplex`, which has it.
    #[inline(always)]
    pub fn position_of_neighbor(self, simplex: SimplexId, neighbor: SimplexId) -> u32 {
        index_of(self.neighbors(simplex), neighbor) as u32
    }

    /// Prefetches the record of `simplex`.
    #[inline(always)]
    pub fn prefetch(self, simplex: SimplexId) {
        prefetch_at(self.0, simplex.index() * Complex::<D>::RECORD, Complex::<D>::RECORD);
    }

    /// Returns true if the facet of `simplex` opposite its vertex number `index` is on the
    /// interface of a partition: the global mesh continues beyond it.
    pub fn is_interface(self, simplex: SimplexId, index: usize) -> bool {
        self.neighbors(simplex)[index] == simplex
    }

    #[inline]
    fn record(self, simplex: SimplexId) -> &'a [u32] {
        &self.0[simplex.index() * Complex::<D>::RECORD..][..Complex::<D>::RECORD]
    }
}

impl<'a, const D: usize> Marking<'a, D> {
    #[inline]
    pub fn records(&self) -> Records<'a, D> {
        self.records
    }

    /// Returns the mark of `simplex`. A search clears those that it sets.
    #[inline(always)]
    pub fn mark_of(&mut self, simplex: SimplexId) -> &mut Mark {
        self.marks.of(simplex)
    }
}

impl<const D: usize> Complex<D> {
    #[inline]
    pub fn records(&self) -> Records<'_, D> {
        Records(&self.records)
    }

    /// Starts a search as [`Self::begin_marks`] does, and returns the records and their marks.
    pub fn marking(&mut self) -> AllocResult<Marking<'_, D>> {
        self.begin_marks()?;
        Ok(Marking { records: Records(&self.records), marks: &mut self.marks })
    }
}
