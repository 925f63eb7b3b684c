//! Components of another scale: clusters of vertices that no facet or segment leads out of. With
//! hierarchical output each stands in a cage of its own, so that it costs the same at any scale.
//!
//! All of the boundary is in the mesh before the first cage is made. In the plane cages come
//! first. Here they would be in the way of facets: a vertex of a cage may be in the plane of a
//! facet beside the component, and a vertex in a facet that is none of it has no place in the mesh.
//! Now it is known what is near, and there is no cage where that is a part of the boundary outside.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Mesher, State};

impl Mesher<'_, '_, 3> {
    /// Gives each cluster a domain and a cage, unless a part of the boundary leads out of it, or is
    /// near. All of the boundary is recovered.
    pub(super) fn cage_components(&mut self, cavity: &mut Cavity) -> Result<()> {
        // A cage that does not surround its inputs may have vertices in their facets.
        if !self.state.parameters.counts_all_corners() {
            return Ok(());
        }
        self.make_domains()?;
        if self.state.hierarchy.is_single() {
            return Ok(());
        }
        for domain in (1..self.state.hierarchy.len()).map(DomainId::new) {
            self.watch.poll_after(64)?;
            if !self.state.hierarchy.node(domain).alive {
                continue;
            }
            let is_near = match self.state.simplex_at_cage(domain) {
                Some(start) => self.is_near_outer_boundary(domain, start)?,
                None => true,
            };
            match is_near {
                true => self.release_cage(domain)?,
                false => self.make_cage(domain, cavity)?,
            }
        }
        Ok(())
    }
}

impl State<3> {
    /// Returns a simplex at some place on the cage sphere of a domain; `None` if the walk there
    /// does not end, which roundings cannot do in a Delaunay triangulation.
    fn simplex_at_cage(&mut self, domain: DomainId) -> Option<SimplexId> {
        let node = self.hierarchy.node(domain);
        let mut x = node.point;
        x[0] += self.sphere_radius(domain);
        self.delaunay.simplex_at(self.delaunay.complex().incident(node.center), &x)
    }
}
