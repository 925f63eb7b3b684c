//! The constants of the paper's theorems as observed on the mesh at hand: ply and intersections of
//! D-balls (`balls`), and the constants K of Definitions 7 and 8 (`constants`) by way of feature
//! sizes (`features`), at some probes of the mesh (`probes`). Only where the options ask for it;
//! the mesh does not depend on it.

mod balls;
mod constants;
mod features;
mod probes;

use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::options::Algorithm;
use std::time::{Duration, Instant};

impl<const D: usize> Mesher<'_, '_, D> {
    /// Measures the complete mesh, if that is asked for. Returns the time that all instruments
    /// took.
    pub(in crate::netmesh) fn measure_instruments(&mut self) -> Result<Duration> {
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

#[cfg(test)]
mod tests;
