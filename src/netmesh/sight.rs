//! What is seen of a simplex at a glance, without changing anything, so that all threads may look.

use super::domains::Hierarchy;
use super::threads::{on_threads, pieces};
use super::{Cell, Mesher};
use crate::delaunay::Delaunay;
use crate::error::Result;
use crate::memory::TryGrow;
use crate::options::Criterion;

pub(super) struct Sight<'a, const D: usize> {
    delaunay: &'a Delaunay<D>,
    hierarchy: &'a Hierarchy<D>,
    cells: &'a [Cell],
    criterion: Criterion,
    bound: f64,
}

impl<const D: usize> Sight<'_, D> {
    /// Whether a live simplex has what all bad ones have, and few others: vertices too near to
    /// others for the radius, or vertices of several domains.
    #[inline]
    pub fn is_suspect(&self, simplex: u32) -> bool {
        let Some(ball) = self.delaunay.ball(simplex) else { return false };
        let allowed = self.nearest_allowed(ball.radius());
        let vertices = self.delaunay.complex().vertices(simplex);
        let is_near = |&&vertex: &&u32| self.cells[vertex as usize].nearest < allowed;
        vertices.iter().filter(is_near).count() >= self.near_of_bad()
            || !self.hierarchy.is_alike(vertices)
    }

    /// How many vertices of a bad simplex, whose vertices are of one domain, are too near to others: an edge
    /// has two ends.
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
    pub(super) fn sight(&self) -> Sight<'_, D> {
        let criterion = self.parameters.criterion;
        let Self { delaunay, hierarchy, cells, bound, .. } = self;
        Sight { delaunay, hierarchy, cells, criterion, bound: *bound }
    }

    /// All live simplices that are suspect, in rising order, in pieces.
    pub(super) fn suspects(&mut self) -> Result<Vec<Vec<u32>>> {
        let threads = self.threads();
        let criterion = self.parameters.criterion;
        let Self { delaunay, hierarchy, cells, bound, watch, .. } = self;
        let complex = delaunay.complex();
        let sight = Sight { delaunay, hierarchy, cells, criterion, bound: *bound };
        on_threads(threads, watch, pieces(complex.simplex_bound()), |piece| {
            let mut suspects = Vec::new();
            for simplex in piece {
                if complex.is_live(simplex) && sight.is_suspect(simplex) {
                    suspects.try_push(simplex)?;
                }
            }
            Ok(suspects)
        })
    }
}
