//! Units of roundings on all axes. What is slanted has the roundings of its largest coordinate on
//! every axis: a facet at y = 0 is not told from one at y = 1e-15 by a crossing at x = 1. But what
//! is flat along an axis, and so at right angles to it, has none there.

use super::super::plane::units_of;
use crate::arrangement::reach::Reach;
use crate::nearest::bounds_of;
use std::array::from_fn;

/// Part of the extent along an axis that a unit of roundings from another axis may be.
const PART: f64 = 1.0 / (1u64 << 40) as f64;

/// Part of the coarsest unit in which bends are measured: as 15 units they may be, what is near by
/// three of the coarsest is within them.
const SHARE_OF_BENDS: f64 = 0.25;

/// The extent of what is rounded.
pub(super) struct Roundings {
    /// Largest unit by axis, unless coordinates on it are larger.
    most: [f64; 3],
    /// Part of the coarsest unit that counts on every axis.
    share: f64,
}

impl Roundings {
    /// Returns the roundings of what is in the box of some points.
    pub fn within<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Self {
        let [low, high] = bounds_of(points);
        Self { most: from_fn(|k| PART * high[k] - PART * low[k]), share: 1.0 }
    }

    /// Returns the roundings in which edges and facets that are bent are measured.
    pub fn of_bends(&self) -> Self {
        Self { share: SHARE_OF_BENDS, ..*self }
    }

    /// Returns the units in the last place of the largest coordinates of points, or the unit of the
    /// coarsest axis, or its part, where that is larger and the extent allows it.
    pub fn units_of<'a>(&self, points: impl Iterator<Item = &'a [f64; 3]>) -> [f64; 3] {
        let units = units_of(points);
        let coarsest = self.share * units.iter().fold(0.0f64, |most, unit| most.max(*unit));
        from_fn(|k| units[k].max(coarsest.min(self.most[k])))
    }

    /// Returns the reach of an edge, with these units.
    pub fn reach(&self, points: &[[f64; 3]], edge: [u32; 2]) -> Reach<3> {
        let ends = edge.map(|end| &points[end as usize]);
        Reach::of(ends).widened(&self.units_of(ends.into_iter()))
    }
}

/// Returns the units of roundings of points, in their own extent.
pub(super) fn units_of_roundings<'a>(
    points: impl Iterator<Item = &'a [f64; 3]> + Clone,
) -> [f64; 3] {
    Roundings::within(points.clone()).units_of(points)
}
