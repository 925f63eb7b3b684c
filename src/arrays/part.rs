//! The source of all arrays: a result, or some of its simplices.

use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::collected;
use crate::mesh::{NONE, Triangulation};
use crate::query::check_arrays;

/// Some or all of the simplices of a result.
#[derive(Clone, Debug)]
pub struct Part<'a> {
    pub(super) mesh: &'a Triangulation,
    pub(super) chosen: Option<Chosen>,
}

/// Simplices that a part consists of.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    /// Ids of the simplices, ascending.
    pub ids: Vec<u32>,
    /// Simplex of the mesh -> true if it belongs to the part.
    pub is_chosen: Vec<bool>,
}

impl<'a> Part<'a> {
    /// Returns the part that has all simplices of a mesh.
    ///
    /// # Errors
    /// `InvalidArgument`: arrays that do not fit together, or ids out of range.
    pub fn whole(mesh: &'a Triangulation) -> Result<Self> {
        check_arrays(mesh)?;
        Ok(Self { mesh, chosen: None })
    }

    /// Returns the part that has the simplices for which `is_chosen` is true; there is one value
    /// for each simplex of the mesh.
    ///
    /// # Errors
    /// `InvalidArgument` (another number of values; arrays that do not fit together),
    /// `OutOfMemory`.
    pub fn of_chosen(mesh: &'a Triangulation, is_chosen: Vec<bool>) -> Result<Self> {
        check_arrays(mesh)?;
        let (count, simplices) = (is_chosen.len(), mesh.simplex_count());
        if count != simplices {
            let message = message!("is_chosen has length {count}; there are {simplices} simplices");
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let of_chosen = (0u32..).zip(&is_chosen).filter(|(_, is_chosen)| **is_chosen);
        let ids = collected(of_chosen.map(|(simplex, _)| simplex))?;
        Ok(Self { mesh, chosen: Some(Chosen { ids, is_chosen }) })
    }

    /// Returns the number of simplices of the part.
    pub fn simplex_count(&self) -> usize {
        self.chosen.as_ref().map_or(self.mesh.simplex_count(), |chosen| chosen.ids.len())
    }

    /// Returns the ids of the part's simplices, ascending.
    pub fn simplices(&self) -> impl ExactSizeIterator<Item = u32> + Clone + '_ {
        let chosen = self.chosen.as_ref();
        let id = move |at| chosen.map_or(at as u32, |chosen| chosen.ids[at]);
        (0..self.simplex_count()).map(id)
    }

    /// Returns the neighbour across facet `i` of a simplex; [`NONE`] at the hull of the mesh, and
    /// if the neighbour is not in the part.
    pub(super) fn neighbor(&self, simplex: u32, i: usize) -> u32 {
        let neighbor = self.mesh.neighbors_of(simplex as usize)[i];
        match &self.chosen {
            Some(chosen) if neighbor != NONE && !chosen.is_chosen[neighbor as usize] => NONE,
            _ => neighbor,
        }
    }
}
