//! tau-quality (Definition 4) as the refinement tests it, simplex by simplex. All vertices of a
//! simplex are at its circumradius R from its Voronoi corner. So the cell of v is bad if and only
//! if an incident simplex has R > tau/2 NN(v). NN only falls.
//!
//! Corner restriction: for a vertex of Omega only corners within `corner_restriction` of the cage
//! sphere's radius count, and likewise for the union cell of a cage with respect to its parent.
//! Without it CLEAN inserts points beside the cages and destroys them. `final_refinement` lifts it
//! at the end.

use crate::complex::{SimplexId, VertexId};
use crate::mesh::MAX_DIM;
use crate::netmesh::state::State;
use crate::netmesh::state::hierarchy::spanned::Spanned;
use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::numerics::shortest_distance;
use crate::options::Criterion;

impl<const D: usize> State<D> {
    /// Returns true if the Voronoi corner of a live simplex makes a cell, or the union cell of a
    /// cage, bad.
    pub(in crate::netmesh) fn is_bad(&mut self, simplex: SimplexId) -> bool {
        let Some(radius) = self.delaunay.radius(simplex) else { return false };
        if self.refine_list.is_limited(simplex) {
            return false;
        }
        let bad_cell = match self.parameters.criterion {
            Criterion::VoronoiAspect => self.worst_inner_cell(simplex, radius).is_some(),
            Criterion::RadiusEdge => self.inner_short_edge(simplex, radius).is_some(),
        };
        bad_cell
            || self
                .parent_of_bad_cage(simplex, |state, parent| state.is_well_inside(simplex, parent))
                .is_some()
    }

    /// Returns the worst cell among those that the corner of `simplex` counts for.
    pub(super) fn worst_inner_cell(&mut self, simplex: SimplexId, radius: f64) -> Option<VertexId> {
        self.worst_cell(simplex, radius, |state, vertex| state.counts_for(simplex, vertex))
    }

    /// Returns the vertex v of `simplex` with the largest R / r_v above the bound, with r_v = NN(v)
    /// / 2, among those that it `counts` for.
    fn worst_cell(
        &mut self,
        simplex: SimplexId,
        radius: f64,
        counts: impl Fn(&mut Self, VertexId) -> bool,
    ) -> Option<VertexId> {
        let mut least = self.nearest_allowed(radius);
        // The worst of all, without a branch (`Array::push_if`): mostly it counts, or is not bad.
        let vertices = self.delaunay.complex().vertices(simplex);
        let all = vertices.iter().fold((least, VertexId::NONE), |(least, worst), &vertex| {
            let nearest = self.cells[vertex].nearest;
            if nearest < least { (nearest, vertex) } else { (least, worst) }
        });
        if !all.1.is_valid() || counts(self, all.1) {
            return all.1.is_valid().then_some(all.1);
        }
        let mut worst = None;
        for index in 0..=D {
            let vertex = self.delaunay.complex().vertices(simplex)[index];
            let nearest = self.cells[vertex].nearest;
            if nearest < least && counts(self, vertex) {
                least = nearest;
                worst = Some(vertex);
            }
        }
        worst
    }

    /// Returns the shortest edge of `simplex`, if that is too short for its radius, and the corner
    /// of `simplex` counts for all its vertices.
    pub(super) fn inner_short_edge(
        &mut self,
        simplex: SimplexId,
        radius: f64,
    ) -> Option<(VertexId, VertexId, f64)> {
        let edge = self.short_edge(simplex, radius)?;
        if self.hierarchy.is_single() {
            // One domain is that of all.
            let vertices = self.delaunay.complex().vertices(simplex);
            let is_free = |&vertex: &VertexId| !self.hierarchy.cage_of(vertex).is_valid();
            let counts = vertices.iter().all(is_free) && self.is_well_inside(simplex, ROOT);
            return counts.then_some(edge);
        }
        let counts = (0..=D).all(|index| {
            let vertex = self.delaunay.complex().vertices(simplex)[index];
            self.counts_for(simplex, vertex)
        });
        counts.then_some(edge)
    }

