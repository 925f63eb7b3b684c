//! A part of a complex as a complex of its own, which is changed apart from the rest and joins it again.

use super::{Complex, INFINITE};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow, collected};
use crate::mesh::NONE;

/// What the simplices and vertices of a part are called in the whole, by their ids in the part.
#[derive(Default)]
pub(crate) struct Names {
    pub simplices: Array<u32>,
    pub vertices: Array<u32>,
}

/// The way back, for the part that is being cut out: simplex or vertex of the whole -> its id in the
/// part, [`NONE`] if it is not there. One serves for all parts, one after the other.
pub(crate) struct Ids {
    pub simplices: Array<u32>,
    pub vertices: Array<u32>,
}

impl Ids {
    pub fn new(simplices: usize, vertices: usize) -> Result<Self> {
        Ok(Self {
            simplices: Array::filled(simplices, NONE)?,
            vertices: Array::filled(vertices, NONE)?,
        })
    }

    /// Gives ids to the named simplices, in their order, and to the vertices named so far.
    pub fn give(&mut self, names: &Names) {
        for (own, &simplex) in names.simplices.iter().enumerate() {
            self.simplices[simplex as usize] = own as u32;
        }
        for (own, &vertex) in names.vertices.iter().enumerate() {
            self.vertices[vertex as usize] = own as u32;
        }
    }

    /// Takes them back.
    pub fn take(&mut self, names: &Names) {
        names.simplices.iter().for_each(|&simplex| self.simplices[simplex as usize] = NONE);
        names.vertices.iter().for_each(|&vertex| self.vertices[vertex as usize] = NONE);
    }
}

impl<const D: usize> Complex<D> {
    /// The live simplices that `names` names as a complex of their own; `ids` knows them, and gets to
    /// know their vertices, as does `names`. Where the whole goes on beyond a facet, the simplex is its
    /// own neighbour: a search does not leave the part. `tick` is called for every simplex.
    pub fn part(
        &self,
        names: &mut Names,
        ids: &mut Ids,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<Self> {
        let mut part = Self::new(names.vertices.len())?;
        part.records.make_room(names.simplices.len() * Self::RECORD)?;
        for (own, &simplex) in names.simplices.iter().enumerate() {
            tick()?;
            for &vertex in self.vertices(simplex) {
                if vertex == INFINITE {
                    part.records.try_push(INFINITE)?;
                    continue;
                }
                let id = &mut ids.vertices[vertex as usize];
                if *id == NONE {
                    *id = part.add_vertex()?;
                    names.vertices.try_push(vertex)?;
                }
                part.incident[*id as usize] = own as u32;
                part.records.try_push(*id)?;
            }
            for &neighbor in self.neighbors(simplex) {
                part.records.try_push(match ids.simplices[neighbor as usize] {
                    NONE => own as u32,
                    id => id,
                })?;
            }
            part.records.try_push(0)?;
        }
        Ok(part)
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
    pub fn lend(&mut self, rooms: &[usize]) -> Option<Vec<Array<u32>>> {
        let rooms = collected(rooms.iter().map(|room| room * Self::RECORD)).ok()?;
        self.records.lend(&rooms)
    }

    /// See [`Records::is_rim`](super::Records::is_rim).
    pub fn is_rim(&self, simplex: u32, index: usize) -> bool {
        self.records().is_rim(simplex, index)
    }

    /// Appends the simplices of `part`, dead ones too, under new ids, which `names` knows afterwards; it
    /// knows the new vertices already. At the rim they are their own neighbours until all parts have
    /// joined ([`Self::replace_joined`]), and those that they were made from stay until then.
    pub fn join(
        &mut self,
        part: Self,
        names: &mut Names,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<()> {
        let base = self.simplex_bound() as u32;
        let count = part.simplex_bound();
        if count > self.id_limit.saturating_sub(base as usize) {
            return Err(AllocError::Ids.into());
        }
        self.records.absorb(part.records)?;
        for &simplex in &part.free {
            self.free.try_push(base + simplex)?;
        }
        names.simplices = Array::with_room(count)?;
        for name in base..base + count as u32 {
            tick()?;
            names.simplices.try_push(name)?;
            *self.mark_mut(name) = 0;
            if !self.is_live(name) {
                continue;
            }
            for index in 0..Self::CORNERS {
                self.neighbors_mut(name)[index] += base;
                let vertex = &mut self.vertices_mut(name)[index];
                if *vertex != INFINITE {
                    *vertex = names.vertices[*vertex as usize];
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
            for index in 0..Self::CORNERS {
                if name != NONE && self.is_live(name) && self.is_rim(name, index) {
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
