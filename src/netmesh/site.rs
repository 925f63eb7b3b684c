//! Where a cage goes and how large it is: MEDIALITY (§6.2) as INSERTINPUT needs it, and the radii
//! that NEWCAGE and GROWCAGE take.

use super::Mesher;
use super::start::{REPRESENTABLE, spacing_near};
use crate::error::Result;
use crate::memory::TryGrow;
use crate::numerics::distance;
use crate::options::Output;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

/// Where a cage is wanted.
#[derive(Clone, Copy, Debug)]
pub(super) struct CageSite {
    pub center: u32,
    pub radius: f64,
    pub parent: u32,
}

/// A cage for an input at distance g from its centre has at least this times g / epsilon for its
/// radius, so that the input is strictly inside epsilon r.
const SLACK: f64 = 1.001;

/// Subnormal distances are rounded to whole units of the smallest double.
const ROUNDING: f64 = 4.0 * f64::from_bits(1);

/// How much more room than it needs a cage must have in a mesh that FINISHMESH completes: that fills
/// the gap which the cage bridges, and the cage's vertices are then too many (docs/decisions.md).
const ROOM_IF_FINISHED: f64 = 128.0;

impl<const D: usize> Mesher<'_, '_, D> {
    /// The cage that INSERTINPUT makes before `input` goes in, around its nearest neighbour u in
    /// M_Omega. The paper asks for mediality |u-v| / |v-s| <= epsilon, s being the second nearest;
    /// that may leave the new cage encroached, and s need not be in U(v) when it is behind u. We
    /// ask for what the cage needs: no vertex within outf r / epsilon of u.
    pub(super) fn wanted_cage(&mut self, input: u32) -> Result<Option<CageSite>> {
        let x = *self.delaunay.point(input);
        let parent = self.containing_domain(&x);
        let Some((center, gap)) = self.nearest_in_domain(&x, parent) else { return Ok(None) };
        let child = self.hierarchy.child_towards(parent, center);
        let clearance = match child {
            Some(child) => self.hierarchy.node(child).outside,
            None => self.cells[center as usize].nearest,
        };
        let most = self.radius_within(clearance) / self.spare_room();
        let most = most.min(self.room_inside(parent, center));
        let least = self.radius_for(gap).max(self.smallest_radius(center));
        let radius = self.lasting_radius(center, child, least, most)?;
        Ok(radius.map(|radius| CageSite { center, radius, parent }))
    }

    /// The larger cage that GROWCAGE makes in place of `cage`, if there is room for it. (The paper
    /// compares Vor(C)'s in-radius (d + r)/2 with r / epsilon^2, but only the nearest outside
    /// vertex's distance d tells whether the new cage is un-encroached.)
    pub(super) fn grown_site(&mut self, cage: u32, least: f64) -> Result<Option<CageSite>> {
        let parent = self.hierarchy.parent(cage);
        let node = self.hierarchy.node(cage);
        let (center, outside) = (node.center, node.outside);
        let most = (outside / self.outer_reach()).min(self.room_inside(parent, center));
        let radius = self.lasting_radius(center, Some(cage), least, most)?;
        Ok(radius.map(|radius| CageSite { center, radius, parent }))
    }

    fn spare_room(&self) -> f64 {
        match self.parameters.output {
            Output::WellSpaced => ROOM_IF_FINISHED,
            Output::Hierarchical => 1.0,
        }
    }

    /// The radius of a cage that has an input at distance `gap` from its centre well inside.
    pub(super) fn radius_for(&self, gap: f64) -> f64 {
        SLACK * gap / self.parameters.epsilon + ROUNDING
    }

    /// The largest radius of a cage with the nearest vertex outside at distance `clearance`.
    fn radius_within(&self, clearance: f64) -> f64 {
        (clearance - ROUNDING) / self.outer_reach()
    }

