//! A `Box` whose memory may be refused.

use crate::memory::{AllocResult, with_capacity};
use std::ops::{Deref, DerefMut};

/// Value in memory of its own. `Box::new` ends the process if there is no memory; the array is what
/// the standard library makes of a vector without another allocation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Boxed<T>(Box<[T; 1]>);

impl<T> Boxed<T> {
    pub fn new(value: T) -> AllocResult<Self> {
        let mut one = with_capacity(1)?;
        one.push(value);
        match one.try_into() {
            Ok(array) => Ok(Self(array)),
            Err(_) => unreachable!("one value is one value"),
        }
    }
}

impl<T> Deref for Boxed<T> {
    type Target = T;

    fn deref(&self) -> &T {
        let [value] = &*self.0;
        value
    }
}

impl<T> DerefMut for Boxed<T> {
    fn deref_mut(&mut self) -> &mut T {
        let [value] = &mut *self.0;
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_its_value() {
        let mut boxed = Boxed::new(vec![1, 2]).unwrap();
        boxed.push(3);
        let copy = boxed.clone();
        boxed.clear();
        assert_eq!((&*boxed, &*copy), (&vec![], &vec![1, 2, 3]));
        assert!(Boxed::new(()).is_ok());
    }
}
