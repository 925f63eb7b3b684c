//! Voronoi cells of vertices and of cages (§3, §4): in-radii, and out-radii restricted to the
//! corners that count for a cell. One pass over the simplices; shared by the measures and the
//! certificate.

use super::corner::Corner;
use super::length::Length;
use super::tree::DomainTree;
use super::view::View;
use crate::memory::{AllocResult, collected, filled};
use crate::mesh::NONE;
use crate::parameters::Parameters;

/// Largest number of domains that the walks up the hierarchy may visit per simplex on average.
/// Cages that are not encroached let no D-ball span more than a few.
const CLIMBS_PER_SIMPLEX: usize = 64;

/// Radii of the cells of all vertices and cages.
pub(crate) struct Cells {
    /// Vertex -> distance to its nearest Delaunay neighbour: twice the in-radius.
    pub nearest: Vec<Length>,
    /// Vertex -> out-radius over the corners that count in the vertex's domain.
    pub farthest: Vec<Length>,
    /// Vertex -> out-radius over all corners.
    pub farthest_anywhere: Vec<Length>,
    /// Domain -> distance of its centre to the nearest vertex outside its ball.
    pub cage_nearest: Vec<Length>,
    /// Domain -> out-radius of the union cell, over the corners that count in the parent.
    pub cage_farthest: Vec<Length>,
    /// Domain -> the same over all corners.
    pub cage_farthest_anywhere: Vec<Length>,
    /// False if simplices span absurdly many domains, and the cage radii were given up.
    pub cages_complete: bool,
}

/// Measures of one simplex, which [`Cells::survey`] passes to its caller.
pub(crate) struct SimplexCell {
    pub simplex: usize,
    /// Circumradius over shortest edge; infinite for a flat simplex.
    pub radius_edge: f64,
    /// True if the circumcentre counts in the domain of each of the vertices.
    pub counts: bool,
    /// The domain of all vertices, [`NONE`] if they are of several.
    pub domain: u32,
}

impl Cells {
    /// Surveys a mesh whose ids are in range. Without a `tree` every corner counts. `slack` (about
    /// 1) multiplies the radius within which corners count. O(simplices) for a hierarchical mesh.
    pub fn survey<const D: usize>(
        view: View<'_, D>,
        tree: Option<&DomainTree>,
        slack: f64,
        mut visit: impl FnMut(&SimplexCell) -> AllocResult<()>,
    ) -> AllocResult<Self> {
        let mut cells = Self::empty(view.vertex_count(), view.mesh.domains.len())?;
        let limits = limits(view, slack)?;
        let mut climbs = view.simplex_count().saturating_mul(CLIMBS_PER_SIMPLEX);
        for simplex in 0..view.simplex_count() {
            let vertices = view.simplex(simplex);
            let points = &view.points_of(vertices)[..View::<D>::VERTICES];
            let star =
                Labelled { view, vertices, points, corner: Corner::new(points)?, limits: &limits };
            let counts = cells.add_vertices(&star, tree.is_some());
            if let Some(tree) = tree {
                cells.add_cages(&star, tree, &mut climbs);
            }
            let ratio = |corner: &Corner<D>| corner.radius.ratio(corner.shortest_edge);
            let radius_edge = star.corner.as_ref().map_or(f64::INFINITY, ratio);
            visit(&SimplexCell { simplex, radius_edge, counts, domain: star.common_label() })?;
        }
        Ok(cells)
    }

    /// Returns true if a simplex has `vertex`: in a part of a mesh some vertices have none.
    pub fn has_cell(&self, vertex: usize) -> bool {
        self.nearest[vertex] != Length::INFINITE
    }

    /// Returns true if a simplex has vertices inside and outside of the ball of `domain`.
    pub fn has_cage(&self, domain: usize) -> bool {
        self.cage_nearest[domain] != Length::INFINITE
    }

    /// Returns the out-radius over the in-radius of the cell of `vertex`, over the corners that
    /// count.
    pub fn aspect(&self, vertex: usize) -> f64 {
        2.0 * self.farthest[vertex].ratio(self.nearest[vertex])
    }

    /// Returns the out-radius over the in-radius of the cell of `vertex`, over all of its corners.
    pub fn aspect_anywhere(&self, vertex: usize) -> f64 {
        2.0 * self.farthest_anywhere[vertex].ratio(self.nearest[vertex])
    }

    /// Returns the aspect of the union cell of the cage of a `domain` of this `radius`, over the
    /// corners that count. Its in-radius is (d + r) / 2 (§5, approximation by cages).
    pub fn cage_aspect(&self, domain: usize, radius: f64) -> f64 {
        let twice_inner = self.cage_nearest[domain].plus(Length::new(radius));
        2.0 * self.cage_farthest[domain].ratio(twice_inner)
    }

    /// Returns the aspect of the union cell of the cage of a `domain` of this `radius`, over all of
    /// its corners.
    pub fn cage_aspect_anywhere(&self, domain: usize, radius: f64) -> f64 {
        let twice_inner = self.cage_nearest[domain].plus(Length::new(radius));
        2.0 * self.cage_farthest_anywhere[domain].ratio(twice_inner)
    }

