//! Prefetching of memory: a search that hops from simplex to simplex would wait for each of them
//! otherwise, since the processor cannot foresee where it goes.

/// Prefetches the cache lines where `count` of `values` from `first` on begin and end, if there are
/// so many. Has no other effect.
#[inline(always)]
pub fn prefetch_at<T>(values: &[T], first: usize, count: usize) {
    let start = values.as_ptr().wrapping_add(first);
    hint(start.cast());
    hint(start.wrapping_add(count).cast::<u8>().wrapping_sub(1));
}

/// Prefetches the cache line where a value begins, if there are so many. Has no other effect.
#[inline(always)]
pub fn prefetch<T>(values: &[T], at: usize) {
    hint(values.as_ptr().wrapping_add(at).cast());
}

#[cfg(all(target_arch = "x86_64", not(miri)))]
#[inline(always)]
#[allow(unsafe_code)]
fn hint(address: *const u8) {
    use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
    // SAFETY: every x86_64 has the instruction, which is a hint: whatever the address, it neither
    // faults nor changes what the program can see.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
}

#[cfg(not(all(target_arch = "x86_64", not(miri))))]
#[inline(always)]
fn hint(_address: *const u8) {}