    /// The largest radius of a cage round a vertex of `parent` that stays inside its ball. With epsilon
    /// at most 0.5 the clearance asks for less.
    fn room_inside(&self, parent: u32, center: u32) -> f64 {
        let radius = self.hierarchy.node(parent).radius;
        let gap = self.hierarchy.distance_to_center(parent, self.delaunay.point(center));
        radius * (1.0 - 1e-9) - gap
    }

    /// The smallest radius about a vertex that doubles can express: a cage around inputs that are a
    /// few units of roundoff apart is as large as that takes.
    fn smallest_radius(&self, center: u32) -> f64 {
        let spacing = spacing_near(self.delaunay.point(center));
        REPRESENTABLE * spacing / (self.parameters.delta * self.parameters.cage_scale)
    }

    /// A vertex within this times r of a cage's centre outer-encroaches it.
    pub(super) fn outer_reach(&self) -> f64 {
        self.parameters.encroachment / self.parameters.epsilon
    }

    /// The vertex of M_Omega nearest to `x`, and its distance.
    fn nearest_in_domain(&mut self, x: &[f64; D], omega: u32) -> Option<(u32, f64)> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for at in 0..self.scratch.cavity.corners.ids.len() {
            let corner = self.scratch.cavity.corners.ids[at];
            let Some(vertex) = self.hierarchy.representative(corner, omega) else { continue };
            let gap = distance(x, self.delaunay.point(vertex));
            if gap < least {
                least = gap;
                nearest = Some((vertex, gap));
            }
        }
        nearest
    }

    /// The smallest radius in `least..=most` that no uninserted input nearby would encroach when
    /// its turn comes. Any radius in the range is a correct one; this one spares cages that would
    /// soon be released and leave their vertices behind.
    fn lasting_radius(
        &mut self,
        center: u32,
        child: Option<u32>,
        least: f64,
        most: f64,
    ) -> Result<Option<f64>> {
        if least > most {
            return Ok(None);
        }
        let reach = self.outer_reach();
        let mut radius = least;
        let range = self.parameters.epsilon * least..reach * most;
        // A heap, since often a few of very many are looked at.
        let mut gaps = BinaryHeap::from(self.gaps_nearby(center, child, range)?);
        while let Some(Reverse(bits)) = gaps.pop() {
            self.watch.poll_after(1)?;
            let gap = f64::from_bits(bits);
            if gap >= reach * radius || radius > most {
                break;
            }
            if gap > self.parameters.epsilon * radius {
                radius = self.radius_for(gap);
            }
        }
        self.scratch.gaps = gaps.into_vec();
        Ok((radius <= most).then_some(radius))
    }

    /// The distances in `range` from `center` to the uninserted inputs whose homes are in the
    /// scratch cavity or next to the centre (or the cage of the `child` domain round it), as bits,
    /// which are ordered as distances are.
    fn gaps_nearby(
        &mut self,
        center: u32,
        child: Option<u32>,
        range: Range<f64>,
    ) -> Result<Vec<Reverse<u64>>> {
        let mut gaps = std::mem::take(&mut self.scratch.gaps);
        gaps.clear();
        if self.location.remaining() == 0 {
            return Ok(gaps);
        }
        let near = &mut self.scratch.near;
        near.clear();
        near.try_extend(&self.scratch.cavity.simplices)?;
        let around: &[u32] = match child {
            Some(child) => &self.hierarchy.node(child).cage,
            None => &[center],
        };
        for &vertex in around {
            self.delaunay.star(vertex, &mut self.scratch.star)?;
            near.try_extend(&self.scratch.star)?;
        }
        near.sort_unstable();
        near.dedup();
        for &simplex in near.iter() {
            for input in self.location.inhabitants(simplex) {
                self.watch.poll_after(1)?;
                let gap = distance(self.delaunay.point(input), self.delaunay.point(center));
                if range.contains(&gap) {
                    gaps.try_push(Reverse(gap.to_bits()))?;
                }
            }
        }
        Ok(gaps)
    }
}
