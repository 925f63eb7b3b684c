//! The combinatorial complex: a triangulated sphere, which is a ball whose hull facets are joined
//! to one infinite vertex. It has vertex ids, simplices and adjacency, but no coordinates.
//!
//! A simplex is a record of 32-bit numbers: the ids of its vertices and of the neighbours opposite
//! them. A search reads them one after the other: in space they are half a cache line. Dead records
//! wait in a stack for reuse. All simplices are oriented alike: replacing a vertex of one by a
//! point on the same side keeps the orientation, so a cavity is retriangulated without a single
//! orientation test.

mod cone;
mod hole;
mod ids;
mod locality;
mod marks;
mod partition;
mod plain;
mod records;
mod ridges;
mod star;
mod vertices;

use crate::memory::{AllocError, AllocResult, Array, Id, TryGrow, reserve};
use cone::EDGES;
pub(crate) use hole::{Beside, Filling};
pub(crate) use ids::{SimplexId, Vertex, VertexId};
pub(crate) use locality::Anchored;
use marks::Marks;
pub(crate) use partition::{GlobalToLocal, LocalToGlobal, PartitionIds};
pub(crate) use records::{Marking, Records};
use ridges::{MAX_TABLE_DIM, Ridges};
pub(crate) use vertices::{IdSet, VertexSet};

/// Facet of `simplex` opposite its vertex number `index`, with the simplex beyond it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facet {
    pub simplex: SimplexId,
    pub index: u32,
    pub beyond: SimplexId,
    /// Position of `simplex` among the neighbours of `beyond`.
    pub mirror: u32,
}

pub(crate) struct Complex<const D: usize> {
    records: Array<u32>,
    /// Dead simplices, the last of which is reused first.
    free: Vec<SimplexId>,
    /// Vertex -> a simplex that has it; none if the vertex is not in the complex.
    incident: Array<SimplexId>,
    marks: Marks,
    /// Table of the directed edges round a cavity in space: see `cone`.
    edges: Vec<SimplexId>,
    ridges: Ridges,
    /// Largest number of simplices that ids can name: one fewer than 2^32, since one id names none.
    id_limit: usize,
}

impl<const D: usize> Complex<D> {
    const VERTICES: usize = D + 1;
    /// Number of words in a record.
    const RECORD: usize = 2 * Self::VERTICES;

    /// Returns an empty complex with `vertices` ids, none of them inserted.
    pub fn new(vertices: usize) -> AllocResult<Self> {
        Ok(Self {
            records: Array::new(),
            free: Vec::new(),
            incident: Array::filled(vertices, SimplexId::NONE)?,
            marks: Marks::default(),
            edges: Vec::new(),
            ridges: Ridges::default(),
            id_limit: SimplexId::NONE.index(),
        })
    }

    /// Removes all vertices and simplices, but keeps their memory.
    pub fn clear(&mut self) {
        self.records.clear();
        self.free.clear();
        self.incident.clear();
    }

    /// Returns one more than the largest simplex id ever used, which is the length of arrays over
    /// simplices.
    pub fn simplex_bound(&self) -> usize {
        self.records.len() / Self::RECORD
    }

    /// Forgets the simplices from `bound` on, and gives their memory back to the system. Nothing
    /// can be inserted, removed or searched afterwards.
    pub fn forget_from(&mut self, bound: SimplexId) {
        self.records.give_back_from(bound.index() * Self::RECORD);
    }

    /// Returns all simplices, dead ones included.
    pub fn simplices(&self) -> impl ExactSizeIterator<Item = SimplexId> + Clone + use<D> {
        SimplexId::below(self.simplex_bound())
    }

    /// Returns the number of live simplices, infinite ones included.
    pub fn simplex_count(&self) -> usize {
        self.simplex_bound() - self.free.len()
    }

    #[inline]
    pub fn vertices(&self, simplex: SimplexId) -> &[VertexId] {
        self.records().vertices(simplex)
    }

    #[inline]
    pub fn neighbors(&self, simplex: SimplexId) -> &[SimplexId] {
        self.records().neighbors(simplex)
    }

    pub fn is_live(&self, simplex: SimplexId) -> bool {
        self.neighbors(simplex)[0].is_valid()
    }

    pub fn is_infinite(&self, simplex: SimplexId) -> bool {
        self.vertices(simplex).contains(&VertexId::INFINITE)
    }

    /// Returns a simplex at `vertex`; none if the vertex is not in the complex.
    #[inline]
    pub fn incident(&self, vertex: VertexId) -> SimplexId {
        self.incident[vertex]
    }

    pub fn contains_vertex(&self, vertex: VertexId) -> bool {
        self.incident(vertex).is_valid()
    }

