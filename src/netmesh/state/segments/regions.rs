//! Regions: the parts of the plane or of space that walls separate, as sets of simplices. They are
//! found when all of the boundary is recovered. Then a simplex belongs to what its predecessors
//! belonged to, for the cavity of a point that crosses no wall is on one side of all of them. Where
//! a point crossed some, what is on either side of a wall tells, once they are recovered again.

use crate::complex::{Complex, SimplexId};
use crate::delaunay::{Cavity, Delaunay};
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, Array, TryGrow};
use crate::netmesh::state::segments::walls::Walls;

/// Number of a watch's units of work for one simplex.
const WORK: u32 = 1;

/// No region is known.
const UNKNOWN: u32 = u32::MAX;

/// Region 0 is what is outside of all segments.
pub(in crate::netmesh) const OUTSIDE: u32 = 0;

#[derive(Default)]
pub(in crate::netmesh) struct Regions {
    /// Simplex -> its region; stale for a dead one. Empty while there are no regions.
    of: Array<u32>,
    /// Wall -> the regions on its left and on its right, or before it and behind.
    pub sides: Vec<[u32; 2]>,
    /// Region -> true if it belongs to the domain, and so is refined.
    pub is_inside: Vec<bool>,
    /// Region -> the caller's number for its simplices.
    pub labels: Vec<i32>,
    /// Region -> the longest edge that it may have.
    pub max_edges: Vec<f64>,
    /// The regions of the simplices to come.
    coming: Vec<u32>,
}

impl Regions {
    /// Returns true if regions have been found.
    pub fn is_known(&self) -> bool {
        !self.sides.is_empty()
    }

    /// Returns the number of regions.
    pub fn len(&self) -> usize {
        self.is_inside.len()
    }

    /// Returns the region of a live simplex, if it is known.
    #[inline]
    pub fn of(&self, simplex: SimplexId) -> Option<u32> {
        self.of.get(simplex.index()).copied().filter(|&region| region != UNKNOWN)
    }

    /// Finds all regions. All subsegments are recovered. O(simplices). They are numbered from
    /// outside on in the order of their first simplices. `tick` is told of the work, and may end
    /// it.
    pub fn find<const D: usize>(
        &mut self,
        delaunay: &Delaunay<D>,
        walls: Walls<'_>,
        found: &mut Vec<SimplexId>,
        mut tick: impl FnMut(u32) -> Result<()>,
    ) -> Result<()> {
        let complex = delaunay.complex();
        self.of.clear();
        self.of.cover(complex.simplex_bound(), UNKNOWN)?;
        self.is_inside.clear();
        self.sides.clear();
        self.sides.cover(walls.count(D), [UNKNOWN; 2])?;
        // A simplex at infinity comes first: no segment is on the hull, which is that of a cage.
        let is_infinite =
            |&simplex: &SimplexId| complex.is_live(simplex) && complex.is_infinite(simplex);
        let at_infinity = complex.simplices().filter(is_infinite).take(1);
        for first in at_infinity.chain(complex.simplices()) {
            if complex.is_live(first) && self.of[first] == UNKNOWN {
                let region = self.is_inside.len() as u32;
                self.is_inside.try_push(true)?;
                self.spread(first, region, complex, walls, found, &mut tick)?;
            }
        }
        Ok(())
    }

    /// Gives all simplices the region that are connected with `first` and have none. `tick` is told
    /// of the work, and may end it.
    fn spread<const D: usize, E: From<AllocError>>(
        &mut self,
        first: SimplexId,
        region: u32,
        complex: &Complex<D>,
        walls: Walls<'_>,
        found: &mut Vec<SimplexId>,
        mut tick: impl FnMut(u32) -> std::result::Result<(), E>,
    ) -> std::result::Result<(), E> {
        self.of[first] = region;
        found.clear();
        found.try_push(first)?;
        while let Some(simplex) = found.pop() {
            tick(WORK)?;
            let (vertices, neighbors) = (complex.vertices(simplex), complex.neighbors(simplex));
            let sides = walls.of(vertices);
            for (index, &beyond) in neighbors.iter().enumerate() {
                if let Some((wall, side)) = sides[index] {
                    self.sides[wall as usize][side] = region;
                } else if self.of[beyond] == UNKNOWN {
                    self.of[beyond] = region;
                    found.try_push(beyond)?;
                }
            }
        }
        Ok(())
    }

