//! The threads. They take parts in their order, and this thread lets them join, in the same order,
//! and watches for the caller.

use super::Part;
use crate::error::Result;
use crate::memory::{enqueue, with_room};
use crate::netmesh::Mesher;
use crate::netmesh::threads::threads;
use crate::netmesh::watch::{INTERVAL, Tally, Watch};
use std::collections::VecDeque;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Mutex, PoisonError};

/// Parts that no thread has taken yet, with their numbers.
type Queue<const D: usize> = Mutex<VecDeque<(usize, Part<D>)>>;
type Done<const D: usize> = (usize, Result<Part<D>>);

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines `parts`, and lets them join; see [`Self::join`] for `moved`.
    pub(super) fn refine_parts(&mut self, parts: Vec<Part<D>>, moved: &mut [u32]) -> Result<()> {
        let tally = Tally::new(self.inputs, self.progress_counts());
        let threads = threads(self.parameters.threads).min(parts.len());
        if threads > 1 {
            return self.refine_on(threads, parts, &tally, moved);
        }
        for mut part in parts {
            self.lend_room(std::slice::from_mut(&mut part))?;
            let part = part.refine(self.watch.lend(&tally))?;
            self.watch.note_tally(&tally);
            self.join(part, moved)?;
        }
        Ok(())
    }

    fn refine_on(
        &mut self,
        threads: usize,
        mut parts: Vec<Part<D>>,
        tally: &Tally,
        moved: &mut [u32],
    ) -> Result<()> {
        self.lend_room(&mut parts)?;
        let count = parts.len();
        let mut queue = VecDeque::new();
        for part in parts.into_iter().enumerate() {
            enqueue(&mut queue, part)?;
        }
        let queue = Mutex::new(queue);
        std::thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            let spawn = |_: &usize| {
                let (queue, sender) = (&queue, sender.clone());
                let work = move || refine_next(queue, tally, &sender);
                std::thread::Builder::new().spawn_scoped(scope, work).is_ok()
            };
            // A system that refuses a thread may have given others.
            if (0..threads).filter(spawn).count() == 0 {
                refine_next(&queue, tally, &sender);
            }
            drop(sender);
            let gathered = self.gather(&receiver, count, tally, moved);
            if gathered.is_err() {
                tally.stop();
            }
            gathered
        })
    }

    /// Lets `count` parts join as they come, but in their order.
    fn gather(
        &mut self,
        receiver: &Receiver<Done<D>>,
        count: usize,
        tally: &Tally,
        moved: &mut [u32],
    ) -> Result<()> {
        let mut done: Vec<Option<Result<Part<D>>>> = with_room(count)?;
        done.resize_with(count, || None);
        let mut next = 0;
        while next < count {
            match receiver.recv_timeout(INTERVAL) {
                Ok((at, part)) => done[at] = Some(part),
                Err(RecvTimeoutError::Timeout) => {}
                // A thread has panicked, and so will the scope.
                Err(RecvTimeoutError::Disconnected) => break,
            }
            while let Some(part) = done.get_mut(next).and_then(Option::take) {
                self.join(part?, moved)?;
                next += 1;
            }
            self.watch.note_tally(tally);
            self.watch.poll()?;
        }
        Ok(())
    }
}

/// Refines the next of the parts until there is none.
fn refine_next<const D: usize>(queue: &Queue<D>, tally: &Tally, sender: &Sender<Done<D>>) {
    loop {
        let next = queue.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
        let Some((at, part)) = next else { return };
        if sender.send((at, part.refine(Watch::of_part(tally)))).is_err() {
            return;
        }
    }
}
