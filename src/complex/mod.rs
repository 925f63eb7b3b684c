//! The combinatorial complex: a triangulated sphere, that is a ball whose hull facets are joined to
//! one infinite vertex. Knows vertex ids, simplices and adjacency; sees no coordinate.
//!
//! A simplex is a record of `u32` ids: its vertices, the neighbours opposite them and its mark, which a
//! search wants one after the other and finds in a cache line or two. Dead ones wait in a LIFO list.
//! All simplices are oriented alike: replacing a vertex of one by a point on the same side keeps the
//! orientation, so a cavity is retriangulated without one orientation test.

mod locality;
mod part;
mod ridges;
mod star;

use crate::memory::{Array, Fallible, Shortage, TryGrow, make_room, prefetch};
use crate::mesh::NONE;
pub(crate) use locality::Anchored;
pub(crate) use part::{Ids, Names};
use ridges::{MAX_TABLE_DIM, Ridges, Side, ridges_of};

/// The vertex that closes the hull. A simplex that has it stands for the half-space beyond a facet.
pub(crate) const INFINITE: u32 = NONE;

/// The facet of `simplex` opposite its vertex number `index`, and the simplex beyond it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    pub simplex: u32,
    pub index: u32,
    pub beyond: u32,
}

pub(crate) struct Complex<const D: usize> {
    records: Array<u32>,
    /// Dead simplices, reused last in first out.
    free: Vec<u32>,
    /// One simplex at each vertex, [`NONE`] for a vertex that is not in the complex.
    incident: Array<u32>,
    epoch: u32,
    ridges: Ridges,
    /// Simplices that ids can name: one fewer than 2^32, since [`NONE`] names none.
    id_limit: usize,
}

impl<const D: usize> Complex<D> {
    const CORNERS: usize = D + 1;
    /// Where a record's mark is, and its length.
    const MARK: usize = 2 * Self::CORNERS;
    const RECORD: usize = Self::MARK + 1;

    /// An empty complex that knows `vertices` ids, none of them inserted.
    pub fn new(vertices: usize) -> Fallible<Self> {
        Ok(Self {
            records: Array::new(),
            free: Vec::new(),
            incident: Array::filled(vertices, NONE)?,
            epoch: 0,
            ridges: Ridges::default(),
            id_limit: NONE as usize,
        })
    }

    /// Forgets all vertices and simplices, but keeps their room.
    pub fn clear(&mut self) {
        self.records.clear();
        self.free.clear();
        self.incident.clear();
    }

    /// One past the largest simplex id ever used; arrays over simplices have this length.
    pub fn simplex_bound(&self) -> usize {
        self.records.len() / Self::RECORD
    }

    /// Number of live simplices, infinite ones included.
    pub fn simplex_count(&self) -> usize {
        self.simplex_bound() - self.free.len()
    }

    #[inline]
    pub fn vertices(&self, simplex: u32) -> &[u32] {
        &self.records[simplex as usize * Self::RECORD..][..Self::CORNERS]
    }

    #[inline]
    pub fn neighbors(&self, simplex: u32) -> &[u32] {
        &self.records[simplex as usize * Self::RECORD..][Self::CORNERS..Self::MARK]
    }

    /// Begins to load the record of `simplex`.
    #[inline(always)]
    pub fn prefetch(&self, simplex: u32) {
        prefetch(&self.records[simplex as usize * Self::RECORD..][..Self::RECORD]);
    }

    pub fn is_live(&self, simplex: u32) -> bool {
        self.neighbors(simplex)[0] != NONE
    }

    pub fn is_infinite(&self, simplex: u32) -> bool {
        self.vertices(simplex).contains(&INFINITE)
    }

    /// A simplex at `vertex`, [`NONE`] if the vertex is not in the complex.
    #[inline]
    pub fn incident(&self, vertex: u32) -> u32 {
        self.incident[vertex as usize]
    }

    pub fn contains_vertex(&self, vertex: u32) -> bool {
        self.incident(vertex) != NONE
    }

    /// Makes room for a new vertex id.
    pub fn add_vertex(&mut self) -> Fallible<u32> {
        self.incident.try_push(NONE)?;
        Ok(self.incident.len() as u32 - 1)
    }

