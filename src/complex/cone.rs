//! The cone of a new vertex over the boundary of its cavity, and the pairs of its simplices that
//! share a ridge of the boundary. In the plane a ridge is a vertex, which remembers the edge that
//! starts there. In space it is an edge; if the cavity has few vertices, a small table has all
//! pairs of them. In higher dimensions a hash table has the ridges, and beyond [`MAX_TABLE_DIM`]
//! the search pivots round each ridge through the cavity. The first two ways are free of branches
//! in the sense of [`Array::push_if`](crate::memory::Array::push_if).

use super::ridges::{MAX_TABLE_DIM, RidgeSide, ridges_of};
use super::{Complex, Facet, SimplexId, VertexId, VertexSet, position};
use crate::memory::AllocResult;

/// Largest number of vertices round a cavity in space, the infinite one counted, whose edges fit in
/// the table.
const NUMBERS: usize = 64;

/// At least the number of vertices of a simplex.
const MAX_VERTICES: usize = 9;

/// Length of the table of the directed edges round a cavity in space. Entry `NUMBERS * i + j` is
/// the simplex that passes from the vertex with number i to the vertex with number j; entries of
/// earlier cones stay where this one has no edge.
pub(super) const EDGES: usize = NUMBERS * NUMBERS;

/// Vertices of the triangle opposite each vertex of a tetrahedron, all seen from the same side: two
/// triangles of a cone's boundary that share an edge pass it in opposite directions.
const TRIANGLES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Start and end of the edge opposite each vertex of a triangle, all in the same direction round
/// it.
const SIDES: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

impl<const D: usize> Complex<D> {
    /// Replaces the simplices of `cavity` by the cone of `vertex` over its `boundary`, whose finite
    /// vertices are `around`. `created[i]` is the new simplex on `boundary[i]`.
    pub fn retriangulate(
        &mut self,
        vertex: VertexId,
        cavity: &[SimplexId],
        boundary: &[Facet],
        around: &VertexSet,
        created: &mut Vec<SimplexId>,
    ) -> AllocResult<()> {
        created.clear();
        for facet in boundary {
            created.push(self.cone(vertex, facet));
        }
        match D {
            2 => self.link_round(boundary, created),
            3 if self.link_by_edges(boundary, around, created) => {}
            4..=MAX_TABLE_DIM => self.link_by_table(boundary, created),
            _ => self.link_by_pivots(cavity, boundary, created)?,
        }
        self.incident[vertex] = created[0];
        for &simplex in cavity {
            self.release(simplex);
        }
        Ok(())
    }

    /// Makes the simplex of `vertex` over `facet`, links it to the simplex beyond, and returns it.
    #[inline(always)]
    fn cone(&mut self, vertex: VertexId, facet: &Facet) -> SimplexId {
        let simplex = self.allocate();
        let (from, index) = (facet.simplex.index() * Self::RECORD, facet.index as usize);
        const { assert!(D < MAX_VERTICES) };
        // By way of the stack, which is no call of `memmove` as a copy within an array is.
        let mut row = [0; MAX_VERTICES];
        row[..Self::VERTICES].copy_from_slice(&self.records[from..][..Self::VERTICES]);
        let (vertices, neighbors) = self.record_mut(simplex).split_at_mut(Self::VERTICES);
        vertices.copy_from_slice(&row[..Self::VERTICES]);
        (vertices[index], neighbors[index]) = (vertex.number(), facet.beyond.number());
        self.neighbors_mut(facet.beyond)[facet.mirror as usize] = simplex;
        simplex
    }

    /// Links the simplices of a cone in the plane, which go round the cavity: each is followed by
    /// the one that starts where its edge ends.
    #[inline(always)]
    fn link_round(&mut self, boundary: &[Facet], created: &[SimplexId]) {
        // Until the second loop is done with a vertex, it has the number of its edge instead of a
        // simplex.
        let mut at_infinity = SimplexId::NONE;
        for (at, facet) in boundary.iter().enumerate() {
            let [start, _] = SIDES[facet.index as usize];
            *self.incident_or(&mut at_infinity, created[at], start) = SimplexId::new(at);
        }
        for (at, facet) in boundary.iter().enumerate() {
            let [start, end] = SIDES[facet.index as usize];
            let following = self.incident_or(&mut at_infinity, created[at], end);
            let next = following.index();
            *following = created[at.max(next)];
            let [_, next_end] = SIDES[boundary[next].index as usize];
            self.neighbors_mut(created[at])[start] = created[next];
            self.neighbors_mut(created[next])[next_end] = created[at];
        }
    }

