//! The D-balls that meet a given D-ball (Theorem 4). They are connected in the Delaunay complex:
//! let B' meet B, and take a point of both. The D-balls that hold this point are its cavity, which
//! is connected, is within the balls that meet B since the point is in B, and has both simplices.
//! Beyond the hull the cavity may be connected only through infinite simplices, so the search
//! passes through all of these.

use super::Delaunay;
use crate::complex::SimplexId;
use crate::memory::{AllocResult, Array, TryGrow};
use crate::numerics::norm;
use std::ops::RangeInclusive;

impl<const D: usize> Delaunay<D> {
    /// Returns the number of other D-balls that meet the D-ball of the finite `simplex`. Distances
    /// are rounded, so that balls which only touch may or may not count. At most `most` simplices
    /// are visited; `found` is a buffer.
    pub fn count_meeting(
        &mut self,
        simplex: SimplexId,
        most: usize,
        found: &mut Array<SimplexId>,
    ) -> AllocResult<u64> {
        found.clear();
        self.complex.begin_marks()?;
        self.complex.mark_inside(simplex)?;
        found.try_push(simplex)?;
        let mut count = 0;
        let mut next = 0;
        while next < found.len() && found.len() < most {
            let current = found[next];
            next += 1;
            for index in 0..=D {
                let beyond = self.complex.neighbors(current)[index];
                if self.complex.is_inside(beyond) {
                    continue;
                }
                self.complex.mark_inside(beyond)?;
                let is_finite = self.has_ball(beyond);
                if !is_finite || self.balls_meet(simplex, beyond) {
                    count += u64::from(is_finite);
                    found.try_push(beyond)?;
                }
            }
        }
        Ok(count)
    }

    /// Collects into `found` (cleared first) the simplices whose D-balls meet the shell of the
    /// given `radii` about `center`, and the infinite ones beside them. Returns false if it ended
    /// before all were found, at `most` simplices. `start` must be one of them. D-balls that hold a
    /// point of the shell are connected, so all of them are. Distances are rounded.
    pub fn meeting_shell(
        &mut self,
        start: SimplexId,
        center: &[f64; D],
        radii: RangeInclusive<f64>,
        most: usize,
        found: &mut Vec<SimplexId>,
    ) -> AllocResult<bool> {
        found.clear();
        self.complex.begin_marks()?;
        self.complex.mark_inside(start)?;
        found.try_push(start)?;
        let mut next = 0;
        while next < found.len() {
            if found.len() > most {
                return Ok(false);
            }
            let current = found[next];
            next += 1;
            for index in 0..=D {
                let beyond = self.complex.neighbors(current)[index];
                if self.complex.is_marked(beyond) {
                    continue;
                }
                // Out of range, or infinite: taken to meet. A D-ball may be much larger than the
                // shell, and is told apart from it in doubles.
                let is_apart = self.circumball_and_anchor(beyond).is_some_and(|(ball, anchor)| {
                    let distance = ball.center_distance(anchor, center);
                    let radius = ball.radius();
                    distance > *radii.end() + radius || distance + radius < *radii.start()
                });
                if is_apart {
                    self.complex.mark_either(beyond, false)?;
                } else {
                    self.complex.mark_inside(beyond)?;
                    found.try_push(beyond)?;
                }
            }
        }
        Ok(true)
    }

    /// Returns true if the D-balls of two finite simplices meet. The centres are not rounded to
    /// coordinates before they are compared, so that those of a tiny cluster are told apart too.
    fn balls_meet(&self, a: SimplexId, b: SimplexId) -> bool {
        let balls = self.circumball_and_anchor(a).zip(self.circumball_and_anchor(b));
        let Some(((a, from), (b, to))) = balls else { return false };
        let (unit_a, unit_b) = (a.unit(), b.unit());
        let offset: [f64; D] = std::array::from_fn(|axis| {
            (to[axis] - from[axis]) + (b.center[axis] * unit_b - a.center[axis] * unit_a)
        });
        norm(&offset) < a.radius() + b.radius()
    }
}
