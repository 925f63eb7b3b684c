//! Large pages for large arrays: with pages of 4 KiB the system needs some 0.1 ms for each MiB that
//! is given back, which a run that is cancelled would wait for, and as much again to provide it.

/// Arrays from this size on are worth the call.
const LARGE: usize = 4 << 20;
/// Large pages have at least this size and alignment.
const LARGE_PAGE: usize = 2 << 20;

/// Asks for large pages under the `capacity` of `vec`, where the system has such.
pub(super) fn prefer_large_pages<T>(vec: &[T], capacity: usize) {
    let bytes = capacity * size_of::<T>();
    if bytes >= LARGE {
        let begin = (vec.as_ptr() as usize).next_multiple_of(LARGE_PAGE);
        let end = (vec.as_ptr() as usize + bytes) / LARGE_PAGE * LARGE_PAGE;
        advise(begin, end.saturating_sub(begin));
    }
}

#[cfg(all(target_os = "linux", not(miri)))]
#[allow(unsafe_code)]
fn advise(begin: usize, length: usize) {
    use std::ffi::{c_int, c_void};
    const MADV_HUGEPAGE: c_int = 14;
    unsafe extern "C" {
        fn madvise(begin: *mut c_void, length: usize, advice: c_int) -> c_int;
    }
    // SAFETY: this advice changes neither what is mapped nor what it holds, for any range; a system
    // that has no large pages answers an error, which changes nothing either.
    unsafe { madvise(begin as *mut c_void, length, MADV_HUGEPAGE) };
}

#[cfg(not(all(target_os = "linux", not(miri))))]
fn advise(_begin: usize, _length: usize) {}
