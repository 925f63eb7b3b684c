//! Memory asked for before it is needed: a search that hops from simplex to simplex waits for each of
//! them otherwise, since the processor cannot foresee where it goes.

/// Begins to load the cache line where `values[at]` begins, if there is such an element. Changes nothing.
#[inline(always)]
#[allow(unsafe_code)]
pub fn prefetch<T>(values: &[T], at: usize) {
    #[cfg(all(target_arch = "x86_64", not(miri)))]
    if let Some(value) = values.get(at) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: the instruction is part of every x86_64, and a hint: it neither reads nor writes as far
        // as the program can tell, whatever the address, and this one is of a live reference.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(value).cast()) };
    }
    #[cfg(not(all(target_arch = "x86_64", not(miri))))]
    let _ = (values, at);
}
