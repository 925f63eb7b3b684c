//! Memory that may be refused: what grows with the input grows through this module, since `Vec`
//! ends the process where the system has no more.

use netmesh::{Error, ErrorKind, Result};

/// Allocates nothing: there may be nothing left.
pub fn out_of_memory() -> Error {
    Error::new(ErrorKind::OutOfMemory, "an allocation failed")
}

/// Returns an empty vector with a reserve for exactly `capacity` elements.
pub fn with_capacity<T>(capacity: usize) -> Result<Vec<T>> {
    let mut vec = Vec::new();
    vec.try_reserve_exact(capacity).map_err(|_| out_of_memory())?;
    Ok(vec)
}

/// Returns `vec![value; length]`.
pub fn filled<T: Clone>(length: usize, value: T) -> Result<Vec<T>> {
    let mut vec = with_capacity(length)?;
    vec.resize(length, value);
    Ok(vec)
}

/// Returns `iterator.collect()`; exact where the iterator knows its length.
pub fn collected<T>(iterator: impl IntoIterator<Item = T>) -> Result<Vec<T>> {
    let iterator = iterator.into_iter();
    let mut vec = with_capacity(iterator.size_hint().0)?;
    for value in iterator {
        vec.try_push(value)?;
    }
    Ok(vec)
}

/// Returns a copy of `values`.
pub fn copied<T: Copy>(values: &[T]) -> Result<Vec<T>> {
    let mut vec = with_capacity(values.len())?;
    vec.extend_from_slice(values);
    Ok(vec)
}

/// Growth that is refused instead of fatal, amortised as that of `Vec`.
pub trait TryGrow<T> {
    fn try_push(&mut self, value: T) -> Result<()>;
    fn try_extend(&mut self, values: &[T]) -> Result<()>
    where
        T: Copy;
}

impl<T> TryGrow<T> for Vec<T> {
    fn try_push(&mut self, value: T) -> Result<()> {
        if self.len() == self.capacity() {
            self.try_reserve(1).map_err(|_| out_of_memory())?;
        }
        self.push(value);
        Ok(())
    }

    fn try_extend(&mut self, values: &[T]) -> Result<()>
    where
        T: Copy,
    {
        self.try_reserve(values.len()).map_err(|_| out_of_memory())?;
        self.extend_from_slice(values);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_had_is_refused() {
        assert_eq!(with_capacity::<u64>(usize::MAX / 4).unwrap_err(), out_of_memory());
        assert_eq!(filled(usize::MAX, 0u64).unwrap_err(), out_of_memory());
        let mut vec = collected(0..3).unwrap();
        vec.try_push(3).unwrap();
        vec.try_extend(&[4, 5]).unwrap();
        assert_eq!(vec, [0, 1, 2, 3, 4, 5]);
    }
}
