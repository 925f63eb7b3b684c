//! Requests of large arrays to the system. Large pages: with pages of 4 KiB the system needs some
//! 0.1 ms to take back each MiB, which a cancelled run would wait for, and as much again to provide
//! it. To provide pages before they are touched, which threads can share. And to take back free
//! pages: an allocator keeps those before memory that is in use.

use std::iter;
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

/// Returns the spare memory of a vector in pieces for [`provide`], which end where large pages do:
/// of two threads that want the same page one works in vain.
pub fn spare_pieces<T>(vec: &mut Vec<T>) -> impl Iterator<Item = &mut [MaybeUninit<T>]> {
    let spare = vec.spare_capacity_mut();
    let begin = spare.as_ptr() as usize;
    let first = (begin.next_multiple_of(LARGE_PAGE) - begin) / size_of::<T>();
    let (first, others) = spare.split_at_mut(first.min(spare.len()));
    iter::once(first).chain(others.chunks_mut((LARGE_PAGE / size_of::<T>()).max(1)))
}

/// Has the system provide the pages of `memory` now, and not at the first touch of each. Returns
/// true if it has.
pub fn provide<T>(memory: &mut [MaybeUninit<T>]) -> bool {
    system::provide(memory)
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
    use libc::{_SC_PAGESIZE, c_int, c_void, madvise, sysconf};
    use libc::{MADV_DONTNEED, MADV_HUGEPAGE, MADV_POPULATE_WRITE};
    use std::mem::MaybeUninit;

    pub fn prefer_large(begin: usize, length: usize) {
        // SAFETY: this advice changes neither what is mapped nor what it holds, for any range; a
        // system that has no large pages answers an error, which changes nothing either.
        unsafe { madvise(begin as *mut c_void, length, MADV_HUGEPAGE) };
    }

    pub fn provide<T>(memory: &mut [MaybeUninit<T>]) -> bool {
        advise_whole_pages(memory, MADV_POPULATE_WRITE)
    }

    pub fn give_back<T>(memory: &mut [MaybeUninit<T>]) {
        advise_whole_pages(memory, MADV_DONTNEED);
    }

    /// Returns true if the system takes the advice, for the whole pages of `memory`.
    fn advise_whole_pages<T>(memory: &mut [MaybeUninit<T>], advice: c_int) -> bool {
        // SAFETY: it only answers; -1, which is no size, if it does not know.
        let Ok(page) = usize::try_from(unsafe { sysconf(_SC_PAGESIZE) }) else { return false };
        let begin = memory.as_mut_ptr().cast::<u8>();
        let skipped = begin.align_offset(page);
        let length = size_of_val(memory).saturating_sub(skipped) / page * page;
        // SAFETY: these are whole pages of `memory`, which nobody else sees and whose values may be
        // anything: they stay mapped, and hold zeros afterwards, or what they held if the system
        // refuses or only provides them.
        unsafe { madvise(begin.wrapping_add(skipped).cast::<c_void>(), length, advice) == 0 }
    }
}

#[cfg(not(all(target_os = "linux", not(miri))))]
mod system {
    pub fn prefer_large(_begin: usize, _length: usize) {}
    pub fn provide<T>(_memory: &mut [std::mem::MaybeUninit<T>]) -> bool {
        false
    }
    pub fn give_back<T>(_memory: &mut [std::mem::MaybeUninit<T>]) {}
}

#[cfg(all(test, target_os = "linux", not(miri)))]
mod tests {
    use super::*;

    /// Returns the number of pages of `memory` that the system has provided.
    #[allow(unsafe_code)]
    fn provided<T>(memory: &[MaybeUninit<T>]) -> usize {
        const PAGE: usize = 4096;
        let begin = (memory.as_ptr() as usize).next_multiple_of(PAGE);
        let pages = (memory.as_ptr_range().end as usize - begin) / PAGE;
        let mut are_resident = vec![0u8; pages];
        // SAFETY: the range is mapped, and there is a byte for each page of at least 4 KiB.
        let status =
            unsafe { libc::mincore(begin as *mut _, pages * PAGE, are_resident.as_mut_ptr()) };
        assert_eq!(status, 0);
        are_resident.iter().filter(|&&byte| byte & 1 == 1).count()
    }

    #[test]
    fn pages_are_provided_before_they_are_touched() {
        const COUNT: usize = 5 << 20;
        let mut vec: Vec<u32> = Vec::with_capacity(COUNT);
        vec.push(7);
        assert!(provided(vec.spare_capacity_mut()) < 1024);
        assert!(spare_pieces(&mut vec).count() > 1);
        if spare_pieces(&mut vec).map(provide).filter(|&is_done| is_done).count() == 0 {
            return eprintln!("skipped: this system does not provide pages before");
        }
        assert!(provided(vec.spare_capacity_mut()) > COUNT / 1024 - 20);
        assert_eq!((&*vec, vec.capacity()), (&[7][..], COUNT));
    }
}
