//! A Delaunay complex from plain arrays.

use super::Delaunay;
use crate::complex::Complex;
use crate::error::Result;
use crate::memory::Array;

impl<const D: usize> Delaunay<D> {
    /// Makes a Delaunay complex of `complex` over `points`, and computes its D-balls. `complex`
    /// must be Delaunay.
    pub fn of_complex(
        points: Array<[f64; D]>,
        complex: Complex<D>,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let mut delaunay = Self { complex, ..Self::new(points)? };
        delaunay.cover_balls()?;
        for simplex in delaunay.complex.simplices() {
            tick()?;
            delaunay.compute_ball(simplex);
        }
        Ok(delaunay)
    }
}