    /// Returns the shortest edge of `simplex`, if that is too short for its radius.
    pub(in crate::netmesh) fn short_edge(
        &self,
        simplex: SimplexId,
        radius: f64,
    ) -> Option<(VertexId, VertexId, f64)> {
        let allowed = self.nearest_allowed(radius);
        let edge = self.shortest_edge(simplex, allowed);
        (edge.2 < allowed).then_some(edge)
    }

    /// Returns the ends and the length of the shortest edge of `simplex` between vertices nearer
    /// than `limit` to another one: that is the shortest of all, if there is one below `limit`.
    /// Infinitely long where there is none.
    pub(in crate::netmesh) fn shortest_edge(
        &self,
        simplex: SimplexId,
        limit: f64,
    ) -> (VertexId, VertexId, f64) {
        let mut vertices = [VertexId::NONE; MAX_DIM + 1];
        let mut count = 0;
        for &vertex in self.delaunay.complex().vertices(simplex) {
            vertices[count] = vertex;
            count += usize::from(self.cells[vertex].nearest < limit);
        }
        if count < 2 {
            return (VertexId::NONE, VertexId::NONE, f64::INFINITY);
        }
        let mut points = [self.delaunay.point(vertices[0]); MAX_DIM + 1];
        for (point, &vertex) in points.iter_mut().zip(&vertices[..count]) {
            *point = self.delaunay.point(vertex);
        }
        let (a, b, length) = shortest_distance(&points[..count]);
        (vertices[a], vertices[b], length)
    }

    /// Returns the distance from its nearest neighbour that a vertex of a good simplex of this
    /// radius has.
    #[inline]
    pub(in crate::netmesh) fn nearest_allowed(&self, radius: f64) -> f64 {
        self.measure().nearest_allowed(radius)
    }

    /// Returns the nearest distance of a vertex of `simplex`: no edge is shorter.
    pub(in crate::netmesh) fn nearest_of(&self, simplex: SimplexId) -> f64 {
        let vertices = self.delaunay.complex().vertices(simplex).iter();
        vertices.map(|&vertex| self.cells[vertex].nearest).fold(f64::INFINITY, f64::min)
    }

    /// Returns true if the corner of `simplex` counts for the cell of its vertex `vertex`.
    fn counts_for(&mut self, simplex: SimplexId, vertex: VertexId) -> bool {
        if self.hierarchy.cage_of(vertex).is_valid() {
            return false;
        }
        let domain = self.hierarchy.domain_of(vertex);
        self.is_well_inside(simplex, domain)
    }

    /// Returns true if the corner of `simplex` is within the corner restriction of `domain`.
    pub(in crate::netmesh) fn is_well_inside(&self, simplex: SimplexId, domain: DomainId) -> bool {
        let max_distance = self.parameters.corner_restriction() * self.sphere_radius(domain);
        let distance = self.delaunay.corner_distance(simplex, &self.hierarchy.node(domain).point);
        distance.is_some_and(|distance| distance < max_distance)
    }

    /// Returns the parent of a cage that separates vertices of `simplex` and whose union cell the
    /// corner makes bad (condition 2 of Definition 4), where the corner `counts` for the parent.
    fn parent_of_bad_cage(
        &mut self,
        simplex: SimplexId,
        counts: impl Fn(&Self, DomainId) -> bool,
    ) -> Option<DomainId> {
        self.spanned_domain(simplex, |state, cage, parent| {
            state.is_beyond_cage_bound(simplex, cage) && parent.is_valid() && counts(state, parent)
        })
        .map(|(_, parent)| parent)
    }

    /// Returns the first domain, from the smallest up, that has vertices of the finite `simplex`
    /// inside and outside and `accepts`, and its parent.
    fn spanned_domain(
        &mut self,
        simplex: SimplexId,
        accepts: impl Fn(&Self, DomainId, DomainId) -> bool,
    ) -> Option<(DomainId, DomainId)> {
        if self.hierarchy.same_domain(self.delaunay.complex().vertices(simplex)) {
            return None;
        }
        let mut spanned = Spanned::new(self.domains_of(simplex)[..=D].iter().copied());
        while let Some(inner) = spanned.smallest(&self.hierarchy) {
            let parent = self.hierarchy.parent(inner);
            if accepts(self, inner, parent) {
                return Some((inner, parent));
            }
            spanned.climb(inner, parent);
        }
        None
    }

