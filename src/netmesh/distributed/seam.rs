//! The part of its mesh that a partition leaves to the next one: the simplices about its interface,
//! where others have to be seen before it goes on, and those where it could not do what it wanted.
//! The rest is settled. A seam is what the partitions on both sides leave.

use crate::error::Result;
use crate::memory::{TryGrow, collected, filled, with_capacity};
use crate::netmesh::distributed::bisection::Bisection;
use crate::netmesh::distributed::piece::{NamedDomain, Piece};

/// Number of rings that a seam has beyond unsettled simplices, a ring being the simplices with a
/// vertex of those before. A point that goes in at a seam changes cells a few steps away, and never
/// those at its end.
pub const RINGS: usize = 3;

impl<const D: usize> Piece<D> {
    /// Divides the piece in what is settled and the seam that it leaves, if there is one. `wanted`:
    /// the [`Self::wanted_names`] of all pieces, rising.
    pub fn divide(
        self,
        rings: usize,
        wanted: &[u64],
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<(Self, Option<Self>)> {
        let mut is_seam = filled(self.simplex_count(), false)?;
        self.mark_unsettled(&mut is_seam, &mut tick)?;
        self.mark_touching(wanted, &mut is_seam)?;
        self.split_around(is_seam, rings, tick)
    }

    /// Returns the rest of the piece, and the simplices that have a vertex of the given names,
    /// which rise, with the rings around them, if there are any.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn give(self, rings: usize, names: &[u64]) -> Result<(Self, Option<Self>)> {
        let mut is_seam = filled(self.simplex_count(), false)?;
        if !self.mark_touching(names, &mut is_seam)? {
            return Ok((self, None));
        }
        self.split_around(is_seam, rings, || Ok(()))
    }

    fn split_around(
        self,
        mut is_seam: Vec<bool>,
        rings: usize,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<(Self, Option<Self>)> {
        if !is_seam.contains(&true) {
            return Ok((self, None));
        }
        self.widen(&mut is_seam, rings, &mut tick)?;
        let (mut settled, seam) = self.split(is_seam, tick)?;
        settled.wanted.clear();
        Ok((settled, Some(seam)))
    }

    /// Returns the rest of the piece, and the simplices that are taken out, as pieces.
    fn split(
        self,
        mut is_out: Vec<bool>,
        mut tick: impl FnMut() -> Result<()>,
    ) -> Result<(Self, Self)> {
        self.keep_hull_together(&mut is_out);
        let out = self.select(&is_out, &mut tick)?;
        is_out.iter_mut().for_each(|is_out| *is_out = !*is_out);
        Ok((self.select(&is_out, &mut tick)?, out))
    }

    /// Partitions the piece by where `cut` has the middle of each simplex; returns each part with
    /// its number, in rising order.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn partition(mut self, cut: &Bisection<D>) -> Result<Vec<(u32, Self)>> {
        let part_of = self.parts(cut)?;
        for (at, &neighbor) in self.neighbors.iter().enumerate() {
            let simplex = at / Self::PER_SIMPLEX;
            if part_of[simplex] != part_of[neighbor as usize] {
                self.outer.try_push(self.facet(simplex, at % Self::PER_SIMPLEX))?;
            }
        }
        self.outer.sort_unstable();
        self.outer.dedup();
        let mut numbers = collected(part_of.iter().copied())?;
        numbers.sort_unstable();
        numbers.dedup();
        let mut parts = with_capacity(numbers.len())?;
        for number in numbers {
            let is_selected = collected(part_of.iter().map(|&part| part == number))?;
            parts.push((number, self.select(&is_selected, || Ok(()))?));
        }
        Ok(parts)
    }

