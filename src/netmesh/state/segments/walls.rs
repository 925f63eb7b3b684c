//! Walls: what separates regions. In the plane these are the lines, in space the parts of facets
//! between lines.

use crate::complex::VertexId;
use crate::netmesh::state::facets::Facets;
use crate::netmesh::state::facets::faces::FACES;
use crate::netmesh::state::segments::chain::Chains;

/// Lines of the plane, or facets of space.
#[derive(Clone, Copy)]
pub(in crate::netmesh) struct Walls<'a> {
    pub chains: &'a Chains,
    pub facets: &'a Facets,
}

/// Wall at a side of a simplex, and the side of it that the simplex is on: 0 on the left of a line
/// and before a facet, where its normal points to, 1 on the other side.
pub(in crate::netmesh) type Seen = Option<(u32, usize)>;

impl Walls<'_> {
    /// Returns the number of walls of a mesh of `dimension`.
    pub fn count(self, dimension: usize) -> usize {
        match dimension {
            2 => self.chains.lines.len(),
            _ => self.facets.walls.len(),
        }
    }

    /// Returns the number by which the winding number on side 0 of a wall is larger than on side 1.
    pub fn balance(self, dimension: usize, wall: usize) -> i64 {
        match dimension {
            2 => self.chains.lines[wall].balance,
            _ => -self.facets.walls[wall].balance,
        }
    }

    /// Returns the caller's segment or facet that a wall is part of, the first of several;
    /// [`NONE`](crate::mesh::NONE) for the boundary of a hull or box.
    pub fn parent(self, dimension: usize, wall: usize) -> u32 {
        match dimension {
            2 => self.chains.lines[wall].segment,
            _ => self.facets.facets[self.facets.walls[wall].facet as usize].parent,
        }
    }

    /// Returns the walls at the sides of a live simplex: number i is opposite vertex number i.
    #[inline]
    pub fn of(self, vertices: &[VertexId]) -> [Seen; 4] {
        match vertices.len() {
            3 => self.lines_of(vertices),
            _ => self.facets_of(vertices),
        }
    }

    #[inline]
    fn lines_of(self, vertices: &[VertexId]) -> [Seen; 4] {
        let [a, b, c] = self.chains.sides_of(vertices);
        let mut index = 0;
        [a, b, c, None].map(|side| {
            index += 1;
            let subsegment = self.chains.get(side?);
            // Simplices turn to the left, and so have what is inside on the left of their edges.
            let is_right = subsegment.ends[0] != vertices[index % 3];
            Some((subsegment.line, usize::from(is_right)))
        })
    }

    #[inline]
    fn facets_of(self, vertices: &[VertexId]) -> [Seen; 4] {
        let wall = |(subfacet, side)| (self.facets.get(subfacet).wall, side);
        self.subfacets_of(vertices).map(|seen| seen.map(wall))
    }

    /// Returns the subfacets that are faces of a live simplex of space, with the sides of them that
    /// it is on: number i is opposite vertex number i.
    #[inline]
    pub fn subfacets_of(self, vertices: &[VertexId]) -> [Seen; 4] {
        let mut seen = [None; 4];
        for (index, number) in self.facets.faces_of(vertices, |_| true) {
            let own = self.facets.get(number).vertices;
            let face = FACES[index].map(|at| vertices[at]);
            let is_before = (0..3).any(|at| [face[at], face[(at + 1) % 3]] == [own[0], own[1]]);
            seen[index] = Some((number, usize::from(!is_before)));
        }
        seen
    }
}
