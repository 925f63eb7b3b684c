//! Allocation that may be refused. `Vec` ends the process when the system has no more memory;
//! arrays that grow with the input grow through this module instead, which returns an
//! [`AllocError`].

mod allocation;
mod array;
mod buckets;
mod id;
mod lists;
mod pages;
mod prefetch;
mod sets;

use crate::error::{Error, ErrorKind};
pub use array::Array;
pub(crate) use buckets::sorted_in_buckets;
pub use id::Id;
pub use lists::Lists;
use pages::prefer_large_pages;
pub use pages::{provide, spare_pieces};
pub use prefetch::{prefetch, prefetch_at};
pub use sets::Sets;
use std::collections::{TryReserveError, VecDeque};

/// Resource that ran out. It takes one byte: results that carry it cost as much as a `bool`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AllocError {
    /// Memory, which the allocator refused.
    Memory,
    /// Ids of 32 bits, for simplices or domains.
    Ids,
}

pub type AllocResult<T> = std::result::Result<T, AllocError>;

impl From<TryReserveError> for AllocError {
    fn from(_: TryReserveError) -> Self {
        Self::Memory
    }
}

impl From<AllocError> for Error {
    /// Makes the error without an allocation, since there may be no memory left.
    fn from(error: AllocError) -> Self {
        match error {
            AllocError::Memory => Self::new(ErrorKind::OutOfMemory, "an allocation failed"),
            AllocError::Ids => Self::new(
                ErrorKind::Limit,
                "the mesh needs more simplices than 32-bit ids can name",
            ),
        }
    }
}

/// Growth that may be refused instead of ending the process, at the amortised cost of `Vec`'s.
pub trait TryGrow<T> {
    fn try_push(&mut self, value: T) -> AllocResult<()>;
    fn try_extend(&mut self, values: &[T]) -> AllocResult<()>
    where
        T: Copy;
    /// Appends `value` until there are `length` elements; never shortens.
    fn cover(&mut self, length: usize, value: T) -> AllocResult<()>
    where
        T: Clone;
}

impl<T> TryGrow<T> for Vec<T> {
    #[inline]
    fn try_push(&mut self, value: T) -> AllocResult<()> {
        reserve(self, 1)?;
        self.push(value);
        Ok(())
    }

    #[inline]
    fn try_extend(&mut self, values: &[T]) -> AllocResult<()>
    where
        T: Copy,
    {
        reserve(self, values.len())?;
        self.extend_from_slice(values);
        Ok(())
    }

    #[inline]
    fn cover(&mut self, length: usize, value: T) -> AllocResult<()>
    where
        T: Clone,
    {
        if self.len() < length {
            reserve(self, length - self.len())?;
            self.resize(length, value);
        }
        Ok(())
    }
}

/// Reserves memory for `additional` more elements, at amortised cost.
#[inline]
pub fn reserve<T>(vec: &mut Vec<T>, additional: usize) -> AllocResult<()> {
    if additional > vec.capacity() - vec.len() { grow(vec, additional) } else { Ok(()) }
}

#[cold]
#[inline(never)]
fn grow<T>(vec: &mut Vec<T>, additional: usize) -> AllocResult<()> {
    vec.try_reserve(additional)?;
    prefer_large_pages(vec, vec.capacity());
    Ok(())
}

/// Reserves memory for `expected` elements in all, if the system grants it. Growing later would
/// move the elements, which takes tenths of a second for the arrays of millions of simplices.
pub fn expect<T>(vec: &mut Vec<T>, expected: usize) {
    let additional = expected.saturating_sub(vec.len());
    if vec.try_reserve_exact(additional).is_ok() {
        prefer_large_pages(vec, vec.capacity());
    }
}

/// Appends to a queue, as [`TryGrow::try_push`] does to a vector.
#[inline]
pub fn enqueue<T>(queue: &mut VecDeque<T>, value: T) -> AllocResult<()> {
    if queue.len() == queue.capacity() {
        queue.try_reserve(1)?;
    }
    queue.push_back(value);
    Ok(())
}

/// Returns an empty vector with a reserve for exactly `capacity` elements.
pub fn with_capacity<T>(capacity: usize) -> AllocResult<Vec<T>> {
    let mut vec = Vec::new();
    vec.try_reserve_exact(capacity)?;
    prefer_large_pages(&vec, capacity);
    Ok(vec)
}

/// Returns a vector of `length` times `value`, as `vec![value; length]` does.
pub fn filled<T: Clone>(length: usize, value: T) -> AllocResult<Vec<T>> {
    let mut vec = with_capacity(length)?;
    vec.resize(length, value);
    Ok(vec)
}

/// Collects the items of an iterator, without spare capacity if the iterator knows its length.
pub fn collected<T>(iterator: impl IntoIterator<Item = T>) -> AllocResult<Vec<T>> {
    let iterator = iterator.into_iter();
    let mut vec = with_capacity(iterator.size_hint().0)?;
    for value in iterator {
        vec.try_push(value)?;
    }
    Ok(vec)
}

/// Returns a copy of `values` as a vector.
pub fn copied<T: Copy>(values: &[T]) -> AllocResult<Vec<T>> {
    let mut vec = with_capacity(values.len())?;
    vec.extend_from_slice(values);
    Ok(vec)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_had_is_refused() {
        assert_eq!(with_capacity::<u64>(usize::MAX / 4).unwrap_err(), AllocError::Memory);
        assert_eq!(filled(usize::MAX, 0u64).unwrap_err(), AllocError::Memory);
        let mut vec = vec![1u64];
        assert_eq!(vec.cover(usize::MAX / 4, 0), Err(AllocError::Memory));
        assert_eq!(vec, [1]);
    }

    #[test]
    fn what_can_be_had_is_as_with_vec() {
        let mut vec = collected(0..3).unwrap();
        vec.try_push(3).unwrap();
        vec.try_extend(&[4, 5]).unwrap();
        vec.cover(8, 9).unwrap();
        vec.cover(2, 7).unwrap();
        assert_eq!(vec, [0, 1, 2, 3, 4, 5, 9, 9]);
        let (filled, copy) = (filled(2, 4u8).unwrap(), copied(&vec).unwrap());
        assert_eq!((filled, copy), (vec![4, 4], vec));
        let mut queue = VecDeque::new();
        (0..9).for_each(|i| enqueue(&mut queue, i).unwrap());
        assert!(queue.into_iter().eq(0..9));
    }

    #[test]
    fn an_allocation_error_has_its_status() {
        assert_eq!(Error::from(AllocError::Memory).kind(), ErrorKind::OutOfMemory);
        assert_eq!(Error::from(AllocError::Ids).kind(), ErrorKind::Limit);
    }
}