    /// Returns the region of a live simplex. All subsegments are recovered. Where it was not known,
    /// all simplices that are connected with it get to know it.
    pub fn resolve<const D: usize>(
        &mut self,
        simplex: SimplexId,
        complex: &Complex<D>,
        walls: Walls<'_>,
        found: &mut Vec<SimplexId>,
    ) -> AllocResult<u32> {
        if let Some(region) = self.of(simplex) {
            return Ok(region);
        }
        self.of.cover(complex.simplex_bound(), UNKNOWN)?;
        found.clear();
        found.try_push(simplex)?;
        let mut region = UNKNOWN;
        // The search ends where it comes to know the region; `spread` goes all the way.
        let mut next = 0;
        while region == UNKNOWN && next < found.len() {
            let current = found[next];
            next += 1;
            let vertices = complex.vertices(current);
            let sides = walls.of(vertices);
            for (index, &beyond) in complex.neighbors(current).iter().enumerate() {
                region = match sides[index] {
                    Some((wall, side)) => self.sides[wall as usize][side],
                    None => self.of[beyond],
                };
                if region != UNKNOWN {
                    break;
                }
                if !found.contains(&beyond) {
                    found.try_push(beyond)?;
                }
            }
        }
        debug_assert!(region != UNKNOWN, "a region has a wall or a simplex that is known");
        self.spread(simplex, region, complex, walls, found, |_| AllocResult::Ok(()))?;
        Ok(region)
    }

    /// Notes that a vertex goes in, whose conflicts are `cavity`. `is_split`: true if it encroaches
    /// subsegments that are recovered, so that new simplices may lie on both sides of one.
    pub fn note_insertion(&mut self, cavity: &Cavity, is_split: bool) -> AllocResult<()> {
        self.coming.clear();
        if !self.is_known() {
            return Ok(());
        }
        for facet in cavity.boundary.iter() {
            let region = if is_split { None } else { self.of(facet.simplex) };
            self.coming.try_push(region.unwrap_or(UNKNOWN))?;
        }
        Ok(())
    }

    /// Gives the simplices that an insertion made their regions. `created[i]` is the simplex on
    /// facet i of the cavity's boundary.
    pub fn note_created(&mut self, created: &[SimplexId], bound: usize) -> AllocResult<()> {
        if !self.is_known() {
            return Ok(());
        }
        self.of.cover(bound, UNKNOWN)?;
        for (&simplex, &region) in created.iter().zip(&self.coming) {
            self.of[simplex] = region;
        }
        Ok(())
    }

    /// Notes that a vertex with this star is removed; the simplices that will fill the hole are in
    /// the same region.
    pub fn note_removal(&mut self, star: &[SimplexId]) {
        self.coming.clear();
        if let (true, Some(&first)) = (self.is_known(), star.first()) {
            let region = self.of(first);
            let is_same = star.iter().all(|&simplex| self.of(simplex) == region);
            self.coming.push(region.filter(|_| is_same).unwrap_or(UNKNOWN));
        }
    }

    /// Gives the simplices that fill a hole their region.
    pub fn note_filled(&mut self, filled: &[SimplexId], bound: usize) -> AllocResult<()> {
        let Some(&region) = self.coming.first() else { return Ok(()) };
        self.of.cover(bound, UNKNOWN)?;
        filled.iter().for_each(|&simplex| self.of[simplex] = region);
        Ok(())
    }
}
