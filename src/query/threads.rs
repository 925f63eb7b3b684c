//! Pieces of work that do not need each other, on as many threads as the caller allows.

use crate::error::{Error, ErrorKind, Result};
use crate::memory::{AllocResult, with_capacity};
use crate::nearest::Stop;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// The most points of a piece: enough that sorting them brings near ones together.
const LARGEST: usize = 1 << 15;

/// The fewest, unless there are no more.
const SMALLEST: usize = 1 << 10;

/// Number of threads that a call works on, and what stops it. A number stands for that many
/// threads.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work<'a> {
    /// Threads to use, 0 for all cores.
    pub threads: u32,
    /// Ends the call, which then answers `Cancelled`, soon after it becomes true.
    pub stop: Stop<'a>,
}

impl From<u32> for Work<'_> {
    fn from(threads: u32) -> Self {
        Self { threads, stop: Stop::default() }
    }
}

impl Work<'_> {
    /// Fails if the call has been stopped, so that its answers are not all there.
    pub(super) fn check(&self) -> Result<()> {
        match self.stop.is_set() {
            true => Err(Error::new(ErrorKind::Cancelled, "the query was stopped")),
            false => Ok(()),
        }
    }
}

/// Returns the number of threads to use: what the caller allows (0: all cores), and no more than
/// there are cores.
pub(crate) fn threads(wanted: u32) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, |count| count.get());
    match wanted {
        0 => cores(),
        1 => 1,
        _ => (wanted as usize).min(cores()),
    }
}

/// Returns the number of points, of `count`, that make a piece of work. No answer depends on it.
pub(super) fn piece(count: usize, threads: usize) -> usize {
    (count / (4 * threads)).clamp(SMALLEST, LARGEST)
}

/// Does each of the pieces, in any order, with scratch memory of each thread.
pub(crate) fn on_threads<W: Send, S: Default>(
    threads: usize,
    pieces: impl Iterator<Item = W> + Send,
    act: impl Fn(&mut S, W) -> AllocResult<()> + Sync,
) -> AllocResult<()> {
    let workers = Workers { queue: Mutex::new(pieces), is_stopped: AtomicBool::new(false), act };
    // A scope asks for memory that cannot be refused.
    if threads <= 1 {
        return workers.work();
    }
    std::thread::scope(|scope| {
        let mut others = with_capacity(threads)?;
        for _ in 1..threads {
            // What the system refuses of the other threads, this one does as well.
            others.extend(std::thread::Builder::new().spawn_scoped(scope, || workers.work()));
        }
        let mut done = workers.work();
        for other in others {
            let other = other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            done = done.and(other);
        }
        done
    })
}

struct Workers<Q, A> {
    queue: Mutex<Q>,
    is_stopped: AtomicBool,
    act: A,
}

impl<Q, A> Workers<Q, A> {
    /// Does pieces until there are none, or one has failed.
    fn work<W, S: Default>(&self) -> AllocResult<()>
    where
        Q: Iterator<Item = W>,
        A: Fn(&mut S, W) -> AllocResult<()>,
    {
        let mut scratch = S::default();
        while !self.is_stopped.load(Ordering::Relaxed) {
            let next = self.queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some(piece) = next else { break };
            let made = (self.act)(&mut scratch, piece);
            if made.is_err() {
                self.is_stopped.store(true, Ordering::Relaxed);
            }
            made?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::AllocError;

    #[test]
    fn every_piece_is_done_once() {
        for threads in [1, 2, 5] {
            let mut counts = vec![0u32; 1000];
            on_threads(threads, counts.chunks_mut(7), |_: &mut (), chunk| {
                chunk.iter_mut().for_each(|count| *count += 1);
                Ok(())
            })
            .unwrap();
            assert!(counts.iter().all(|&count| count == 1));
        }
    }

    #[test]
    fn a_refusal_of_memory_is_passed_on() {
        for threads in [1, 2, 3] {
            let act = |_: &mut (), piece| match piece {
                40 => Err(AllocError::Memory),
                _ => Ok(()),
            };
            assert_eq!(on_threads(threads, 0..1 << 20, act), Err(AllocError::Memory));
        }
    }
}
