//! A few points that every ball with nearly all points of a set must meet.
//!
//! Lift x to (x, |x|^2) in d + 1 dimensions: balls and half-spaces of R^d are half-spaces there.
//! The set is paired off once per coordinate (the lifting of Mulzer and Werner, "Approximating
//! Tverberg points in linear time for any fixed dimension", 2013). Before coordinate i there are
//! disjoint subsets whose hulls all have a point over the same z_1..z_{i-1}; the median of these
//! points in coordinate i is z_i, and each subset below the median is joined with one above: the
//! segment between their points meets the median. So after d + 1 coordinates at least 2^-(d+1) of
//! the number of points are left as disjoint subsets, of at most 2^(d+1) points each, with z in
//! every hull. Let X be any of them. A ball that avoids X is a half-space without z, as z is in the
//! hull of X; so it misses a point of every other subset as well. Hence a ball with more than 1 -
//! 2^-(d+1) of the points has a point of X. The work is linear.
//!
//! The coordinates are rounded, relative to the median and to the median distance from it. That
//! touches only how deep z is, that is the bound on the size of a net, never the net's property.

use crate::memory::{AllocResult, TryGrow, reserve};
use crate::netmesh::rounds::net::PointId;

/// A subset, and the point of its hull that is over the medians so far.
struct Part<const D: usize> {
    at: [f64; D],
    lift: f64,
    /// Two other parts, or twice the same number: that of a single point.
    halves: [u32; 2],
}

impl<const D: usize> Part<D> {
    #[inline]
    fn coordinate(&self, axis: usize) -> f64 {
        if axis < D { self.at[axis] } else { self.lift }
    }

    /// Returns the point that is `share` of `self` and the rest of `other`.
    fn between(&self, other: &Self, share: f64) -> ([f64; D], f64) {
        let mix = |a: f64, b: f64| share * a + (1.0 - share) * b;
        (std::array::from_fn(|axis| mix(self.at[axis], other.at[axis])), mix(self.lift, other.lift))
    }
}

/// Finds X; keeps its buffers.
pub(in crate::netmesh) struct Center<const D: usize> {
    parts: Vec<Part<D>>,
    /// Numbers of the parts that are paired off next.
    level: Vec<u32>,
    paired: Vec<u32>,
    values: Vec<f64>,
    /// Numbers of the points in one part.
    leaves: Vec<u32>,
    support: Vec<PointId>,
}

impl<const D: usize> Default for Center<D> {
    fn default() -> Self {
        Self {
            parts: Vec::new(),
            level: Vec::new(),
            paired: Vec::new(),
            values: Vec::new(),
            leaves: Vec::new(),
            support: Vec::new(),
        }
    }
}

impl<const D: usize> Center<D> {
    /// Returns X for the `members` of `points`, of which there are some; the most central point
    /// first.
    pub fn support(&mut self, points: &[[f64; D]], members: &[PointId]) -> AllocResult<&[PointId]> {
        self.lift(points, members)?;
        for axis in 0..=D {
            self.pair_off(axis)?;
        }
        let z = self.parts[self.level[0] as usize].at;
        let (mut best, mut central, mut least) = (self.level[0], 0, f64::INFINITY);
        for at in 0..self.level.len() {
            self.collect(self.level[at])?;
            for &leaf in &self.leaves {
                let point = &self.parts[leaf as usize].at;
                let distance: f64 = point.iter().zip(&z).map(|(x, z)| (x - z) * (x - z)).sum();
                if distance < least {
                    (best, central, least) = (self.level[at], leaf, distance);
                }
            }
        }
        self.collect(best)?;
        if let Some(first) = self.leaves.iter().position(|&leaf| leaf == central) {
            self.leaves.swap(0, first);
        }
        self.support.clear();
        reserve(&mut self.support, self.leaves.len())?;
        self.support.extend(self.leaves.iter().map(|&leaf| members[leaf as usize]));
        Ok(&self.support)
    }

    /// Makes a part of every point.
    fn lift(&mut self, points: &[[f64; D]], members: &[PointId]) -> AllocResult<()> {
        self.parts.clear();
        self.level.clear();
        reserve(&mut self.parts, members.len())?;
        reserve(&mut self.level, members.len())?;
        let mut origin = [0.0; D];
        for (axis, median) in origin.iter_mut().enumerate() {
            *median = self.median(members.iter().map(|&i| points[i][axis]))?;
        }
        let offset =
            |i: PointId| -> [f64; D] { std::array::from_fn(|axis| points[i][axis] - origin[axis]) };
        let largest = |x: [f64; D]| x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let scale = inverse_power(self.median(members.iter().map(|&i| largest(offset(i))))?);
        for (number, &i) in members.iter().enumerate() {
            let at = offset(i).map(|x| x * scale);
            let lift = at.iter().map(|x| x * x).sum();
            self.parts.push(Part { at, lift, halves: [number as u32; 2] });
            self.level.push(number as u32);
        }
        Ok(())
    }

    fn median(&mut self, values: impl ExactSizeIterator<Item = f64>) -> AllocResult<f64> {
        self.values.clear();
        reserve(&mut self.values, values.len())?;
        self.values.extend(values);
        let middle = self.values.len() / 2;
        Ok(*self.values.select_nth_unstable_by(middle, f64::total_cmp).1)
    }

    /// Joins parts below the median in coordinate `axis` with parts above it; the median's own
    /// part stays as it is and comes first.
    fn pair_off(&mut self, axis: usize) -> AllocResult<()> {
        let Self { parts, level, paired, .. } = self;
        let middle = level.len() / 2;
        let value = |parts: &[Part<D>], i: u32| parts[i as usize].coordinate(axis);
        let (low, median, high) = level.select_nth_unstable_by(middle, |&a, &b| {
            value(parts, a).total_cmp(&value(parts, b)).then(a.cmp(&b))
        });
        let z = value(parts, *median);
        paired.clear();
        reserve(paired, 1 + high.len())?;
        reserve(parts, high.len())?;
        paired.push(*median);
        for (&a, &b) in low.iter().zip(&*high) {
            let (below, above) = (&parts[a as usize], &parts[b as usize]);
            let share =
                (above.coordinate(axis) - z) / (above.coordinate(axis) - below.coordinate(axis));
            if 0.0 < share && share < 1.0 {
                let (at, lift) = below.between(above, share);
                paired.push(parts.len() as u32);
                parts.push(Part { at, lift, halves: [a, b] });
            } else {
                // One of them is on the median itself; or out of range.
                paired.push(if share == 0.0 { b } else { a });
            }
        }
        std::mem::swap(level, paired);
        Ok(())
    }

    /// Collects the numbers of the points of part `root` into `leaves`.
    fn collect(&mut self, root: u32) -> AllocResult<()> {
        self.leaves.clear();
        self.paired.clear();
        self.paired.try_push(root)?;
        while let Some(part) = self.paired.pop() {
            let [a, b] = self.parts[part as usize].halves;
            if a == b {
                self.leaves.try_push(a)?;
            } else {
                self.paired.try_push(b)?;
                self.paired.try_push(a)?;
            }
        }
        Ok(())
    }
}

/// Returns about 1 / `length`, a power of two.
fn inverse_power(length: f64) -> f64 {
    let exponent = (length.to_bits() >> 52 & 0x7ff).clamp(23, 2023);
    f64::from_bits((2046 - exponent) << 52)
}
