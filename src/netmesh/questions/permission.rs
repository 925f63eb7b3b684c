//! Permission: before an operation begins in a partition, it asks whether the interface allows it.

use crate::complex::VertexId;
use crate::delaunay::Cavity;
use crate::memory::AllocResult;
use crate::netmesh::questions::cage_site::CageSite;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::netmesh::state::{Mesher, State};
use std::ops::RangeInclusive;

/// The number of simplices that are examined around a wanted cage. A cage that meets more is left
/// to the global mesh.
const MOST_ROUND_CAGE: usize = 1 << 13;

/// Room that a partition must have beside a cage sphere, relative to the yield radius of the cage's
/// vertices: cage vertices and D-balls are rounded.
const MARGIN: f64 = 1.0 + 1e-6;

impl<const D: usize> State<D> {
    /// Returns true if no simplex of `cavity` is locked.
    pub(in crate::netmesh) fn may_replace_cavity(&self, cavity: &Cavity) -> bool {
        !self.interface.is_some()
            || !cavity.simplices.iter().any(|&simplex| self.interface.is_locked(simplex))
    }

    /// Returns true if `x`, whose cavity is given, may be inserted, and the cages that it
    /// encroaches from outside released.
    pub(in crate::netmesh) fn may_insert(&mut self, x: &[f64; D], cavity: &Cavity) -> bool {
        if !self.interface.is_some() {
            return true;
        }
        if !self.may_replace_cavity(cavity) {
            return false;
        }
        if let Some(domain) = self.common_domain(cavity) {
            if self.hierarchy.contains(domain, x) {
                return true;
            }
        }
        for at in 0..cavity.vertices.ids.len() {
            let mut domain = self.hierarchy.domain_of(cavity.vertices.ids[at]);
            while !self.hierarchy.contains(domain, x) {
                if self.interface.is_non_owned(domain) && self.outer_encroaches(domain, x) {
                    self.interface.want_non_owned(domain);
                    return false;
                }
                domain = self.hierarchy.parent(domain);
            }
        }
        true
    }

    /// Returns true if vertices in the `shell` about `center`, given by distances, encroach no
    /// non-owned domain from outside, of those from the domain of `vertex` up to `parent`, or to
    /// one as large.
    fn keeps_off_below(
        &mut self,
        parent: DomainId,
        vertex: VertexId,
        center: &[f64; D],
        shell: &RangeInclusive<f64>,
    ) -> bool {
        let mut domain = self.hierarchy.domain_of(vertex);
        while domain != ROOT
            && domain != parent
            && self.hierarchy.node(domain).radius < self.hierarchy.node(parent).radius
        {
            if self.interface.is_non_owned(domain) {
                let distance = self.hierarchy.distance_to_center(domain, center);
                let reach = self.outer_reach(domain);
                if *shell.start() <= distance + reach && distance - reach <= *shell.end() {
                    self.interface.want_non_owned(domain);
                    return false;
                }
            }
            domain = self.hierarchy.parent(domain);
        }
        true
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns true if a cage may be made at `site`: no locked simplex is in conflict with a point
    /// near its sphere, and the partition owns all domains between there and the parent. The inside
    /// of the sphere stays as it is.
    pub(in crate::netmesh) fn may_make_cage(&mut self, site: &CageSite) -> AllocResult<bool> {
        if !self.state.interface.is_some() {
            return Ok(true);
        }
        if site.inner.is_some_and(|inner| self.state.interface.want_non_owned(inner)) {
            return Ok(false);
        }
        let center = *self.state.delaunay.point(site.center);
        let radius = self.state.parameters.cage_scale * site.radius;
        let margin = MARGIN * self.state.parameters.gamma;
        let shell = (1.0 - margin) * radius..=(1.0 + margin) * radius;
        let mut on_sphere = center;
        on_sphere[0] += radius;
        let start = self.state.delaunay.complex().incident(site.center);
        let Some(start) = self.state.delaunay.walk_to_conflict(start, &on_sphere, &mut 0) else {
            return Ok(false);
        };
        let mut near = std::mem::take(&mut self.scratch.near);
        let is_all = self.state.delaunay.meeting_shell(
            start,
            &center,
            shell.clone(),
            MOST_ROUND_CAGE,
            &mut near,
        )?;
        let is_free = is_all
            && near.iter().all(|&simplex| {
                !self.state.interface.is_locked(simplex)
                    && (0..=D).all(|index| {
                        let vertex = self.state.delaunay.complex().vertices(simplex)[index];
                        vertex.is_valid()
                            && self.state.keeps_off_below(site.parent, vertex, &center, &shell)
                    })
            });
        self.scratch.near = near;
        Ok(is_free)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Inputs;
    use crate::netmesh::state::interface::Interface;
    use crate::netmesh::state::watch::Watch;
    use crate::options::Options;
    use crate::parameters::Parameters;

    /// A cage may be made beside a domain that the partition does not own, but not so near that its
    /// vertices would encroach that, and not around it.
    #[test]
    fn cages_keep_off_domains_that_are_not_owned() {
        let points: Vec<f64> = (0..50).flat_map(|at| [f64::from(at % 7), f64::from(at)]).collect();
        let inputs = Inputs::new(2, 50, &points, 0).unwrap();
        let parameters = Parameters::resolve(2, &Options::default()).unwrap();
        let mut mesher = Mesher::<2>::new(&inputs, parameters, Watch::new(None)).unwrap();
        let mut cavity = Cavity::default();
        mesher.start_netmesh(&mut cavity).unwrap();
        mesher.insert_rounds(&mut cavity).unwrap();
        let vertex = VertexId::new(0);
        let point = *mesher.state.delaunay.point(vertex);
        let radius = 2f64.powi(-20);
        let domain = mesher.state.hierarchy.create(vertex, point, radius, ROOT, 0).unwrap();
        mesher.state.hierarchy.set_domain(vertex, domain);
        let mut non_owned = vec![false; domain.index() + 1];
        non_owned[domain.index()] = true;
        let reach = mesher.state.outer_encroachment() * radius;
        let own = radius / 64.0;
        let margin = MARGIN * mesher.state.parameters.gamma;
        let shell = (1.0 - margin) * own..=(1.0 + margin) * own;
        let at = |distance: f64| [point[0] + distance, point[1]];
        for (is_non_owned, distance, expected) in [
            (true, reach + 2.0 * own, true),
            (true, reach + 0.5 * own, false),
            (true, 0.5 * reach, false),
            (false, 0.5 * reach, true),
        ] {
            non_owned[domain.index()] = is_non_owned;
            mesher.state.interface = Interface::new(non_owned.clone()).unwrap();
            assert_eq!(mesher.state.keeps_off_below(ROOT, vertex, &at(distance), &shell), expected);
            assert_eq!(mesher.state.interface.has_work_left(domain), !expected);
        }
        let around = 8.0 * reach;
        let site = CageSite { center: vertex, radius: around, parent: ROOT, inner: Some(domain) };
        assert!(mesher.may_make_cage(&site).unwrap());
        non_owned[domain.index()] = true;
        mesher.state.interface = Interface::new(non_owned).unwrap();
        assert!(
            !mesher.may_make_cage(&site).unwrap() && mesher.state.interface.has_work_left(domain)
        );
    }
}
