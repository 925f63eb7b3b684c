//! A growing array whose reserve can be split: partitions of a mesh grow in it, each in a stretch
//! of its own and on a thread of its own, and joining them does not copy.

use super::allocation::Allocation;
use super::pages::{give_back, prefer_large_pages};
use super::{AllocResult, TryGrow, copied, with_capacity};
use std::mem::{ManuallyDrop, MaybeUninit};
use std::ops::{Deref, DerefMut, Index, IndexMut};
use std::ptr::NonNull;
use std::slice::SliceIndex;

/// Size in bytes from which on the system can move an allocation by mapping it elsewhere.
const MAPPED: usize = 32 << 20;

/// Growing array of plain values, as `Vec` is. Its memory may be a stretch of a larger allocation,
/// whose other stretches belong to other arrays. Memory that a large array frees goes back to the
/// system at once, not only to the allocator.
///
/// The unsafe code relies on this: `[start, start + capacity)` lies in `allocation`, and no other
/// array has any of it ([`Array::split_reserve`] divides a stretch, [`Array::absorb`] joins two,
/// and growing makes a new one or has the allocation alone); its first `length` values are
/// initialised. Nothing else looks into `allocation` while it is shared.
pub struct Array<T> {
    start: NonNull<T>,
    length: usize,
    capacity: usize,
    /// Reference to the memory; `None` if the capacity is 0.
    allocation: Option<Allocation<T>>,
}

// SAFETY: the values in its stretch are the array's alone, as those of a `Vec` are; of
// `allocation` threads share the counter only, and whoever comes last frees the memory.
#[allow(unsafe_code)]
unsafe impl<T: Send> Send for Array<T> {}
// SAFETY: as above; a shared array gives out shared values only.
#[allow(unsafe_code)]
unsafe impl<T: Sync> Sync for Array<T> {}

impl<T: Copy> Default for Array<T> {
    fn default() -> Self {
        Self { start: NonNull::dangling(), length: 0, capacity: 0, allocation: None }
    }
}

impl<T: Copy> Array<T> {
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns an array of `length` times `value`.
    pub fn filled(length: usize, value: T) -> AllocResult<Self> {
        let mut array = Self::with_capacity(length)?;
        array.resize_within(length, value);
        Ok(array)
    }

    /// Returns a copy of `values`.
    pub fn copied(values: &[T]) -> AllocResult<Self> {
        let mut array = Self::new();
        array.try_extend(values)?;
        Ok(array)
    }

    /// Returns an empty array with a reserve for `capacity` values.
    pub fn with_capacity(capacity: usize) -> AllocResult<Self> {
        let mut array = Self::new();
        array.reserve(capacity)?;
        Ok(array)
    }

    /// Removes all but the first `length` values.
    pub fn truncate(&mut self, length: usize) {
        self.length = self.length.min(length);
    }

    /// Removes all but the first `length` values, and gives the pages of the others back to the
    /// system.
    #[allow(unsafe_code)]
    pub fn give_back_from(&mut self, length: usize) {
        let removed = self.length.saturating_sub(length);
        self.truncate(length);
        // SAFETY: as many values were there after `length`, within the stretch, which are spare
        // now.
        unsafe {
            let start = self.start.add(self.length).cast::<MaybeUninit<T>>();
            give_back(NonNull::slice_from_raw_parts(start, removed).as_mut());
        }
    }

    pub fn clear(&mut self) {
        self.length = 0;
    }

    /// Reserves memory for `additional` more values, at amortised cost.
    #[inline]
    pub fn reserve(&mut self, additional: usize) -> AllocResult<()> {
        if additional > self.capacity - self.length { self.grow(additional) } else { Ok(()) }
    }

    /// Reserves memory for `expected` values in all, if the system grants it: see
    /// [`super::expect`].
    pub fn expect(&mut self, expected: usize) {
        if expected > self.capacity {
            // Refused, it is asked for when it is needed.
            let _ = self.move_to(expected);
        }
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self, additional: usize) -> AllocResult<()> {
        let needed = self.length.saturating_add(additional);
        self.move_to(needed.max(self.length.saturating_mul(2)).max(4))
    }

