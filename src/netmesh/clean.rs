//! CLEAN (§6.4) and YIELDINGINSERT (§6.3): the far corner of a bad cell goes in, or the input
//! nearest to it in its D-ball instead.

use super::Mesher;
use super::steiner::SteinerPoint;
use crate::error::Result;
use crate::memory::{Fallible, TryGrow, enqueue, expect};
use crate::numerics::distance;
use std::collections::VecDeque;

const QUEUED: u8 = 1;
const LIMITED: u8 = 2;

/// REFINELIST: simplices that were bad when they were queued; whether they still are is tested
/// when they come up, so an id that was reused meanwhile does no harm.
#[derive(Default)]
pub(super) struct RefineList {
    queue: VecDeque<u32>,
    flags: Vec<u8>,
}

impl RefineList {
    /// Makes room for so many simplices if the system gives it.
    pub fn expect(&mut self, simplices: usize) {
        expect(&mut self.flags, simplices);
    }

    /// Forgets what was known of ids that new simplices have taken.
    pub fn forget(&mut self, created: &[u32], bound: usize) -> Fallible<()> {
        self.flags.cover(bound, 0)?;
        for &simplex in created {
            self.flags[simplex as usize] &= QUEUED;
        }
        Ok(())
    }

    pub fn push(&mut self, simplex: u32) -> Fallible<()> {
        let flags = &mut self.flags[simplex as usize];
        if *flags & QUEUED != 0 {
            return Ok(());
        }
        *flags |= QUEUED;
        enqueue(&mut self.queue, simplex)
    }

    fn pop(&mut self) -> Option<u32> {
        let simplex = self.queue.pop_front()?;
        self.flags[simplex as usize] &= !QUEUED;
        Some(simplex)
    }

    /// Whether the corner of `simplex` cannot be inserted for want of precision.
    pub fn is_limited(&self, simplex: u32) -> bool {
        self.flags.get(simplex as usize).is_some_and(|flags| flags & LIMITED != 0)
    }

    fn limit(&mut self, simplex: u32) {
        self.flags[simplex as usize] |= LIMITED;
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// CLEAN: refines until no cell is bad that doubles can mend.
    pub(super) fn clean(&mut self) -> Result<()> {
        while let Some(simplex) = self.refine.pop() {
            if self.delaunay.complex().is_live(simplex) && self.is_bad(simplex) {
                self.refine_corner(simplex)?;
                self.queue_again(simplex)?;
            }
        }
        Ok(())
    }

    /// An input that was yielded to may lie on the D-ball within rounding and leave the simplex.
    fn queue_again(&mut self, simplex: u32) -> Fallible<()> {
        if self.delaunay.complex().is_live(simplex) && self.is_bad(simplex) {
            self.refine.push(simplex)?;
        }
        Ok(())
    }

    /// YIELDINGINSERT of the Steiner point for `simplex`.
    pub(super) fn refine_corner(&mut self, simplex: u32) -> Result<()> {
        let Some(SteinerPoint { point: x, radius }) = self.steiner_point(simplex) else {
            self.refine.limit(simplex);
            return Ok(());
        };
        self.delaunay.find_cavity(simplex, &x, &mut self.scratch.cavity)?;
        // With a yield radius above 1 - epsilon the input need not be medial: INSERTINPUT, not
        // the paper's INSERT, and with it the encroachment that an input may cause.
        if let Some(input) = self.input_near(&x, self.parameters.yield_radius * radius)? {
            let first = self.central_neighbor(input)?.unwrap_or(input);
            return self.insert_input(first);
        }
        self.collect_cavity_corners()?;
        let domain = self.enter(&x)?;
        let vertex = self.add_vertex(x)?;
        self.hierarchy.set_domain(vertex, domain);
        self.insert_into_cavity(vertex)
    }

    /// The uninserted input nearest to `x` within `reach`, among the homes in the scratch cavity
    /// (the cavity of `x`).
    pub(super) fn input_near(&mut self, x: &[f64; D], reach: f64) -> Result<Option<u32>> {
        let mut best = None;
        let mut best_gap = reach;
        for at in 0..self.scratch.cavity.simplices.len() {
            let simplex = self.scratch.cavity.simplices[at];
            for input in self.location.inhabitants(simplex) {
                self.watch.tick(1)?;
                let gap = distance(x, self.delaunay.point(input));
                if gap < best_gap {
                    best_gap = gap;
                    best = Some(input);
                }
            }
        }
        Ok(best)
    }
}
