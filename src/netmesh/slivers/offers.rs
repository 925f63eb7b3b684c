//! Points for slivers that no move mends. They go in by what they are worth, the best first: one
//! point may mend slivers all round it, and where it went in, moves may mend what is left.

use super::Slivers;
use super::phase::POINTS;
use super::queue::Sliver;
use super::random::Random;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::Mesher;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A point for a sliver, and when it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Offer<const D: usize> {
    pub sliver: Sliver,
    pub x: [f64; D],
    pub class: i32,
    pub time: u64,
}

impl<const D: usize> Eq for Offer<D> {}

impl<const D: usize> PartialOrd for Offer<D> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The one of a higher class is greater, then that with smaller ids: inputs that are near each
/// other have ids that are, so points of one class go in side by side.
impl<const D: usize> Ord for Offer<D> {
    fn cmp(&self, other: &Self) -> Ordering {
        let ids = |offer: &Self| (offer.sliver.vertices, offer.sliver.simplex);
        self.class.cmp(&other.class).then_with(|| ids(other).cmp(&ids(self)))
    }
}

/// The class of points that are worth `gain`: twice as much is one class more.
fn class(gain: f64) -> i32 {
    gain.log2().floor() as i32
}

/// Offers, the best first.
#[derive(Default)]
pub(super) struct Offers<const D: usize>(BinaryHeap<Offer<D>>);

impl<const D: usize> Offers<D> {
    fn push(&mut self, offer: Offer<D>) -> AllocResult<()> {
        if self.0.len() == self.0.capacity() {
            self.0.try_reserve(1)?;
        }
        self.0.push(offer);
        Ok(())
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// The next sliver to mend. Where none waits, points go in until one does.
    pub(super) fn next_sliver(
        &mut self,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<Option<Sliver>> {
        loop {
            if self.is_spent(slivers) {
                return Ok(None);
            }
            if let Some(sliver) = slivers.queue.pop() {
                return Ok(Some(sliver));
            }
            let Some(offer) = slivers.offers.0.pop() else { return Ok(None) };
            self.take_offer(&offer, slivers, cavity)?;
        }
    }

    /// Finds a point for `sliver`, which waits for another pass if there is none.
    pub(super) fn make_offer(
        &mut self,
        sliver: &Sliver,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let random = &mut Random::of(sliver, 0);
        let numbers = [1, POINTS];
        let points =
            self.best_insertions(sliver, numbers, slivers.least_gain, random, slivers, cavity)?;
        let time = self.now();
        match points.first() {
            Some(point) => {
                let class = class(point.gain);
                slivers.offers.push(Offer { sliver: *sliver, x: point.x, class, time })?;
            }
            None => slivers.queue.fail(*sliver)?,
        }
        Ok(())
    }

    /// Inserts the point of an offer if it is worth as much as it was. Moves come first where
    /// something has changed since.
    fn take_offer(
        &mut self,
        offer: &Offer<D>,
        slivers: &mut Slivers<D>,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let Offer { sliver, x, class: expected, time } = offer;
        if !self.is_current(sliver, &slivers.penalties) {
            return Ok(());
        }
        if sliver.vertices.iter().any(|&vertex| slivers.changed[vertex] > *time) {
            return Ok(slivers.queue.push(*sliver)?);
        }
        self.state.delaunay.find_cavity(sliver.simplex, x, cavity)?;
        let worth = self.judge_insertion(x, slivers.least_gain, slivers, cavity)?;
        if worth.is_none_or(|(gain, _)| class(gain) < *expected) {
            return self.make_offer(sliver, slivers, cavity);
        }
        self.insert_point(sliver.simplex, x, slivers, cavity)?;
        if self.is_current(sliver, &slivers.penalties) {
            slivers.queue.push(*sliver)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex::{SimplexId, VertexId};

    #[test]
    fn what_is_worth_more_comes_first_and_equals_by_place() {
        let offer = |gain, first: usize| {
            let vertices = [first, 7, 8, 9].map(VertexId::new);
            let sliver = Sliver { penalty: 1.5, simplex: SimplexId::new(first), vertices };
            Offer { sliver, x: [0.0; 3], class: class(gain), time: 0 }
        };
        let mut offers = Offers::default();
        for (gain, first) in [(3.9, 3), (2.1, 2), (0.001, 0), (8.0, 6), (7.9, 1)] {
            offers.push(offer(gain, first)).unwrap();
        }
        assert_eq!(offers.len(), 5);
        let all = std::iter::from_fn(|| offers.0.pop());
        let all: Vec<_> = all.map(|offer| offer.sliver.vertices[0].index()).collect();
        assert_eq!(all, [6, 1, 2, 3, 0]);
    }
}
