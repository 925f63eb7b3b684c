//! The records of all simplices in one array, as searches read them.

use super::{Complex, index_of};
use crate::memory::prefetch_at;

/// The vertices and neighbours of all simplices.
#[derive(Clone, Copy)]
pub(crate) struct Records<'a, const D: usize>(&'a [u32]);

/// The same for a search that marks what it saw.
pub(crate) struct Marking<'a, const D: usize> {
    records: &'a mut [u32],
    epoch: u32,
}

/// What a search sees of a simplex as it crosses a facet.
pub(crate) struct Sighting {
    /// Where the simplex has the one before among its neighbours.
    pub mirror: u32,
    mark: u32,
}

impl<'a, const D: usize> Records<'a, D> {
    #[inline]
    pub fn vertices(self, simplex: u32) -> &'a [u32] {
        &self.record(simplex)[..Complex::<D>::VERTICES]
    }

    #[inline]
    pub fn neighbors(self, simplex: u32) -> &'a [u32] {
        &self.record(simplex)[Complex::<D>::VERTICES..Complex::<D>::MARK]
    }

    /// Begins to load the record of `simplex`.
    #[inline(always)]
    pub fn prefetch(self, simplex: u32) {
        prefetch_at(self.0, simplex as usize * Complex::<D>::RECORD, Complex::<D>::RECORD);
    }

    /// Whether the facet of `simplex` opposite its vertex number `index` is a cut facet of a
    /// partition.
    pub fn is_interface(self, simplex: u32, index: usize) -> bool {
        self.neighbors(simplex)[index] == simplex
    }

    #[inline]
    fn record(self, simplex: u32) -> &'a [u32] {
        &self.0[simplex as usize * Complex::<D>::RECORD..][..Complex::<D>::RECORD]
    }
}

impl<const D: usize> Marking<'_, D> {
    #[inline]
    pub fn records(&self) -> Records<'_, D> {
        Records(self.records)
    }

    /// What [`Complex::has_marks_of`] knows the search by.
    pub fn number(&self) -> u32 {
        self.epoch
    }

    /// Comes to `simplex` from its neighbour `before`.
    #[inline(always)]
    pub fn see(&self, simplex: u32, before: u32) -> Sighting {
        let record = self.records().record(simplex);
        let neighbors = &record[Complex::<D>::VERTICES..Complex::<D>::MARK];
        Sighting { mirror: index_of(neighbors, before) as u32, mark: record[Complex::<D>::MARK] }
    }

    /// Whether the simplex was marked before.
    #[inline(always)]
    pub fn is_marked(&self, seen: &Sighting) -> bool {
        seen.mark >= self.epoch
    }

    /// Whether the simplex was marked inside before.
    #[inline(always)]
    pub fn is_inside(&self, seen: &Sighting) -> bool {
        seen.mark == self.epoch
    }

    /// Marks `simplex` as inside, or else as outside.
    #[inline(always)]
    pub fn mark(&mut self, simplex: u32, is_inside: bool) {
        self.records[simplex as usize * Complex::<D>::RECORD + Complex::<D>::MARK] =
            self.epoch + u32::from(!is_inside);
    }
}

impl<const D: usize> Complex<D> {
    #[inline]
    pub fn records(&self) -> Records<'_, D> {
        Records(&self.records)
    }

    /// Starts a search as [`Self::begin_marks`] does.
    pub fn marking(&mut self) -> Marking<'_, D> {
        let epoch = self.begin_marks();
        Marking { records: &mut self.records, epoch }
    }
}
