//! Pieces of work that do not need each other, on as many threads as the caller allows.

use crate::error::{Error, ErrorKind, Result};
use crate::memory::AllocResult;
use crate::nearest::Stop;
use crate::threads::{Pieces, together, usable};

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

    /// Returns the number of threads for `count` points, and of points that make a piece of work.
    /// No answer depends on them.
    pub(super) fn shares(&self, count: usize) -> (usize, usize) {
        // How many cores there are is a question to the system, which one piece need not ask.
        split(count, if count <= SMALLEST { 1 } else { threads(self.threads) })
    }
}

/// Returns how many of the threads have a piece of work on `count` points, and the points of one.
fn split(count: usize, threads: usize) -> (usize, usize) {
    let piece = (count / (4 * threads)).clamp(SMALLEST, LARGEST);
    (threads.min(count.div_ceil(piece).max(1)), piece)
}

/// Returns the number of threads to use: what the caller allows (0: all cores), and no more than
/// there are cores.
pub(crate) fn threads(wanted: u32) -> usize {
    usable(wanted)
}

/// Does each of the pieces, in any order, with scratch memory of each thread.
pub(crate) fn on_threads<W: Send, S: Default>(
    threads: usize,
    pieces: impl Iterator<Item = W> + Send,
    act: impl Fn(&mut S, W) -> AllocResult<()> + Sync,
) -> AllocResult<()> {
    let pieces = Pieces::new(pieces);
    let work = || {
        let mut scratch = S::default();
        while let Some((_, piece)) = pieces.take() {
            let made = act(&mut scratch, piece);
            if made.is_err() {
                pieces.stop();
            }
            made?;
        }
        Ok(())
    };
    together(threads, work, work)?.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::AllocError;

    #[test]
    fn no_thread_is_without_a_piece() {
        let shares = |threads, count| Work::from(threads).shares(count);
        assert_eq!([0, 1, SMALLEST].map(|count| shares(0, count)), [(1, SMALLEST); 3]);
        assert_eq!(shares(0, 1 << 30), (usable(0), LARGEST));
        assert_eq!(split(2 * SMALLEST + 1, 5), (3, SMALLEST));
        assert_eq!(split(20 * SMALLEST, 5), (5, SMALLEST));
        for threads in [1, 2, 5, 64] {
            for count in [1, SMALLEST + 1, 10_000, 1_000_000] {
                let (used, piece) = split(count, threads);
                assert!((1..=threads.min(count.div_ceil(piece))).contains(&used), "{count}");
                assert!((SMALLEST..=LARGEST).contains(&piece), "{piece}");
            }
        }
    }

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
