//! The combinatorial complex: a triangulated sphere, that is a ball whose hull facets are joined to
//! one infinite vertex. Knows vertex ids, simplices and adjacency; sees no coordinate.
//!
//! A simplex is a record of `u32` ids: its vertices, the neighbours opposite them and its mark,
//! which a search wants one after the other and finds in a cache line or two. Dead ones wait in a
//! LIFO list. All simplices are oriented alike: replacing a vertex of one by a point on the same
//! side keeps the orientation, so a cavity is retriangulated without one orientation test.

mod cone;
mod locality;
mod partition;
mod records;
mod ridges;
mod star;
mod vertices;

use crate::memory::{AllocError, AllocResult, Array, TryGrow, make_room};
use crate::mesh::NONE;
use cone::EDGES;
pub(crate) use locality::Anchored;
pub(crate) use partition::{GlobalToLocal, LocalToGlobal};
pub(crate) use records::{Marking, Records};
use ridges::{MAX_TABLE_DIM, Ridges};
pub(crate) use vertices::VertexSet;

/// The vertex that closes the hull. A simplex that has it stands for the half-space beyond a facet.
pub(crate) const INFINITE: u32 = NONE;

/// The facet of `simplex` opposite its vertex number `index`, and the simplex beyond it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    pub simplex: u32,
    pub index: u32,
    pub beyond: u32,
    /// Where `beyond` has `simplex` among its neighbours.
    pub mirror: u32,
}

pub(crate) struct Complex<const D: usize> {
    records: Array<u32>,
    /// Dead simplices, reused last in first out.
    free: Vec<u32>,
    /// One simplex at each vertex, [`NONE`] for a vertex that is not in the complex.
    incident: Array<u32>,
    epoch: u32,
    /// The directed edges round a cavity in space, see `cone`.
    edges: Vec<u32>,
    ridges: Ridges,
    /// Simplices that ids can name: one fewer than 2^32, since [`NONE`] names none.
    id_limit: usize,
}

impl<const D: usize> Complex<D> {
    const VERTICES: usize = D + 1;
    /// Where a record's mark is, and its length.
    const MARK: usize = 2 * Self::VERTICES;
    const RECORD: usize = Self::MARK + 1;

    /// An empty complex that knows `vertices` ids, none of them inserted.
    pub fn new(vertices: usize) -> AllocResult<Self> {
        Ok(Self {
            records: Array::new(),
            free: Vec::new(),
            incident: Array::filled(vertices, NONE)?,
            epoch: 0,
            edges: Vec::new(),
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
        self.records().vertices(simplex)
    }

    #[inline]
    pub fn neighbors(&self, simplex: u32) -> &[u32] {
        self.records().neighbors(simplex)
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
    pub fn add_vertex(&mut self) -> AllocResult<u32> {
        self.incident.try_push(NONE)?;
        Ok(self.incident.len() as u32 - 1)
    }

    /// Builds the complex of one finite, positively oriented simplex and its infinite neighbours.
    pub fn begin(&mut self, first: &[u32]) -> AllocResult<()> {
        assert!(self.records.is_empty() && first.len() == Self::VERTICES);
        self.reserve(D + 2, 0)?;
        let finite = self.allocate();
        self.vertices_mut(finite).copy_from_slice(first);
        for opposite in 0..Self::VERTICES {
            let infinite = self.allocate();
            let vertices = self.vertices_mut(infinite);
            vertices.copy_from_slice(first);
            vertices[opposite] = INFINITE;
            // Seen from beyond the facet the vertices turn the other way.
            vertices.swap((opposite + 1) % Self::VERTICES, (opposite + 2) % Self::VERTICES);
        }
        self.link_all();
        for &vertex in first {
            self.incident[vertex as usize] = finite;
        }
        Ok(())
    }

    /// Reserves memory for `created` new simplices and for `released` more dead ones, so that
    /// neither has to ask for it. The caller then makes at most `created`.
    pub fn reserve(&mut self, created: usize, released: usize) -> AllocResult<()> {
        let appended = created.saturating_sub(self.free.len());
        if appended > self.id_limit.saturating_sub(self.simplex_bound()) {
            return Err(AllocError::Ids);
        }
        match D {
            2 => {}
            3 => self.edges.cover(EDGES, 0)?,
            4..=MAX_TABLE_DIM => self.ridges.reserve::<D>(created)?,
            _ => {}
        }
        make_room(&mut self.free, released)?;
        self.records.make_room(appended * Self::RECORD)
    }

    /// Reserves memory for `simplices` simplices and `vertices` vertices if the system gives it.
    pub fn expect(&mut self, simplices: usize, vertices: usize) {
        self.records.expect(simplices * Self::RECORD);
        self.incident.expect(vertices);
    }

    /// Lets the complex run out of ids where a test can see it.
    #[cfg(test)]
    pub fn limit_ids(&mut self, limit: usize) {
        self.id_limit = limit;
    }

    /// Links the D + 2 simplices of [`Self::begin`]: any two share the facet without one vertex
    /// each.
    fn link_all(&mut self) {
        let count = self.simplex_bound() as u32;
        for simplex in 0..count {
            for index in 0..Self::VERTICES {
                let missing = self.vertices(simplex)[index];
                let neighbor = (0..count)
                    .find(|&other| other != simplex && !self.vertices(other).contains(&missing));
                self.neighbors_mut(simplex)[index] = neighbor.expect("two simplices share a facet");
            }
        }
    }

    /// Starts a search: afterwards no simplex is marked. The two marks are independent. Returns
    /// what
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
    pub fn is_inside(&self, simplex: u32) -> bool {
        self.mark(simplex) == self.epoch
    }

    #[inline]
    pub fn is_marked(&self, simplex: u32) -> bool {
        self.mark(simplex) >= self.epoch
    }

    /// Marks `simplex` as inside, or else as outside.
    #[inline]
    pub fn mark_either(&mut self, simplex: u32, is_inside: bool) {
        *self.mark_mut(simplex) = self.epoch + u32::from(!is_inside);
    }

    /// A record that the caller fills in; one that no simplex had is all zeros.
    #[inline(always)]
    fn allocate(&mut self) -> u32 {
        if let Some(simplex) = self.free.pop() {
            return simplex;
        }
        let simplex = self.simplex_bound() as u32;
        self.records.resize_within(self.records.len() + Self::RECORD, 0);
        simplex
    }

    fn record_mut(&mut self, simplex: u32) -> &mut [u32] {
        &mut self.records[simplex as usize * Self::RECORD..][..Self::RECORD]
    }

    fn release(&mut self, simplex: u32) {
        self.neighbors_mut(simplex)[0] = NONE;
        self.free.push(simplex);
    }

    fn vertices_mut(&mut self, simplex: u32) -> &mut [u32] {
        &mut self.records[simplex as usize * Self::RECORD..][..Self::VERTICES]
    }

    #[inline]
    fn neighbors_mut(&mut self, simplex: u32) -> &mut [u32] {
        &mut self.records[simplex as usize * Self::RECORD..][Self::VERTICES..Self::MARK]
    }
}

/// Where `id` stands last in `ids`, 0 if nowhere. Without a branch, as `Array::push_if`.
#[inline(always)]
fn index_of(ids: &[u32], id: u32) -> usize {
    ids.iter().enumerate().fold(0, |found, (at, &other)| if other == id { at } else { found })
}

/// Where `id` stands in `ids`; the caller knows that it does.
#[inline]
pub(crate) fn position(ids: &[u32], id: u32) -> usize {
    ids.iter().position(|&other| other == id).expect("adjacent simplices name each other")
}