    /// Builds the complex of one finite, positively oriented simplex and its infinite neighbours.
    pub fn begin(&mut self, corners: &[u32]) -> Fallible<()> {
        assert!(self.records.is_empty() && corners.len() == Self::CORNERS);
        self.reserve(D + 2, 0)?;
        let finite = self.allocate();
        self.vertices_mut(finite).copy_from_slice(corners);
        for opposite in 0..Self::CORNERS {
            let infinite = self.allocate();
            let vertices = self.vertices_mut(infinite);
            vertices.copy_from_slice(corners);
            vertices[opposite] = INFINITE;
            // Seen from beyond the facet the corners turn the other way.
            vertices.swap((opposite + 1) % Self::CORNERS, (opposite + 2) % Self::CORNERS);
        }
        self.link_all();
        for &corner in corners {
            self.incident[corner as usize] = finite;
        }
        Ok(())
    }

    /// Makes room for `created` new simplices and for `released` more dead ones, so that neither
    /// has to ask for memory. The caller then makes at most so many.
    pub fn reserve(&mut self, created: usize, released: usize) -> Fallible<()> {
        let appended = created.saturating_sub(self.free.len());
        if appended > self.id_limit.saturating_sub(self.simplex_bound()) {
            return Err(Shortage::Ids);
        }
        if D <= MAX_TABLE_DIM {
            self.ridges.reserve::<D>(created)?;
        }
        make_room(&mut self.free, released)?;
        self.records.make_room(appended * Self::RECORD)
    }

    /// Makes room for so many simplices and vertices if the system gives it.
    pub fn expect(&mut self, simplices: usize, vertices: usize) {
        self.records.expect(simplices * Self::RECORD);
        self.incident.expect(vertices);
    }

    /// Lets the complex run out of ids where a test can see it.
    #[cfg(test)]
    pub fn limit_ids(&mut self, limit: usize) {
        self.id_limit = limit;
    }

    /// Links the D + 2 simplices of [`Self::begin`]: any two share the facet without one vertex each.
    fn link_all(&mut self) {
        let count = self.simplex_bound() as u32;
        for simplex in 0..count {
            for index in 0..Self::CORNERS {
                let missing = self.vertices(simplex)[index];
                let neighbor = (0..count)
                    .find(|&other| other != simplex && !self.vertices(other).contains(&missing));
                self.neighbors_mut(simplex)[index] = neighbor.expect("two simplices share a facet");
            }
        }
    }

    /// Starts a search: afterwards no simplex is marked. The two marks are independent. Returns what
    /// [`Self::has_marks_of`] knows the search by.
    pub fn begin_marks(&mut self) -> u32 {
        if self.epoch >= u32::MAX - 2 {
            self.records.chunks_exact_mut(Self::RECORD).for_each(|record| record[Self::MARK] = 0);
            self.epoch = 0;
        }
        self.epoch += 2;
        self.epoch
    }

    #[inline]
    fn mark(&self, simplex: u32) -> u32 {
        self.records[simplex as usize * Self::RECORD + Self::MARK]
    }

    #[inline]
    fn mark_mut(&mut self, simplex: u32) -> &mut u32 {
        &mut self.records[simplex as usize * Self::RECORD + Self::MARK]
    }

    /// Whether no other search began since the one that got this number.
    #[inline]
    pub fn has_marks_of(&self, search: u32) -> bool {
        self.epoch == search
    }

    #[inline]
    pub fn mark_inside(&mut self, simplex: u32) {
        *self.mark_mut(simplex) = self.epoch;
    }

    #[inline]
    pub fn mark_outside(&mut self, simplex: u32) {
        *self.mark_mut(simplex) = self.epoch + 1;
    }

    #[inline]
    pub fn is_inside(&self, simplex: u32) -> bool {
        self.mark(simplex) == self.epoch
    }

    #[inline]
    pub fn is_marked(&self, simplex: u32) -> bool {
        self.mark(simplex) >= self.epoch
    }

    /// Replaces the cavity (the simplices marked inside, listed in `cavity`) by the cone of
    /// `vertex` over its `boundary`. `created[i]` is the new simplex on `boundary[i]`.
    pub fn retriangulate(
        &mut self,
        vertex: u32,
        cavity: &[u32],
        boundary: &[Facet],
        created: &mut Vec<u32>,
    ) {
        created.clear();
        for facet in boundary {
            created.push(self.cone(vertex, facet));
        }
        if D <= MAX_TABLE_DIM {
            self.ridges.begin::<D>(boundary.len());
            for (facet, &simplex) in boundary.iter().zip(created.iter()) {
                self.link_by_table(facet.index as usize, simplex);
            }
        } else {
            for (facet, &simplex) in boundary.iter().zip(created.iter()) {
                self.link_by_pivots(facet, simplex);
            }
        }
        self.incident[vertex as usize] = created[0];
        for &simplex in cavity {
            self.release(simplex);
        }
    }

