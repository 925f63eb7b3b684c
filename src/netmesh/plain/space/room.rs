//! Places of dead tetrahedra, where new ones can be made.

use crate::memory::{AllocResult, TryGrow};
use std::ops::Range;

/// Places that one thread may use.
#[derive(Default)]
pub(super) struct Room {
    places: Vec<u32>,
    ranges: Vec<Range<u32>>,
    size: usize,
}

impl Room {
    /// Returns the number of places.
    #[inline]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Returns the number of places that [`Self::split`] can take.
    pub fn in_ranges(&self) -> usize {
        self.size - self.places.len()
    }

    pub fn add(&mut self, place: u32) -> AllocResult<()> {
        self.size += 1;
        self.places.try_push(place)
    }

    pub fn add_range(&mut self, range: Range<u32>) -> AllocResult<()> {
        self.size += range.len();
        self.ranges.try_push(range)
    }

    #[inline]
    pub fn take(&mut self) -> Option<u32> {
        let place = self.places.pop().or_else(|| self.take_from_ranges())?;
        self.size -= 1;
        Some(place)
    }

    fn take_from_ranges(&mut self) -> Option<u32> {
        while let Some(range) = self.ranges.last_mut() {
            match range.next() {
                Some(place) => return Some(place),
                None => self.ranges.pop(),
            };
        }
        None
    }

    /// Takes ranges and parts of them with so many places, or all that there are.
    pub fn split(&mut self, mut count: usize) -> AllocResult<Self> {
        let mut part = Self::default();
        while count > 0 {
            let Some(range) = self.ranges.last_mut() else { break };
            let taken = range.start..range.end.min(range.start + count as u32);
            range.start = taken.end;
            if range.start == range.end {
                self.ranges.pop();
            }
            count -= taken.len();
            self.size -= taken.len();
            part.add_range(taken)?;
        }
        Ok(part)
    }

    /// Adds all places of another room.
    pub fn join(&mut self, other: Self) -> AllocResult<()> {
        self.size += other.size;
        self.places.try_extend(&other.places)?;
        for range in other.ranges {
            self.ranges.try_push(range)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_taken_once() {
        let mut room = Room::default();
        room.add_range(10..20).unwrap();
        room.add_range(5..5).unwrap();
        room.add_range(40..50).unwrap();
        room.add(3).unwrap();
        let mut part = room.split(13).unwrap();
        assert_eq!((room.size(), part.size()), (8, 13));
        let mut all: Vec<u32> = std::iter::from_fn(|| room.take()).collect();
        assert_eq!((all.len(), room.size()), (8, 0));
        all.extend(std::iter::from_fn(|| part.take()).take(6));
        part.add(100).unwrap();
        room.join(part).unwrap();
        assert_eq!(room.size(), 8);
        assert_eq!(room.split(100).unwrap().size() + room.size(), 8);
    }
}
