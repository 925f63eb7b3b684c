//! Exact signs of determinants of points, by other methods than the builder's: in two dimensions,
//! and for orientations in three, the adaptive expansions of the package `robust`, where they are
//! exact; for spheres a determinant in doubles, where its error leaves no doubt; all others by
//! elimination in intervals, and in integers where intervals do not decide.
//!
//! No sign takes more than some KiB of stack: callers may have threads of small stacks.

mod adaptive;
mod interval;

pub(super) use adaptive::{Adaptive, Robust};

use crate::memory::AllocResult;
use crate::quality::exact::{Lift, lifted_determinant_sign};
use std::cmp::Ordering;

/// The signs that a check asks for, and how many of them came from where.
#[derive(Debug, Default)]
pub(super) struct Signs<A = Robust> {
    pub(super) adaptive: A,
    pub(super) by_expansions: u64,
    pub(super) by_intervals: u64,
    pub(super) by_integers: u64,
}

impl<A: Adaptive> Signs<A> {
    /// Returns the sign of det[p1 - p0, ..., pD - p0] for `D + 1` finite points.
    pub fn orientation<const D: usize>(&mut self, simplex: &[&[f64; D]]) -> AllocResult<Ordering> {
        if let Some(sign) = self.adaptive.orientation(simplex) {
            self.by_expansions += 1;
            return Ok(sign);
        }
        self.determinant(simplex[0], &simplex[1..], Lift::None)
    }

    /// Tells whether `q` is strictly inside (greater), on (equal) or strictly outside (less) the
    /// sphere through the `D + 1` finite points of a positively oriented simplex.
    pub fn in_ball<const D: usize>(
        &mut self,
        simplex: &[&[f64; D]],
        q: &[f64; D],
    ) -> AllocResult<Ordering> {
        if let Some(sign) = self.adaptive.in_ball(simplex, q) {
            self.by_expansions += 1;
            return Ok(sign);
        }
        let mut ends = [q; crate::mesh::MAX_DIM + 1];
        ends[..D].copy_from_slice(&simplex[1..]);
        // With edges v_i to the simplex, w to q and centre c: det(v) (|w|^2 - 2 w.c), positive
        // outside.
        Ok(self.determinant(simplex[0], &ends[..=D], Lift::Square)?.reverse())
    }

    fn determinant<const D: usize>(
        &mut self,
        origin: &[f64; D],
        ends: &[&[f64; D]],
        lift: Lift,
    ) -> AllocResult<Ordering> {
        if let Some(sign) = interval::determinant_sign(origin, ends, lift) {
            self.by_intervals += 1;
            return Ok(sign);
        }
        self.by_integers += 1;
        lifted_determinant_sign(origin, ends, lift)
    }
}