    /// The simplex of `vertex` over `facet`, linked to the simplex beyond. The facet's own
    /// simplex, though dead, points to it from then on: that is how a pivot finds it.
    fn cone(&mut self, vertex: u32, facet: &Facet) -> u32 {
        let simplex = self.allocate();
        let (from, index) = (facet.simplex as usize * Self::RECORD, facet.index as usize);
        let to = simplex as usize * Self::RECORD;
        self.records.copy_within(from..from + Self::CORNERS, to);
        self.records[to + index] = vertex;
        for i in (0..Self::CORNERS).filter(|&i| i != index) {
            let corner = self.records[to + i];
            if corner != INFINITE {
                self.incident[corner as usize] = simplex;
            }
        }
        self.neighbors_mut(simplex)[index] = facet.beyond;
        self.neighbors_mut(facet.simplex)[index] = simplex;
        let mirror = position(self.neighbors(facet.beyond), facet.simplex);
        self.neighbors_mut(facet.beyond)[mirror] = simplex;
        simplex
    }

    /// Links `simplex`, whose corner number `apex` is the new vertex, across each ridge of its facet
    /// on the cavity to the simplex that has the ridge too, if that has come before.
    fn link_by_table(&mut self, apex: usize, simplex: u32) {
        for (ridge, index) in ridges_of::<D>(self.vertices(simplex), apex) {
            if let Some(other) = self.ridges.pair(ridge, Side { simplex, index }) {
                self.neighbors_mut(simplex)[index as usize] = other.simplex;
                self.neighbors_mut(other.simplex)[other.index as usize] = simplex;
            }
        }
    }

    /// Links `simplex` (the cone over `facet`) across each ridge of the facet by pivoting round
    /// the ridge through the cavity.
    fn link_by_pivots(&mut self, facet: &Facet, simplex: u32) {
        for ridge in 0..Self::CORNERS {
            if self.neighbors(simplex)[ridge] != NONE {
                continue;
            }
            let (neighbor, index) = self.pivot(facet, ridge);
            self.neighbors_mut(simplex)[ridge] = neighbor;
            self.neighbors_mut(neighbor)[index] = simplex;
        }
    }

    /// Turns round the ridge of `facet` without corner `leave` until the cavity ends; returns the
    /// cone there and the number of its corner that is not on the ridge.
    #[inline]
    fn pivot(&self, facet: &Facet, leave: usize) -> (u32, usize) {
        let (mut current, mut enter, mut leave) = (facet.simplex, facet.index as usize, leave);
        loop {
            let next = self.neighbors(current)[leave];
            if !self.is_inside(next) {
                return (next, enter);
            }
            let kept = self.vertices(current)[enter];
            enter = position(self.neighbors(next), current);
            leave = position(self.vertices(next), kept);
            current = next;
        }
    }

    fn allocate(&mut self) -> u32 {
        if let Some(simplex) = self.free.pop() {
            self.neighbors_mut(simplex).fill(NONE);
            *self.mark_mut(simplex) = 0;
            return simplex;
        }
        let simplex = self.simplex_bound() as u32;
        self.records.resize_within(self.records.len() + Self::MARK, NONE);
        self.records.resize_within(self.records.len() + 1, 0);
        simplex
    }

    fn release(&mut self, simplex: u32) {
        self.neighbors_mut(simplex)[0] = NONE;
        self.free.push(simplex);
    }

    fn vertices_mut(&mut self, simplex: u32) -> &mut [u32] {
        &mut self.records[simplex as usize * Self::RECORD..][..Self::CORNERS]
    }

    #[inline]
    fn neighbors_mut(&mut self, simplex: u32) -> &mut [u32] {
        &mut self.records[simplex as usize * Self::RECORD..][Self::CORNERS..Self::MARK]
    }
}

/// Where `id` stands in `ids`; the caller knows that it does.
#[inline]
pub(crate) fn position(ids: &[u32], id: u32) -> usize {
    ids.iter().position(|&other| other == id).expect("adjacent simplices name each other")
}
