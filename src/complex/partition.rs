//! A part of a complex as a complex of its own, which is changed apart from the rest and joins it again.

use super::{Complex, INFINITE};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, collected};
use crate::mesh::NONE;

/// What the simplices and vertices of a part are called in the whole, by their ids in the part.
#[derive(Default)]
pub(crate) struct LocalToGlobal {
    pub simplices: Array<u32>,
    pub vertices: Array<u32>,
}

/// The way back, for the part that is being cut out: simplex or vertex of the whole -> its id in the
/// part, [`NONE`] if it is not there. One serves for all parts, one after the other.
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

    /// Gives ids to the named simplices, in their order, and to the vertices named so far.
    pub fn give(&mut self, local_to_global: &LocalToGlobal) {
        for (own, &simplex) in local_to_global.simplices.iter().enumerate() {
            self.simplices[simplex as usize] = own as u32;
        }
        for (own, &vertex) in local_to_global.vertices.iter().enumerate() {
            self.vertices[vertex as usize] = own as u32;
        }
    }

    /// Takes them back.
    pub fn take(&mut self, local_to_global: &LocalToGlobal) {
        local_to_global
            .simplices
            .iter()
            .for_each(|&simplex| self.simplices[simplex as usize] = NONE);
        local_to_global.vertices.iter().for_each(|&vertex| self.vertices[vertex as usize] = NONE);
    }
}

impl<const D: usize> Complex<D> {
    /// The live simplices that `names` names as a complex of their own; `ids` knows them, and gets to
    /// know their vertices, as does `names`. Where the whole goes on beyond a facet, the simplex is its
    /// own neighbour: a search does not leave the part. `tick` is called for every simplex.
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

    /// Simplices that there is room for.
    pub fn spare_simplices(&self) -> usize {
        self.records.spare() / Self::RECORD
    }

    /// Goes on in `room`, which is empty.
    pub fn move_to(&mut self, room: Array<u32>) -> AllocResult<()> {
        self.records.move_into(room)
    }

    /// Divides the spare room for simplices, so many for each; `None` if it is not enough.
    pub fn split_reserve(&mut self, reserves: &[usize]) -> Option<Vec<Array<u32>>> {
        let reserves = collected(reserves.iter().map(|room| room * Self::RECORD)).ok()?;
        self.records.split_reserve(&reserves)
    }

    /// See [`Records::is_rim`](super::Records::is_rim).
    pub fn is_interface(&self, simplex: u32, index: usize) -> bool {
        self.records().is_interface(simplex, index)
    }

    /// Appends the simplices of `part`, dead ones too, under new ids, which `names` knows afterwards; it
    /// knows the new vertices already. At the rim they are their own neighbours until all parts have
    /// joined ([`Self::replace_joined`]), and those that they were made from stay until then.
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

    /// When the parts of the first simplices have joined, `moved` to new ids (simplex -> its new id):
    /// links parts at their rims, and lets go of the first ones.
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
