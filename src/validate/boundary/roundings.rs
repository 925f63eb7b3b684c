//! Units of what rounding explains, along each axis: those in the last place of the largest
//! coordinates there. Facets and segments in space that are split where they cross have vertices
//! which are computed with all coordinates: on what is slanted a quarter of the coarsest axis' unit
//! counts on each, up to a part of the extent of the inputs along that.

use super::exact::unit_in_last_place;
use crate::mesh::Inputs;
use std::array::from_fn;

/// Part of the extent of the inputs along an axis that a unit from another axis may be.
const PART: f64 = 1.0 / (1u64 << 40) as f64;

/// Part of the coarsest unit that counts for bends on every axis: vertices are on edges and facets
/// within three of that unit, and 16 units are allowed.
const SHARE: f64 = 0.25;

/// Largest unit from other axes, by axis.
#[derive(Clone, Copy)]
pub(super) struct Roundings<const D: usize> {
    most: [f64; D],
}

impl<const D: usize> Roundings<D> {
    /// Returns roundings that each axis has on its own.
    pub fn of_axes() -> Self {
        Self { most: [0.0; D] }
    }

    /// Returns roundings for what is split at crossings within the inputs.
    pub fn of_crossings(inputs: &Inputs) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for point in (0..inputs.distinct()).map(|at| inputs.distinct_point(at)) {
            low = from_fn(|k| low[k].min(point[k]));
            high = from_fn(|k| high[k].max(point[k]));
        }
        Self { most: from_fn(|k| PART * high[k] - PART * low[k]) }
    }

    /// Returns the units of some points by axis, in which bends are measured.
    pub fn units_of<'a>(&self, points: impl IntoIterator<Item = &'a [f64; D]>) -> [f64; D] {
        self.shared_units(points, SHARE)
    }

    /// Returns the units of some points by axis, in which the ways between them are measured.
    pub fn steps_of<'a>(&self, points: impl IntoIterator<Item = &'a [f64; D]>) -> [f64; D] {
        self.shared_units(points, 1.0)
    }

    fn shared_units<'a>(
        &self,
        points: impl IntoIterator<Item = &'a [f64; D]>,
        share: f64,
    ) -> [f64; D] {
        let larger = |most: [f64; D], x: &[f64; D]| from_fn(|k| most[k].max(x[k].abs()));
        let units = points.into_iter().fold([0.0; D], larger).map(unit_in_last_place);
        let coarsest = share * units.iter().fold(0.0f64, |most, unit| most.max(*unit));
        from_fn(|k| units[k].max(coarsest.min(self.most[k])))
    }
}
