//! CLEAN (§6.4) and YIELDINGINSERT (§6.3): the far corner of a bad cell goes in, or the input
//! nearest to it in its D-ball instead.

use super::Mesher;
use super::refine::Entry;
use super::steiner::SteinerPoint;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::numerics::distance;

impl<const D: usize> Mesher<'_, '_, D> {
    /// CLEAN: refines until no cell is bad that doubles can mend.
    pub(super) fn clean(&mut self) -> Result<()> {
        while let Some(entry) = self.refine.pop() {
            let simplex = entry.simplex;
            if !self.delaunay.complex().is_live(simplex) {
                continue;
            }
            if self.is_bad(simplex) {
                self.refine_corner(simplex)?;
            } else if let Some(domain) = self.open_domain(simplex) {
                self.close_slit(simplex, domain)?;
            }
            self.queue_again(entry)?;
        }
        Ok(())
    }

    /// An input that was yielded to may lie on the D-ball within rounding, and a further cage vertex
    /// beyond it: they leave the simplex.
    fn queue_again(&mut self, entry: Entry) -> AllocResult<()> {
        if self.refine.is_current(entry) && self.delaunay.complex().is_live(entry.simplex) {
            self.examine(entry.simplex)?;
        }
        Ok(())
    }

    /// YIELDINGINSERT of the Steiner point for `simplex`.
    pub(super) fn refine_corner(&mut self, simplex: u32) -> Result<()> {
        let Some(SteinerPoint { point: x, radius, is_corner }) = self.steiner_point(simplex) else {
            self.refine.limit(simplex);
            return Ok(());
        };
        self.delaunay.find_cavity(simplex, &x, &mut self.scratch.cavity)?;
        if !self.may_replace_cavity() {
            self.refine.limit(simplex);
            return Ok(());
        }
        // With a yield radius above 1 - epsilon the input need not be medial: INSERTINPUT, not
        // the paper's INSERT, and with it the encroachment that an input may cause.
        if let Some(input) = self.input_near(&x, self.parameters.yield_radius * radius)? {
            self.stats.yields += 1;
            if !self.insert_input(input)? {
                self.refine.limit(simplex);
            }
            return Ok(());
        }
        if !self.may_insert(&x) {
            self.refine.limit(simplex);
            return Ok(());
        }
        let domain = self.enter(&x)?;
        let vertex = self.add_vertex(x)?;
        match is_corner {
            true => self.stats.far_corners += 1,
            false => self.stats.off_centers += 1,
        }
        self.hierarchy.set_domain(vertex, domain);
        self.insert_into_cavity(vertex)
    }

    /// The uninserted input nearest to `x` within `reach`, among the homes in the scratch cavity
    /// (the cavity of `x`).
    pub(super) fn input_near(&mut self, x: &[f64; D], reach: f64) -> Result<Option<u32>> {
        if self.location.remaining() == 0 {
            return Ok(None);
        }
        let mut best = None;
        let mut best_gap = reach;
        for at in 0..self.scratch.cavity.simplices.len() {
            let simplex = self.scratch.cavity.simplices[at];
            for input in self.location.inhabitants(simplex) {
                self.watch.poll_after(1)?;
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
