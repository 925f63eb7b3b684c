//! Encroachment (Definition 2), read off the vertices U(x) of the D-balls that hold x, which are
//! the vertices of `cavity`.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::netmesh::state::State;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};

/// Domains from the innermost outward that an input may encroach from inside: radii fall by
/// epsilon per level, so a point near one sphere is far inside all but the next.
pub(in crate::netmesh) const LEVELS: usize = 3;

/// Subnormal distances are rounded to whole units: one that is not above a limit may still be.
const SMALLEST: f64 = f64::from_bits(1);

impl<const D: usize> State<D> {
    /// Returns the innermost domain that holds `x`, over the climbs from U(x).
    pub(in crate::netmesh) fn containing_domain(
        &mut self,
        x: &[f64; D],
        cavity: &Cavity,
    ) -> DomainId {
        if self.hierarchy.is_single() {
            return ROOT;
        }
        if let Some(domain) = self.common_domain(cavity) {
            return self.hierarchy.climb_to(domain, x);
        }
        let mut innermost = ROOT;
        for at in 0..cavity.vertices.ids.len() {
            let from = self.hierarchy.domain_of(cavity.vertices.ids[at]);
            let domain = self.hierarchy.climb_to(from, x);
            if self.hierarchy.node(domain).radius < self.hierarchy.node(innermost).radius {
                innermost = domain;
            }
        }
        innermost
    }

    /// Returns the domain of all of U(x), where that is known without a climb.
    pub(in crate::netmesh) fn common_domain(&mut self, cavity: &Cavity) -> Option<DomainId> {
        let vertices = &cavity.vertices.ids;
        self.hierarchy.same_domain(vertices).then(|| self.hierarchy.domain_of(vertices[0]))
    }

    /// Returns the innermost domain that `input` encroaches from inside (INENCROACH).
    pub(in crate::netmesh) fn inner_encroached(
        &mut self,
        input: VertexId,
        cavity: &Cavity,
    ) -> Option<DomainId> {
        if self.hierarchy.is_single() {
            return None;
        }
        let x = *self.delaunay.point(input);
        let domain = self.containing_domain(&x, cavity);
        self.inner_encroached_from(domain, &x)
    }

    /// Returns the first domain from `domain` outward whose annulus (epsilon r, r) holds `x`. The
    /// root is exempt: its ball is chosen to hold all inputs.
    pub(in crate::netmesh) fn inner_encroached_from(
        &mut self,
        domain: DomainId,
        x: &[f64; D],
    ) -> Option<DomainId> {
        let mut domain = domain;
        for _ in 0..LEVELS {
            if domain == ROOT {
                return None;
            }
            let max_distance = self.parameters.epsilon * self.hierarchy.node(domain).radius;
            if self.hierarchy.distance_to_center(domain, x) + SMALLEST > max_distance {
                return Some(domain);
            }
            domain = self.hierarchy.parent(domain);
        }
        None
    }

    /// Returns the distance from the centre of `domain` within which a vertex outside encroaches
    /// it.
    pub(super) fn outer_reach(&self, domain: DomainId) -> f64 {
        self.outer_encroachment() * self.hierarchy.node(domain).radius
    }

    /// Returns true if `x`, which is outside of `domain`, encroaches it.
    pub(in crate::netmesh) fn outer_encroaches(&self, domain: DomainId, x: &[f64; D]) -> bool {
        self.hierarchy.distance_to_center(domain, x) < self.outer_reach(domain)
    }

    /// Returns the distance from a cage's centre, relative to the radius of its domain, within
    /// which a vertex outer-encroaches it.
    pub(super) fn outer_encroachment(&self) -> f64 {
        self.parameters.encroachment / self.parameters.epsilon
    }

    /// Returns the radius of the sphere that the vertices of the cage of `domain` are near.
    pub(in crate::netmesh) fn sphere_radius(&self, domain: DomainId) -> f64 {
        self.parameters.cage_scale * self.hierarchy.node(domain).radius
    }
}