    /// Moves the values to an allocation of their own, for `capacity` values.
    #[allow(unsafe_code)]
    fn move_to(&mut self, capacity: usize) -> AllocResult<()> {
        let own = self.allocation.as_mut().and_then(Allocation::exclusive);
        // The system may make a large allocation larger without moving what is there.
        let is_mapped = |memory: &[MaybeUninit<T>]| size_of_val(memory) >= MAPPED;
        let own = own.filter(|memory| memory.len() == self.capacity && is_mapped(memory));
        if let Some(memory) = own {
            memory.try_reserve_exact(capacity - memory.len())?;
            prefer_large_pages(memory, memory.capacity());
            // SAFETY: values that may be uninitialised need no initialisation.
            unsafe { memory.set_len(memory.capacity()) };
            self.capacity = memory.len();
            self.start = NonNull::from(memory.as_mut_slice()).cast();
            return Ok(());
        }
        let mut memory: Vec<MaybeUninit<T>> = with_capacity(capacity)?;
        memory.extend(self.iter().map(|&value| MaybeUninit::new(value)));
        // SAFETY: as above.
        unsafe { memory.set_len(memory.capacity()) };
        let (start, capacity) = (NonNull::from(memory.as_mut_slice()).cast(), memory.len());
        self.allocation = Some(Allocation::new(memory)?);
        (self.start, self.capacity) = (start, capacity);
        Ok(())
    }

    /// Appends `value` if `condition` holds, without a branch. There must be room in the reserve in
    /// any case.
    ///
    /// This is the branch-free idiom of the hot loops. A processor guesses which way a branch goes,
    /// and a wrong guess costs as much time as some 20 instructions. No processor can guess if a
    /// simplex is in conflict, a vertex is new or a neighbor is nearer. So the loops do the work of
    /// both ways and the condition only selects a value: here the value is always written, and the
    /// length grows by one or by zero. That pays where the condition is unpredictable and the work
    /// is a few instructions; a branch that nearly always goes the same way is cheaper.
    #[inline(always)]
    pub fn push_if(&mut self, condition: bool, value: T) {
        assert!(self.length < self.capacity, "it is reserved before");
        // SAFETY: within the stretch, by the assertion.
        #[allow(unsafe_code)]
        unsafe {
            self.start.add(self.length).write(value);
        }
        self.length += usize::from(condition);
    }

    /// Appends `value` until there are `length` values, for which there must be room in the
    /// reserve.
    #[inline]
    pub fn resize_within(&mut self, length: usize, value: T) {
        assert!(length <= self.capacity, "it is reserved before");
        for at in self.length..length {
            // SAFETY: within the stretch, by the assertion.
            #[allow(unsafe_code)]
            unsafe {
                self.start.add(at).write(value);
            }
        }
        self.length = self.length.max(length);
    }

    /// Returns the values as a vector. They are not copied if they have an allocation of their own.
    #[allow(unsafe_code)]
    pub fn into_vec(mut self) -> AllocResult<Vec<T>> {
        let (start, length, capacity) = (self.start, self.length, self.capacity);
        let own = self.allocation.as_mut().and_then(Allocation::exclusive);
        match own.filter(|memory| memory.len() == capacity) {
            Some(memory) => {
                let memory = ManuallyDrop::new(std::mem::take(memory));
                // SAFETY: the stretch is all that the vector has, so it begins where that does;
                // values that may be uninitialised are laid out as others, and so many are
                // initialised.
                Ok(unsafe { Vec::from_raw_parts(start.as_ptr(), length, memory.capacity()) })
            }
            None => copied(&self),
        }
    }

    /// Returns the number of values that fit in the reserve.
    pub fn spare(&self) -> usize {
        self.capacity - self.length
    }

