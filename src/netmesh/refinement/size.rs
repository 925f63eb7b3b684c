//! Refinement by size: simplices that meet the box of the inputs are no larger than the caller asks
//! for. Outside the box sizes grow as fast as the quality bound allows.
//!
//! A size is the length of an edge. It is asked for once at each vertex; for a vertex outside the
//! box the nearest point of the box counts, so that the caller knows where questions come from.
//! The least size of its vertices bounds a simplex: its circumradius is at most that of the
//! regular simplex with edges of that length. With `max_edge` no edge is longer than that, too.
//! What a field does between the vertices is not seen. But all points of a simplex are within the
//! diameter of its D-ball from its vertices: where a field changes by at most L times the
//! distance, its bound is kept at all points up to the factor 1 / (1 - 2 L c), where c is the
//! circumradius of the regular simplex with edges of length 1.
//!
//! It ends: a corner goes in that is farther from all vertices than half the size asked for, and
//! the caller answers finitely many sizes at vertices that are as far apart. Where doubles are too
//! coarse a simplex is precision-limited, and `max_vertices` ends what was asked for by mistake.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::netmesh::state::Mesher;
use crate::netmesh::state::facets::floors::Purpose;
use crate::netmesh::state::hierarchy::ROOT;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Refines until no simplex is larger than what is asked for, and each cell keeps the bound.
    /// Each vertex is looked at once: what comes later has a later vertex. Returns whether any
    /// simplex was too large.
    pub(in crate::netmesh) fn refine_by_size(&mut self, cavity: &mut Cavity) -> Result<bool> {
        let mut any = false;
        let mut vertex = 0;
        while self.sizes.is_some() && vertex < self.state.delaunay.point_count() {
            self.watch.poll_after(1)?;
            match self.largest_at(VertexId::new(vertex))? {
                Some(simplex) => {
                    any = true;
                    self.destroy(simplex, cavity)?;
                    self.clean(cavity)?;
                }
                None => {
                    vertex += 1;
                    let count = self.state.delaunay.point_count();
                    self.state.stage.size_fraction = vertex as f64 / count as f64;
                    self.note_progress();
                }
            }
        }
        self.report_progress()?;
        Ok(any)
    }

    /// Returns the simplex at `vertex` that is too large by the largest factor.
    fn largest_at(&mut self, vertex: VertexId) -> Result<Option<SimplexId>> {
        if !self.state.is_inserted(vertex) {
            return Ok(None);
        }
        self.state.delaunay.star(vertex, &mut self.scratch.star)?;
        let mut largest = (1.0, None);
        for at in 0..self.scratch.star.len() {
            let simplex = self.scratch.star[at];
            let excess = self.excess(simplex)?;
            if excess > largest.0 && !self.state.is_outside(simplex)? {
                largest = (excess, Some(simplex));
            }
        }
        Ok(largest.1)
    }

    /// Returns the factor by which a live simplex is larger than it may be, 0 where no size is
    /// asked for or doubles are too coarse for a point in it.
    pub(in crate::netmesh) fn excess(&mut self, simplex: SimplexId) -> Result<f64> {
        if self.sizes.is_none() || self.state.refine_list.is_limited(simplex) {
            return Ok(0.0);
        }
        let max_edge = self.state.max_edge_of_region(simplex)?;
        match &mut self.sizes {
            Some(sizes) => sizes.excess(&self.state.delaunay, simplex, max_edge),
            None => Ok(0.0),
        }
    }

    /// Inserts a point into the D-ball of `simplex`, or makes it precision-limited: also where all
    /// that could be done for it is kept.
    fn destroy(&mut self, simplex: SimplexId, cavity: &mut Cavity) -> Result<()> {
        let before = self.state.delaunay.simplices_created();
        self.insert_within(simplex, cavity)?;
        if self.state.delaunay.simplices_created() == before {
            self.state.refine_list.limit(simplex);
        }
        Ok(())
    }

    fn insert_within(&mut self, simplex: SimplexId, cavity: &mut Cavity) -> Result<()> {
        match self.state.is_well_inside(simplex, ROOT) {
            true => self.insert_corner(simplex, cavity),
            false => self.narrow_cage_gap(simplex, ROOT, Purpose::Size, cavity),
        }
    }
}
