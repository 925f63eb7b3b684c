//! Encroachment (Definition 2), read off the vertices U(x) of the D-balls that hold x, which are the
//! corners of the scratch cavity.

use super::Mesher;
use super::domains::ROOT;
use crate::memory::AllocResult;

/// Domains from the innermost outward that an input may encroach from inside: radii fall by
/// epsilon per level, so a point near one sphere is far inside all but the next.
pub(super) const LEVELS: usize = 3;

/// Subnormal distances are rounded to whole units: one that is not above a limit may still be.
const SMALLEST: f64 = f64::from_bits(1);

impl<const D: usize> Mesher<'_, '_, D> {
    /// The innermost domain that holds `x`, over the climbs from U(x).
    pub(super) fn containing_domain(&mut self, x: &[f64; D]) -> u32 {
        if self.hierarchy.is_single() {
            return ROOT;
        }
        if let Some(domain) = self.common_domain() {
            return self.hierarchy.climb_to(domain, x);
        }
        let mut innermost = ROOT;
        for at in 0..self.scratch.cavity.corners.ids.len() {
            let from = self.hierarchy.domain_of(self.scratch.cavity.corners.ids[at]);
            let domain = self.hierarchy.climb_to(from, x);
            if self.hierarchy.node(domain).radius < self.hierarchy.node(innermost).radius {
                innermost = domain;
            }
        }
        innermost
    }

    /// The domain of all of U(x), where that is known without a climb.
    pub(super) fn common_domain(&mut self) -> Option<u32> {
        let corners = &self.scratch.cavity.corners.ids;
        self.hierarchy.is_alike(corners).then(|| self.hierarchy.domain_of(corners[0]))
    }

    /// INENCROACH: the innermost domain that `input` encroaches from inside.
    pub(super) fn inner_encroached(&mut self, input: u32) -> Option<u32> {
        if self.hierarchy.is_single() {
            return None;
        }
        let x = *self.delaunay.point(input);
        let domain = self.containing_domain(&x);
        self.inner_encroached_from(domain, &x)
    }

    /// The first domain from `domain` outward whose annulus (epsilon r, r) holds `x`. The root is
    /// exempt: its ball is chosen to hold all inputs.
    pub(super) fn inner_encroached_from(&mut self, domain: u32, x: &[f64; D]) -> Option<u32> {
        let mut domain = domain;
        for _ in 0..LEVELS {
            if domain == ROOT {
                return None;
            }
            let reach = self.parameters.epsilon * self.hierarchy.node(domain).radius;
            if self.hierarchy.distance_to_center(domain, x) + SMALLEST > reach {
                return Some(domain);
            }
            domain = self.hierarchy.parent(domain);
        }
        None
    }

    /// OUTENCROACH with RELEASECAGE: releases every cage that `x`, whose conflicts are the scratch
    /// cavity, encroaches from outside. Returns the innermost domain that then holds `x`.
    pub(super) fn enter(&mut self, x: &[f64; D]) -> AllocResult<u32> {
        if self.hierarchy.is_single() {
            return Ok(ROOT);
        }
        if let Some(domain) = self.common_domain() {
            if self.hierarchy.contains(domain, x) {
                return Ok(domain);
            }
        }
        let reach = self.parameters.encroachment / self.parameters.epsilon;
        for at in 0..self.scratch.cavity.corners.ids.len() {
            let mut domain = self.hierarchy.domain_of(self.scratch.cavity.corners.ids[at]);
            while !self.hierarchy.contains(domain, x) {
                let gap = self.hierarchy.distance_to_center(domain, x);
                let parent = self.hierarchy.parent(domain);
                if gap < reach * self.hierarchy.node(domain).radius {
                    self.release_cage(domain)?;
                }
                domain = parent;
            }
        }
        Ok(self.containing_domain(x))
    }
}
