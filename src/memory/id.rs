//! Ids with a type for each kind of thing. Vertices and simplices are both known by 32-bit numbers;
//! as ids of two types neither is mistaken for the other.

use super::Array;
use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::marker::PhantomData;
use std::ops::{Index, IndexMut, Range};

/// Id of a thing of the kind that the empty type `Of` stands for. In memory an id is its number, so
/// that it costs nothing.
#[repr(transparent)]
pub struct Id<Of> {
    number: u32,
    of: PhantomData<Of>,
}

impl<Of> Id<Of> {
    /// Id of nothing.
    pub const NONE: Self = Self::from_number(u32::MAX);

    /// Returns the id of the thing at position `index` in an array of all. The index must fit in 32
    /// bits.
    #[inline(always)]
    pub const fn new(index: usize) -> Self {
        Self::from_number(index as u32)
    }

    #[inline(always)]
    pub const fn from_number(number: u32) -> Self {
        Self { number, of: PhantomData }
    }

    #[inline(always)]
    pub const fn number(self) -> u32 {
        self.number
    }

    /// Returns the position in an array of all things of this kind.
    #[inline(always)]
    pub const fn index(self) -> usize {
        self.number as usize
    }

    /// Returns true unless this is the id of nothing.
    #[inline(always)]
    pub const fn is_valid(self) -> bool {
        self.number != Self::NONE.number
    }

    /// Returns the ids below `bound`, ascending.
    #[inline]
    pub fn below(bound: usize) -> impl ExactSizeIterator<Item = Self> + Clone {
        Self::range(0..bound)
    }

    #[inline]
    pub fn range(range: Range<usize>) -> impl ExactSizeIterator<Item = Self> + Clone {
        (range.start as u32..range.end as u32).map(Self::from_number)
    }

    /// Returns `numbers` as ids, without copying.
    #[inline(always)]
    #[allow(unsafe_code)]
    pub fn from_numbers(numbers: &[u32]) -> &[Self] {
        // SAFETY: an id is a transparent number, so it has the layout of one, and every number is
        // that of an id.
        unsafe { &*(std::ptr::from_ref(numbers) as *const [Self]) }
    }

    /// Returns `numbers` as mutable ids, without copying.
    #[inline(always)]
    #[allow(unsafe_code)]
    pub fn from_numbers_mut(numbers: &mut [u32]) -> &mut [Self] {
        // SAFETY: as above; every id is a number too.
        unsafe { &mut *(std::ptr::from_mut(numbers) as *mut [Self]) }
    }
}

// Not derived: that would ask for the same of `Of`.
impl<Of> Clone for Id<Of> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<Of> Copy for Id<Of> {}

impl<Of> PartialEq for Id<Of> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

impl<Of> Eq for Id<Of> {}

impl<Of> PartialOrd for Id<Of> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<Of> Ord for Id<Of> {
    #[inline(always)]
    fn cmp(&self, other: &Self) -> Ordering {
        self.number.cmp(&other.number)
    }
}

impl<Of> Hash for Id<Of> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.number.hash(state);
    }
}

impl<Of> fmt::Debug for Id<Of> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.is_valid() {
            true => self.number.fmt(formatter),
            false => formatter.write_str("none"),
        }
    }
}

impl<T, Of> Index<Id<Of>> for [T] {
    type Output = T;

    #[inline(always)]
    fn index(&self, id: Id<Of>) -> &T {
        &self[id.index()]
    }
}

impl<T, Of> IndexMut<Id<Of>> for [T] {
    #[inline(always)]
    fn index_mut(&mut self, id: Id<Of>) -> &mut T {
        &mut self[id.index()]
    }
}

impl<T, Of> Index<Id<Of>> for Vec<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, id: Id<Of>) -> &T {
        &self[id.index()]
    }
}

impl<T, Of> IndexMut<Id<Of>> for Vec<T> {
    #[inline(always)]
    fn index_mut(&mut self, id: Id<Of>) -> &mut T {
        &mut self[id.index()]
    }
}

impl<T, Of> Index<Id<Of>> for Array<T> {
    type Output = T;

    #[inline(always)]
    fn index(&self, id: Id<Of>) -> &T {
        &self[id.index()]
    }
}

impl<T, Of> IndexMut<Id<Of>> for Array<T> {
    #[inline(always)]
    fn index_mut(&mut self, id: Id<Of>) -> &mut T {
        &mut self[id.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    enum Thing {}
    type ThingId = Id<Thing>;

    #[test]
    fn ids_are_their_numbers_in_memory() {
        assert_eq!((size_of::<ThingId>(), align_of::<ThingId>()), (4, 4));
        let mut numbers = [3, u32::MAX, 0];
        let ids = [ThingId::new(3), ThingId::NONE, ThingId::from_number(0)];
        assert_eq!(*ThingId::from_numbers(&numbers), ids);
        ThingId::from_numbers_mut(&mut numbers)[1] = ThingId::new(7);
        assert_eq!(numbers, [3, 7, 0]);
        assert!(ThingId::from_numbers(&[]).is_empty());
    }

    #[test]
    fn ids_are_ordered_as_their_numbers() {
        let ids: Vec<ThingId> = ThingId::below(3).chain(ThingId::range(7..9)).collect();
        assert_eq!(ids.iter().map(|id| id.number()).collect::<Vec<_>>(), [0, 1, 2, 7, 8]);
        assert!(ids.is_sorted() && ids[4] < ThingId::NONE);
        assert!(ids.iter().all(|id| id.is_valid()) && !ThingId::NONE.is_valid());
        assert_eq!(format!("{:?}", [ids[3], ThingId::NONE]), "[7, none]");
    }

    #[test]
    fn arrays_are_indexed_by_ids() {
        let id = ThingId::new(1);
        let mut array = Array::copied(&[5, 6, 7]).unwrap();
        let mut vec = Vec::from([5, 6, 7]);
        array[id] += 10;
        vec[id] += 10;
        assert_eq!((array[id], vec[id], vec[1..][id]), (16, 16, 7));
    }
}
