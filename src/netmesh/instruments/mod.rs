//! The constants of the paper's theorems as observed on the mesh at hand: ply and D-ball
//! intersections (`balls`), and the constants K of Definitions 7 and 8 (`constants`) by way of
//! feature sizes (`features`). Only where the options ask for it; the mesh does not depend on it.

mod balls;
mod constants;
mod features;
pub(super) mod observations;
#[cfg(test)]
mod tests;

use super::Mesher;
use crate::error::Result;
use crate::options::Algorithm;
use std::time::{Duration, Instant};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Measures the complete mesh, if that is asked for. Returns the time that all instruments
    /// took.
    pub(super) fn measure_instruments(&mut self) -> Result<Duration> {
        if !self.state.parameters.instruments {
            return Ok(Duration::ZERO);
        }
        let begun = Instant::now();
        self.measure_ply()?;
        self.measure_intersections()?;
        if self.state.parameters.algorithm != Algorithm::Delaunay {
            self.measure_feature_size_constant()?;
        }
        Ok(std::mem::take(&mut self.instruments).spent + begun.elapsed())
    }
}

/// Every how many-th of `count` things is a probe, so that there are at most `probes`.
fn stride(count: usize, probes: usize) -> usize {
    count.div_ceil(probes).max(1)
}
