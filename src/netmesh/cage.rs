//! The three cage operations (§6.3): NEWCAGE, GROWCAGE, RELEASECAGE.

use super::site::CageSite;
use super::template::{cage_points, turned};
use super::{Mesher, some};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow};
use crate::numerics::distance;
use crate::options::NetOrdering;
use rand_core::Rng;

/// A cage vertex this close to another vertex, relative to delta times the cage sphere's radius,
/// has been displaced by rounding: the packing property leaves more room in exact arithmetic.
const PACKING: f64 = 0.1;

/// A cage grows at least by this factor: the vertices of a smaller one would coincide with those
/// that the old cage leaves behind.
const GROWTH: f64 = 1.5;

impl<const D: usize> Mesher<'_, '_, D> {
    /// NEWCAGE(p, r): a domain in `site.parent` around the vertex `site.center` and all that is
    /// concentric with it there, and the cage's vertices. `start` is a simplex near the sphere.
    /// Where rounding leaves no room for a cage vertex there is none, and the centre is
    /// precision-limited.
    pub(super) fn new_cage(&mut self, site: CageSite, start: u32) -> Result<()> {
        let point = *self.delaunay.point(site.center);
        let cage = self.hierarchy.create(
            site.center,
            point,
            site.radius,
            site.parent,
            self.template.len(),
        )?;
        self.stats.cages_created += 1;
        self.adopt_center(cage, site);
        let mut start = start;
        let mut yielded = Vec::new();
        let turn = self.turn_of(cage);
        let directions = turned(&self.template, turn)?;
        for x in cage_points(&directions, &point, self.sphere_radius(cage))? {
            if let Some(vertex) = self.insert_cage_vertex(cage, x, start)? {
                start = self.delaunay.complex().incident(vertex);
                if self.is_input(vertex) {
                    yielded.try_push(vertex)?;
                }
            }
        }
        self.measure_clearance(cage)?;
        self.examine_cage(cage)?;
        self.make_room_outside(cage, &yielded)
    }

    /// What turns the template for `cage`: random bits, or in a deterministic ordering those of a
    /// fixed sequence (the fractions of multiples of the golden ratio).
    fn turn_of(&mut self, cage: u32) -> u64 {
        match self.parameters.ordering {
            NetOrdering::SampledNet => self.random.next_u64(),
            NetOrdering::DeterministicNet => u64::from(cage).wrapping_mul(0x9e37_79b9_7f4a_7c15),
        }
    }

    /// Puts the centre, or the outermost domain concentric with it, into the new domain.
    fn adopt_center(&mut self, cage: u32, site: CageSite) {
        match self.hierarchy.child_towards(site.parent, site.center) {
            Some(child) => self.hierarchy.set_parent(child, cage),
            None => self.hierarchy.set_domain(site.center, cage),
        }
    }

    /// YIELDINGINSERT of one cage point; `None` if rounding leaves no room for it.
    fn insert_cage_vertex(&mut self, cage: u32, x: [f64; D], start: u32) -> Result<Option<u32>> {
        let start = if self.delaunay.complex().is_live(start) {
            start
        } else {
            self.delaunay.complex().incident(self.hierarchy.node(cage).center)
        };
        let Some(home) = self.delaunay.locate(start, &x) else {
            self.limit_cage(cage);
            return Ok(None);
        };
        self.delaunay.find_cavity(home, &x, &mut self.scratch.cavity)?;
        let nearest = self.nearest_corner(&x);
        if nearest < PACKING * self.parameters.delta * self.sphere_radius(cage) {
            self.limit_cage(cage);
            return Ok(None);
        }
        let vertex = match self.input_near(&x, self.parameters.gamma * nearest)? {
            Some(input) => {
                self.stats.yields += 1;
                self.find_cavity_of_input(input)?;
                input
            }
            None => {
                self.stats.cage_points += 1;
                self.add_vertex(x)?
            }
        };
        self.insert_into_cage(cage, vertex)?;
        Ok(Some(vertex))
    }

    /// Inserts `vertex`, whose conflicts are the scratch cavity, as a vertex of the cage of `domain`.
    pub(super) fn insert_into_cage(&mut self, domain: u32, vertex: u32) -> Result<()> {
        let x = *self.delaunay.point(vertex);
        self.enter(&x)?;
        self.hierarchy.set_domain(vertex, domain);
        self.hierarchy.join_cage(vertex, domain)?;
        self.insert_into_cavity(vertex)
    }

    /// The radius of the sphere that the vertices of the cage of `domain` are near.
    pub(super) fn sphere_radius(&self, domain: u32) -> f64 {
        self.parameters.cage_scale * self.hierarchy.node(domain).radius
    }

    fn limit_cage(&mut self, cage: u32) {
        let center = self.hierarchy.node(cage).center;
        self.precision_limited[center as usize] = true;
    }

