//! From the state of a run to plain data: finite simplices and living domains, renumbered.

use super::Mesher;
use super::domains::ROOT;
use crate::complex::INFINITE;
use crate::mesh::{Domain, NONE, Triangulation, VertexKind};
use crate::options::Algorithm;
use std::time::Instant;

impl<const D: usize> Mesher<'_, '_, D> {
    pub(super) fn into_triangulation(mut self, begun: Instant) -> Triangulation {
        let (simplices, neighbors) = self.finite_simplices();
        let vertices = self.delaunay.point_count() as u32;
        let (domains, ids) = self.living_domains();
        let renumbered = |domain: u32| match domain {
            NONE => NONE,
            domain => ids[domain as usize],
        };
        let cage_of: Vec<u32> =
            (0..vertices).map(|v| renumbered(self.hierarchy.cage_of(v))).collect();
        let vertex_domains = match domains.is_empty() {
            true => vec![NONE; vertices as usize],
            false => (0..vertices).map(|v| renumbered(self.hierarchy.domain_of(v))).collect(),
        };
        let kinds: Vec<VertexKind> = (0..vertices).map(|v| self.kind(v, &cage_of)).collect();
        let precision_limited = self.limited_vertices();
        self.count_vertices(&kinds, &precision_limited);
        self.stats.seconds = begun.elapsed().as_secs_f64();
        Triangulation {
            dim: D,
            points: (0..vertices).flat_map(|v| *self.delaunay.point(v)).collect(),
            simplices,
            neighbors,
            kinds,
            vertex_domains,
            cage_of,
            domains,
            precision_limited,
            parameters: self.parameters,
            stats: self.stats,
        }
    }

    fn finite_simplices(&self) -> (Vec<u32>, Vec<u32>) {
        let complex = self.delaunay.complex();
        let bound = complex.simplex_bound() as u32;
        let is_finite = |s: u32| complex.is_live(s) && !complex.is_infinite(s);
        let mut ids = vec![NONE; bound as usize];
        let mut count = 0;
        for simplex in (0..bound).filter(|&s| is_finite(s)) {
            ids[simplex as usize] = count;
            count += 1;
        }
        let mut simplices = Vec::with_capacity(count as usize * (D + 1));
        let mut neighbors = Vec::with_capacity(count as usize * (D + 1));
        for simplex in (0..bound).filter(|&s| is_finite(s)) {
            simplices.extend_from_slice(complex.vertices(simplex));
            neighbors.extend(complex.neighbors(simplex).iter().map(|&n| ids[n as usize]));
        }
        debug_assert!(!simplices.contains(&INFINITE));
        (simplices, neighbors)
    }

    /// The living domains, parents before children, and the map from ids to their indices.
    fn living_domains(&mut self) -> (Vec<Domain>, Vec<u32>) {
        let count = self.hierarchy.len();
        let mut living: Vec<u32> =
            (0..count).filter(|&domain| self.hierarchy.node(domain).alive).collect();
        // A parent's ball contains its children's: by falling radius parents come first.
        living.sort_by(|&a, &b| {
            let radius = |domain: u32| self.hierarchy.node(domain).radius;
            radius(b).total_cmp(&radius(a)).then(a.cmp(&b))
        });
        debug_assert!(living.first().is_none_or(|&domain| domain == ROOT));
        let mut ids = vec![NONE; count as usize];
        for (index, &domain) in living.iter().enumerate() {
            ids[domain as usize] = index as u32;
        }
        let domains = living
            .iter()
            .map(|&domain| {
                let parent = match self.hierarchy.parent(domain) {
                    NONE => NONE,
                    parent => ids[parent as usize],
                };
                let node = self.hierarchy.node(domain);
                Domain { center: node.center, parent, radius: node.radius }
            })
            .collect();
        (domains, ids)
    }

    fn kind(&self, vertex: u32, cage_of: &[u32]) -> VertexKind {
        if self.is_input(vertex) {
            VertexKind::Input
        } else if cage_of[vertex as usize] != NONE {
            VertexKind::Cage
        } else {
            VertexKind::Steiner
        }
    }

    /// Vertices whose cage could not be made, or with a corner that could not be inserted, or so
    /// near to another that ratios of radii and distances drown in the rounding of subnormals.
    fn limited_vertices(&mut self) -> Vec<bool> {
        const SUBNORMAL: f64 = f64::from_bits(1 << 30);
        let mut limited = std::mem::take(&mut self.precision_limited);
        for (limited, &nearest) in limited.iter_mut().zip(&self.nearest) {
            *limited |= nearest < SUBNORMAL;
        }
        for simplex in 0..self.delaunay.complex().simplex_bound() as u32 {
            if self.refine.is_limited(simplex) && self.delaunay.complex().is_live(simplex) {
                for &vertex in self.delaunay.complex().vertices(simplex) {
                    limited[vertex as usize] = true;
                }
            }
        }
        limited
    }

    fn count_vertices(&mut self, kinds: &[VertexKind], limited: &[bool]) {
        let count = |kind| kinds.iter().filter(|&&k| k == kind).count() as u64;
        self.stats.input_vertices = count(VertexKind::Input);
        self.stats.steiner_vertices = count(VertexKind::Steiner);
        self.stats.cage_vertices = count(VertexKind::Cage);
        self.stats.precision_limited = limited.iter().filter(|&&l| l).count() as u64;
        self.stats.exact_fallbacks = self.delaunay.exact_fallbacks();
        self.stats.touches = self.location.total_touches();
        self.stats.max_touches = u64::from(self.location.max_touches());
        debug_assert!(
            self.parameters.algorithm != Algorithm::Delaunay || self.hierarchy.len() == 0
        );
    }
}
