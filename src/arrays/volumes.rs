//! Volumes of simplices.

use super::Part;
use crate::error::Result;
use crate::memory::{AllocResult, collected};
use crate::mesh::in_dimension;
use crate::numerics::volume;
use crate::query::view::View;

impl Part<'_> {
    /// Returns the volumes of the simplices (areas in 2D), in the order of [`Part::simplices`].
    /// They are exact up to a relative error of 1e-12, or 2^-1074 if subnormal; below the range of
    /// doubles they are 0, beyond it infinite. O(simplices).
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn volumes(&self) -> Result<Vec<f64>> {
        Ok(in_dimension!(self.mesh.dim, D => volumes::<D>(self), _ => Ok(Vec::new()))?)
    }
}

fn volumes<const D: usize>(part: &Part<'_>) -> AllocResult<Vec<f64>> {
    let view = View::<D> { mesh: part.mesh };
    let of_simplex = |id| volume(&view.points_of(view.simplex(id))[..=D]);
    collected(part.simplices().map(of_simplex))
}
