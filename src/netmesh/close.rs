//! The last refinement, once all inputs are in: to the bound that the caller asked for, over all
//! corners of all cells.
//!
//! While the mesh grows its bound is looser, and a cell answers only for its corners inside the hull
//! of its domain's cage (`quality`): refinement up to the cage would destroy it. That leaves slits,
//! cells that look out between the vertices of a coarse cage. Now every corner counts: one near the
//! cage sphere or beyond it goes in as a further cage vertex, at the nearest point of the sphere, and
//! one well inside as a Steiner point. Then Definition 4 holds as it stands, over all corners.
//!
//! It ends as Ruppert's refinement of a domain with a smooth boundary does ("A Delaunay refinement
//! algorithm for quality 2-dimensional mesh generation", 1995). Inputs keep away from the sphere
//! (Definition 2), Steiner points by [`NEAR`] times their insertion radius. A corner beyond the sphere
//! sees it through a cap that no vertex is in, so its projection is at least as far from all vertices
//! as the cap is high; that is as deep as the vertex inside lies. What this argument's constants do
//! not cover, [`SPACING`] ends; no run with default options came to that.

use super::sight::Look;
use super::{Mesher, some};
use crate::error::Result;
use crate::memory::AllocResult;
use crate::mesh::NONE;
use crate::numerics::norm;
use crate::options::{Criterion, Phase};

/// A corner within this times its radius of the cage sphere, or beyond it, belongs to the cage.
const NEAR: f64 = 0.5;

/// Simplices of a tile, and of a mesh that goes without. What is refined at a time stays in the cache,
/// which halves the time of large meshes; the order by length is kept in tiles only, which costs up to
/// 0.6 % more vertices, and 3 % around close pairs (docs/decisions.md).
const TILE: usize = 1 << 12;
const SMALL: usize = 1 << 17;

