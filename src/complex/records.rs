//! The records of all simplices in one array, for searches.

use super::{Complex, SimplexId, VertexId, index_of};
use crate::memory::prefetch_at;

/// Vertices and neighbours of all simplices, to read.
#[derive(Clone, Copy)]
pub(crate) struct Records<'a, const D: usize>(&'a [u32]);

/// Records of all simplices for a search that marks the simplices that it meets.
pub(crate) struct Marking<'a, const D: usize> {
    records: &'a mut [u32],
    epoch: u32,
}

/// Mark of a simplex as a search reads it when it crosses a facet, and the way back.
pub(crate) struct Sighting {
    /// Position of the simplex that the search came from, among the neighbours.
    pub mirror: u32,
    mark: u32,
}

impl<'a, const D: usize> Records<'a, D> {
    #[inline]
    pub fn vertices(self, simplex: SimplexId) -> &'a [VertexId] {
        VertexId::from_numbers(&self.record(simplex)[..Complex::<D>::VERTICES])
    }

    #[inline]
    pub fn neighbors(self, simplex: SimplexId) -> &'a [SimplexId] {
        neighbors_in::<D>(self.record(simplex))
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

#[inline(always)]
fn neighbors_in<const D: usize>(record: &[u32]) -> &[SimplexId] {
    SimplexId::from_numbers(&record[Complex::<D>::VERTICES..Complex::<D>::MARK])
}

impl<const D: usize> Marking<'_, D> {
    #[inline]
    pub fn records(&self) -> Records<'_, D> {
        Records(self.records)
    }

    /// Returns the number of the search, for [`Complex::has_marks_of`].
    pub fn number(&self) -> u32 {
        self.epoch
    }

    /// Reads the mark of `simplex`, reached from its neighbour `before`.
    #[inline(always)]
    pub fn see(&self, simplex: SimplexId, before: SimplexId) -> Sighting {
        let record = self.records().record(simplex);
        let mirror = index_of(neighbors_in::<D>(record), before) as u32;
        Sighting { mirror, mark: record[Complex::<D>::MARK] }
    }

    /// Returns true if this search had marked the simplex, inside or outside.
    #[inline(always)]
    pub fn is_marked(&self, seen: &Sighting) -> bool {
        seen.mark >= self.epoch
    }

    /// Returns true if this search had marked the simplex as inside.
    #[inline(always)]
    pub fn is_inside(&self, seen: &Sighting) -> bool {
        seen.mark == self.epoch
    }

    /// Marks `simplex` as inside, or else as outside.
    #[inline(always)]
    pub fn mark(&mut self, simplex: SimplexId, is_inside: bool) {
        self.records[simplex.index() * Complex::<D>::RECORD + Complex::<D>::MARK] =
            self.epoch + u32::from(!is_inside);
    }
}

impl<const D: usize> Complex<D> {
    #[inline]
    pub fn records(&self) -> Records<'_, D> {
        Records(&self.records)
    }

    /// Starts a search as [`Self::begin_marks`] does, and returns the records to mark.
    pub fn marking(&mut self) -> Marking<'_, D> {
        let epoch = self.begin_marks();
        Marking { records: &mut self.records, epoch }
    }
}
