//! Memory shared by several arrays, each with a stretch of it; the last of them frees it.

use super::pages::give_back;
use super::{AllocResult, with_capacity};
use std::mem::{ManuallyDrop, MaybeUninit};
use std::ptr::NonNull;
use std::sync::atomic::{AtomicUsize, Ordering, fence};

/// Reference to memory that several arrays share. `Arc` would do, if its allocation could be
/// refused.
pub(super) struct Allocation<T> {
    shared: NonNull<Shared<T>>,
}

struct Shared<T> {
    /// Number of references to this memory: one of each array with a stretch.
    holders: AtomicUsize,
    memory: Vec<MaybeUninit<T>>,
    /// Capacity of the vector whose only element this is.
    capacity: usize,
}

impl<T> Allocation<T> {
    pub fn new(memory: Vec<MaybeUninit<T>>) -> AllocResult<Self> {
        let mut holder = with_capacity(1)?;
        let capacity = holder.capacity();
        holder.push(Shared { holders: AtomicUsize::new(1), memory, capacity });
        let mut holder = ManuallyDrop::new(holder);
        Ok(Self { shared: NonNull::from(&mut holder[0]) })
    }

    pub fn is_same(&self, other: &Self) -> bool {
        self.shared == other.shared
    }

    /// Returns the memory if no other array has a stretch of it, else `None`.
    #[allow(unsafe_code)]
    pub fn exclusive(&mut self) -> Option<&mut Vec<MaybeUninit<T>>> {
        // SAFETY: it lives as long as an allocation points to it. If this is the only one nobody
        // else can reach it, nor make another one meanwhile; what others did to it came before they
        // let go.
        unsafe {
            let is_alone = self.shared.as_ref().holders.load(Ordering::Acquire) == 1;
            // Not before that is known.
            if is_alone { Some(&mut self.shared.as_mut().memory) } else { None }
        }
    }
}

impl<T> Clone for Allocation<T> {
    #[allow(unsafe_code)]
    fn clone(&self) -> Self {
        // SAFETY: it lives as long as an allocation points to it.
        unsafe { self.shared.as_ref() }.holders.fetch_add(1, Ordering::Relaxed);
        Self { shared: self.shared }
    }
}

impl<T> Drop for Allocation<T> {
    #[allow(unsafe_code)]
    fn drop(&mut self) {
        // SAFETY: it lives as long as an allocation points to it. The last one takes it down, after
        // all that others did: it is the one element of a vector of that capacity.
        unsafe {
            if self.shared.as_ref().holders.fetch_sub(1, Ordering::Release) == 1 {
                fence(Ordering::Acquire);
                give_back(&mut self.shared.as_mut().memory);
                let capacity = self.shared.as_ref().capacity;
                drop(Vec::from_raw_parts(self.shared.as_ptr(), 1, capacity));
            }
        }
    }
}
