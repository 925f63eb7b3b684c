//! Examination: simplices that an insertion or a release changed are tested, and the bad ones are
//! put on REFINELIST (§6.4).

use crate::complex::{SimplexId, VertexId};
use crate::memory::AllocResult;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Cell, Mesher, Scratch, State};
use crate::options::Criterion;

impl<const D: usize> Mesher<'_, '_, D> {
    /// Queues the bad ones among the simplices just created, and tells their vertices of the
    /// corners that have come. `in_same_domain`: whether all vertices are ([`same_domain`]).
    ///
    /// [`same_domain`]: crate::netmesh::state::hierarchy::Hierarchy::same_domain
    pub(super) fn examine_created(&mut self, in_same_domain: bool) -> AllocResult<()> {
        let measure = self.state.measure();
        let State { delaunay, hierarchy, cells, .. } = &mut self.state;
        let cells: &mut [Cell] = cells;
        let Scratch { created, suspects, .. } = &mut self.scratch;
        suspects.clear();
        suspects.reserve(created.len())?;
        for &simplex in created.iter() {
            let Some(radius) = delaunay.radius(simplex) else { continue };
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
            self.state.examine_suspect(self.scratch.suspects[at])?;
        }
        Ok(())
    }

    /// Queues the bad ones among the simplices at `vertex`.
    pub(in crate::netmesh) fn examine_star(&mut self, vertex: VertexId) -> AllocResult<()> {
        self.examine_corners(vertex, |mesher, simplex, _| mesher.state.examine(simplex))
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
            let Some(radius) = self.state.delaunay.radius(simplex) else {
                continue;
            };
            farthest = farthest.max(radius);
            examine(self, simplex, radius)?;
        }
        self.state.cells[vertex].farthest = farthest;
        Ok(())
    }

    /// Queues the simplices that make the cell of `vertex` bad, after its nearest distance fell.
    /// The lengths of the edges there are what they were, and so is all that other cells depend on.
    /// The cell of a cage's vertex has no bound of its own.
    pub(super) fn examine_cell(&mut self, vertex: VertexId) -> AllocResult<()> {
        let Cell { nearest, farthest } = self.state.cells[vertex];
        if self.state.parameters.criterion == Criterion::RadiusEdge
            || nearest >= self.state.nearest_allowed(farthest)
            || self.state.hierarchy.cage_of(vertex).is_valid()
        {
            return Ok(());
        }
        let is_bad_open = self.state.is_bad_open();
        self.examine_corners(vertex, |mesher, simplex, radius| {
            if nearest >= mesher.state.nearest_allowed(radius) {
                Ok(())
            } else if is_bad_open && !mesher.state.refine_list.is_limited(simplex) {
                mesher.state.queue(simplex)
            } else {
                mesher.state.examine_suspect(simplex)
            }
        })
    }

    /// Queues the simplices that make the union cell of `cage` bad, after its clearance fell: those
    /// at its vertices whose corners are beyond the bound now. All other cells are what they were.
    pub(super) fn examine_union_cell(&mut self, cage: DomainId) -> AllocResult<()> {
        let farthest = self.state.cage_bound(cage);
        for at in 0..self.state.hierarchy.node(cage).cage.len() {
            let vertex = self.state.hierarchy.node(cage).cage[at];
            let distance =
                self.state.hierarchy.distance_to_center(cage, self.state.delaunay.point(vertex));
            let max_distance = farthest - distance;
            if self.state.cells[vertex].farthest > max_distance {
                self.examine_corners(vertex, |mesher, simplex, radius| {
                    match radius > max_distance {
                        true => mesher.state.examine(simplex),
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
}

impl<const D: usize> State<D> {
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
        self.parameters.criterion == Criterion::RadiusEdge
    }

    /// Queues a simplex with an edge that is too short, where that is all that counts.
    fn examine_edges(&mut self, simplex: SimplexId) -> AllocResult<()> {
        let Some(radius) = self.delaunay.radius(simplex) else { return Ok(()) };
        match self.short_edge(simplex, radius) {
            Some((_, _, length)) if !self.refine_list.is_limited(simplex) => {
                self.queue_by(simplex, length)
            }
            _ => Ok(()),
        }
    }

    /// Puts a live simplex on REFINELIST, by the length that its corner is measured against.
    fn queue(&mut self, simplex: SimplexId) -> AllocResult<()> {
        let length = match self.parameters.criterion {
            _ if !self.refine_list.is_sorted() => 0.0,
            Criterion::VoronoiAspect => self.nearest_of(simplex),
            Criterion::RadiusEdge => self.shortest_edge(simplex, f64::INFINITY).2,
        };
        self.queue_by(simplex, length)
    }

    /// Puts a live simplex on REFINELIST by a `length` that is known, unless it is exempt. In space
    /// most of those that an insertion makes are gone before their turn comes; of these only
    /// CLEAN asks whether they are forced, which takes long.
    fn queue_by(&mut self, simplex: SimplexId, length: f64) -> AllocResult<()> {
        let is_exempt = match self.as_space() {
            Some(_) => self.is_known_outside(simplex),
            None => self.is_exempt(simplex),
        };
        match is_exempt {
            true => Ok(()),
            false => self.refine_list.push(simplex, length),
        }
    }
}