    /// Returns the entry for the simplex incident to vertex number `index` of `simplex`; it is
    /// `at_infinity` for the infinite vertex.
    #[inline(always)]
    fn incident_or<'a>(
        &'a mut self,
        at_infinity: &'a mut SimplexId,
        simplex: SimplexId,
        index: usize,
    ) -> &'a mut SimplexId {
        let vertex = self.records[simplex.index() * Self::RECORD + index];
        let vertex = VertexId::from_number(vertex);
        if vertex == VertexId::INFINITE { at_infinity } else { &mut self.incident[vertex] }
    }

    /// Links the simplices of a cone in space by the table of edges, if there are few vertices
    /// round the cavity; returns false otherwise.
    #[inline(always)]
    fn link_by_edges(
        &mut self,
        boundary: &[Facet],
        around: &VertexSet,
        created: &[SimplexId],
    ) -> bool {
        if around.ids.len() >= NUMBERS {
            return false;
        }
        let Self { edges, records, incident, .. } = self;
        let edges: &mut [SimplexId; EDGES] = (&mut edges[..]).try_into().expect("it is reserved");
        let mut last = [SimplexId::NONE; NUMBERS];
        for (facet, &simplex) in boundary.iter().zip(created) {
            let (vertices, neighbors) =
                records[simplex.index() * Self::RECORD..][..8].split_at_mut(4);
            let [i, j, k] = TRIANGLES[facet.index as usize].map(|index| index % 4);
            let number = |index: usize| {
                around.number(VertexId::from_number(vertices[index])) as usize % NUMBERS
            };
            let (a, b, c) = (number(i), number(j), number(k));
            edges[NUMBERS * a + b] = simplex;
            edges[NUMBERS * b + c] = simplex;
            edges[NUMBERS * c + a] = simplex;
            // Where the other side of each edge is to be found.
            neighbors[k] = (NUMBERS * b + a) as u32;
            neighbors[i] = (NUMBERS * c + b) as u32;
            neighbors[j] = (NUMBERS * a + c) as u32;
            (last[a], last[b], last[c]) = (simplex, simplex, simplex);
        }
        for (facet, &simplex) in boundary.iter().zip(created) {
            let neighbors = &mut records[simplex.index() * Self::RECORD..][4..8];
            for index in TRIANGLES[facet.index as usize] {
                let neighbor = &mut neighbors[index % 4];
                *neighbor = edges[*neighbor as usize % EDGES].number();
            }
        }
        for (&vertex, &simplex) in around.ids.iter().zip(&last[1..]) {
            incident[vertex] = simplex;
        }
        true
    }

    /// Records for every vertex of the new simplices the last of them that has it, as incident to
    /// it.
    pub(super) fn touch_vertices(&mut self, created: &[SimplexId]) {
        for &simplex in created {
            let record = &self.records[simplex.index() * Self::RECORD..];
            for &vertex in VertexId::from_numbers(&record[..Self::VERTICES]) {
                if vertex != VertexId::INFINITE {
                    self.incident[vertex] = simplex;
                }
            }
        }
    }

    /// Links the simplices of a cone by the hash table of ridges.
    fn link_by_table(&mut self, boundary: &[Facet], created: &[SimplexId]) {
        self.ridges.begin::<D>(boundary.len());
        for (facet, &simplex) in boundary.iter().zip(created) {
            for (ridge, index) in ridges_of::<D>(self.vertices(simplex), facet.index as usize) {
                if let Some(other) = self.ridges.pair(ridge, RidgeSide { simplex, index }) {
                    self.neighbors_mut(simplex)[index as usize] = other.simplex;
                    self.neighbors_mut(other.simplex)[other.index as usize] = simplex;
                }
            }
        }
        self.touch_vertices(created);
    }

    /// Links the simplices of a cone by pivoting round each ridge through the cavity.
    fn link_by_pivots(
        &mut self,
        cavity: &[SimplexId],
        boundary: &[Facet],
        created: &[SimplexId],
    ) -> AllocResult<()> {
        self.begin_marks()?;
        cavity.iter().try_for_each(|&simplex| self.mark_inside(simplex))?;
        for (facet, &simplex) in boundary.iter().zip(created) {
            let neighbors = self.neighbors_mut(simplex);
            neighbors.fill(SimplexId::NONE);
            neighbors[facet.index as usize] = facet.beyond;
            // The facet's own simplex, though dead, points to its cone: that is how a pivot finds
            // it.
            self.neighbors_mut(facet.simplex)[facet.index as usize] = simplex;
        }
        for (facet, &simplex) in boundary.iter().zip(created) {
            for ridge in (0..Self::VERTICES).filter(|&ridge| ridge != facet.index as usize) {
                if !self.neighbors(simplex)[ridge].is_valid() {
                    let (neighbor, index) = self.pivot(facet, ridge);
                    self.neighbors_mut(simplex)[ridge] = neighbor;
                    self.neighbors_mut(neighbor)[index] = simplex;
                }
            }
        }
        self.touch_vertices(created);
        Ok(())
    }

    /// Pivots round the ridge of `facet` without vertex `leave` until the cavity ends; returns the
    /// simplex of the cone there, and the number of its vertex that is neither on the ridge nor the
    /// apex.
    #[inline]
    fn pivot(&self, facet: &Facet, leave: usize) -> (SimplexId, usize) {
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
}
