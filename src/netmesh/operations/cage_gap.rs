//! Gaps between the vertices of a coarse cage, through which a cell looks out. The final refinement
//! narrows them: a corner near the cage sphere or beyond it goes in as a further cage vertex, at
//! the nearest point of the sphere, and one well inside as a Steiner point.

use crate::complex::SimplexId;
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::AllocResult;
use crate::netmesh::state::facets::floors::Purpose;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::norm;

/// A corner within this times its radius of the cage sphere, or beyond it, belongs to the cage.
const NEAR: f64 = 0.5;

/// A further cage vertex keeps this distance from others, relative to the sphere's radius.
const SPACING: f64 = 1.0 / 64.0;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Inserts a point that narrows the gap in the cage of `domain` through which a cell reaches
    /// the corner of `simplex`.
    pub(in crate::netmesh) fn narrow_cage_gap(
        &mut self,
        simplex: SimplexId,
        domain: DomainId,
        purpose: Purpose,
        cavity: &mut Cavity,
    ) -> Result<()> {
        if self.state.is_clear_of_cage(simplex, domain, cavity)? {
            return self.refine_corner(simplex, purpose, cavity);
        }
        match self.state.projected_corner(simplex, domain) {
            Some(x) if self.finds_room(simplex, domain, &x, cavity)? => {
                match self.state.may_insert(&x, cavity) {
                    true => self.join_at(domain, x, cavity),
                    false => Ok(self.state.block(simplex)?),
                }
            }
            _ => {
                self.state.refine_list.limit(simplex);
                Ok(())
            }
        }
    }

    /// Finds the cavity of `x` and returns true if `x` is far enough from its vertices, and is no
    /// uninserted input, of which a partition may have some left.
    fn finds_room(
        &mut self,
        near: SimplexId,
        domain: DomainId,
        x: &[f64; D],
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let Some(start) = self.state.delaunay.locate(near, x) else { return Ok(false) };
        self.state.delaunay.find_cavity(start, x, cavity)?;
        let is_apart = self.state.nearest_vertex_distance(x, cavity)
            >= SPACING * self.state.sphere_radius(domain);
        Ok(is_apart && self.input_near(x, 0.0, cavity)?.is_none())
    }

    /// Inserts `x`, whose conflicts are `cavity`, as a vertex of the cage of `domain`.
    fn join_at(&mut self, domain: DomainId, x: [f64; D], cavity: &Cavity) -> Result<()> {
        self.state.stats.cage_points += 1;
        self.state.stats.closing_points += 1;
        let vertex = self.state.add_vertex(x)?;
        self.insert_into_cage(domain, vertex, cavity)
    }
}

impl<const D: usize> State<D> {
    /// Returns true if the corner of `simplex` is inside the cage sphere by a fraction of its
    /// radius, and everything next to it is inside the domain.
    fn is_clear_of_cage(
        &mut self,
        simplex: SimplexId,
        domain: DomainId,
        cavity: &mut Cavity,
    ) -> AllocResult<bool> {
        let center = self.hierarchy.node(domain).point;
        let Some(distance) = self.delaunay.corner_distance(simplex, &center) else {
            return Ok(false);
        };
        let radius = self.delaunay.radius(simplex).unwrap_or(f64::INFINITY);
        let depth = self.sphere_radius(domain) - distance;
        let clear = depth > NEAR * radius;
        let Some(corner) = self.delaunay.corner(simplex).filter(|_| clear) else {
            return Ok(false);
        };
        if !self.is_inside(simplex, domain) {
            return Ok(false);
        }
        self.delaunay.find_cavity(simplex, &corner, cavity)?;
        Ok(cavity.simplices.iter().all(|&simplex| self.is_inside(simplex, domain)))
    }

    /// Returns true if all vertices of `simplex` are in `domain`. The hull of the root's cage is
    /// the hull of the mesh.
    fn is_inside(&self, simplex: SimplexId, domain: DomainId) -> bool {
        self.delaunay.complex().vertices(simplex).iter().all(|&vertex| {
            vertex.is_valid() && self.hierarchy.contains(domain, self.delaunay.point(vertex))
        })
    }

    /// Returns the point of the cage sphere nearest to the corner of `simplex`.
    fn projected_corner(&self, simplex: SimplexId, domain: DomainId) -> Option<[f64; D]> {
        let corner = self.delaunay.corner(simplex)?;
        let center = &self.hierarchy.node(domain).point;
        let offset: [f64; D] = std::array::from_fn(|axis| corner[axis] - center[axis]);
        let stretch = self.sphere_radius(domain) / norm(&offset);
        let x: [f64; D] = std::array::from_fn(|axis| center[axis] + stretch * offset[axis]);
        x.iter().all(|x| x.is_finite()).then_some(x)
    }
}
