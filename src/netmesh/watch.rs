//! Progress and cancellation: the clock is read every fraction of a millisecond, the caller is called
//! 20 to 30 times a second and where a round or a stage ends, and a run that is cancelled or grows
//! past its limit stops with an error.

use crate::error::{Error, ErrorKind, Result};
use crate::options::{Phase, Progress, ProgressFn};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

pub(super) const INTERVAL: Duration = Duration::from_millis(30);
/// Work between two looks at the clock, in units of some 100 ns: a fraction of a millisecond.
const STRIDE: u32 = 2048;

pub(super) struct Watch<'a, 'b> {
    callback: Option<&'a mut ProgressFn<'b>>,
    last: Instant,
    countdown: u32,
    /// What another thread stops the work by.
    stop: Option<&'a AtomicBool>,
    /// What was noted last, for places that cannot count.
    progress: Progress,
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
        Self { callback, last: Instant::now(), countdown: STRIDE, stop: None, progress }
    }

    /// For a thread that has no caller to call, and goes on until told to `stop`.
    pub fn until(stop: &'a AtomicBool) -> Self {
        Self { stop: Some(stop), ..Self::new(None) }
    }

    /// Whether it is time to [`Self::call`], after so much more `work`.
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
        self.callback.is_some() && self.last.elapsed() >= INTERVAL
            || self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }

    /// Calls the caller if it is time to, after so much more `work`.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    #[inline]
    pub fn tick(&mut self, work: u32) -> Result<()> {
        if self.is_due(work) { self.call() } else { Ok(()) }
    }

    /// As [`Self::tick`], after work that was long.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    pub fn look(&mut self) -> Result<()> {
        self.tick(STRIDE)
    }

    /// What the next call tells the caller; its fraction never falls.
    pub fn note(&mut self, phase: Phase, fraction: f64, counts: [u64; 3]) {
        let fraction = self.progress.fraction.max(fraction).min(1.0);
        let [inputs_inserted, vertices, simplices] = counts;
        self.progress = Progress { phase, fraction, inputs_inserted, vertices, simplices };
    }

    /// Calls the caller.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    #[cold]
    pub fn call(&mut self) -> Result<()> {
        let progress = &self.progress;
        let go_on = self.callback.as_mut().is_none_or(|callback| callback(progress));
        // The caller's own time is not the run's.
        self.last = Instant::now();
        let is_stopped = self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed));
        if !go_on || is_stopped {
            return Err(Error::new(
                ErrorKind::Cancelled,
                "the progress function cancelled the run",
            ));
        }
        Ok(())
    }
}
