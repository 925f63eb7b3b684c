//! Encroachment (Definition 2) and mediality (§6.2), both read off the vertices U(x) of the D-balls
//! that hold x, which are the corners of the scratch cavity.

use super::Mesher;
use super::cage::CageSite;
use super::domains::ROOT;
use super::parameters::Parameters;
use crate::numerics::distance;

/// Domains from the innermost outward that an input may encroach from inside: radii fall by
/// epsilon per level, so a point near one sphere is far inside all but the next.
pub(super) const LEVELS: usize = 3;
/// A new cage is this much larger than |u - v| / epsilon, so that v is strictly inside epsilon r.
const SLACK: f64 = 1.001;

/// How much more room than it needs a cage must have to be smaller than the refinement that it
/// saves (docs/decisions.md): cages are cheap in 2D, dearer above.
const fn pays<const D: usize>() -> f64 {
    if D == 2 { 1.0 } else { 2.0 }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// The cage that INSERTINPUT makes before `input` goes in, around its nearest neighbour u in
    /// M_Omega. The paper asks for mediality |u-v| / |v-s| <= epsilon, s being the second nearest;
    /// that may leave the new cage encroached, and s need not be in U(v) when it is behind u. We
    /// ask for what the cage needs: no vertex within outf r / epsilon of u.
    pub(super) fn wanted_cage(&mut self, input: u32) -> Option<CageSite> {
        let x = *self.delaunay.point(input);
        let parent = self.containing_domain(&x);
        let (center, gap) = self.nearest_in_domain(&x, parent)?;
        let Parameters { epsilon, encroachment, .. } = self.parameters;
        let radius = SLACK * gap / epsilon;
        let has_room =
            self.clearance(center, parent) >= pays::<D>() * encroachment * radius / epsilon;
        has_room.then_some(CageSite { center, radius, parent })
    }

    /// The vertex of M_Omega nearest to `x`, and its distance.
    fn nearest_in_domain(&mut self, x: &[f64; D], omega: u32) -> Option<(u32, f64)> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for at in 0..self.scratch.corners.ids.len() {
            let corner = self.scratch.corners.ids[at];
            let Some(vertex) = self.hierarchy.representative(corner, omega) else { continue };
            let gap = distance(x, self.delaunay.point(vertex));
            if gap < least {
                least = gap;
                nearest = Some((vertex, gap));
            }
        }
        nearest
    }

    /// The distance from `vertex`, which is in M_Omega, to the nearest vertex that is not in the
    /// child of Omega around it.
    fn clearance(&mut self, vertex: u32, omega: u32) -> f64 {
        match self.hierarchy.child_towards(omega, vertex) {
            Some(child) => self.hierarchy.node(child).outside,
            None => self.nearest[vertex as usize],
        }
    }

    /// The innermost domain that holds `x`, over the climbs from U(x).
    pub(super) fn containing_domain(&mut self, x: &[f64; D]) -> u32 {
        if self.hierarchy.is_single() {
            return ROOT;
        }
        let mut innermost = ROOT;
        for at in 0..self.scratch.corners.ids.len() {
            let from = self.hierarchy.domain_of(self.scratch.corners.ids[at]);
            let domain = self.hierarchy.climb_to(from, x);
            if self.hierarchy.node(domain).radius < self.hierarchy.node(innermost).radius {
                innermost = domain;
            }
        }
        innermost
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
            if self.hierarchy.distance_to_center(domain, x) > reach {
                return Some(domain);
            }
            domain = self.hierarchy.parent(domain);
        }
        None
    }

    /// OUTENCROACH with RELEASECAGE: releases every cage that `x`, whose conflicts are the scratch
    /// cavity, encroaches from outside. Returns the innermost domain that then holds `x`.
    pub(super) fn enter(&mut self, x: &[f64; D]) -> u32 {
        if self.hierarchy.is_single() {
            return ROOT;
        }
        let reach = self.parameters.encroachment / self.parameters.epsilon;
        for at in 0..self.scratch.corners.ids.len() {
            let mut domain = self.hierarchy.domain_of(self.scratch.corners.ids[at]);
            while !self.hierarchy.contains(domain, x) {
                let gap = self.hierarchy.distance_to_center(domain, x);
                let parent = self.hierarchy.parent(domain);
                if gap < reach * self.hierarchy.node(domain).radius {
                    self.release_cage(domain);
                }
                domain = parent;
            }
        }
        self.containing_domain(x)
    }
}
