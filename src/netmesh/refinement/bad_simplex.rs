//! A view of simplices that tells which ones may be bad. It changes nothing, so all threads may use
//! it.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::netmesh::cages::domains::Hierarchy;
use crate::netmesh::partitions::workers::{on_threads, pieces};
use crate::netmesh::{Cell, Mesher, State};
use crate::options::Criterion;

pub(in crate::netmesh) struct BadSimplexView<'a, const D: usize> {
    delaunay: &'a Delaunay<D>,
    hierarchy: &'a Hierarchy<D>,
    cells: &'a [Cell],
    measure: Measure,
}

/// Which simplices a scan tests.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::netmesh) enum Scan {
    All,
    /// Those with vertices of several domains.
    SpanningDomains,
}

/// What a simplex is measured by.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Measure {
    pub criterion: Criterion,
    pub bound: f64,
}

impl<const D: usize> BadSimplexView<'_, D> {
    /// Whether a live simplex has what all bad ones have, and few others: vertices too near to
    /// others for the radius, or vertices of several domains.
    #[inline]
    pub fn is_suspect(&self, simplex: SimplexId) -> bool {
        let Some(ball) = self.delaunay.ball(simplex) else { return false };
        let allowed = self.measure.nearest_allowed(ball.radius());
        let vertices = self.delaunay.complex().vertices(simplex);
        let is_near = |&&vertex: &&VertexId| self.cells[vertex].nearest < allowed;
        vertices.iter().filter(is_near).count() >= self.measure.near_of_bad()
            || !self.hierarchy.same_domain(vertices)
    }

    /// Whether a live simplex has vertices of several domains.
    #[inline]
    fn spans_domains(&self, simplex: SimplexId) -> bool {
        let is_finite = self.delaunay.ball(simplex).is_some();
        is_finite && !self.hierarchy.same_domain(self.delaunay.complex().vertices(simplex))
    }
}

impl Measure {
    /// How many vertices of a bad simplex, whose vertices are of one domain, are too near to
    /// others: an edge has two ends.
    #[inline]
    pub fn near_of_bad(&self) -> usize {
        match self.criterion {
            Criterion::VoronoiAspect => 1,
            Criterion::RadiusEdge => 2,
        }
    }

    /// A vertex nearer than this to its nearest neighbour makes a simplex of the given radius bad.
    #[inline]
    pub fn nearest_allowed(&self, radius: f64) -> f64 {
        match self.criterion {
            Criterion::VoronoiAspect => 2.0 * radius / self.bound,
            Criterion::RadiusEdge => radius / self.bound,
        }
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    #[inline]
    pub(in crate::netmesh) fn bad_simplex_view(&self) -> BadSimplexView<'_, D> {
        let State { delaunay, hierarchy, cells, .. } = &self.state;
        BadSimplexView { delaunay, hierarchy, cells, measure: self.measure() }
    }

    #[inline]
    pub(in crate::netmesh) fn measure(&self) -> Measure {
        Measure { criterion: self.state.parameters.criterion, bound: self.state.stage.bound }
    }

    /// All live simplices that a scan finds suspect, in rising order, in pieces.
    pub(in crate::netmesh) fn suspects(&mut self, scan: Scan) -> Result<Vec<Vec<SimplexId>>> {
        if scan == Scan::SpanningDomains && self.state.hierarchy.is_single() {
            return Ok(Vec::new());
        }
        let threads = self.threads();
        let measure = self.measure();
        let watch = &mut self.watch;
        let State { delaunay, hierarchy, cells, .. } = &self.state;
        let complex = delaunay.complex();
        let view = BadSimplexView { delaunay, hierarchy, cells, measure };
        on_threads(threads, watch, pieces(complex.simplex_bound()), |piece| {
            let mut suspects = Vec::new();
            for simplex in piece {
                let is_suspect = match scan {
                    Scan::All => view.is_suspect(simplex),
                    Scan::SpanningDomains => view.spans_domains(simplex),
                };
                if is_suspect && complex.is_live(simplex) {
                    suspects.try_push(simplex)?;
                }
            }
            Ok(suspects)
        })
    }
}
