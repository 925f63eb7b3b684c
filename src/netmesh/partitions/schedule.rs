//! The threads take partitions in order. The calling thread joins them in the same order, and
//! watches for the caller.

use crate::complex::SimplexId;
use crate::error::Result;
use crate::memory::with_capacity;
use crate::netmesh::partitions::partition::Partition;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::watch::{INTERVAL, Tally, Watch, cancelled};
use crate::netmesh::state::workers::{Tick, Workers};
use crate::threads::asked;
use std::sync::mpsc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};

/// A partition that a worker has refined, with its number.
type Done<const D: usize> = (usize, Result<Partition<D>>);

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines `partitions` and joins them. See [`Self::join`] for `moved`.
    pub(super) fn refine_partitions(
        &mut self,
        partitions: Vec<Partition<D>>,
        moved: &mut [SimplexId],
    ) -> Result<()> {
        let tally =
            Tally::new(self.state.inputs, self.share_of_partitions(), self.state.progress_counts());
        let threads = asked(self.state.parameters.threads).min(partitions.len());
        if threads > 1 {
            return self.refine_on(threads, partitions, &tally, moved);
        }
        for mut partition in partitions {
            self.split_reserves(std::slice::from_mut(&mut partition))?;
            let partition = partition.refine(self.watch.split(&tally))?;
            self.watch.note_tally(&tally);
            self.join(partition, moved)?;
        }
        Ok(())
    }

    fn refine_on(
        &mut self,
        threads: usize,
        mut partitions: Vec<Partition<D>>,
        tally: &Tally,
        moved: &mut [SimplexId],
    ) -> Result<()> {
        self.split_reserves(&mut partitions)?;
        let count = partitions.len();
        let refine = |partition: Partition<D>, _: &mut Tick<'_>| {
            Ok(partition.refine(Watch::of_partition(tally)))
        };
        let workers = Workers::new(partitions.into_iter(), refine);
        let work = |sender: Sender<Done<D>>| {
            // Nobody waits for the rest if the receiver is gone.
            let send =
                |at, done, _: &mut Tick<'_>| sender.send((at, done)).map_err(|_| cancelled());
            let _ = workers.work(&mut |_| Ok(()), send);
        };
        std::thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            let spawn = |_: &usize| {
                let (work, sender) = (&work, sender.clone());
                std::thread::Builder::new().spawn_scoped(scope, move || work(sender)).is_ok()
            };
            // A system that refuses a thread may have given others.
            if (0..threads).filter(spawn).count() == 0 {
                work(sender.clone());
            }
            drop(sender);
            let gathered = self.gather(&receiver, count, tally, moved);
            if gathered.is_err() {
                tally.stop();
            }
            gathered
        })
    }

    /// Joins `count` partitions in their order.
    fn gather(
        &mut self,
        receiver: &Receiver<Done<D>>,
        count: usize,
        tally: &Tally,
        moved: &mut [SimplexId],
    ) -> Result<()> {
        let mut done: Vec<Option<Result<Partition<D>>>> = with_capacity(count)?;
        done.resize_with(count, || None);
        let mut next = 0;
        while next < count {
            match receiver.recv_timeout(INTERVAL) {
                Ok((at, partition)) => done[at] = Some(partition),
                Err(RecvTimeoutError::Timeout) => {}
                // A thread has panicked, and so will the scope.
                Err(RecvTimeoutError::Disconnected) => break,
            }
            while let Some(partition) = done.get_mut(next).and_then(Option::take) {
                self.join(partition?, moved)?;
                next += 1;
            }
            self.watch.note_tally(tally);
            self.watch.poll()?;
        }
        Ok(())
    }
}