    /// Returns a new vertex id.
    pub fn add_vertex(&mut self) -> AllocResult<VertexId> {
        self.incident.try_push(SimplexId::NONE)?;
        Ok(VertexId::new(self.incident.len() - 1))
    }

    /// Builds the complex of one finite, positively oriented simplex and its infinite neighbours.
    pub fn begin(&mut self, first: &[VertexId]) -> AllocResult<()> {
        assert!(self.records.is_empty() && first.len() == Self::VERTICES);
        self.reserve(D + 2, 0)?;
        let finite = self.allocate();
        self.vertices_mut(finite).copy_from_slice(first);
        for opposite in 0..Self::VERTICES {
            let infinite = self.allocate();
            let vertices = self.vertices_mut(infinite);
            vertices.copy_from_slice(first);
            vertices[opposite] = VertexId::INFINITE;
            // Seen from beyond the facet the vertices turn the other way.
            vertices.swap((opposite + 1) % Self::VERTICES, (opposite + 2) % Self::VERTICES);
        }
        self.link_all();
        for &vertex in first {
            self.incident[vertex] = finite;
        }
        Ok(())
    }

    /// Reserves memory for `created` new simplices and for `released` more dead ones, so that
    /// neither step has to allocate. The caller then makes at most `created`.
    pub fn reserve(&mut self, created: usize, released: usize) -> AllocResult<()> {
        let appended = created.saturating_sub(self.free.len());
        if appended > self.id_limit.saturating_sub(self.simplex_bound()) {
            return Err(AllocError::Ids);
        }
        match D {
            2 => {}
            3 => self.edges.cover(EDGES, SimplexId::NONE)?,
            4..=MAX_TABLE_DIM => self.ridges.reserve::<D>(created)?,
            _ => {}
        }
        reserve(&mut self.free, released)?;
        self.records.reserve(appended * Self::RECORD)
    }

    /// Reserves memory for `simplices` simplices and `vertices` vertices, if the system grants it.
    pub fn expect(&mut self, simplices: usize, vertices: usize) {
        self.records.expect(simplices * Self::RECORD);
        self.marks.expect(simplices);
        self.incident.expect(vertices);
    }

    /// Limits the number of simplex ids, so that a test can exhaust them.
    #[cfg(test)]
    pub fn limit_ids(&mut self, limit: usize) {
        self.id_limit = limit;
    }

    /// Links the D + 2 simplices of [`Self::begin`]: any two share the facet without one vertex of
    /// each.
    fn link_all(&mut self) {
        let all = self.simplices();
        for simplex in all.clone() {
            for index in 0..Self::VERTICES {
                let missing = self.vertices(simplex)[index];
                let neighbor = all
                    .clone()
                    .find(|&other| other != simplex && !self.vertices(other).contains(&missing));
                self.neighbors_mut(simplex)[index] = neighbor.expect("two simplices share a facet");
            }
        }
    }

    /// Returns a simplex whose record the caller fills in; the record of a new id is all zeros.
    #[inline(always)]
    fn allocate(&mut self) -> SimplexId {
        if let Some(simplex) = self.free.pop() {
            debug_assert!(!self.is_marked(simplex), "a search reaches live simplices only");
            return simplex;
        }
        let simplex = SimplexId::new(self.simplex_bound());
        self.records.resize_within(self.records.len() + Self::RECORD, 0);
        simplex
    }

    fn record_mut(&mut self, simplex: SimplexId) -> &mut [u32] {
        &mut self.records[simplex.index() * Self::RECORD..][..Self::RECORD]
    }

    fn release(&mut self, simplex: SimplexId) {
        self.neighbors_mut(simplex)[0] = SimplexId::NONE;
        self.free.push(simplex);
    }

    fn vertices_mut(&mut self, simplex: SimplexId) -> &mut [VertexId] {
        let record = &mut self.records[simplex.index() * Self::RECORD..];
        VertexId::from_numbers_mut(&mut record[..Self::VERTICES])
    }

    #[inline]
    fn neighbors_mut(&mut self, simplex: SimplexId) -> &mut [SimplexId] {
        let record = &mut self.records[simplex.index() * Self::RECORD..];
        SimplexId::from_numbers_mut(&mut record[Self::VERTICES..Self::RECORD])
    }
}

/// Returns the last position of `id` in `ids`, and 0 if it is not there. Free of branches, as
/// `Array::push_if` is.
#[inline(always)]
fn index_of<Of>(ids: &[Id<Of>], id: Id<Of>) -> usize {
    ids.iter().enumerate().fold(0, |found, (at, &other)| if other == id { at } else { found })
}

/// Returns the position of `id` in `ids`, which must have it.
#[inline]
pub(crate) fn position<Of>(ids: &[Id<Of>], id: Id<Of>) -> usize {
    ids.iter().position(|&other| other == id).expect("adjacent simplices name each other")
}
