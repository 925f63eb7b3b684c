//! The cone of a new vertex over the boundary of its cavity, and which two of its simplices share a
//! ridge of the boundary. In the plane a ridge is a vertex, which remembers the edge that starts
//! there; in space an edge of few vertices, a table of whose pairs is small; then a hash table
//! knows them, and beyond that one pivots round each through the cavity. The first two are free of
//! branches in the sense of [`Array::push_if`](crate::memory::Array::push_if).

use super::ridges::{MAX_TABLE_DIM, Side, ridges_of};
use super::{Complex, Facet, INFINITE, VertexSet, position};
use crate::mesh::NONE;

/// Vertices of a boundary, the infinite one counted, whose edges have a place in the table.
const NUMBERS: usize = 64;

/// Length of the table of the directed edges round a cavity in space: at `NUMBERS * i + j` is the
/// simplex that passes from the vertex with number i to that with number j. It holds what earlier
/// cones left where this one has no edge.
pub(super) const EDGES: usize = NUMBERS * NUMBERS;

/// Triangles with an apex, as the tetrahedron with number `i` for its apex is turned: all cones
/// look at theirs from the same side, so two that share an edge pass it in opposite directions.
const TRIANGLES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// The same in the plane: where the edge opposite each vertex starts and ends.
const SIDES: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

impl<const D: usize> Complex<D> {
    /// Replaces the cavity (the simplices marked inside, listed in `cavity`) by the cone of
    /// `vertex` over its `boundary`, whose finite vertices are `around`. `created[i]` is the new
    /// simplex on `boundary[i]`.
    pub fn retriangulate(
        &mut self,
        vertex: u32,
        cavity: &[u32],
        boundary: &[Facet],
        around: &VertexSet,
        created: &mut Vec<u32>,
    ) {
        created.clear();
        for facet in boundary {
            created.push(self.cone(vertex, facet));
        }
        match D {
            2 => self.link_round(boundary, created),
            3 if self.link_by_edges(boundary, around, created) => {}
            4..=MAX_TABLE_DIM => self.link_by_table(boundary, created),
            _ => self.link_by_pivots(boundary, created),
        }
        self.incident[vertex as usize] = created[0];
        for &simplex in cavity {
            self.release(simplex);
        }
    }

    /// The simplex of `vertex` over `facet`, linked to the simplex beyond.
    #[inline(always)]
    fn cone(&mut self, vertex: u32, facet: &Facet) -> u32 {
        let simplex = self.allocate();
        let (from, index) = (facet.simplex as usize * Self::RECORD, facet.index as usize);
        self.records.copy_within(from..from + Self::VERTICES, simplex as usize * Self::RECORD);
        let (vertices, others) = self.record_mut(simplex).split_at_mut(Self::VERTICES);
        let (neighbors, mark) = others.split_at_mut(Self::VERTICES);
        (vertices[index], neighbors[index], mark[0]) = (vertex, facet.beyond, 0);
        self.neighbors_mut(facet.beyond)[facet.mirror as usize] = simplex;
        simplex
    }

    /// Links the cones in the plane, which go round the cavity: each is followed by the one that
    /// starts where its edge ends.
    #[inline(always)]
    fn link_round(&mut self, boundary: &[Facet], created: &[u32]) {
        let vertex_at = |complex: &Self, at: usize, index: usize| {
            complex.records[created[at] as usize * Self::RECORD + index]
        };
        let mut at_infinity = 0;
        for (at, facet) in boundary.iter().enumerate() {
            let [start, _] = SIDES[facet.index as usize];
            match vertex_at(self, at, start) {
                INFINITE => at_infinity = at as u32,
                vertex => self.incident[vertex as usize] = at as u32,
            }
        }
        for (at, facet) in boundary.iter().enumerate() {
            let [start, end] = SIDES[facet.index as usize];
            let following = match vertex_at(self, at, end) {
                INFINITE => &mut at_infinity,
                vertex => &mut self.incident[vertex as usize],
            };
            let next = *following as usize;
            *following = created[at.max(next)];
            let [_, next_end] = SIDES[boundary[next].index as usize];
            self.neighbors_mut(created[at])[start] = created[next];
            self.neighbors_mut(created[next])[next_end] = created[at];
        }
    }

