//! A partition of a complex is a complex of its own, which is changed apart from the rest and then
//! joins it again.

use super::{Complex, INFINITE};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, collected};
use crate::mesh::NONE;

/// The global ids of the simplices and vertices of a partition, by their local ids.
#[derive(Default)]
pub(crate) struct LocalToGlobal {
    pub simplices: Array<u32>,
    pub vertices: Array<u32>,
}

/// The local ids in the partition that is being cut out, by global ids: simplex or vertex of the
/// global mesh -> its id in the partition, [`NONE`] if it is not there. One serves for all
/// partitions, one after the other.
pub(crate) struct GlobalToLocal {
    pub simplices: Array<u32>,
    pub vertices: Array<u32>,
}

impl GlobalToLocal {
    pub fn new(simplices: usize, vertices: usize) -> Result<Self> {
        Ok(Self {
            simplices: Array::filled(simplices, NONE)?,
            vertices: Array::filled(vertices, NONE)?,
        })
    }

    /// Numbers the simplices of a partition in their order, and the vertices that it has so far.
    pub fn give(&mut self, local_to_global: &LocalToGlobal) {
        for (own, &simplex) in local_to_global.simplices.iter().enumerate() {
            self.simplices[simplex as usize] = own as u32;
        }
        for (own, &vertex) in local_to_global.vertices.iter().enumerate() {
            self.vertices[vertex as usize] = own as u32;
        }
    }

    /// Forgets the numbers of a partition.
    pub fn take(&mut self, local_to_global: &LocalToGlobal) {
        local_to_global
            .simplices
            .iter()
            .for_each(|&simplex| self.simplices[simplex as usize] = NONE);
        local_to_global.vertices.iter().for_each(|&vertex| self.vertices[vertex as usize] = NONE);
    }
}

impl<const D: usize> Complex<D> {
    /// The live simplices of `local_to_global` as a complex of their own. `ids` has their numbers;
    /// vertices are added to both. Where the global mesh continues beyond a facet, the simplex is
    /// its own neighbour, so that no search leaves the partition. `tick` is called for every
    /// simplex.
    pub fn partition(
        &self,
        local_to_global: &mut LocalToGlobal,
        ids: &mut GlobalToLocal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let mut partition = Self::new(local_to_global.vertices.len())?;
        partition.records.make_room(local_to_global.simplices.len() * Self::RECORD)?;
        for (own, &simplex) in local_to_global.simplices.iter().enumerate() {
            tick()?;
            for &vertex in self.vertices(simplex) {
                if vertex == INFINITE {
                    partition.records.try_push(INFINITE)?;
                    continue;
                }
                let id = &mut ids.vertices[vertex as usize];
                if *id == NONE {
                    *id = partition.add_vertex()?;
                    local_to_global.vertices.try_push(vertex)?;
                }
                partition.incident[*id as usize] = own as u32;
                partition.records.try_push(*id)?;
            }
            for &neighbor in self.neighbors(simplex) {
                partition.records.try_push(match ids.simplices[neighbor as usize] {
                    NONE => own as u32,
                    id => id,
                })?;
            }
            partition.records.try_push(0)?;
        }
        Ok(partition)
    }

    /// The number of simplices that the spare memory has room for.
    pub fn spare_simplices(&self) -> usize {
        self.records.spare() / Self::RECORD
    }

    /// Moves to `reserve`, which is empty.
    pub fn move_to(&mut self, reserve: Array<u32>) -> AllocResult<()> {
        self.records.move_into(reserve)
    }

    /// Splits the spare memory: `reserves` has the number of simplices for each share. `None` if it
    /// is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize]) -> Option<Vec<Array<u32>>> {
        let reserves = collected(reserves.iter().map(|reserve| reserve * Self::RECORD)).ok()?;
        self.records.split_reserve(&reserves)
    }

    /// See [`Records::is_interface`](super::Records::is_interface).
    pub fn is_interface(&self, simplex: u32, index: usize) -> bool {
        self.records().is_interface(simplex, index)
    }

    /// Appends the simplices of `partition`, dead ones too, under new ids, which `local_to_global`
    /// has afterwards; it has the new vertices already. At the interface simplices are their own
    /// neighbours until all partitions have joined ([`Self::replace_joined`]). The simplices that
    /// the partition was cut from stay until then.
    pub fn join(
        &mut self,
        partition: Self,
        local_to_global: &mut LocalToGlobal,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        let base = self.simplex_bound() as u32;
        let count = partition.simplex_bound();
        if count > self.id_limit.saturating_sub(base as usize) {
            return Err(AllocError::Ids.into());
        }
        self.records.absorb(partition.records)?;
        for &simplex in &partition.free {
            self.free.try_push(base + simplex)?;
        }
        local_to_global.simplices = Array::with_room(count)?;
        for name in base..base + count as u32 {
            tick()?;
            local_to_global.simplices.try_push(name)?;
            *self.mark_mut(name) = 0;
            if !self.is_live(name) {
                continue;
            }
            for index in 0..Self::VERTICES {
                self.neighbors_mut(name)[index] += base;
                let vertex = &mut self.vertices_mut(name)[index];
                if *vertex != INFINITE {
                    *vertex = local_to_global.vertices[*vertex as usize];
                    let vertex = *vertex;
                    self.incident[vertex as usize] = name;
                }
            }
        }
        Ok(())
    }

    /// Called when all partitions have joined. `moved`: simplex that became one of a partition ->
    /// its new id. Links partitions at their interfaces, and releases the simplices that they were
    /// cut from.
    pub fn replace_joined(
        &mut self,
        moved: &[u32],
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        for (simplex, &name) in moved.iter().enumerate() {
            tick()?;
            for index in 0..Self::VERTICES {
                if name != NONE && self.is_live(name) && self.is_interface(name, index) {
                    let neighbor = self.neighbors(simplex as u32)[index];
                    self.neighbors_mut(name)[index] = moved[neighbor as usize];
                }
            }
        }
        for (simplex, &name) in moved.iter().enumerate() {
            tick()?;
            if name != NONE {
                self.neighbors_mut(simplex as u32)[0] = NONE;
                self.free.try_push(simplex as u32)?;
            }
        }
        Ok(())
    }
}
