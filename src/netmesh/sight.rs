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
    measure: Measure,
}

/// Which simplices are looked at.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Look {
    AtAll,
    /// Those with vertices of several domains.
    AtDivided,
}

/// What a simplex is measured by.
#[derive(Clone, Copy)]
pub(super) struct Measure {
    pub criterion: Criterion,
    pub bound: f64,
}

impl<const D: usize> Sight<'_, D> {
    /// Whether a live simplex has what all bad ones have, and few others: vertices too near to
    /// others for the radius, or vertices of several domains.
    #[inline]
    pub fn is_suspect(&self, simplex: u32) -> bool {
        let Some(ball) = self.delaunay.ball(simplex) else { return false };
        let allowed = self.measure.nearest_allowed(ball.radius());
        let vertices = self.delaunay.complex().vertices(simplex);
        let is_near = |&&vertex: &&u32| self.cells[vertex as usize].nearest < allowed;
        vertices.iter().filter(is_near).count() >= self.measure.near_of_bad()
            || !self.hierarchy.is_alike(vertices)
    }

    /// Whether a live simplex has vertices of several domains.
    #[inline]
    fn is_divided(&self, simplex: u32) -> bool {
        let is_finite = self.delaunay.ball(simplex).is_some();
        is_finite && !self.hierarchy.is_alike(self.delaunay.complex().vertices(simplex))
    }
}

impl Measure {
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
        let Self { delaunay, hierarchy, cells, .. } = self;
        Sight { delaunay, hierarchy, cells, measure: self.measure() }
    }

    #[inline]
    pub(super) fn measure(&self) -> Measure {
        Measure { criterion: self.parameters.criterion, bound: self.bound }
    }

    /// All live simplices that are suspect among those that are looked at, in rising order, in pieces.
    pub(super) fn suspects(&mut self, look: Look) -> Result<Vec<Vec<u32>>> {
        if look == Look::AtDivided && self.hierarchy.is_single() {
            return Ok(Vec::new());
        }
        let threads = self.threads();
        let measure = self.measure();
        let Self { delaunay, hierarchy, cells, watch, .. } = self;
        let complex = delaunay.complex();
        let sight = Sight { delaunay, hierarchy, cells, measure };
        on_threads(threads, watch, pieces(complex.simplex_bound()), |piece| {
            let mut suspects = Vec::new();
            for simplex in piece {
                let is_suspect = match look {
                    Look::AtAll => sight.is_suspect(simplex),
                    Look::AtDivided => sight.is_divided(simplex),
                };
                if is_suspect && complex.is_live(simplex) {
                    suspects.try_push(simplex)?;
                }
            }
            Ok(suspects)
        })
    }
}