    /// Returns the domains of the vertices of `simplex`, in their order.
    fn domains_of(&mut self, simplex: SimplexId) -> [DomainId; MAX_DIM + 1] {
        let mut domains = [DomainId::NONE; MAX_DIM + 1];
        for (domain, &vertex) in domains.iter_mut().zip(self.delaunay.complex().vertices(simplex)) {
            *domain = self.hierarchy.domain_of(vertex);
        }
        domains
    }

    /// Returns true if the corner of `simplex` is farther from the centre of `cage` than the bound
    /// allows.
    pub(super) fn is_beyond_cage_bound(&self, simplex: SimplexId, cage: DomainId) -> bool {
        self.bad_simplex_view().is_beyond_cage_bound(simplex, cage)
    }

    /// Returns the distance from the centre of `cage` within which the corners of a good union cell
    /// are.
    pub(in crate::netmesh) fn cage_bound(&self, cage: DomainId) -> f64 {
        self.measure().cage_bound(self.hierarchy.node(cage))
    }

    /// Returns the domain through whose cage the corner of a live simplex slips and makes a cell
    /// bad.
    pub(in crate::netmesh) fn open_domain(&mut self, simplex: SimplexId) -> Option<DomainId> {
        let radius = self.delaunay.radius(simplex)?;
        if !self.stage.is_final || self.refine_list.is_limited(simplex) {
            return None;
        }
        let open = match self.parameters.criterion {
            Criterion::VoronoiAspect => self.domain_of_open_cell(simplex, radius),
            Criterion::RadiusEdge => self.domain_of_short_edge(simplex, radius),
        };
        open.filter(|&domain| self.parameters.counts_all_corners_in(domain)).or_else(|| {
            self.parent_of_bad_cage(simplex, |state, parent| {
                state.parameters.counts_all_corners_in(parent)
            })
        })
    }

    /// Returns true if the vertices of a live simplex, which is finite, are of one domain. Those
    /// between a cage and what is around it have no bound. Changes nothing.
    pub(super) fn is_in_one_domain(&self, simplex: SimplexId) -> bool {
        let vertices = self.delaunay.complex().vertices(simplex);
        let domain_of = |vertex| self.hierarchy.compressed_domain_of(vertex);
        self.hierarchy.same_domain(vertices)
            || vertices[1..].iter().all(|&vertex| domain_of(vertex) == domain_of(vertices[0]))
    }

    /// Returns true if all that is bad (`is_bad`) is open, too: the same corners are too far, only
    /// more of them count. By edges that is not so where a simplex has vertices of several domains.
    pub(in crate::netmesh) fn is_bad_open(&self) -> bool {
        let is_by_cells = self.parameters.criterion == Criterion::VoronoiAspect;
        self.stage.is_final
            && self.parameters.counts_all_corners()
            && (is_by_cells || self.hierarchy.is_single())
    }

    /// Returns the domain of the vertex with the worst cell, if that is bad.
    fn domain_of_open_cell(&mut self, simplex: SimplexId, radius: f64) -> Option<DomainId> {
        let is_cell = |state: &mut Self, vertex| !state.hierarchy.cage_of(vertex).is_valid();
        let worst = self.worst_cell(simplex, radius, is_cell);
        worst.map(|vertex| self.hierarchy.domain_of(vertex))
    }

    /// Returns the domain of all vertices, if an edge is too short for the radius. Where the
    /// vertices are of several domains, the corner is that of a cage's union cell.
    fn domain_of_short_edge(&mut self, simplex: SimplexId, radius: f64) -> Option<DomainId> {
        self.short_edge(simplex, radius)?;
        let vertices = self.delaunay.complex().vertices(simplex);
        if self.hierarchy.same_domain(vertices) {
            return Some(self.hierarchy.domain_of(vertices[0]));
        }
        let domains = self.domains_of(simplex);
        domains[1..=D].iter().all(|&domain| domain == domains[0]).then_some(domains[0])
    }
}