    /// Returns the names of the centres and cages of domains at which something is left to do. In
    /// rising order.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn wanted_names(&self) -> Result<Vec<u64>> {
        let has_work_left =
            |domain: &&NamedDomain<D>| self.wanted.binary_search(&domain.name).is_ok();
        let wanted = self.domains.iter().filter(has_work_left);
        let mut names = collected(
            wanted.flat_map(|domain| domain.cage.iter().copied().chain([domain.center])),
        )?;
        names.sort_unstable();
        names.dedup();
        Ok(names)
    }

    /// Returns the names of vertices where something is left to do, and [`Self::wanted_names`]. In
    /// rising order.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn unsettled_names(&self) -> Result<Vec<u64>> {
        let mut is_unsettled = filled(self.simplex_count(), false)?;
        self.mark_unsettled(&mut is_unsettled, &mut || Ok(()))?;
        let mut names = self.names_of(&is_unsettled)?;
        names.try_extend(&self.wanted_names()?)?;
        names.sort_unstable();
        names.dedup();
        Ok(names)
    }

    /// Returns the names of the vertices of the simplices that have a vertex of the given names,
    /// which rise. In rising order.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn names_beside(&self, names: &[u64]) -> Result<Vec<u64>> {
        let mut is_touching = filled(self.simplex_count(), false)?;
        match self.mark_touching(names, &mut is_touching)? {
            true => self.names_of(&is_touching),
            false => Ok(Vec::new()),
        }
    }

    /// Marks the simplices that have a vertex of the given names, which rise. Whether there are
    /// any.
    fn mark_touching(&self, names: &[u64], is_marked: &mut [bool]) -> Result<bool> {
        if names.is_empty() {
            return Ok(false);
        }
        let is_named = collected(
            self.vertices.iter().map(|vertex| names.binary_search(&vertex.name).is_ok()),
        )?;
        if !is_named.contains(&true) {
            return Ok(false);
        }
        for (simplex, is_marked) in is_marked.iter_mut().enumerate() {
            let mut vertices = self.vertices_of(simplex).iter();
            *is_marked |= vertices.any(|&vertex| is_named.get(vertex as usize) == Some(&true));
        }
        Ok(true)
    }

    fn names_of(&self, is_in: &[bool]) -> Result<Vec<u64>> {
        let mut is_vertex = filled(self.vertices.len(), false)?;
        for (simplex, _) in is_in.iter().enumerate().filter(|(_, is_in)| **is_in) {
            for &vertex in self.vertices_of(simplex) {
                if let Some(is_vertex) = is_vertex.get_mut(vertex as usize) {
                    *is_vertex = true;
                }
            }
        }
        let own = self.vertices.iter().zip(is_vertex).filter(|(_, is_vertex)| *is_vertex);
        let mut names = collected(own.map(|(vertex, _)| vertex.name))?;
        names.sort_unstable();
        Ok(names)
    }

    /// Returns true if all is done that can be done without other pieces.
    pub fn is_settled(&self) -> Result<bool> {
        let mut is_unsettled = filled(self.simplex_count(), false)?;
        self.mark_unsettled(&mut is_unsettled, &mut || Ok(()))?;
        Ok(self.wanted.is_empty() && !is_unsettled.contains(&true))
    }

    /// Marks the simplices at outer facets, the unsettled ones, and those at inputs that encroach
    /// domains.
    fn mark_unsettled(
        &self,
        is_seam: &mut [bool],
        tick: &mut impl FnMut() -> Result<()>,
    ) -> Result<()> {
        for (simplex, index) in self.interface_facets() {
            tick()?;
            is_seam[simplex] |= self.outer.binary_search(&self.facet(simplex, index)).is_ok();
        }
        for (is_seam, is_unsettled) in is_seam.iter_mut().zip(&self.is_unsettled) {
            *is_seam |= is_unsettled;
        }
        let mut encroaching = collected(self.encroaching.iter().copied())?;
        encroaching.sort_unstable();
        self.mark_touching(&encroaching, is_seam)?;
        Ok(())
    }

    /// Marks all simplices that are at most `rings` steps from a marked one.
    fn widen(
        &self,
        is_seam: &mut [bool],
        rings: usize,
        tick: &mut impl FnMut() -> Result<()>,
    ) -> Result<()> {
        let mut is_near = filled(self.vertices.len(), false)?;
        for _ in 0..rings {
            for simplex in (0..self.simplex_count()).filter(|&simplex| is_seam[simplex]) {
                for &vertex in self.vertices_of(simplex) {
                    if let Some(is_near) = is_near.get_mut(vertex as usize) {
                        *is_near = true;
                    }
                }
            }
            for (simplex, is_seam) in is_seam.iter_mut().enumerate() {
                tick()?;
                let mut vertices = self.vertices_of(simplex).iter();
                *is_seam |= vertices.any(|&vertex| is_near.get(vertex as usize) == Some(&true));
            }
        }
        Ok(())
    }
}