    /// Splits the reserve among empty arrays: `reserves` has the number of values for each. The
    /// last gets the remainder as well. Returns `None` if the reserve is too small.
    #[allow(unsafe_code)]
    pub fn split_reserve(&mut self, reserves: &[usize]) -> Option<Vec<Self>> {
        let spare = self.spare();
        let needed = reserves.iter().try_fold(0usize, |sum, &reserve| sum.checked_add(reserve))?;
        let mut shares: Vec<Self> = with_capacity(reserves.len()).ok()?;
        if needed > spare || reserves.is_empty() {
            return None;
        }
        let mut offset = self.length;
        self.capacity = self.length;
        for &capacity in reserves {
            // SAFETY: at most `needed` after `length`, so within the stretch that this array had,
            // which ends at `length` now; and after the arrays before.
            let start = unsafe { self.start.add(offset) };
            shares.push(Self { start, length: 0, capacity, allocation: self.allocation.clone() });
            offset += capacity;
        }
        if let Some(last) = shares.last_mut() {
            last.capacity += spare - needed;
        }
        Some(shares)
    }

    /// Moves the values to the reserve of `share`, which must be empty.
    pub fn move_into(&mut self, mut share: Self) -> AllocResult<()> {
        share.try_extend(self)?;
        *self = share;
        Ok(())
    }

    /// Appends the values of `other`. If `other` has the stretch after this array's, both stretches
    /// become one, without copying.
    #[allow(unsafe_code)]
    pub fn absorb(&mut self, other: Self) -> AllocResult<()> {
        let is_shared = match (&self.allocation, &other.allocation) {
            (Some(own), Some(others)) => own.is_same(others),
            _ => false,
        };
        let is_next =
            is_shared && self.start.as_ptr().wrapping_add(self.capacity) == other.start.as_ptr();
        if !is_next {
            return self.try_extend(&other);
        }
        // SAFETY: the two stretches are one now, and `other` ends here without touching its values.
        // They move towards the start of it, to where they may overlap with themselves. What they
        // leave is spare.
        unsafe {
            let end = self.start.add(self.length);
            if end != other.start {
                other.start.copy_to(end, other.length);
                let left = self.capacity - self.length;
                let left = left.min(other.length);
                let start = other.start.add(other.length - left).cast::<MaybeUninit<T>>();
                give_back(NonNull::slice_from_raw_parts(start, left).as_mut());
            }
        }
        self.length += other.length;
        self.capacity += other.capacity;
        Ok(())
    }
}

impl<T: Copy> TryGrow<T> for Array<T> {
    #[inline]
    fn try_push(&mut self, value: T) -> AllocResult<()> {
        self.reserve(1)?;
        self.resize_within(self.length + 1, value);
        Ok(())
    }

    #[allow(unsafe_code)]
    fn try_extend(&mut self, values: &[T]) -> AllocResult<()> {
        self.reserve(values.len())?;
        let values_start = NonNull::from(values).cast::<T>();
        // SAFETY: they fit in the reserve, in which no other array's values are.
        unsafe { values_start.copy_to_nonoverlapping(self.start.add(self.length), values.len()) };
        self.length += values.len();
        Ok(())
    }

    #[inline]
    fn cover(&mut self, length: usize, value: T) -> AllocResult<()> {
        if self.length < length {
            self.reserve(length - self.length)?;
            self.resize_within(length, value);
        }
        Ok(())
    }
}

impl<T> Deref for Array<T> {
    type Target = [T];

    #[inline(always)]
    #[allow(unsafe_code)]
    fn deref(&self) -> &[T] {
        // SAFETY: so many values are initialised from there on, and only this array has them.
        unsafe { std::slice::from_raw_parts(self.start.as_ptr(), self.length) }
    }
}

impl<T, I: SliceIndex<[T]>> Index<I> for Array<T> {
    type Output = I::Output;

    #[inline(always)]
    fn index(&self, index: I) -> &I::Output {
        &(**self)[index]
    }
}

impl<T, I: SliceIndex<[T]>> IndexMut<I> for Array<T> {
    #[inline(always)]
    fn index_mut(&mut self, index: I) -> &mut I::Output {
        &mut (**self)[index]
    }
}

