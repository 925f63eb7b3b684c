//! Threads that share pieces of work: each piece is taken by the first thread that is free, and
//! done once. No result depends on which thread that is, if those who use this put results in the
//! order of the pieces.

use crate::memory::{AllocResult, collected, with_capacity};
use std::iter::Enumerate;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::{Builder, available_parallelism, scope};

/// Returns the number of threads that a caller asks for; 0 stands for all cores.
pub(crate) fn asked(wanted: u32) -> usize {
    match wanted {
        0 => available_parallelism().map_or(1, |count| count.get()),
        _ => wanted as usize,
    }
}

/// Returns the number of threads that a caller asks for, and no more than there are cores.
pub(crate) fn usable(wanted: u32) -> usize {
    // How many cores there are is a question to the system, which one thread need not ask.
    if wanted == 1 { 1 } else { asked(wanted).min(asked(0)) }
}

/// Pieces of work that no thread has taken yet.
pub(crate) struct Pieces<I> {
    queue: Mutex<Enumerate<I>>,
    is_stopped: AtomicBool,
}

impl<I: Iterator> Pieces<I> {
    pub fn new(pieces: I) -> Self {
        Self { queue: Mutex::new(pieces.enumerate()), is_stopped: AtomicBool::new(false) }
    }

    /// Takes the next piece, with its number. There is none after [`Self::stop`].
    pub fn take(&self) -> Option<(usize, I::Item)> {
        match self.is_stopped() {
            true => None,
            false => self.queue.lock().unwrap_or_else(PoisonError::into_inner).next(),
        }
    }

    /// Leaves the pieces that are not taken undone. Returns true on the first call.
    pub fn stop(&self) -> bool {
        !self.is_stopped.swap(true, Ordering::Relaxed)
    }

    pub fn is_stopped(&self) -> bool {
        self.is_stopped.load(Ordering::Relaxed)
    }
}

/// Does `own` on the calling thread and `other` on each further one of `threads` threads. Returns
/// what they return, that of `own` first. Where the system refuses threads there are fewer.
pub(crate) fn together<T: Send>(
    threads: usize,
    own: impl FnOnce() -> T,
    other: impl Fn() -> T + Sync,
) -> AllocResult<Vec<T>> {
    // A scope asks for memory that cannot be refused.
    if threads <= 1 {
        return collected([own()]);
    }
    scope(|scope| {
        let mut others = with_capacity(threads)?;
        for _ in 1..threads {
            others.extend(Builder::new().spawn_scoped(scope, &other));
        }
        let mut done = with_capacity(threads)?;
        done.push(own());
        for other in others {
            done.push(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        Ok(done)
    })
}

/// Does `work` on every piece, on as many threads as there are scratches: a thread has one for all
/// that it does.
///
/// # Errors
/// Fails as `work` does; pieces may then be left undone.
pub(crate) fn share<P, S: Send>(
    pieces: impl Iterator<Item = P> + Send,
    scratches: &mut [S],
    work: impl Fn(&mut S, P) -> AllocResult<()> + Sync,
) -> AllocResult<()> {
    let (threads, pieces) = (scratches.len(), Pieces::new(pieces));
    let scratches = Pieces::new(scratches.iter_mut());
    let run = || -> AllocResult<()> {
        if let Some((_, scratch)) = scratches.take() {
            while let Some((_, piece)) = pieces.take() {
                work(scratch, piece)?;
            }
        }
        Ok(())
    };
    together(threads, run, run)?.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::AllocError;

    #[test]
    fn every_piece_is_taken_once_until_all_stop() {
        for threads in [1, 2, 5] {
            let pieces = Pieces::new(10..1010);
            let work = || std::iter::from_fn(|| pieces.take()).collect::<Vec<_>>();
            let mut taken = together(threads, work, work).unwrap().concat();
            taken.sort_unstable();
            assert!(taken.into_iter().eq((10..1010).enumerate()));
        }
        let pieces = Pieces::new(0..2);
        assert_eq!(pieces.take(), Some((0, 0)));
        assert!(pieces.stop() && !pieces.stop() && pieces.is_stopped());
        assert_eq!(pieces.take(), None);
    }

    #[test]
    fn every_piece_is_done_with_the_scratch_of_a_thread() {
        for threads in [1, 3] {
            let (mut sums, mut done) = (vec![0; threads], vec![false; 1000]);
            let work = |sum: &mut usize, (piece, done): (usize, &mut bool)| {
                *sum += piece;
                *done = true;
                Ok(())
            };
            share(done.iter_mut().enumerate(), &mut sums, work).unwrap();
            assert!(done.iter().all(|&done| done));
            assert_eq!(sums.iter().sum::<usize>(), 999 * 500);
        }
        let fail = |_: &mut (), piece| if piece == 7 { Err(AllocError::Memory) } else { Ok(()) };
        assert_eq!(share(0..9, &mut [(); 2], fail), Err(AllocError::Memory));
        assert_eq!(share(0..7, &mut [(); 2], fail), Ok(()));
    }

    #[test]
    fn the_own_result_comes_first() {
        assert_eq!(together(1, || 1, || 2), Ok(vec![1]));
        let all = together(3, || 1, || 2).unwrap();
        assert!(all[0] == 1 && all[1..].iter().all(|&other| other == 2));
        assert!(usable(1) == 1 && usable(0) == asked(0) && asked(7) == 7);
    }
}