/// A further cage vertex keeps this distance from others, relative to the sphere's radius.
const SPACING: f64 = 1.0 / 64.0;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines until no cell is bad over all its corners. Insertions examine what they change; but a
    /// cage's union cell may have corners at simplices without a vertex of the cage, which are not seen
    /// when its clearance falls: hence until a look at all that have vertices of several domains finds
    /// nothing.
    pub(super) fn close(&mut self) -> Result<()> {
        self.begin_closing()?;
        let mut look = Look::AtAll;
        if self.delaunay.complex().simplex_count() > SMALL && !self.is_nearly_closed() {
            self.close_tiles()?;
            look = Look::AtDivided;
        }
        while self.close_all(look)? {
            look = Look::AtDivided;
        }
        debug_assert!(!self.is_any_open(), "what is not divided was seen when it changed");
        self.closed = 1.0;
        self.report_progress()
    }

    /// A first look at a part; what it leaves bad the whole finds.
    pub(super) fn close_part(&mut self) -> Result<()> {
        self.begin_closing()?;
        self.close_tiles()
    }

    fn begin_closing(&mut self) -> Result<()> {
        self.bound = self.parameters.quality_bound;
        self.closing = true;
        self.before_closing = self.delaunay.point_count();
        self.phase = Phase::Finish;
        self.report_progress()?;
        Ok(self.refine.sort_by_length()?)
    }

    /// A first look, one tile after the other.
    fn close_tiles(&mut self) -> Result<()> {
        let watch = &mut self.watch;
        let complex = self.delaunay.complex();
        let order = complex.order_by_anchor(self.inputs, || watch.poll_after(1))?.order;
        for (at, tile) in order.chunks(TILE).enumerate() {
            self.close_simplices(tile)?;
            self.closed = (at * TILE) as f64 / order.len() as f64;
            self.note_progress();
        }
        Ok(())
    }

    /// Mends those of some simplices that are bad, with all that gets bad by it.
    fn close_simplices(&mut self, simplices: &[u32]) -> Result<()> {
        for &simplex in simplices {
            self.watch.poll_after(1)?;
            if self.delaunay.complex().is_live(simplex) {
                self.examine(simplex)?;
            }
        }
        self.clean()
    }

    /// Mends all simplices that are bad; whether any was.
    fn close_all(&mut self, look: Look) -> Result<bool> {
        for simplex in self.suspects(look)?.into_iter().flatten() {
            self.watch.poll_after(2)?;
            self.examine_suspect(simplex)?;
        }
        let was_bad = !self.refine.is_empty();
        self.clean()?;
        Ok(was_bad)
    }

    fn is_any_open(&mut self) -> bool {
        let bound = self.delaunay.complex().simplex_bound() as u32;
        (0..bound).any(|simplex| {
            self.delaunay.complex().is_live(simplex) && self.open_domain(simplex).is_some()
        })
    }

    /// The domain through whose cage the corner of a live simplex slips and makes a cell bad.
    pub(super) fn open_domain(&mut self, simplex: u32) -> Option<u32> {
        let radius = self.delaunay.ball(simplex)?.radius();
        if !self.closing || self.refine.is_limited(simplex) {
            return None;
        }
        let open = match self.parameters.criterion {
            Criterion::VoronoiAspect => self.domain_of_open_cell(simplex, radius),
            Criterion::RadiusEdge => self.domain_of_short_edge(simplex, radius),
        };
        open.filter(|&domain| self.parameters.closes(domain)).or_else(|| {
            self.parent_of_bad_cage(simplex, |mesher, parent| mesher.parameters.closes(parent))
        })
    }

    /// Whether all that is bad (`is_bad`) is open, too: the same corners are too far, only more of them
    /// count. By edges that is not so where a simplex has vertices of several domains.
    pub(super) fn is_bad_open(&self) -> bool {
        let is_by_cells = self.parameters.criterion == Criterion::VoronoiAspect;
        self.closing && self.parameters.closes_all() && (is_by_cells || self.hierarchy.is_single())
    }

    /// The domain of the vertex with the worst cell, if that is bad.
    fn domain_of_open_cell(&mut self, simplex: u32, radius: f64) -> Option<u32> {
        let is_cell = |mesher: &mut Self, vertex| mesher.hierarchy.cage_of(vertex) == NONE;
        let worst = self.worst_cell(simplex, radius, is_cell);
        worst.map(|vertex| self.hierarchy.domain_of(vertex))
    }

    /// The domain of all vertices, if an edge is too short for the radius. Where the vertices are of
    /// several domains, the corner is that of a cage's union cell.
    fn domain_of_short_edge(&mut self, simplex: u32, radius: f64) -> Option<u32> {
        self.short_edge(simplex, radius)?;
        let vertices = self.delaunay.complex().vertices(simplex);
        if self.hierarchy.is_alike(vertices) {
            return Some(self.hierarchy.domain_of(vertices[0]));
        }
        let domains = self.domains_of(simplex);
        domains[1..=D].iter().all(|&domain| domain == domains[0]).then_some(domains[0])
    }

    /// Inserts a point that narrows the slit in the cage of `domain` that the corner of `simplex`
    /// slips through.
    pub(super) fn close_slit(&mut self, simplex: u32, domain: u32) -> Result<()> {
        if self.is_clear_of_cage(simplex, domain)? {
            return self.refine_corner(simplex);
        }
        match self.projected_corner(simplex, domain) {
            Some(x) if self.finds_room(simplex, domain, &x)? && self.may_join(domain, &x) => {
                self.join_at(domain, x)
            }
            _ => {
                self.refine.limit(simplex);
                Ok(())
            }
        }
    }

    /// Whether the corner of `simplex` is inside the cage sphere by a part of its radius, and all
    /// that it would be next to is inside the domain.
    fn is_clear_of_cage(&mut self, simplex: u32, domain: u32) -> AllocResult<bool> {
        let center = self.hierarchy.node(domain).point;
        let Some(gap) = self.delaunay.corner_distance(simplex, &center) else { return Ok(false) };
        let radius = self.delaunay.ball(simplex).map_or(f64::INFINITY, |ball| ball.radius());
        let depth = self.sphere_radius(domain) - gap;
        let clear = depth > NEAR * radius;
        let Some(corner) = self.delaunay.corner(simplex).filter(|_| clear) else {
            return Ok(false);
        };
        if !self.is_inside(simplex, domain) {
            return Ok(false);
        }
        self.delaunay.find_cavity(simplex, &corner, &mut self.scratch.cavity)?;
        Ok(self.scratch.cavity.simplices.iter().all(|&simplex| self.is_inside(simplex, domain)))
    }

    /// Whether all vertices of `simplex` are in `domain`. The hull of the root's cage is the hull of the
    /// mesh.
    fn is_inside(&self, simplex: u32, domain: u32) -> bool {
        self.delaunay.complex().vertices(simplex).iter().all(|&vertex| {
            some(vertex).is_some_and(|v| self.hierarchy.contains(domain, self.delaunay.point(v)))
        })
    }

    /// The point of the cage sphere nearest to the corner of `simplex`.
    fn projected_corner(&self, simplex: u32, domain: u32) -> Option<[f64; D]> {
        let corner = self.delaunay.corner(simplex)?;
        let center = &self.hierarchy.node(domain).point;
        let offset: [f64; D] = std::array::from_fn(|axis| corner[axis] - center[axis]);
        let stretch = self.sphere_radius(domain) / norm(&offset);
        let x: [f64; D] = std::array::from_fn(|axis| center[axis] + stretch * offset[axis]);
        x.iter().all(|x| x.is_finite()).then_some(x)
    }

    /// Finds the cavity of `x` and tells whether `x` is far enough from its corners.
    fn finds_room(&mut self, near: u32, domain: u32, x: &[f64; D]) -> AllocResult<bool> {
        let Some(start) = self.delaunay.locate(near, x) else { return Ok(false) };
        self.delaunay.find_cavity(start, x, &mut self.scratch.cavity)?;
        Ok(self.nearest_corner(x) >= SPACING * self.sphere_radius(domain))
    }

    fn may_join(&mut self, domain: u32, x: &[f64; D]) -> bool {
        !self.rim.is_foreign(domain) && self.may_insert(x)
    }

    /// Inserts `x`, whose conflicts are the scratch cavity, as a vertex of the cage of `domain`.
    fn join_at(&mut self, domain: u32, x: [f64; D]) -> Result<()> {
        self.stats.cage_points += 1;
        self.stats.closing_points += 1;
        let vertex = self.add_vertex(x)?;
        self.insert_into_cage(domain, vertex)
    }
}