impl<'a, T> IntoIterator for &'a Array<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T> DerefMut for Array<T> {
    #[inline(always)]
    #[allow(unsafe_code)]
    fn deref_mut(&mut self) -> &mut [T] {
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts_mut(self.start.as_ptr(), self.length) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(values: std::ops::Range<u32>) -> Array<u32> {
        let mut array = Array::new();
        values.for_each(|value| array.try_push(value).unwrap());
        array
    }

    #[test]
    fn it_grows_as_a_vector_does() {
        let mut array = filled(0..1000);
        assert_eq!(*array, Vec::from_iter(0..1000)[..]);
        array.cover(1003, 7).unwrap();
        array.cover(10, 8).unwrap();
        assert_eq!(array[998..], [998, 999, 7, 7, 7]);
        array[1000] = 5;
        array.expect(5000);
        array.try_extend(&[1, 2]).unwrap();
        assert_eq!(array[999..], [999, 5, 7, 7, 1, 2]);
        array.clear();
        assert!(array.is_empty());
        assert!(array.reserve(usize::MAX / 4).is_err());
        array.try_push(3).unwrap();
        assert_eq!(*array, [3]);
    }

    #[test]
    fn what_is_not_wanted_leaves_no_trace() {
        let mut array = filled(0..2);
        array.reserve(2).unwrap();
        for (value, condition) in [(7, false), (8, true), (9, false), (10, true), (11, false)] {
            array.reserve(1).unwrap();
            array.push_if(condition, value);
        }
        assert_eq!(*array, [0, 1, 8, 10]);
    }

    #[test]
    #[should_panic = "it is reserved before"]
    fn nothing_is_written_beyond_the_reserve() {
        let mut shares = filled(0..3).split_reserve(&[0]);
        // Whatever is left is the last one's.
        let last = shares.as_mut().unwrap().last_mut().unwrap();
        for _ in 0..=last.spare() {
            last.push_if(true, 1);
        }
    }

    #[test]
    fn what_was_split_off_comes_back_in_its_place() {
        let mut array = filled(0..3);
        array.expect(100);
        let start = array.as_ptr();
        let mut shares = array.split_reserve(&[10, 20, 30]).unwrap();
        assert!(array.split_reserve(&[1]).is_none());
        std::thread::scope(|scope| {
            for (at, share) in shares.iter_mut().enumerate() {
                scope.spawn(move || {
                    (0..5 + at as u32).for_each(|i| share.try_push(10 * at as u32 + i).unwrap());
                });
            }
        });
        for share in shares {
            array.absorb(share).unwrap();
        }
        let expected: Vec<u32> = (0..3).chain(0..5).chain(10..16).chain(20..27).collect();
        assert_eq!(*array, expected[..]);
        assert_eq!(array.as_ptr(), start);
        array.cover(100, 1).unwrap();
        assert_eq!(array.as_ptr(), start);
    }

    #[test]
    fn it_becomes_a_vector_in_its_place_where_it_has_an_allocation_of_its_own() {
        assert!(Array::<u32>::new().into_vec().unwrap().is_empty());
        let mut array = filled(0..3);
        array.expect(100);
        let start = array.as_ptr();
        let mut shares = array.split_reserve(&[10, 20]).unwrap();
        shares.iter_mut().for_each(|share| share.try_push(7).unwrap());
        let last = shares.pop().unwrap();
        array.absorb(shares.pop().unwrap()).unwrap();
        let mut copy = last.into_vec().unwrap();
        copy.push(8);
        assert_eq!(copy, [7, 8]);
        let vec = array.into_vec().unwrap();
        assert_eq!(vec, [0, 1, 2, 7]);
        assert_ne!(vec.as_ptr(), start);
        let mut array = filled(0..1000);
        array.expect(3000);
        let shares = array.split_reserve(&[500]).unwrap();
        shares.into_iter().for_each(|share| array.absorb(share).unwrap());
        let start = array.as_ptr();
        let mut vec = array.into_vec().unwrap();
        assert!(vec.as_ptr() == start && vec.capacity() >= 3000);
        vec.push(5);
        assert_eq!(vec[998..], [998, 999, 5]);
    }

    /// Only spare memory goes back to the system: its pages hold nothing afterwards.
    #[test]
    fn only_what_is_spare_goes_back_to_the_system() {
        // Miri would take hours, and nothing goes back there.
        let unit: u32 = if cfg!(miri) { 1 } else { 1000 };
        let units = |count: u32| (count * unit) as usize;
        let mut array = filled(0..7);
        array.expect(units(1700));
        let mut shares = array.split_reserve(&[units(800), units(800)]).unwrap();
        for (at, count) in [(0, 350), (1, 790)] {
            (0..count * unit).for_each(|i| shares[at].try_push(i).unwrap());
        }
        for share in shares {
            array.absorb(share).unwrap();
        }
        let expected = || (0..7).chain(0..350 * unit).chain(0..790 * unit);
        let known = 7 + units(1140);
        assert!(array.iter().copied().eq(expected()));
        array.cover(units(1600), 9).unwrap();
        assert!(array.iter().copied().take(known).eq(expected()));
        assert!(array[known..].iter().all(|&value| value == 9));
        // Neighbours of what is freed stay.
        let arrays: Vec<_> = (0..8).map(|at| Array::filled(units(300), at).unwrap()).collect();
        let odd: Vec<_> = arrays.into_iter().filter(|array| array[0] % 2 == 1).collect();
        assert!(odd.iter().zip(0..).all(|(odd, at)| odd.iter().all(|&value| value == 2 * at + 1)));
    }

    #[test]
    fn what_is_given_back_is_spare_and_the_rest_stays() {
        // As above.
        let unit: u32 = if cfg!(miri) { 1 } else { 1000 };
        let count = 900 * unit;
        let mut array = filled(0..count);
        let capacity = array.len() + array.spare();
        for length in [count + 1, 500 * unit, 500 * unit - 1, 3] {
            array.give_back_from(length as usize);
            assert!(array.iter().copied().eq(0..length.min(count)));
            assert_eq!(array.len() + array.spare(), capacity);
        }
        array.cover(count as usize, 9).unwrap();
        let others = std::iter::repeat_n(9, count as usize - 3);
        assert!(array.iter().copied().eq((0..3).chain(others)));
    }

    #[test]
    fn a_stretch_that_is_not_the_next_is_copied() {
        let mut array = filled(0..3);
        array.expect(40);
        let mut shares = array.split_reserve(&[5, 5]).unwrap();
        let mut last = shares.pop().unwrap();
        last.try_extend(&[7, 8]).unwrap();
        array.absorb(last).unwrap();
        shares[0].try_extend(&[1, 1, 1, 1, 1]).unwrap();
        assert_eq!(*array, [0, 1, 2, 7, 8]);
        array.absorb(shares.pop().unwrap()).unwrap();
        assert_eq!(*array, [0, 1, 2, 7, 8, 1, 1, 1, 1, 1]);
    }

    #[test]
    fn what_outgrew_its_reserve_comes_back_too() {
        let mut array = filled(0..3);
        array.expect(20);
        let mut shares = array.split_reserve(&[2, 2]).unwrap();
        (0..50).for_each(|i| shares[0].try_push(i).unwrap());
        shares[1].try_push(99).unwrap();
        // The array may grow meanwhile, too.
        array.try_push(3).unwrap();
        for share in shares {
            array.absorb(share).unwrap();
        }
        let expected: Vec<u32> = (0..4).chain(0..50).chain([99]).collect();
        assert_eq!(*array, expected[..]);
    }

    #[test]
    fn a_reserve_that_is_too_small_is_not_split() {
        let mut array = filled(0..4);
        array.expect(10);
        let spare = array.capacity - 4;
        assert!(array.split_reserve(&[spare, 1]).is_none());
        assert!(array.split_reserve(&[usize::MAX, 2]).is_none());
        assert!(array.split_reserve(&[]).is_none());
        assert_eq!(array.split_reserve(&[spare]).unwrap().len(), 1);
        assert!(Array::<u32>::new().split_reserve(&[0]).is_some_and(|shares| shares[0].is_empty()));
    }
}
