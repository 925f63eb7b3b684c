//! NEWCAGE and GROWCAGE (§6.3). They call each other: a new cage may take in inputs that encroach
//! the domains around it, whose cages then grow.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::netmesh::operations::template::{cage_points, turned};
use crate::netmesh::questions::cage_site::CageSite;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Mesher, State};
use crate::options::NetOrdering;
use rand_core::Rng;

/// A cage vertex this close to another vertex, relative to delta times the cage sphere's radius,
/// has been displaced by rounding: the packing property leaves more room in exact arithmetic.
const PACKING: f64 = 0.1;

/// A cage grows at least by this factor: the vertices of a smaller one would coincide with those
/// that the old cage leaves behind.
const GROWTH: f64 = 1.5;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Makes a domain in `site.parent` around the vertex `site.center` and all that is concentric
    /// with it there, and the vertices of its cage (NEWCAGE). `start` is a simplex near the sphere.
    /// Where rounding leaves no room for a cage vertex there is none, and the centre is
    /// precision-limited.
    pub(super) fn new_cage(
        &mut self,
        site: CageSite,
        start: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let point = *self.state.delaunay.point(site.center);
        let cage = self.state.hierarchy.create(
            site.center,
            point,
            site.radius,
            site.parent,
            self.state.template.len(),
        )?;
        self.state.stats.cages_created += 1;
        self.state.adopt_center(cage, site);
        let mut start = start;
        let mut yielded = Vec::new();
        let turn = self.state.turn_of(cage);
        let directions = turned(&self.state.template, turn)?;
        for x in cage_points(&directions, &point, self.state.sphere_radius(cage))? {
            if let Some(vertex) = self.insert_cage_vertex(cage, x, start, cavity)? {
                start = self.state.delaunay.complex().incident(vertex);
                if self.state.is_input(vertex) {
                    yielded.try_push(vertex)?;
                }
            }
        }
        self.measure_clearance(cage)?;
        self.examine_cage(cage)?;
        self.make_room_outside(cage, &yielded, cavity)
    }

    /// Makes the cage of a domain that has all its vertices already. There is none where the domain
    /// has been released, or its ball is not inside that of its parent.
    pub(in crate::netmesh) fn make_cage(
        &mut self,
        cage: DomainId,
        cavity: &mut Cavity,
    ) -> Result<()> {
        let node = self.state.hierarchy.node(cage);
        let (center, point, radius) = (node.center, node.point, node.radius);
        if !node.alive {
            return Ok(());
        }
        let parent = self.state.hierarchy.parent(cage);
        if radius > self.state.room_inside(parent, &point) {
            return Ok(self.release_cage(cage)?);
        }
        let mut start = self.state.delaunay.complex().incident(center);
        let turn = self.state.turn_of(cage);
        let directions = turned(&self.state.template, turn)?;
        for x in cage_points(&directions, &point, self.state.sphere_radius(cage))? {
            if let Some(vertex) = self.insert_cage_vertex(cage, x, start, cavity)? {
                start = self.state.delaunay.complex().incident(vertex);
            }
        }
        Ok(self.measure_clearance(cage)?)
    }

    /// Inserts one cage point, or the input that it yields to (YIELDINGINSERT); `None` if rounding
    /// leaves no room for it.
    fn insert_cage_vertex(
        &mut self,
        cage: DomainId,
        x: [f64; D],
        start: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<Option<VertexId>> {
        let start = if self.state.delaunay.complex().is_live(start) {
            start
        } else {
            self.state.delaunay.complex().incident(self.state.hierarchy.node(cage).center)
        };
        let Some(start) = self.state.delaunay.locate(start, &x) else {
            self.state.limit_cage(cage);
            return Ok(None);
        };
        self.state.delaunay.find_cavity(start, &x, cavity)?;
        let nearest = self.state.nearest_vertex_distance(&x, cavity);
        if nearest < PACKING * self.state.parameters.delta * self.state.sphere_radius(cage) {
            self.state.limit_cage(cage);
            return Ok(None);
        }
        let vertex = match self.input_near(&x, self.state.parameters.gamma * nearest, cavity)? {
            Some(input) => {
                self.state.stats.yields += 1;
                self.state.find_cavity_of_input(input, cavity)?;
                input
            }
            None => {
                self.state.stats.cage_points += 1;
                self.state.add_vertex(x)?
            }
        };
        self.insert_into_cage(cage, vertex, cavity)?;
        Ok(Some(vertex))
    }

    /// Inserts `vertex`, whose conflicts are `cavity`, as a vertex of the cage of `domain`.
    pub(super) fn insert_into_cage(
        &mut self,
        domain: DomainId,
        vertex: VertexId,
        cavity: &Cavity,
    ) -> Result<()> {
        let x = *self.state.delaunay.point(vertex);
        self.enter(&x, cavity)?;
        self.state.hierarchy.set_domain(vertex, domain);
        self.state.hierarchy.join_cage(vertex, domain)?;
        self.insert_into_cavity(vertex, cavity)
    }

    /// Grows the domains around a new cage that inputs which it yielded to encroach from inside.
    pub(in crate::netmesh) fn make_room_outside(
        &mut self,
        cage: DomainId,
        yielded: &[VertexId],
        cavity: &mut Cavity,
    ) -> Result<()> {
        for &input in yielded {
            let x = *self.state.delaunay.point(input);
            loop {
                let living = self.state.hierarchy.find(cage);
                let outer = match living == cage {
                    true => self.state.hierarchy.parent(living),
                    false => living,
                };
                let Some(domain) = self.state.inner_encroached_from(outer, &x) else { break };
                let start = self.state.delaunay.complex().incident(input);
                if !self.grow_cage_for(domain, &x, start, cavity)? {
                    self.state.interface.deferred.try_push((cage, input))?;
                    break;
                }
            }
        }
        Ok(())
    }

    /// Makes a cage of radius `least`, or a little more where there is room for it, and releases
    /// the old one (GROWCAGE). The paper's radius is r / epsilon. Returns false if the interface
    /// defers it.
    pub(in crate::netmesh) fn grow_cage(
        &mut self,
        cage: DomainId,
        least: f64,
        start: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        if self.state.interface.want_non_owned(cage) {
            return Ok(false);
        }
        if let Some(site) = self.grown_site(cage, least, cavity)? {
            if !self.may_make_cage(&site)? {
                self.state.interface.want(cage)?;
                return Ok(false);
            }
            self.state.stats.cages_grown += 1;
            self.new_cage(site, start, cavity)?;
        }
        if self.state.hierarchy.node(cage).alive {
            self.release_cage(cage)?;
        }
        Ok(true)
    }

    /// Grows the cage that the point at `x` encroaches from inside.
    pub(in crate::netmesh) fn grow_cage_for(
        &mut self,
        cage: DomainId,
        x: &[f64; D],
        start: SimplexId,
        cavity: &mut Cavity,
    ) -> Result<bool> {
        let needed = self.state.radius_for(self.state.hierarchy.distance_to_center(cage, x));
        let least = needed.max(GROWTH * self.state.hierarchy.node(cage).radius);
        self.grow_cage(cage, least, start, cavity)
    }

    /// Measures the distance from the centre of `cage` to the nearest vertex outside, which is a
    /// neighbour of a cage vertex.
    fn measure_clearance(&mut self, cage: DomainId) -> AllocResult<()> {
        for at in 0..self.state.hierarchy.node(cage).cage.len() {
            let vertex = self.state.hierarchy.node(cage).cage[at];
            self.state.delaunay.star(vertex, &mut self.scratch.star)?;
            for at in 0..self.scratch.star.len() {
                for index in 0..=D {
                    let other =
                        self.state.delaunay.complex().vertices(self.scratch.star[at])[index];
                    if other.is_valid() {
                        self.state.separate(cage, other);
                    }
                }
            }
        }
        Ok(())
    }
}

impl<const D: usize> State<D> {
    /// Returns the bits that turn the template for `cage`: random ones, or in a deterministic
    /// ordering those of a fixed sequence (the fractions of multiples of the golden ratio).
    fn turn_of(&mut self, cage: DomainId) -> u64 {
        match self.parameters.ordering {
            NetOrdering::SampledNet => self.random.next_u64(),
            NetOrdering::DeterministicNet => {
                (cage.index() as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
            }
        }
    }

    /// Puts the centre, or the outermost domain concentric with it, into the new domain.
    fn adopt_center(&mut self, cage: DomainId, site: CageSite) {
        match site.inner {
            Some(child) => self.hierarchy.set_parent(child, cage),
            None => self.hierarchy.set_domain(site.center, cage),
        }
    }

    fn limit_cage(&mut self, cage: DomainId) {
        let center = self.hierarchy.node(cage).center;
        self.precision_limited[center] = true;
    }
}