    pub(super) fn nearest_corner(&self, x: &[f64; D]) -> f64 {
        let gaps =
            self.scratch.cavity.corners.ids.iter().map(|&v| distance(x, self.delaunay.point(v)));
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// Inputs that the new cage yielded to may encroach the domains around it from inside.
    pub(super) fn make_room_outside(&mut self, cage: u32, yielded: &[u32]) -> Result<()> {
        for &input in yielded {
            let x = *self.delaunay.point(input);
            loop {
                let living = self.hierarchy.find(cage);
                let outer = match living == cage {
                    true => self.hierarchy.parent(living),
                    false => living,
                };
                let Some(domain) = self.inner_encroached_from(outer, &x) else { break };
                let start = self.delaunay.complex().incident(input);
                if !self.grow_cage_for(domain, &x, start)? {
                    self.rim.postponed.try_push((cage, input))?;
                    break;
                }
            }
        }
        Ok(())
    }

    /// GROWCAGE(C): a cage of radius `least` or a little more where there is room for it; then the
    /// old one is released. The paper's radius is r / epsilon. Whether it was done (`rim`).
    pub(super) fn grow_cage(&mut self, cage: u32, least: f64, start: u32) -> Result<bool> {
        if self.rim.is_foreign(cage) {
            return Ok(false);
        }
        if let Some(site) = self.grown_site(cage, least)? {
            if !self.may_make_cage(&site)? {
                return Ok(false);
            }
            self.stats.cages_grown += 1;
            self.new_cage(site, start)?;
        }
        if self.hierarchy.node(cage).alive {
            self.release_cage(cage)?;
        }
        Ok(true)
    }

    /// GROWCAGE of the cage that the point at `x` encroaches from inside.
    pub(super) fn grow_cage_for(&mut self, cage: u32, x: &[f64; D], start: u32) -> Result<bool> {
        let needed = self.radius_for(self.hierarchy.distance_to_center(cage, x));
        let least = needed.max(GROWTH * self.hierarchy.node(cage).radius);
        self.grow_cage(cage, least, start)
    }

    /// RELEASECAGE(C): its vertices become vertices of the parent domain. Their cells, and those of
    /// their neighbours, whose corners were exempt inside the cage, are examined anew.
    pub(super) fn release_cage(&mut self, cage: u32) -> AllocResult<()> {
        debug_assert!(!self.rim.is_foreign(cage));
        self.hierarchy.release(cage);
        self.stats.cages_released += 1;
        let mut affected = std::mem::take(&mut self.scratch.affected);
        affected.restart(self.delaunay.point_count())?;
        for at in 0..self.hierarchy.node(cage).cage.len() {
            let vertex = self.hierarchy.node(cage).cage[at];
            self.delaunay.star(vertex, &mut self.scratch.star)?;
            for &simplex in &self.scratch.star {
                for &corner in self.delaunay.complex().vertices(simplex) {
                    if some(corner).is_some() {
                        affected.insert(corner)?;
                    }
                }
            }
        }
        for &vertex in &affected.ids {
            self.examine_star(vertex)?;
        }
        self.scratch.affected = affected;
        Ok(())
    }

    /// The distance from the centre of `cage` to the nearest vertex outside; it is a neighbour of
    /// a cage vertex.
    fn measure_clearance(&mut self, cage: u32) -> AllocResult<()> {
        for at in 0..self.hierarchy.node(cage).cage.len() {
            let vertex = self.hierarchy.node(cage).cage[at];
            self.delaunay.star(vertex, &mut self.scratch.star)?;
            for at in 0..self.scratch.star.len() {
                for index in 0..=D {
                    let other = self.delaunay.complex().vertices(self.scratch.star[at])[index];
                    if some(other).is_some() {
                        self.separate(cage, other);
                    }
                }
            }
        }
        Ok(())
    }

    /// Lowers the clearance of `cage` to `vertex` if that is outside.
    fn separate(&mut self, cage: u32, vertex: u32) {
        debug_assert!(!self.rim.is_foreign(cage));
        let gap = self.hierarchy.distance_to_center(cage, self.delaunay.point(vertex));
        let node = self.hierarchy.node_mut(cage);
        if gap >= node.radius && gap < node.outside {
            node.outside = gap;
        }
    }

    /// After `vertex` went in: it and its neighbours may be the nearest outside of each other's
    /// cages.
    pub(super) fn update_clearances(&mut self, vertex: u32, neighbors: &[u32]) -> AllocResult<()> {
        for &neighbor in neighbors {
            if self.hierarchy.is_alike(&[vertex, neighbor]) {
                continue;
            }
            let mut inner = self.hierarchy.domain_of(vertex);
            let mut other = self.hierarchy.domain_of(neighbor);
            while inner != other {
                let climb = self.hierarchy.node(inner).radius < self.hierarchy.node(other).radius;
                let (cage, outside) = if climb { (inner, neighbor) } else { (other, vertex) };
                let before = self.hierarchy.node(cage).outside;
                self.separate(cage, outside);
                // An infinite clearance is that of a cage in the making.
                if self.hierarchy.node(cage).outside < before && before.is_finite() {
                    self.examine_union_cell(cage)?;
                }
                let parent = self.hierarchy.parent(cage);
                if climb { inner = parent } else { other = parent }
            }
        }
        Ok(())
    }
}
