//! Workers do independent pieces of work, on as many threads as the caller allows. Pieces are done
//! in any order, and their results come in the order of the pieces. So nothing depends on the
//! threads.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, with_capacity};
use crate::netmesh::Mesher;
use crate::netmesh::watch::Watch;
use std::iter::Enumerate;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// The number of ids in a piece. It takes a millisecond or a few, after which the caller may want
/// to be called.
pub(in crate::netmesh) const PIECE: usize = 1 << 14;

/// Threads that the caller allows.
pub(in crate::netmesh) fn threads(wanted: u32) -> usize {
    match wanted {
        0 => std::thread::available_parallelism().map_or(1, |count| count.get()),
        _ => wanted as usize,
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// The number of threads for work that changes nothing, at most the number of cores: the caller
    /// may allow any number. A mesh that is not partitioned is made on one thread.
    pub(in crate::netmesh) fn threads(&self) -> usize {
        if self.is_partitioned() {
            threads(self.state.parameters.threads).min(threads(0))
        } else {
            1
        }
    }
}

/// The simplices below `bound`, in pieces.
pub(in crate::netmesh) fn pieces(
    bound: usize,
) -> impl Iterator<Item = impl Iterator<Item = SimplexId> + Send> + Send {
    let end = move |begin: usize| bound.min(begin + PIECE);
    (0..bound).step_by(PIECE).map(move |begin| SimplexId::range(begin..end(begin)))
}

/// What `act` makes of each of the `pieces`, in their order. The calling thread is one of the
/// workers, and polls the watch. It does alone what the system refuses other threads for.
pub(in crate::netmesh) fn on_threads<W: Send, T: Send>(
    threads: usize,
    watch: &mut Watch<'_, '_>,
    pieces: impl Iterator<Item = W> + Send,
    act: impl Fn(W) -> AllocResult<T> + Sync,
) -> Result<Vec<T>> {
    let workers = Workers::new(pieces, act);
    // A scope asks for memory that cannot be refused.
    let mut done = match threads {
        0 | 1 => workers.collect(|| watch.poll())?,
        _ => workers.collect_together(threads, watch)?,
    };
    done.sort_unstable_by_key(|&(at, _)| at);
    Ok(collected(done.into_iter().map(|(_, made)| made))?)
}

/// Pieces that no worker has taken yet, with their numbers, and what is to be made of each.
pub(super) struct Workers<Q, A> {
    queue: Mutex<Q>,
    is_stopped: AtomicBool,
    act: A,
}

impl<I: Iterator, A> Workers<Enumerate<I>, A> {
    pub fn new(pieces: I, act: A) -> Self {
        Self { queue: Mutex::new(pieces.enumerate()), is_stopped: AtomicBool::new(false), act }
    }

    /// Does pieces until there are none, or until a worker has failed. `deliver` gets what was made
    /// of each, with its number.
    pub fn work<T>(&self, mut deliver: impl FnMut(usize, T) -> Result<()>) -> Result<()>
    where
        A: Fn(I::Item) -> AllocResult<T>,
    {
        while !self.is_stopped.load(Ordering::Relaxed) {
            let next = self.queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((at, piece)) = next else { break };
            let made = (self.act)(piece).map_err(Into::into);
            let delivered = made.and_then(|made| deliver(at, made));
            if delivered.is_err() {
                self.is_stopped.store(true, Ordering::Relaxed);
            }
            delivered?;
        }
        Ok(())
    }

    /// [`Self::work`] on one thread. `poll` is called after each piece.
    fn collect<T>(&self, mut poll: impl FnMut() -> Result<()>) -> Result<Vec<(usize, T)>>
    where
        A: Fn(I::Item) -> AllocResult<T>,
    {
        let mut done = Vec::new();
        self.work(|at, made| {
            done.try_push((at, made))?;
            poll()
        })?;
        Ok(done)
    }

    /// [`Self::work`] on `threads` threads, of which this is one.
    fn collect_together<T: Send>(
        &self,
        threads: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Vec<(usize, T)>>
    where
        I: Send,
        A: Fn(I::Item) -> AllocResult<T> + Sync,
    {
        std::thread::scope(|scope| {
            let mut others = with_capacity(threads)?;
            for _ in 1..threads {
                let builder = std::thread::Builder::new();
                others.extend(builder.spawn_scoped(scope, || self.collect(|| Ok(()))));
            }
            let mut done = self.collect(|| watch.poll())?;
            for other in others {
                let other = other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                for made in other? {
                    done.try_push(made)?;
                }
            }
            Ok(done)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ErrorKind;
    use crate::memory::AllocError;
    use crate::options::Progress;
    use std::time::Duration;

    #[test]
    fn pieces_are_done_once_and_come_in_their_order() {
        for threads in [1, 2, 5] {
            for bound in [0, 1, PIECE, PIECE + 1, 9 * PIECE + 7] {
                let pieces = pieces(bound).map(Vec::from_iter);
                let made = on_threads(threads, &mut Watch::new(None), pieces, Ok).unwrap();
                assert_eq!(made.len(), bound.div_ceil(PIECE));
                assert!(made.into_iter().flatten().eq(SimplexId::below(bound)));
            }
        }
    }

    /// Also where another thread is refused memory, or the caller wants no more.
    #[test]
    fn all_give_up_when_one_does() {
        for threads in [1, 2, 3] {
            let refused =
                |piece: u32| if piece == 40 { Err(AllocError::Memory) } else { Ok(piece) };
            let error =
                on_threads(threads, &mut Watch::new(None), 0..1 << 30, refused).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::OutOfMemory);
            let mut cancel = |_: &Progress| false;
            let sleep = |_| {
                std::thread::sleep(Duration::from_millis(1));
                Ok(())
            };
            let error = on_threads(threads, &mut Watch::new(Some(&mut cancel)), 0..1 << 30, sleep)
                .unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Cancelled);
        }
    }
}
