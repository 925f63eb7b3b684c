//! Away with Steiner vertices that the bound does not need: what stands near a segment was often
//! put there for a triangle that others have mended since.

use crate::complex::{SimplexId, VertexId};
use crate::delaunay::Hole;
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, TryGrow, filled};
use crate::netmesh::segments::ring::Ring;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::{Mesher, State};
use crate::numerics::{Circumball, shortest_distance};

/// Buffers that all removals share.
#[derive(Default)]
struct Buffers {
    hole: Hole<2>,
    filled: Vec<SimplexId>,
}

impl Mesher<'_, '_, 2> {
    /// Removes every Steiner vertex that is on no segment, in no cage and no domain's centre, and
    /// leaves no simplex beyond the bound: the last one first, and once more those next to one that
    /// went. O(vertices) for vertices of few neighbours.
    pub(in crate::netmesh) fn coarsen(&mut self) -> Result<()> {
        let mut buffers = Buffers::default();
        let is_center = self.state.centers()?;
        let is_candidate = |vertex: &VertexId| !is_center[*vertex];
        let mut again = Vec::new();
        let all = self.state.inputs..self.state.delaunay.point_count();
        for vertex in all.rev().map(VertexId::new).filter(is_candidate) {
            self.watch.poll_after(4)?;
            if self.remove_if_needless(vertex, &mut buffers)? {
                // The others' turn comes.
                let seen = buffers.hole.vertices.ids.iter().filter(|&&other| other > vertex);
                again.try_reserve(buffers.hole.vertices.ids.len()).map_err(AllocError::from)?;
                again.extend(seen);
            }
        }
        while let Some(vertex) = again.pop() {
            self.watch.poll_after(4)?;
            if is_candidate(&vertex) && self.remove_if_needless(vertex, &mut buffers)? {
                again.try_extend(&buffers.hole.vertices.ids)?;
            }
        }
        Ok(())
    }

    /// Removes `vertex` if the bound holds without it. Returns true if it went.
    fn remove_if_needless(&mut self, vertex: VertexId, buffers: &mut Buffers) -> Result<bool> {
        let Buffers { hole, filled } = buffers;
        let is_needless = !self.state.is_input(vertex)
            && self.state.is_free(vertex)
            && !self.state.is_surely_needed(vertex)
            && self.state.delaunay.find_hole(vertex, hole)?
            && self.state.is_needless(vertex, hole);
        if is_needless {
            let x = *self.state.delaunay.point(vertex);
            self.state.remove_and_measure(vertex, hole, filled)?;
            self.note_departure(&x, &hole.vertices.ids)?;
        }
        Ok(is_needless)
    }
}

impl State<2> {
    /// Returns, for every vertex, true if it is the centre of a living domain: its cage is found
    /// from there.
    fn centers(&self) -> AllocResult<Vec<bool>> {
        let mut is_center = filled(self.delaunay.point_count(), false)?;
        for domain in (0..self.hierarchy.len()).map(DomainId::new) {
            let node = self.hierarchy.node(domain);
            if node.alive {
                is_center[node.center] = true;
            }
        }
        Ok(is_center)
    }

    /// Returns true if `vertex` is in the mesh, in no cage, and on no segment.
    fn is_free(&self, vertex: VertexId) -> bool {
        self.is_inserted(vertex)
            && !self.hierarchy.cage_of(vertex).is_valid()
            && !self.segments.chains.holds(vertex)
    }

    /// Returns true if doubles tell that some simplex would be beyond the bound without `vertex`.
    fn is_surely_needed(&self, vertex: VertexId) -> bool {
        let ring = Ring::around(&self.delaunay, vertex);
        ring.is_some_and(|ring| ring.has_beyond(self.parameters.quality_bound))
    }

    /// Returns true if all simplices that would fill the hole of `vertex` keep the bound, and its
    /// neighbours are in its domain.
    fn is_needless(&self, vertex: VertexId, hole: &Hole<2>) -> bool {
        let around = &hole.vertices.ids;
        let bound = self.parameters.quality_bound;
        self.hierarchy.same_domain(around)
            && self.hierarchy.same_domain(&[vertex, around[0]])
            && (0..hole.filling.len() as u32).all(|number| {
                let vertices = hole.filling.vertices(number);
                let points: [&[f64; 2]; 3] =
                    std::array::from_fn(|index| self.delaunay.point(vertices[index]));
                let (_, _, shortest) = shortest_distance(&points);
                Circumball::of(|index| points[index]).radius() <= bound * shortest
            })
    }

    /// Removes `vertex`, whose hole is found, and measures what fills that. Its id is not used
    /// again.
    fn remove_and_measure(
        &mut self,
        vertex: VertexId,
        hole: &Hole<2>,
        filled: &mut Vec<SimplexId>,
    ) -> AllocResult<()> {
        self.remove_with_regions(vertex, hole, filled)?;
        let bound = self.delaunay.complex().simplex_bound();
        self.refine_list.forget(filled, bound)?;
        filled.iter().for_each(|&simplex| self.note_corner(simplex));
        Ok(())
    }
}
