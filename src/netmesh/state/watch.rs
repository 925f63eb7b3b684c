//! Progress and cancellation. The clock is read every fraction of a millisecond. The caller is
//! called every 30 milliseconds, and where a round or a stage ends. A run that is cancelled or
//! grows past its limit stops with an error.

use crate::error::{Error, ErrorKind, Result};
use crate::options::{Phase, Progress, ProgressFn};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

pub(in crate::netmesh) const INTERVAL: Duration = Duration::from_millis(30);

/// Work between two readings of the clock, in units of some 100 ns: a fraction of a millisecond.
const STRIDE: u32 = 2048;

pub(crate) struct Watch<'a, 'b> {
    callback: Option<&'a mut ProgressFn<'b>>,
    last: Instant,
    countdown: u32,
    /// Progress that was noted last, for places that cannot count.
    progress: Progress,
    /// Counts of all partitions, in a run that has some.
    tally: Option<&'a Tally>,
}

/// Counts of the partitions of a mesh together, and the sign for them to stop.
pub(crate) struct Tally {
    /// The number of inputs of the mesh.
    inputs: u64,
    /// The part of the run that is done when all partitions are.
    share: f64,
    /// Inputs inserted, vertices, simplices.
    counts: [AtomicU64; 3],
    is_stopped: AtomicBool,
}

impl Tally {
    /// Begins with `counts`, what the mesh of `inputs` inputs had when it was cut. `share`: the
    /// part of the run that is done when all partitions are.
    pub fn new(inputs: usize, share: f64, counts: [u64; 3]) -> Self {
        Self {
            inputs: inputs as u64,
            share,
            counts: counts.map(AtomicU64::new),
            is_stopped: AtomicBool::new(false),
        }
    }

    /// Adds what one partition has done since it last reported.
    fn add(&self, before: &[u64; 3], now: &[u64; 3]) {
        for (count, (before, now)) in self.counts.iter().zip(before.iter().zip(now)) {
            count.fetch_add(now.wrapping_sub(*before), Ordering::Relaxed);
        }
    }

    /// Tells all partitions to stop.
    pub fn stop(&self) {
        self.is_stopped.store(true, Ordering::Relaxed);
    }
}

impl<'a, 'b> Watch<'a, 'b> {
    pub fn new(callback: Option<&'a mut ProgressFn<'b>>) -> Self {
        let progress = Progress {
            phase: Phase::Prepare,
            fraction: 0.0,
            inputs_inserted: 0,
            vertices: 0,
            simplices: 0,
        };
        Self { callback, last: Instant::now(), countdown: STRIDE, progress, tally: None }
    }

    /// Returns the watch of a partition that is made on another thread.
    pub fn of_partition(tally: &'a Tally) -> Self {
        Self { tally: Some(tally), ..Self::new(None) }
    }

    /// Returns the watch of a partition that is made on the calling thread.
    pub fn split<'c>(&'c mut self, tally: &'c Tally) -> Watch<'c, 'b> {
        Watch {
            callback: self.callback.as_deref_mut(),
            last: self.last,
            countdown: self.countdown,
            progress: self.progress,
            tally: Some(tally),
        }
    }

    /// Returns true if it is time to [`Self::report`], after so much more `work`.
    #[inline]
    pub fn is_due(&mut self, work: u32) -> bool {
        if work < self.countdown {
            self.countdown -= work;
            return false;
        }
        self.is_time()
    }

    #[cold]
    fn is_time(&mut self) -> bool {
        self.countdown = STRIDE;
        (self.callback.is_some() || self.tally.is_some()) && self.last.elapsed() >= INTERVAL
    }

    /// Calls the caller if it is time to, after so much more `work`.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    #[inline]
    pub fn poll_after(&mut self, work: u32) -> Result<()> {
        if self.is_due(work) { self.report() } else { Ok(()) }
    }

    /// Calls the caller if it is time to, after work that was long.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    pub fn poll(&mut self) -> Result<()> {
        self.poll_after(STRIDE)
    }

    /// Sets the progress that the next call tells the caller; its fraction never falls.
    pub fn note(&mut self, phase: Phase, fraction: f64, counts: [u64; 3]) {
        let fraction = self.progress.fraction.max(fraction).min(1.0);
        let [inputs_inserted, vertices, simplices] = counts;
        self.progress = Progress { phase, fraction, inputs_inserted, vertices, simplices };
    }

    /// Adds what a partition has `now`, where it had `before`.
    pub fn note_partition(&mut self, before: &[u64; 3], now: &[u64; 3]) {
        if let Some(tally) = self.tally {
            tally.add(before, now);
            self.note_tally(tally);
        }
    }

    /// Notes what all partitions have. They insert and refine at the same time; usually there is
    /// one Steiner point to every input.
    pub fn note_tally(&mut self, tally: &Tally) {
        let counts = tally.counts.each_ref().map(|count| count.load(Ordering::Relaxed));
        let [inserted, vertices, _] = counts;
        let added = vertices.saturating_sub(inserted).min(inserted);
        let fraction = (0.63 * inserted as f64 + 0.37 * added as f64) / tally.inputs as f64;
        self.note(Phase::Insert, tally.share * fraction, counts);
    }

    /// Calls the caller.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    #[cold]
    pub fn report(&mut self) -> Result<()> {
        let progress = &self.progress;
        let go_on = self.callback.as_mut().is_none_or(|callback| callback(progress));
        // The caller's own time is not the run's.
        self.last = Instant::now();
        let is_stopped = self.tally.is_some_and(|tally| tally.is_stopped.load(Ordering::Relaxed));
        if !go_on || is_stopped {
            return Err(cancelled());
        }
        Ok(())
    }
}

/// Returns the error of a run that its caller has stopped.
pub(in crate::netmesh) fn cancelled() -> Error {
    Error::new(ErrorKind::Cancelled, "the progress function cancelled the run")
}
