//! A view of simplices that tells which ones may be bad. It changes nothing, so all threads may use
//! it.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::state::hierarchy::{DomainId, Hierarchy, Node};
use crate::netmesh::state::workers::{on_threads, pieces};
use crate::netmesh::state::{Cell, Mesher, State};
use crate::options::Criterion;
use crate::parameters::least_aspect;

pub(in crate::netmesh) struct BadSimplexView<'a, const D: usize> {
    delaunay: &'a Delaunay<D>,
    hierarchy: &'a Hierarchy<D>,
    cells: &'a [Cell],
    measure: QualityBound,
}

/// Simplices that a scan tests.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::netmesh) enum Scan {
    All,
    /// Simplices with vertices of several domains.
    SpanningDomains,
}

/// Criterion and bound that simplices are measured by.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct QualityBound {
    pub criterion: Criterion,
    pub bound: f64,
}

impl<const D: usize> BadSimplexView<'_, D> {
    /// Returns true if a live simplex has what all bad ones have, and few others: vertices too near
    /// to others for the radius, or vertices of several domains.
    #[inline]
    pub fn is_suspect(&self, simplex: SimplexId) -> bool {
        let Some(radius) = self.delaunay.radius(simplex) else { return false };
        let allowed = self.measure.nearest_allowed(radius);
        let vertices = self.delaunay.complex().vertices(simplex);
        let is_near = |&&vertex: &&VertexId| self.cells[vertex].nearest < allowed;
        vertices.iter().filter(is_near).count() >= self.measure.near_of_bad()
            || !self.hierarchy.same_domain(vertices)
    }

    /// Returns true if a live simplex has vertices of several domains.
    #[inline]
    fn spans_domains(&self, simplex: SimplexId) -> bool {
        let is_finite = self.delaunay.has_ball(simplex);
        is_finite && !self.hierarchy.same_domain(self.delaunay.complex().vertices(simplex))
    }

    /// Returns true if a live simplex is suspect, and not only for its domains or for the vertices
    /// of a cage: the corner is beyond the bound of a union cell, or the cell of a near vertex has
    /// a bound. The hierarchy must be compressed.
    fn may_be_bad(&self, simplex: SimplexId) -> bool {
        let Some(radius) = self.delaunay.radius(simplex) else { return false };
        let allowed = self.measure.nearest_allowed(radius);
        let vertices = self.delaunay.complex().vertices(simplex);
        let has_bound = |vertex: VertexId| match self.measure.criterion {
            Criterion::VoronoiAspect => !self.hierarchy.cage_of(vertex).is_valid(),
            Criterion::RadiusEdge => true,
        };
        let is_near =
            |&&vertex: &&VertexId| self.cells[vertex].nearest < allowed && has_bound(vertex);
        vertices.iter().filter(is_near).count() >= self.measure.near_of_bad()
            || !self.hierarchy.same_domain(vertices)
                && self.hierarchy.spans(vertices, |cage| self.is_beyond_cage_bound(simplex, cage))
    }

    /// Returns true if the corner of `simplex` is farther from the centre of `cage` than the bound
    /// allows.
    pub fn is_beyond_cage_bound(&self, simplex: SimplexId, cage: DomainId) -> bool {
        let node = self.hierarchy.node(cage);
        let distance = self.delaunay.corner_distance(simplex, &node.point);
        distance.is_some_and(|distance| distance > self.measure.cage_bound(node))
    }
}

impl QualityBound {
    /// Returns the number of vertices of a bad simplex in one domain that are too near to others:
    /// an edge has two ends.
    #[inline]
    pub fn near_of_bad(&self) -> usize {
        match self.criterion {
            Criterion::VoronoiAspect => 1,
            Criterion::RadiusEdge => 2,
        }
    }

    /// Returns the distance from its nearest neighbour below which a vertex makes a simplex of the
    /// given radius bad.
    #[inline]
    pub fn nearest_allowed(&self, radius: f64) -> f64 {
        match self.criterion {
            Criterion::VoronoiAspect => 2.0 * radius / self.bound,
            Criterion::RadiusEdge => radius / self.bound,
        }
    }

    /// Returns tau for the union cells of cages: a simplex's radius over its shortest edge is at
    /// most half the aspect of its vertices' cells. It is not below the least bound of an aspect,
    /// which the criterion does not ask for.
    fn aspect_bound<const D: usize>(&self) -> f64 {
        match self.criterion {
            Criterion::VoronoiAspect => self.bound,
            Criterion::RadiusEdge => (2.0 * self.bound).max(least_aspect(D)),
        }
    }

    /// Returns the distance from the centre of `cage` within which the corners of a good union cell
    /// are.
    pub fn cage_bound<const D: usize>(&self, cage: &Node<D>) -> f64 {
        let in_radius = 0.5 * (cage.outside + cage.radius);
        self.aspect_bound::<D>() * in_radius
    }
}

impl<const D: usize> State<D> {
    #[inline]
    pub(in crate::netmesh) fn bad_simplex_view(&self) -> BadSimplexView<'_, D> {
        let State { delaunay, hierarchy, cells, .. } = self;
        BadSimplexView { delaunay, hierarchy, cells, measure: self.measure() }
    }

    #[inline]
    pub(in crate::netmesh) fn measure(&self) -> QualityBound {
        QualityBound { criterion: self.parameters.criterion, bound: self.stage.bound }
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns all live simplices that a scan finds suspect, in rising order, in pieces. Many span
    /// domains, and few of those are bad: those that may be are told here, on all threads.
    pub(in crate::netmesh) fn suspects(&mut self, scan: Scan) -> Result<Vec<Vec<SimplexId>>> {
        if scan == Scan::SpanningDomains && self.state.hierarchy.is_single() {
            return Ok(Vec::new());
        }
        let threads = self.state.threads();
        let measure = self.state.measure();
        let watch = &mut self.watch;
        let State { delaunay, hierarchy, cells, .. } = &mut self.state;
        hierarchy.compress(|| watch.poll_after(1))?;
        let complex = delaunay.complex();
        let view = BadSimplexView { delaunay, hierarchy, cells, measure };
        on_threads(threads, watch, pieces(complex.simplex_bound()), |piece| {
            let mut suspects = Vec::new();
            for simplex in piece {
                let is_suspect = match scan {
                    Scan::All => view.may_be_bad(simplex),
                    Scan::SpanningDomains => {
                        view.spans_domains(simplex) && view.may_be_bad(simplex)
                    }
                };
                if is_suspect && complex.is_live(simplex) {
                    suspects.try_push(simplex)?;
                }
            }
            Ok(suspects)
        })
    }
}
