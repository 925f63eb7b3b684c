//! tau-quality (Definition 4) as the refinement tests it, simplex by simplex. All vertices of a
//! simplex are at its circumradius R from its Voronoi corner. So the cell of v is bad if and only
//! if an incident simplex has R > tau/2 NN(v). NN only falls.
//!
//! Corner restriction: for a vertex of Omega only corners within `corner_restriction` of the cage
//! sphere's radius count, and likewise for the union cell of a cage with respect to its parent.
//! Without it CLEAN inserts points beside the cages and destroys them. `final_refinement` lifts it
//! at the end.

use crate::complex::{SimplexId, VertexId};
use crate::memory::AllocResult;
use crate::mesh::MAX_DIM;
use crate::netmesh::cages::domains::{DomainId, ROOT, Spanned};
use crate::netmesh::{Cell, Mesher, Scratch, State};
use crate::numerics::shortest_distance;
use crate::options::Criterion;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Queues the bad ones among the simplices just created, and tells their vertices of the
    /// corners that have come. `in_same_domain`: whether all vertices are ([`same_domain`]).
    ///
    /// [`same_domain`]: crate::netmesh::cages::domains::Hierarchy::same_domain
    pub(in crate::netmesh) fn examine_created(&mut self, in_same_domain: bool) -> AllocResult<()> {
        let measure = self.measure();
        let State { delaunay, hierarchy, cells, .. } = &mut self.state;
        let cells: &mut [Cell] = cells;
        let Scratch { created, suspects, .. } = &mut self.scratch;
        suspects.clear();
        suspects.reserve(created.len())?;
        for &simplex in created.iter() {
            let Some(ball) = delaunay.ball(simplex) else { continue };
            let radius = ball.radius();
            let allowed = measure.nearest_allowed(radius);
            let vertices = delaunay.complex().vertices(simplex);
            let mut near = 0;
            for &vertex in vertices {
                let cell = &mut cells[vertex];
                // Written in any case, without a branch (`Array::push_if`).
                cell.farthest = if radius > cell.farthest { radius } else { cell.farthest };
                near += usize::from(cell.nearest < allowed);
            }
            let is_near = near >= measure.near_of_bad();
            suspects
                .push_if(is_near || !(in_same_domain || hierarchy.same_domain(vertices)), simplex);
        }
        for at in 0..self.scratch.suspects.len() {
            self.examine_suspect(self.scratch.suspects[at])?;
        }
        Ok(())
    }

    /// Queues the bad ones among the simplices at `vertex`.
    pub(in crate::netmesh) fn examine_star(&mut self, vertex: VertexId) -> AllocResult<()> {
        self.examine_corners(vertex, |mesher, simplex, _| mesher.examine(simplex))
    }

    /// Measures the farthest corner of `vertex`, and has the simplices there examined, given their
    /// radii.
    fn examine_corners(
        &mut self,
        vertex: VertexId,
        examine: impl Fn(&mut Self, SimplexId, f64) -> AllocResult<()>,
    ) -> AllocResult<()> {
        self.state.delaunay.star(vertex, &mut self.scratch.star)?;
        let mut farthest = 0.0f64;
        for at in 0..self.scratch.star.len() {
            let simplex = self.scratch.star[at];
            let Some(radius) = self.state.delaunay.ball(simplex).map(|ball| ball.radius()) else {
                continue;
            };
            farthest = farthest.max(radius);
            examine(self, simplex, radius)?;
        }
        self.state.cells[vertex].farthest = farthest;
        Ok(())
    }

    /// After the nearest distance of `vertex` fell: its cell may have gone bad. The lengths of the
    /// edges there are what they were, and so is all that other cells depend on. The cell of a
    /// cage's vertex has no bound of its own.
    pub(in crate::netmesh) fn examine_cell(&mut self, vertex: VertexId) -> AllocResult<()> {
        let Cell { nearest, farthest } = self.state.cells[vertex];
        if self.state.parameters.criterion == Criterion::RadiusEdge
            || nearest >= self.nearest_allowed(farthest)
            || self.state.hierarchy.cage_of(vertex).is_valid()
        {
            return Ok(());
        }
        let is_bad_open = self.is_bad_open();
        self.examine_corners(vertex, |mesher, simplex, radius| {
            if nearest >= mesher.nearest_allowed(radius) {
                Ok(())
            } else if is_bad_open && !mesher.state.refine_list.is_limited(simplex) {
                mesher.queue(simplex)
            } else {
                mesher.examine_suspect(simplex)
            }
        })
    }

    /// After the clearance of `cage` fell: its union cell may have gone bad over the corners at its
    /// vertices that are beyond the bound now. All other cells are what they were.
    pub(in crate::netmesh) fn examine_union_cell(&mut self, cage: DomainId) -> AllocResult<()> {
        let farthest = self.cage_bound(cage);
        for at in 0..self.state.hierarchy.node(cage).cage.len() {
            let vertex = self.state.hierarchy.node(cage).cage[at];
            let distance =
                self.state.hierarchy.distance_to_center(cage, self.state.delaunay.point(vertex));
            let max_distance = farthest - distance;
            if self.state.cells[vertex].farthest > max_distance {
                self.examine_corners(vertex, |mesher, simplex, radius| {
                    match radius > max_distance {
                        true => mesher.examine(simplex),
                        false => Ok(()),
                    }
                })?;
            }
        }
        Ok(())
    }

    /// Queues the bad ones among the simplices round `cage`.
    pub(in crate::netmesh) fn examine_cage(&mut self, cage: DomainId) -> AllocResult<()> {
        for at in 0..self.state.hierarchy.node(cage).cage.len() {
            self.examine_star(self.state.hierarchy.node(cage).cage[at])?;
        }
        Ok(())
    }

    pub(in crate::netmesh) fn examine(&mut self, simplex: SimplexId) -> AllocResult<()> {
        if self.bad_simplex_view().is_suspect(simplex) {
            self.examine_suspect(simplex)
        } else {
            Ok(())
        }
    }

    pub(in crate::netmesh) fn examine_suspect(&mut self, simplex: SimplexId) -> AllocResult<()> {
        if self.is_by_edges() && self.is_bad_open() {
            return self.examine_edges(simplex);
        }
        if self.open_domain(simplex).is_some() || (!self.is_bad_open() && self.is_bad(simplex)) {
            self.queue(simplex)?;
        }
        Ok(())
    }

    fn is_by_edges(&self) -> bool {
        self.state.parameters.criterion == Criterion::RadiusEdge
    }

    /// Queues a simplex with an edge that is too short, where that is all that counts.
    fn examine_edges(&mut self, simplex: SimplexId) -> AllocResult<()> {
        let Some(ball) = self.state.delaunay.ball(simplex) else { return Ok(()) };
        match self.short_edge(simplex, ball.radius()) {
            Some((_, _, length)) if !self.state.refine_list.is_limited(simplex) => {
                self.queue_by(simplex, length)
            }
            _ => Ok(()),
        }
    }

    /// See [`super::bad_simplex::Measure::nearest_allowed`].
    #[inline]
    fn nearest_allowed(&self, radius: f64) -> f64 {
        self.measure().nearest_allowed(radius)
    }

    /// Puts a live simplex on REFINELIST, by the length that its corner is measured against.
    fn queue(&mut self, simplex: SimplexId) -> AllocResult<()> {
        let length = match self.state.parameters.criterion {
            _ if !self.state.refine_list.is_sorted() => 0.0,
            Criterion::VoronoiAspect => self.nearest_of(simplex),
            Criterion::RadiusEdge => self.shortest_edge(simplex, f64::INFINITY).2,
        };
        self.queue_by(simplex, length)
    }

    /// The same by a `length` that is known.
    fn queue_by(&mut self, simplex: SimplexId, length: f64) -> AllocResult<()> {
        match self.is_exempt(simplex) {
            true => Ok(()),
            false => self.state.refine_list.push(simplex, length),
        }
    }

    /// The nearest distance of a vertex of `simplex`: no edge is shorter.
    fn nearest_of(&self, simplex: SimplexId) -> f64 {
        let vertices = self.state.delaunay.complex().vertices(simplex).iter();
        vertices.map(|&vertex| self.state.cells[vertex].nearest).fold(f64::INFINITY, f64::min)
    }

    /// Whether the Voronoi corner of a live simplex makes a cell, or the union cell of a cage, bad.
    pub(in crate::netmesh) fn is_bad(&mut self, simplex: SimplexId) -> bool {
        let Some(ball) = self.state.delaunay.ball(simplex) else { return false };
        let radius = ball.radius();
        if self.state.refine_list.is_limited(simplex) {
            return false;
        }
        let bad_cell = match self.state.parameters.criterion {
            Criterion::VoronoiAspect => self.worst_inner_cell(simplex, radius).is_some(),
            Criterion::RadiusEdge => self.inner_short_edge(simplex, radius).is_some(),
        };
        bad_cell
            || self
                .parent_of_bad_cage(simplex, |mesher, parent| {
                    mesher.is_well_inside(simplex, parent)
                })
                .is_some()
    }

    /// The worst cell among those that the corner of `simplex` counts for.
    pub(in crate::netmesh) fn worst_inner_cell(
        &mut self,
        simplex: SimplexId,
        radius: f64,
    ) -> Option<VertexId> {
        self.worst_cell(simplex, radius, |mesher, vertex| mesher.counts_for(simplex, vertex))
    }

    /// The vertex v of `simplex` with the largest R / r_v above the bound, with r_v = NN(v) / 2,
    /// among those that it `counts` for.
    pub(in crate::netmesh) fn worst_cell(
        &mut self,
        simplex: SimplexId,
        radius: f64,
        counts: impl Fn(&mut Self, VertexId) -> bool,
    ) -> Option<VertexId> {
        let mut least = self.nearest_allowed(radius);
        // The worst of all, without a branch (`Array::push_if`): mostly it counts, or is not bad.
        let vertices = self.state.delaunay.complex().vertices(simplex);
        let all = vertices.iter().fold((least, VertexId::NONE), |(least, worst), &vertex| {
            let nearest = self.state.cells[vertex].nearest;
            if nearest < least { (nearest, vertex) } else { (least, worst) }
        });
        if !all.1.is_valid() || counts(self, all.1) {
            return all.1.is_valid().then_some(all.1);
        }
        let mut worst = None;
        for index in 0..=D {
            let vertex = self.state.delaunay.complex().vertices(simplex)[index];
            let nearest = self.state.cells[vertex].nearest;
            if nearest < least && counts(self, vertex) {
                least = nearest;
                worst = Some(vertex);
            }
        }
        worst
    }

    /// As [`Self::short_edge`], if the corner of `simplex` counts for all its vertices.
    pub(in crate::netmesh) fn inner_short_edge(
        &mut self,
        simplex: SimplexId,
        radius: f64,
    ) -> Option<(VertexId, VertexId, f64)> {
        let edge = self.short_edge(simplex, radius)?;
        if self.state.hierarchy.is_single() {
            // One domain is that of all.
            let vertices = self.state.delaunay.complex().vertices(simplex);
            let is_free = |&vertex: &VertexId| !self.state.hierarchy.cage_of(vertex).is_valid();
            let counts = vertices.iter().all(is_free) && self.is_well_inside(simplex, ROOT);
            return counts.then_some(edge);
        }
        let counts = (0..=D).all(|index| {
            let vertex = self.state.delaunay.complex().vertices(simplex)[index];
            self.counts_for(simplex, vertex)
        });
        counts.then_some(edge)
    }

    /// The shortest edge of `simplex`, if that is too short for its radius.
    pub(in crate::netmesh) fn short_edge(
        &self,
        simplex: SimplexId,
        radius: f64,
    ) -> Option<(VertexId, VertexId, f64)> {
        let allowed = self.nearest_allowed(radius);
        let edge = self.shortest_edge(simplex, allowed);
        (edge.2 < allowed).then_some(edge)
    }

    /// The ends and the length of the shortest edge of `simplex` between vertices nearer than
    /// `limit` to another one: that is the shortest of all, if there is one below `limit`.
    /// Infinitely long where there is none.
    fn shortest_edge(&self, simplex: SimplexId, limit: f64) -> (VertexId, VertexId, f64) {
        let mut vertices = [VertexId::NONE; MAX_DIM + 1];
        let mut count = 0;
        for &vertex in self.state.delaunay.complex().vertices(simplex) {
            vertices[count] = vertex;
            count += usize::from(self.state.cells[vertex].nearest < limit);
        }
        if count < 2 {
            return (VertexId::NONE, VertexId::NONE, f64::INFINITY);
        }
        let mut points = [self.state.delaunay.point(vertices[0]); MAX_DIM + 1];
        for (point, &vertex) in points.iter_mut().zip(&vertices[..count]) {
            *point = self.state.delaunay.point(vertex);
        }
        let (a, b, length) = shortest_distance(&points[..count]);
        (vertices[a], vertices[b], length)
    }

    /// Whether the corner of `simplex` counts for the cell of its vertex `vertex`.
    fn counts_for(&mut self, simplex: SimplexId, vertex: VertexId) -> bool {
        if self.state.hierarchy.cage_of(vertex).is_valid() {
            return false;
        }
        let domain = self.state.hierarchy.domain_of(vertex);
        self.is_well_inside(simplex, domain)
    }

    /// Whether the corner of `simplex` is within the corner restriction of `domain`.
    pub(in crate::netmesh) fn is_well_inside(&self, simplex: SimplexId, domain: DomainId) -> bool {
        let max_distance = self.state.parameters.corner_restriction() * self.sphere_radius(domain);
        let distance =
            self.state.delaunay.corner_distance(simplex, &self.state.hierarchy.node(domain).point);
        distance.is_some_and(|distance| distance < max_distance)
    }

    /// Condition 2 of Definition 4 for every cage that separates vertices of `simplex`: the parent
    /// of one whose union cell the corner makes bad, where it `counts` for the parent.
    pub(in crate::netmesh) fn parent_of_bad_cage(
        &mut self,
        simplex: SimplexId,
        counts: impl Fn(&Self, DomainId) -> bool,
    ) -> Option<DomainId> {
        self.spanned_domain(simplex, |mesher, cage, parent| {
            mesher.is_beyond_cage_bound(simplex, cage)
                && parent.is_valid()
                && counts(mesher, parent)
        })
        .map(|(_, parent)| parent)
    }

    /// The first domain, from the smallest up, that has vertices of the finite `simplex` inside and
    /// outside and `is_wanted`, and its parent.
    pub(in crate::netmesh) fn spanned_domain(
        &mut self,
        simplex: SimplexId,
        is_wanted: impl Fn(&Self, DomainId, DomainId) -> bool,
    ) -> Option<(DomainId, DomainId)> {
        if self.state.hierarchy.same_domain(self.state.delaunay.complex().vertices(simplex)) {
            return None;
        }
        let mut spanned = Spanned::new(self.domains_of(simplex)[..=D].iter().copied());
        while let Some(inner) = spanned.smallest(&self.state.hierarchy) {
            let parent = self.state.hierarchy.parent(inner);
            if is_wanted(self, inner, parent) {
                return Some((inner, parent));
            }
            spanned.climb(inner, parent);
        }
        None
    }

    /// The domains of the vertices of `simplex`, in their order.
    pub(in crate::netmesh) fn domains_of(&mut self, simplex: SimplexId) -> [DomainId; MAX_DIM + 1] {
        let mut domains = [DomainId::NONE; MAX_DIM + 1];
        for (domain, &vertex) in
            domains.iter_mut().zip(self.state.delaunay.complex().vertices(simplex))
        {
            *domain = self.state.hierarchy.domain_of(vertex);
        }
        domains
    }

    /// Whether the corner of `simplex` is farther from the centre of `cage` than the bound allows.
    fn is_beyond_cage_bound(&self, simplex: SimplexId, cage: DomainId) -> bool {
        self.bad_simplex_view().is_beyond_cage_bound(simplex, cage)
    }

    /// See [`super::bad_simplex::Measure::cage_bound`].
    fn cage_bound(&self, cage: DomainId) -> f64 {
        self.measure().cage_bound(self.state.hierarchy.node(cage))
    }

    /// The domain through whose cage the corner of a live simplex slips and makes a cell bad.
    pub(in crate::netmesh) fn open_domain(&mut self, simplex: SimplexId) -> Option<DomainId> {
        let radius = self.state.delaunay.ball(simplex)?.radius();
        if !self.state.stage.is_final || self.state.refine_list.is_limited(simplex) {
            return None;
        }
        let open = match self.state.parameters.criterion {
            Criterion::VoronoiAspect => self.domain_of_open_cell(simplex, radius),
            Criterion::RadiusEdge => self.domain_of_short_edge(simplex, radius),
        };
        open.filter(|&domain| self.state.parameters.counts_all_corners_in(domain)).or_else(|| {
            self.parent_of_bad_cage(simplex, |mesher, parent| {
                mesher.state.parameters.counts_all_corners_in(parent)
            })
        })
    }

    /// Whether all that is bad (`is_bad`) is open, too: the same corners are too far, only more of
    /// them count. By edges that is not so where a simplex has vertices of several domains.
    pub(in crate::netmesh) fn is_bad_open(&self) -> bool {
        let is_by_cells = self.state.parameters.criterion == Criterion::VoronoiAspect;
        self.state.stage.is_final
            && self.state.parameters.counts_all_corners()
            && (is_by_cells || self.state.hierarchy.is_single())
    }

    /// The domain of the vertex with the worst cell, if that is bad.
    fn domain_of_open_cell(&mut self, simplex: SimplexId, radius: f64) -> Option<DomainId> {
        let is_cell =
            |mesher: &mut Self, vertex| !mesher.state.hierarchy.cage_of(vertex).is_valid();
        let worst = self.worst_cell(simplex, radius, is_cell);
        worst.map(|vertex| self.state.hierarchy.domain_of(vertex))
    }

    /// The domain of all vertices, if an edge is too short for the radius. Where the vertices are
    /// of several domains, the corner is that of a cage's union cell.
    fn domain_of_short_edge(&mut self, simplex: SimplexId, radius: f64) -> Option<DomainId> {
        self.short_edge(simplex, radius)?;
        let vertices = self.state.delaunay.complex().vertices(simplex);
        if self.state.hierarchy.same_domain(vertices) {
            return Some(self.state.hierarchy.domain_of(vertices[0]));
        }
        let domains = self.domains_of(simplex);
        domains[1..=D].iter().all(|&domain| domain == domains[0]).then_some(domains[0])
    }
}
