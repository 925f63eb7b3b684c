//! Which input of a cluster goes in first. A cage stands round a vertex and has to hold the cluster
//! as seen from there: round an input at the rim it is twice as large as round a central one, and
//! must find twice the room.

use super::Mesher;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::numerics::distance;
use crate::options::Algorithm;

/// A gap this many times as wide as what it surrounds sets inputs apart (docs/decisions.md).
const GAP: f64 = 2.0;

/// Fewer inputs have no middle.
const FEWEST: usize = 3;

impl<const D: usize> Mesher<'_, '_, D> {
    /// The most central input of the cluster of uninserted inputs round `input`, to be inserted
    /// before it; `None` if there is no cluster, or if `input` is the one. Looks at inputs in the
    /// cavity of `input` only, all of which its insertion touches.
    pub(super) fn central_neighbor(&mut self, input: u32) -> Result<Option<u32>> {
        if self.parameters.algorithm != Algorithm::Netmesh || self.is_inserted(input) {
            return Ok(None);
        }
        self.find_cavity_of_input(input)?;
        self.collect_cavity_corners()?;
        let clearance = self.nearest_corner(self.delaunay.point(input));
        let outside = self.collect_inputs_near(input, clearance)?;
        let size = cluster_size(&self.scratch.cluster, outside);
        self.scratch.cluster.truncate(size);
        Ok(self.most_central().filter(|&central| central != input))
    }

    /// Collects the inputs in the scratch cavity that may be in a cluster with `input`, itself
    /// included, in the order of their distances from it. Returns that of the nearest other one, or
    /// `clearance`, if that is less.
    fn collect_inputs_near(&mut self, input: u32, clearance: f64) -> Result<f64> {
        let mut outside = clearance;
        let x = *self.delaunay.point(input);
        self.scratch.cluster.clear();
        for &simplex in &self.scratch.cavity.simplices {
            for other in self.location.inhabitants(simplex) {
                self.watch.tick(1)?;
                let gap = distance(&x, self.delaunay.point(other));
                if gap * GAP < clearance {
                    self.scratch.cluster.try_push((gap.to_bits(), other))?;
                } else {
                    outside = outside.min(gap);
                }
            }
        }
        self.scratch.cluster.sort_unstable();
        Ok(outside)
    }

    /// The input of the scratch cluster nearest to the middle of its bounding box.
    fn most_central(&self) -> Option<u32> {
        let points = self.scratch.cluster.iter().map(|&(_, input)| self.delaunay.point(input));
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for point in points {
            for axis in 0..D {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        let middle = std::array::from_fn(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
        let eccentricity = |input: u32| distance(self.delaunay.point(input), &middle);
        let inputs = self.scratch.cluster.iter().map(|&(_, input)| input);
        inputs.min_by(|&a, &b| eccentricity(a).total_cmp(&eccentricity(b)))
    }
}

/// How many of `near` the first gap sets apart, that to what is `outside` included; 0 if none does
/// or they are too few.
fn cluster_size(near: &[(u64, u32)], outside: f64) -> usize {
    let gap = |at: usize| near.get(at).map_or(outside, |&(bits, _)| f64::from_bits(bits));
    (FEWEST..=near.len()).find(|&size| gap(size) > GAP * gap(size - 1)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(gaps: &[f64], outside: f64) -> usize {
        let near: Vec<_> = gaps.iter().map(|gap| (gap.to_bits(), 0)).collect();
        cluster_size(&near, outside)
    }

    #[test]
    fn a_cluster_ends_at_the_first_wide_gap() {
        assert_eq!(size(&[0.0, 1.0, 1.5, 4.0, 9.0], 20.0), 3);
        assert_eq!(size(&[0.0, 1.0, 1.5, 2.9, 4.0], 9.0), 5);
        assert_eq!(size(&[0.0, 1.0, 1.5, 2.9, 4.0], 8.0), 0);
        assert_eq!(size(&[0.0, 1.0], 20.0), 0);
        assert_eq!(size(&[], 20.0), 0);
    }
}
