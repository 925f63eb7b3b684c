//! Workers do independent pieces of work, on as many threads as the caller allows. Pieces are done
//! in any order, and their results come in the order of the pieces. So nothing depends on the
//! threads.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, provide, spare_pieces, with_capacity};
use crate::netmesh::state::watch::{Watch, cancelled};
use crate::threads::{Pieces, together};

/// The number of ids in a piece. It takes a millisecond or a few, after which the caller may want
/// to be called.
pub(in crate::netmesh) const PIECE: usize = 1 << 14;

/// Returns the simplices below `bound`, in pieces.
pub(in crate::netmesh) fn pieces(
    bound: usize,
) -> impl Iterator<Item = impl Iterator<Item = SimplexId> + Send> + Send {
    let end = move |begin: usize| bound.min(begin + PIECE);
    (0..bound).step_by(PIECE).map(move |begin| SimplexId::range(begin..end(begin)))
}

/// Returns what `act` makes of each of the `pieces`, in their order. The calling thread is one of
/// the workers, and polls the watch. It does alone what the system refuses other threads for.
pub(in crate::netmesh) fn on_threads<W: Send, T: Send>(
    threads: usize,
    watch: &mut Watch<'_, '_>,
    pieces: impl Iterator<Item = W> + Send,
    act: impl Fn(W) -> AllocResult<T> + Sync,
) -> Result<Vec<T>> {
    on_threads_with_ticks(threads, watch, pieces, |piece, _| Ok(act(piece)?))
}

/// Returns what `act` makes of each of the `pieces`, which take long: `act` calls the tick after
/// each bit of work, and gives up where that is an error. On the calling thread the tick polls the
/// watch.
pub(in crate::netmesh) fn on_threads_with_ticks<W: Send, T: Send>(
    threads: usize,
    watch: &mut Watch<'_, '_>,
    pieces: impl Iterator<Item = W> + Send,
    act: impl Fn(W, &mut Tick<'_>) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    let workers = Workers::new(pieces, act);
    let mut done = workers.collect_together(threads, watch)?;
    done.sort_unstable_by_key(|&(at, _)| at);
    Ok(collected(done.into_iter().map(|(_, made)| made))?)
}

/// Has the system provide the spare memory of a vector on all threads: where one touches it first,
/// the others wait for it.
pub(in crate::netmesh) fn provide_spare<T: Send>(
    threads: usize,
    watch: &mut Watch<'_, '_>,
    vec: &mut Vec<T>,
) -> Result<()> {
    if threads > 1 {
        on_threads(threads, watch, spare_pieces(vec), |piece| Ok(provide(piece)))?;
    }
    Ok(())
}

/// Returns a vector of so many values, in memory that all threads have the system provide.
pub(in crate::netmesh) fn filled_on_threads<T: Send>(
    threads: usize,
    watch: &mut Watch<'_, '_>,
    length: usize,
    value: impl FnMut() -> T,
) -> Result<Vec<T>> {
    let mut vec = with_capacity(length)?;
    provide_spare(threads, watch, &mut vec)?;
    vec.resize_with(length, value);
    Ok(vec)
}

/// Called after so much work ([`Watch::poll_after`]).
pub(in crate::netmesh) type Tick<'a> = dyn FnMut(u32) -> Result<()> + 'a;

/// More work than may pass without a look at the clock.
const LONG: u32 = u32::MAX;

/// Pieces that no worker has taken yet, and the function that does one.
pub(in crate::netmesh) struct Workers<I, A> {
    pieces: Pieces<I>,
    act: A,
}

impl<I: Iterator, A> Workers<I, A> {
    pub fn new(pieces: I, act: A) -> Self {
        Self { pieces: Pieces::new(pieces), act }
    }

    /// Does pieces until there are none, or until a worker has failed: the first one to do so has
    /// the error. `deliver` gets what was made of each, with its number. `tick` is for what makes
    /// it.
    pub fn work<T>(
        &self,
        tick: &mut Tick<'_>,
        mut deliver: impl FnMut(usize, T, &mut Tick<'_>) -> Result<()>,
    ) -> Result<()>
    where
        A: Fn(I::Item, &mut Tick<'_>) -> Result<T>,
    {
        while let Some((at, piece)) = self.pieces.take() {
            let made = (self.act)(piece, tick);
            let delivered = made.and_then(|made| deliver(at, made, tick));
            if delivered.is_err() && self.pieces.stop() {
                return delivered;
            }
        }
        Ok(())
    }

    /// Does [`Self::work`] on this thread. `tick` is called after each piece, too.
    fn collect<T>(&self, mut tick: impl FnMut(u32) -> Result<()>) -> Result<Vec<(usize, T)>>
    where
        A: Fn(I::Item, &mut Tick<'_>) -> Result<T>,
    {
        let mut done = Vec::new();
        self.work(&mut tick, |at, made, tick| {
            done.try_push((at, made))?;
            tick(LONG)
        })?;
        Ok(done)
    }

    /// Fails after another worker has failed: the tick of a worker that has no watch.
    fn check(&self) -> Result<()> {
        match self.pieces.is_stopped() {
            true => Err(cancelled()),
            false => Ok(()),
        }
    }

    /// Does [`Self::work`] on `threads` threads, of which this is one.
    fn collect_together<T: Send>(
        &self,
        threads: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Vec<(usize, T)>>
    where
        I: Send,
        A: Fn(I::Item, &mut Tick<'_>) -> Result<T> + Sync,
    {
        let own = || self.collect(|work| self.check().and_then(|()| watch.poll_after(work)));
        let mut done = Vec::new();
        for made in together(threads, own, || self.collect(|_| self.check()))? {
            for piece in made? {
                done.try_push(piece)?;
            }
        }
        Ok(done)
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

    /// An error on one thread stops a long piece on another one, and it is the error that counts.
    #[test]
    fn long_pieces_are_given_up_when_another_one_fails() {
        for (threads, failing) in [(2, 0), (2, 1), (3, 2)] {
            let act = |piece: usize, tick: &mut Tick<'_>| {
                if piece == failing {
                    std::thread::sleep(Duration::from_millis(1));
                    return Err(AllocError::Memory.into());
                }
                loop {
                    tick(1)?;
                }
            };
            let done = on_threads_with_ticks(threads, &mut Watch::new(None), 0..threads, act);
            let done: Result<Vec<()>> = done;
            assert_eq!(done.unwrap_err().kind(), ErrorKind::OutOfMemory);
        }
        let mut cancel = |_: &Progress| false;
        let act = |(), tick: &mut Tick<'_>| -> Result<()> {
            loop {
                tick(1)?;
            }
        };
        let pieces = std::iter::repeat_n((), 2);
        let done = on_threads_with_ticks(2, &mut Watch::new(Some(&mut cancel)), pieces, act);
        assert_eq!(done.unwrap_err().kind(), ErrorKind::Cancelled);
    }

    /// All workers give up where one is refused memory, or the caller wants no more.
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
