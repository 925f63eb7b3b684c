//! A vertex goes into sheets, and these become Delaunay triangulations of their planes again, by
//! flips (C. L. Lawson, "Software for C1 surface interpolation", 1977). Edges that are subsegments
//! stay.

use crate::complex::VertexId;
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::NONE;
use crate::netmesh::questions::subfacets::OnSheet;
use crate::netmesh::state::{Mesher, State};

/// An edge is flipped where the sine of [`diagonal`](State::diagonal) is below minus this: what
/// roundings make of it for four vertices on a circle is far less.
const ROUNDING: f64 = 1e-13;

impl Mesher<'_, '_, 3> {
    /// Flips edges until all sheets are Delaunay, notes how small their subfacets are, and queues
    /// all of these.
    pub(in crate::netmesh) fn make_sheets_delaunay(&mut self) -> Result<()> {
        let Self { state, watch, .. } = self;
        let mut waiting = collected(0..state.facets.len() as u32)?;
        while let Some(subfacet) = waiting.pop() {
            watch.poll_after(2)?;
            let flips = (0..3).find(|&edge| state.flips(subfacet, edge));
            if let Some(edge) = flips {
                waiting.try_extend(&state.facets.flip(subfacet, edge)?)?;
            }
        }
        for subfacet in 0..state.facets.len() as u32 {
            watch.poll_after(2)?;
            let (_, radius) = state.circle_of(subfacet);
            state.facets.note_first_radius(subfacet, radius);
            state.facets.wait(subfacet, radius)?;
        }
        Ok(())
    }
}

impl State<3> {
    /// Returns true if an edge is an inner one that must be flipped.
    fn flips(&self, subfacet: u32, edge: usize) -> bool {
        if self.facets.get(subfacet).subsegments[edge] != NONE {
            return false;
        }
        let (sine, is_convex) = self.diagonal(subfacet, edge);
        is_convex && sine < -ROUNDING && !self.would_repeat(subfacet, edge)
    }

    /// Queues a subfacet to be looked for in the mesh.
    pub(in crate::netmesh) fn queue_subfacet(&mut self, subfacet: u32) -> AllocResult<()> {
        let (_, radius) = self.circle_of(subfacet);
        self.facets.wait(subfacet, radius)
    }

    /// Puts `vertex` into the sheet of a subfacet near it. Returns false, and changes nothing, if
    /// it is beyond a subsegment.
    pub(in crate::netmesh) fn put_in_sheet(
        &mut self,
        near: u32,
        vertex: VertexId,
    ) -> AllocResult<bool> {
        let x = *self.delaunay.point(vertex);
        let mut made = std::mem::take(&mut self.facets.found);
        made.clear();
        let is_in = match self.walk_in_sheet(near, &x) {
            OnSheet::Beyond(_) => false,
            OnSheet::At { subfacet, edge: None } => {
                made.try_extend(&self.facets.split_inside(subfacet, vertex)?)?;
                true
            }
            OnSheet::At { subfacet, edge: Some(edge) } => {
                made.try_extend(&self.facets.split_inner_edge(subfacet, edge, vertex)?)?;
                true
            }
        };
        let kept = self.flip_around(&mut made);
        self.facets.found = made;
        kept.map(|()| is_in)
    }

    /// Splits `subsegment` at `vertex` in all facets that meet there. `second` is its part behind
    /// the vertex.
    pub(in crate::netmesh) fn split_in_sheets(
        &mut self,
        subsegment: u32,
        second: u32,
        vertex: VertexId,
    ) -> AllocResult<()> {
        let [start, _] = self.segments.chains.get(subsegment).ends;
        let [_, end] = self.segments.chains.get(second).ends;
        let mut made = std::mem::take(&mut self.facets.found);
        made.clear();
        self.facets.split_pages(subsegment, second, [start, end], vertex, &mut made)?;
        let kept = self.flip_around(&mut made);
        self.facets.found = made;
        kept
    }

    /// Flips edges around a vertex that has gone into sheets until these are Delaunay. `made` has
    /// the subfacets around it, each with the vertex as its number 0.
    fn flip_around(&mut self, made: &mut Vec<u32>) -> AllocResult<()> {
        let mut next = 0;
        while next < made.len() {
            let subfacet = made[next];
            if self.flips(subfacet, 0) {
                let [_, other] = self.facets.flip(subfacet, 0)?;
                made.try_push(other)?;
            } else {
                next += 1;
            }
        }
        made.iter().try_for_each(|&subfacet| self.queue_subfacet(subfacet))
    }
}
