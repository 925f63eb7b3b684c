//! Partitions of a complex: each is a complex of its own, which is changed apart from the rest and
//! then joined with it again.

use super::{Complex, SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, collected};

/// Global ids of the simplices and vertices of a partition, by their local ids.
#[derive(Default)]
pub(crate) struct LocalToGlobal {
    pub simplices: Array<SimplexId>,
    pub vertices: Array<VertexId>,
}

/// Local ids in the partition that is being extracted, by global ids; none for a simplex or vertex
/// that is not in it. One serves for all partitions, one after the other.
pub(crate) struct GlobalToLocal {
    pub simplices: Array<SimplexId>,
    pub vertices: Array<VertexId>,
}

/// Ids of the partition that is being extracted, in both directions.
pub(crate) struct PartitionIds<'a> {
    pub local_to_global: LocalToGlobal,
    pub global_to_local: &'a mut GlobalToLocal,
}

impl GlobalToLocal {
    pub fn new(simplices: usize, vertices: usize) -> Result<Self> {
        Ok(Self {
            simplices: Array::filled(simplices, SimplexId::NONE)?,
            vertices: Array::filled(vertices, VertexId::NONE)?,
        })
    }

    /// Assigns local ids to the simplices of a partition, and to the vertices that it has so far.
    pub fn number(&mut self, local_to_global: LocalToGlobal) -> PartitionIds<'_> {
        for (local, &simplex) in local_to_global.simplices.iter().enumerate() {
            self.simplices[simplex] = SimplexId::new(local);
        }
        for (local, &vertex) in local_to_global.vertices.iter().enumerate() {
            self.vertices[vertex] = VertexId::new(local);
        }
        PartitionIds { local_to_global, global_to_local: self }
    }
}

impl PartitionIds<'_> {
    /// Clears the local ids, so that those of the next partition can be recorded.
    pub fn forget_local(self) -> LocalToGlobal {
        for &simplex in &self.local_to_global.simplices {
            self.global_to_local.simplices[simplex] = SimplexId::NONE;
        }
        for &vertex in &self.local_to_global.vertices {
            self.global_to_local.vertices[vertex] = VertexId::NONE;
        }
        self.local_to_global
    }
}

impl<const D: usize> Complex<D> {
    /// Extracts the live simplices of `ids` as a complex of their own, and adds their other
    /// vertices to `ids`. If the global mesh continues beyond a facet, the simplex is its own
    /// neighbour there, so that no search leaves the partition. `tick` is called for every simplex.
    pub fn partition(
        &self,
        ids: &mut PartitionIds<'_>,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let PartitionIds { local_to_global, global_to_local } = ids;
        let mut partition = Self::new(local_to_global.vertices.len())?;
        partition.records.reserve(local_to_global.simplices.len() * Self::RECORD)?;
        for (local, &simplex) in local_to_global.simplices.iter().enumerate() {
            tick()?;
            let local = SimplexId::new(local);
            for &vertex in self.vertices(simplex) {
                if vertex == VertexId::INFINITE {
                    partition.records.try_push(vertex.number())?;
                    continue;
                }
                let id = &mut global_to_local.vertices[vertex];
                if !id.is_valid() {
                    *id = partition.add_vertex()?;
                    local_to_global.vertices.try_push(vertex)?;
                }
                partition.incident[*id] = local;
                partition.records.try_push(id.number())?;
            }
            for &neighbor in self.neighbors(simplex) {
                let id = global_to_local.simplices[neighbor];
                let id = if id.is_valid() { id } else { local };
                partition.records.try_push(id.number())?;
            }
        }
        Ok(partition)
    }

    /// Returns the number of simplices that fit in the spare memory.
    pub fn spare_simplices(&self) -> usize {
        self.records.spare() / Self::RECORD
    }

    /// Moves the simplices to `reserve`, which must be empty.
    pub fn move_to(&mut self, reserve: Array<u32>) -> AllocResult<()> {
        self.records.move_into(reserve)
    }

    /// Splits the spare memory: `reserves` has the number of simplices of each share. Returns
    /// `None` if there is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize]) -> Option<Vec<Array<u32>>> {
        let reserves = collected(reserves.iter().map(|reserve| reserve * Self::RECORD)).ok()?;
        self.records.split_reserve(&reserves)
    }

    /// Returns true if a facet is on the interface: see
    /// [`Records::is_interface`](super::Records::is_interface).
    pub fn is_interface(&self, simplex: SimplexId, index: usize) -> bool {
        self.records().is_interface(simplex, index)
    }

    /// Appends the simplices of `partition`, dead ones included, under new ids, which
    /// `local_to_global` has afterwards; it must have the new vertices already. At the interface
    /// simplices stay their own neighbours until all partitions have joined
    /// ([`Self::replace_joined`]). The simplices from which the partition was extracted stay until
    /// then.
    pub fn join(
        &mut self,
        partition: Self,
        local_to_global: &mut LocalToGlobal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        let base = self.simplex_bound();
        let count = partition.simplex_bound();
        if count > self.id_limit.saturating_sub(base) {
            return Err(AllocError::Ids.into());
        }
        let moved = |simplex: SimplexId| SimplexId::new(base + simplex.index());
        self.records.absorb(partition.records)?;
        for &simplex in &partition.free {
            self.free.try_push(moved(simplex))?;
        }
        local_to_global.simplices = Array::with_capacity(count)?;
        for simplex in SimplexId::range(base..base + count) {
            tick()?;
            local_to_global.simplices.try_push(simplex)?;
            if !self.is_live(simplex) {
                continue;
            }
            for index in 0..Self::VERTICES {
                let neighbor = &mut self.neighbors_mut(simplex)[index];
                *neighbor = moved(*neighbor);
                let vertex = &mut self.vertices_mut(simplex)[index];
                if *vertex != VertexId::INFINITE {
                    *vertex = local_to_global.vertices[*vertex];
                    let vertex = *vertex;
                    self.incident[vertex] = simplex;
                }
            }
        }
        Ok(())
    }

    /// Links joined partitions at their interfaces, and releases the simplices from which they were
    /// extracted. Called when all partitions have joined. `moved` gives each extracted simplex its
    /// new id.
    pub fn replace_joined(
        &mut self,
        moved: &[SimplexId],
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        for (simplex, &new) in SimplexId::below(moved.len()).zip(moved) {
            tick()?;
            for index in 0..Self::VERTICES {
                if new.is_valid() && self.is_live(new) && self.is_interface(new, index) {
                    let neighbor = self.neighbors(simplex)[index];
                    self.neighbors_mut(new)[index] = moved[neighbor];
                }
            }
        }
        for (simplex, &new) in SimplexId::below(moved.len()).zip(moved) {
            tick()?;
            if new.is_valid() {
                self.neighbors_mut(simplex)[0] = SimplexId::NONE;
                self.free.try_push(simplex)?;
            }
        }
        Ok(())
    }
}
