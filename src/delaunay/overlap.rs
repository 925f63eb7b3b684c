//! Which D-balls meet one D-ball (Theorem 4). They are connected in the Delaunay complex: let B' meet
//! B, and take a point of both. The D-balls that hold this point are its cavity, which is connected,
//! is within the balls that meet B since the point is in B, and has both simplices. Beyond the hull the
//! cavity may be connected only through infinite simplices, so these are all passed through.

use super::Delaunay;
use crate::memory::{Fallible, TryGrow};
use crate::numerics::norm;

impl<const D: usize> Delaunay<D> {
    /// The number of other D-balls that meet that of the finite `simplex`. Distances are rounded:
    /// which balls that only touch are counted is left open. No more than `most` simplices are
    /// visited; `found` is a buffer.
    pub fn count_meeting(
        &mut self,
        simplex: u32,
        most: usize,
        found: &mut Vec<u32>,
    ) -> Fallible<u64> {
        found.clear();
        self.complex.begin_marks();
        self.complex.mark_inside(simplex);
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
                self.complex.mark_inside(beyond);
                let is_finite = self.ball(beyond).is_some();
                if !is_finite || self.balls_meet(simplex, beyond) {
                    count += u64::from(is_finite);
                    found.try_push(beyond)?;
                }
            }
        }
        Ok(count)
    }

    /// Whether the D-balls of two finite simplices meet. The centres are compared unrounded: those
    /// of a tiny cluster are told apart too.
    fn balls_meet(&self, a: u32, b: u32) -> bool {
        let (Some((a, from)), Some((b, to))) = (self.ball_and_anchor(a), self.ball_and_anchor(b))
        else {
            return false;
        };
        let (unit_a, unit_b) = (a.unit(), b.unit());
        let offset: [f64; D] = std::array::from_fn(|axis| {
            (to[axis] - from[axis]) + (b.center[axis] * unit_b - a.center[axis] * unit_a)
        });
        norm(&offset) < a.radius() + b.radius()
    }
}