    fn empty(vertices: usize, domains: usize) -> AllocResult<Self> {
        Ok(Self {
            nearest: filled(vertices, Length::INFINITE)?,
            farthest: filled(vertices, Length::ZERO)?,
            farthest_anywhere: filled(vertices, Length::ZERO)?,
            cage_nearest: filled(domains, Length::INFINITE)?,
            cage_farthest: filled(domains, Length::ZERO)?,
            cage_farthest_anywhere: filled(domains, Length::ZERO)?,
            cages_complete: true,
        })
    }

    /// Enters one simplex into the cells of its vertices; returns whether its corner counts in all.
    fn add_vertices<const D: usize>(&mut self, star: &Labelled<'_, D>, restricted: bool) -> bool {
        let radius = star.corner.as_ref().map_or(Length::INFINITE, |corner| corner.radius);
        let (mut last, mut last_counts, mut all_count) = (NONE, true, true);
        for (i, &v) in star.vertices.iter().enumerate() {
            for (j, &w) in star.vertices.iter().enumerate().skip(i + 1) {
                let length = Length::between(star.points[i], star.points[j]);
                self.nearest[v as usize] = self.nearest[v as usize].min(length);
                self.nearest[w as usize] = self.nearest[w as usize].min(length);
            }
            let label = star.label(v);
            if restricted && label != last {
                (last, last_counts) = (label, star.counts_in(label));
            }
            all_count &= last_counts;
            self.farthest_anywhere[v as usize] = self.farthest_anywhere[v as usize].max(radius);
            if last_counts {
                self.farthest[v as usize] = self.farthest[v as usize].max(radius);
            }
        }
        all_count
    }

    /// Enters one simplex into the union cells of all domains that hold some of its vertices only.
    ///
    /// The nearest vertex outside a ball is seen so: the Delaunay graph is connected within every
    /// ball, so that vertex has a neighbour among the vertices inside.
    fn add_cages<const D: usize>(
        &mut self,
        star: &Labelled<'_, D>,
        tree: &DomainTree,
        climbs: &mut usize,
    ) {
        for (i, &v) in star.vertices.iter().enumerate() {
            let mut domain = star.label(v);
            if star.vertices[..i].iter().any(|&w| star.label(w) == domain) {
                continue;
            }
            while star.vertices.iter().any(|&w| !tree.holds(domain, star.label(w))) {
                if *climbs == 0 {
                    self.cages_complete = false;
                    return;
                }
                *climbs -= 1;
                self.add_cage(star, tree, domain);
                domain = tree.parent(domain);
            }
        }
    }

    fn add_cage<const D: usize>(&mut self, star: &Labelled<'_, D>, tree: &DomainTree, domain: u32) {
        let index = domain as usize;
        let center = star.view.point(star.view.mesh.domains[index].center);
        for (point, &w) in star.points.iter().zip(star.vertices) {
            if !tree.holds(domain, star.label(w)) {
                let distance = Length::between(point, center);
                self.cage_nearest[index] = self.cage_nearest[index].min(distance);
            }
        }
        let corner = star.corner.as_ref();
        let reach = corner.map_or(Length::INFINITE, |c| c.distance(star.points, center));
        self.cage_farthest_anywhere[index] = self.cage_farthest_anywhere[index].max(reach);
        if star.counts_in(tree.parent(domain)) {
            self.cage_farthest[index] = self.cage_farthest[index].max(reach);
        }
    }
}

/// One simplex with the domains of its vertices and its corner.
struct Labelled<'a, const D: usize> {
    view: View<'a, D>,
    vertices: &'a [u32],
    points: &'a [&'a [f64; D]],
    corner: Option<Corner<D>>,
    limits: &'a [Length],
}

impl<const D: usize> Labelled<'_, D> {
    fn label(&self, vertex: u32) -> u32 {
        self.view.mesh.vertex_domains[vertex as usize]
    }

    fn common_label(&self) -> u32 {
        let label = self.label(self.vertices[0]);
        if self.vertices.iter().all(|&v| self.label(v) == label) { label } else { NONE }
    }

    /// Returns true if the Voronoi corner counts for cells of `domain`. The corner of a flat
    /// simplex always counts.
    fn counts_in(&self, domain: u32) -> bool {
        let Some(corner) = &self.corner else {
            return true;
        };
        let center = self.view.point(self.view.mesh.domains[domain as usize].center);
        corner.distance(self.points, center) < self.limits[domain as usize]
    }
}

/// Returns for each domain the distance from its centre within which corners count.
fn limits<const D: usize>(view: View<'_, D>, slack: f64) -> AllocResult<Vec<Length>> {
    let parameters = &view.mesh.parameters;
    let factor = corner_restriction(parameters) * parameters.cage_scale * slack;
    collected(view.mesh.domains.iter().map(|domain| Length::new(domain.radius).times(factor)))
}

/// Returns the fraction of the radius of a domain's cage sphere within which corners count. The
/// cage is a delta-net of its sphere, whose hull holds the ball of 1 - delta^2 / 2; what is beyond
/// belongs to the union cell of the cage.
fn corner_restriction(parameters: &Parameters) -> f64 {
    const LARGEST: f64 = 0.85;
    LARGEST.min(1.0 - 0.5 * parameters.delta * parameters.delta)
}