    /// Links the cones in space, if the vertices round the cavity are few enough.
    #[inline(always)]
    fn link_by_edges(&mut self, boundary: &[Facet], around: &VertexSet, created: &[u32]) -> bool {
        if around.ids.len() >= NUMBERS {
            return false;
        }
        let Self { edges, records, incident, .. } = self;
        let edges: &mut [u32; EDGES] = (&mut edges[..]).try_into().expect("there is room for all");
        let mut last = [NONE; NUMBERS];
        for (facet, &simplex) in boundary.iter().zip(created) {
            let (vertices, neighbors) =
                records[simplex as usize * Self::RECORD..][..8].split_at_mut(4);
            let [i, j, k] = TRIANGLES[facet.index as usize].map(|index| index % 4);
            let number = |index: usize| around.number(vertices[index]) as usize % NUMBERS;
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
            let neighbors = &mut records[simplex as usize * Self::RECORD..][4..8];
            for index in TRIANGLES[facet.index as usize] {
                let neighbor = &mut neighbors[index % 4];
                *neighbor = edges[*neighbor as usize % EDGES];
            }
        }
        for (&vertex, &simplex) in around.ids.iter().zip(&last[1..]) {
            incident[vertex as usize] = simplex;
        }
        true
    }

    /// Every vertex of the cones is incident to the last one that has it.
    fn touch_vertices(&mut self, created: &[u32]) {
        for &simplex in created {
            let at = simplex as usize * Self::RECORD;
            for &vertex in &self.records[at..][..Self::VERTICES] {
                if vertex != INFINITE {
                    self.incident[vertex as usize] = simplex;
                }
            }
        }
    }

    /// Links the cones by a table of the ridges.
    fn link_by_table(&mut self, boundary: &[Facet], created: &[u32]) {
        self.ridges.begin::<D>(boundary.len());
        for (facet, &simplex) in boundary.iter().zip(created) {
            for (ridge, index) in ridges_of::<D>(self.vertices(simplex), facet.index as usize) {
                if let Some(other) = self.ridges.pair(ridge, Side { simplex, index }) {
                    self.neighbors_mut(simplex)[index as usize] = other.simplex;
                    self.neighbors_mut(other.simplex)[other.index as usize] = simplex;
                }
            }
        }
        self.touch_vertices(created);
    }

    /// Links the cones by pivoting round the ridges through the cavity.
    fn link_by_pivots(&mut self, boundary: &[Facet], created: &[u32]) {
        for (facet, &simplex) in boundary.iter().zip(created) {
            let neighbors = self.neighbors_mut(simplex);
            neighbors.fill(NONE);
            neighbors[facet.index as usize] = facet.beyond;
            // The facet's own simplex, though dead, points to its cone: that is how a pivot finds
            // it.
            self.neighbors_mut(facet.simplex)[facet.index as usize] = simplex;
        }
        for (facet, &simplex) in boundary.iter().zip(created) {
            for ridge in (0..Self::VERTICES).filter(|&ridge| ridge != facet.index as usize) {
                if self.neighbors(simplex)[ridge] == NONE {
                    let (neighbor, index) = self.pivot(facet, ridge);
                    self.neighbors_mut(simplex)[ridge] = neighbor;
                    self.neighbors_mut(neighbor)[index] = simplex;
                }
            }
        }
        self.touch_vertices(created);
    }

    /// Turns round the ridge of `facet` without vertex `leave` until the cavity ends; returns the
    /// cone there and the number of its vertex that is not on the ridge.
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
}
