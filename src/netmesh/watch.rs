//! Progress and cancellation: the clock is read every few insertions, the caller is called about
//! 20 times a second, and a run that is cancelled or grows past its limit stops with an error.

use crate::error::{Error, ErrorKind, Result};
use crate::options::{Phase, Progress, ProgressFn};
use std::time::{Duration, Instant};

const INTERVAL: Duration = Duration::from_millis(45);
/// Insertions between two looks at the clock; far below a millisecond in any dimension up to 4.
const STRIDE: u32 = 16;

pub(super) struct Watch<'a, 'b> {
    callback: Option<&'a mut ProgressFn<'b>>,
    last: Instant,
    countdown: u32,
    fraction: f64,
}

impl<'a, 'b> Watch<'a, 'b> {
    pub fn new(callback: Option<&'a mut ProgressFn<'b>>) -> Self {
        Self { callback, last: Instant::now(), countdown: STRIDE, fraction: 0.0 }
    }

    /// Whether it is time to [`Self::report`].
    #[inline]
    pub fn is_due(&mut self) -> bool {
        self.countdown -= 1;
        if self.countdown > 0 {
            return false;
        }
        self.countdown = STRIDE;
        self.callback.is_some() && self.last.elapsed() >= INTERVAL
    }

    /// Calls the caller.
    ///
    /// # Errors
    /// `Cancelled` if the caller says so.
    pub fn report(&mut self, phase: Phase, fraction: f64, counts: [u64; 3]) -> Result<()> {
        self.last = Instant::now();
        self.fraction = self.fraction.max(fraction).min(1.0);
        let [inputs_inserted, vertices, simplices] = counts;
        let progress =
            Progress { phase, fraction: self.fraction, inputs_inserted, vertices, simplices };
        let go_on = self.callback.as_mut().is_none_or(|callback| callback(&progress));
        if !go_on {
            return Err(Error::new(
                ErrorKind::Cancelled,
                "the progress function cancelled the run",
            ));
        }
        Ok(())
    }
}
