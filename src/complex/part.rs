//! A part of a complex as a complex of its own, which is changed apart from the rest and put back.

use super::{Complex, INFINITE};
use crate::memory::{Fallible, TryGrow, with_room};
use crate::mesh::NONE;

/// What the simplices and vertices of a part are called in the whole.
#[derive(Debug, Default)]
pub(crate) struct Names {
    pub simplices: Vec<u32>,
    pub vertices: Vec<u32>,
}

/// An order of simplices, of which any run may become a part.
pub(crate) struct Cuts<'a> {
    pub order: &'a [u32],
    /// Simplex -> where it is in `order`.
    pub places: &'a [u32],
}

impl<const D: usize> Complex<D> {
    /// The simplices `cuts.order[run]`, which must be live, as a complex of their own. Where the whole
    /// goes on, a simplex is its own neighbour there; it must stay. `ids` has [`NONE`] for each vertex
    /// of the whole, then and afterwards.
    pub fn part(
        &self,
        cuts: &Cuts<'_>,
        run: std::ops::Range<usize>,
        ids: &mut [u32],
    ) -> Fallible<(Self, Names)> {
        let mut part = Self::new(0)?;
        part.records = with_room(run.len() * Self::RECORD)?;
        let mut names = Names::default();
        names.simplices.try_extend(&cuts.order[run.clone()])?;
        for (own, &simplex) in names.simplices.iter().enumerate() {
            for &vertex in self.vertices(simplex) {
                let id = match vertex {
                    INFINITE => INFINITE,
                    known if ids[known as usize] != NONE => ids[known as usize],
                    new => {
                        ids[new as usize] = names.vertices.len() as u32;
                        names.vertices.try_push(new)?;
                        part.incident.try_push(own as u32)?;
                        ids[new as usize]
                    }
                };
                part.records.push(id);
            }
            for &neighbor in self.neighbors(simplex) {
                let place = cuts.places[neighbor as usize] as usize;
                let id = if run.contains(&place) { place - run.start } else { own };
                part.records.push(id as u32);
            }
            part.records.push(0);
        }
        names.vertices.iter().for_each(|&vertex| ids[vertex as usize] = NONE);
        Ok((part, names))
    }

    /// Whether the whole goes on beyond a facet of `simplex` of a part.
    pub fn is_at_rim(&self, simplex: u32) -> bool {
        self.neighbors(simplex).contains(&simplex)
    }

    /// Replaces the simplices that became `part` by what that is now. `names` knows its new vertices
    /// already, and knows its new simplices afterwards; those that died have the name [`NONE`].
    pub fn put_back(&mut self, part: &Self, names: &mut Names) -> Fallible<()> {
        let taken = names.simplices.len();
        self.reserve(part.simplex_bound() - taken, taken)?;
        for (own, name) in names.simplices.iter_mut().enumerate() {
            if !part.is_live(own as u32) {
                self.release(*name);
                *name = NONE;
            }
        }
        for own in taken..part.simplex_bound() {
            let name = if part.is_live(own as u32) { self.allocate() } else { NONE };
            names.simplices.try_push(name)?;
        }
        for (own, &name) in names.simplices.iter().enumerate() {
            if name != NONE {
                self.overwrite(name, part, own as u32, names);
            }
        }
        Ok(())
    }

    fn overwrite(&mut self, name: u32, part: &Self, own: u32, names: &Names) {
        for index in 0..Self::CORNERS {
            let vertex = part.vertices(own)[index];
            if vertex != INFINITE {
                let vertex = names.vertices[vertex as usize];
                self.vertices_mut(name)[index] = vertex;
                self.incident[vertex as usize] = name;
            } else {
                self.vertices_mut(name)[index] = INFINITE;
            }
            let neighbor = part.neighbors(own)[index];
            if neighbor != own {
                self.neighbors_mut(name)[index] = names.simplices[neighbor as usize];
            }
        }
    }
}
