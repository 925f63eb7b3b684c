//! Preparation of the places where the mesh is cut. A partition defers every input next to a
//! simplex at its interface, and the simplices of the coarse mesh are large. So the inputs at the
//! interfaces go in before the mesh is cut, until the simplices there are as small as they get.

use crate::complex::{Anchored, SimplexId, VertexId};
use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::{AllocResult, Array, TryGrow, collected, with_capacity};
use crate::netmesh::state::workers::{on_threads, pieces};
use crate::netmesh::state::{Mesher, State};

/// The rounds of a tile end when one inserts no more than one input of this number.
pub(super) const FEW: usize = 32;

impl<const D: usize> State<D> {
    /// Returns the inputs at which partitions begin, except the first one. Partitions have equal
    /// numbers of inputs. A simplex belongs to the partition of its anchor.
    pub(super) fn interfaces(&self, count: usize) -> AllocResult<Vec<VertexId>> {
        let first = |partition| VertexId::new(partition * self.inputs / count);
        collected((1..count).map(first))
    }

    /// Returns true if `simplex`, or a neighbour of it, has neighbours in several partitions.
    fn is_at_interface(&self, simplex: SimplexId, interfaces: &[VertexId]) -> bool {
        let neighbors =
            |simplex: SimplexId| self.delaunay.complex().neighbors(simplex).iter().copied();
        let near = neighbors(simplex).flat_map(neighbors);
        let mut partitions = near.filter_map(|other| self.partition_of(other, interfaces));
        let first = partitions.next();
        partitions.any(|partition| Some(partition) != first)
    }

    /// Returns the number of the partition that a simplex is in, if it has an input.
    fn partition_of(&self, simplex: SimplexId, interfaces: &[VertexId]) -> Option<usize> {
        let vertices = self.delaunay.complex().vertices(simplex).iter().copied();
        let anchor = vertices.filter(|&vertex| vertex.index() < self.inputs).min()?;
        Some(interfaces.partition_point(|&interface| interface <= anchor))
    }
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Returns all simplices in an order of locality, a run for each partition.
    pub(in crate::netmesh) fn between(
        &mut self,
        interfaces: &[VertexId],
    ) -> Result<Vec<Array<SimplexId>>> {
        let anchored = self.anchored()?;
        let mut runs = with_capacity(interfaces.len() + 1)?;
        let mut begin = 0;
        let ends = interfaces.iter().map(|interface| interface.index());
        for end in ends.chain([self.state.inputs]) {
            let mut run = Array::new();
            for anchor in VertexId::range(begin..end) {
                self.watch.poll_after(1)?;
                run.try_extend(anchored.of(anchor))?;
            }
            if !run.is_empty() {
                runs.push(run);
            }
            begin = end;
        }
        Ok(runs)
    }

    fn anchored(&mut self) -> Result<Anchored> {
        let watch = &mut self.watch;
        self.state.delaunay.complex().order_by_anchor(self.state.inputs, || watch.poll_after(1))
    }

    /// Inserts the inputs of simplices at interfaces, pass by pass.
    pub(super) fn insert_at_interfaces(
        &mut self,
        interfaces: &[VertexId],
        cavity: &mut Cavity,
    ) -> Result<()> {
        let begun = self.state.conflict_lists.remaining();
        loop {
            let before = self.state.conflict_lists.remaining();
            let lists = self.lists_at(interfaces)?;
            self.insert_pass(0, 0, &lists, cavity)?;
            let after = self.state.conflict_lists.remaining();
            if before - after <= (begun - after) / FEW {
                return Ok(());
            }
        }
    }

    /// Returns the simplices at interfaces that have inputs, in rising order.
    fn lists_at(&mut self, interfaces: &[VertexId]) -> Result<Vec<SimplexId>> {
        let threads = self.state.threads();
        let Self { state, watch, .. } = self;
        let state = &*state;
        let has_inputs = |&simplex: &SimplexId| state.conflict_lists.count(simplex) > 0;
        let is_at_interface = |&simplex: &SimplexId| state.is_at_interface(simplex, interfaces);
        let bound = state.delaunay.complex().simplex_bound();
        let lists = on_threads(threads, watch, pieces(bound), |piece| {
            collected(piece.filter(has_inputs).filter(is_at_interface))
        })?;
        Ok(collected(lists.into_iter().flatten())?)
    }
}
