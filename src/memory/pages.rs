//! Requests of large arrays to the system. Large pages: with pages of 4 KiB the system needs some
//! 0.1 ms to take back each MiB, which a cancelled run would wait for, and as much again to provide
//! it. And to take back free pages: an allocator keeps those before memory that is in use.

use std::mem::MaybeUninit;

/// Size in bytes from which on arrays ask for large pages.
const LARGE: usize = 4 << 20;
/// Least size and alignment of large pages, in bytes.
const LARGE_PAGE: usize = 2 << 20;

/// Size in bytes from which on memory is given back.
const GIVEN_BACK: usize = 1 << 20;

/// Asks for large pages under the `capacity` of `vec`, if the system has them.
pub(super) fn prefer_large_pages<T>(vec: &[T], capacity: usize) {
    let bytes = capacity * size_of::<T>();
    if bytes >= LARGE {
        let begin = (vec.as_ptr() as usize).next_multiple_of(LARGE_PAGE);
        let end = (vec.as_ptr() as usize + bytes) / LARGE_PAGE * LARGE_PAGE;
        system::prefer_large(begin, end.saturating_sub(begin));
    }
}

/// Gives the pages of `memory` back to the system; the values in it are lost.
pub(super) fn give_back<T>(memory: &mut [MaybeUninit<T>]) {
    if size_of_val(memory) >= GIVEN_BACK {
        system::give_back(memory);
    }
}

#[cfg(all(target_os = "linux", not(miri)))]
#[allow(unsafe_code)]
mod system {
    use libc::{_SC_PAGESIZE, MADV_DONTNEED, MADV_HUGEPAGE, c_void, madvise, sysconf};
    use std::mem::MaybeUninit;

    pub fn prefer_large(begin: usize, length: usize) {
        // SAFETY: this advice changes neither what is mapped nor what it holds, for any range; a
        // system that has no large pages answers an error, which changes nothing either.
        unsafe { madvise(begin as *mut c_void, length, MADV_HUGEPAGE) };
    }

    pub fn give_back<T>(memory: &mut [MaybeUninit<T>]) {
        // SAFETY: it only answers; -1, which is no size, if it does not know.
        let Ok(page) = usize::try_from(unsafe { sysconf(_SC_PAGESIZE) }) else { return };
        let begin = memory.as_mut_ptr().cast::<u8>();
        let skipped = begin.align_offset(page);
        let length = size_of_val(memory).saturating_sub(skipped) / page * page;
        // SAFETY: these are whole pages of `memory`, which nobody else sees and whose values may be
        // anything: they stay mapped, and hold zeros afterwards, or what they held if the system
        // refuses.
        unsafe { madvise(begin.wrapping_add(skipped).cast(), length, MADV_DONTNEED) };
    }
}

#[cfg(not(all(target_os = "linux", not(miri))))]
mod system {
    pub fn prefer_large(_begin: usize, _length: usize) {}
    pub fn give_back<T>(_memory: &mut [std::mem::MaybeUninit<T>]) {}
}
