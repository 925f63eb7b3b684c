//! The vertices that corners become, and where they are in pieces.

use super::super::isolated::Added;
use super::super::meet::Face;
use super::super::pieces::Pieces;
use super::candidates::vertices_of;
use super::corners::{Corner, Corners, Vertex, edge_of};
use super::owners::Owners;
use crate::arrangement::near::Near;
use crate::arrangement::reach::Reach;
use crate::memory::{AllocResult, TryGrow};

/// Vertex at a corner, and for each of the two pieces the edges that it is on: bit k stands for the
/// edge from vertex k of the piece to the next one.
struct Placed {
    vertex: u32,
    edges: [u8; 2],
}

impl Corners {
    /// Makes vertices of the corners, which are appended to `points`, and returns where pieces have
    /// them and the lines between them. Of `points` those from `inputs` on are no inputs. Expected
    /// O(n log n), where edges pass between few vertices.
    pub fn placed(
        &mut self,
        points: &mut Vec<[f64; 3]>,
        inputs: usize,
        pieces: &Pieces,
        owners: &Owners,
    ) -> AllocResult<Added> {
        let vertices = vertices_of(points, &self.candidates, &owners.roundings)?;
        let points = &points[..];
        let mut placer = Placer { points, pieces, owners, added: Added::default() };
        let mut placed = Vec::new();
        for pair in self.all.chunk_by(|a, b| a.pair == b.pair) {
            placed.clear();
            for corner in pair {
                let vertex = vertex_of(corner, &vertices);
                let edges = [placer.place(corner, 0, vertex)?, placer.place(corner, 1, vertex)?];
                placed.try_push(Placed { vertex, edges })?;
            }
            placer.join(pair[0].pieces, &mut placed)?;
        }
        for corner in &self.areas.corners {
            let vertex = vertex_of(corner, &vertices);
            placer.place(corner, 0, vertex)?;
            placer.place(corner, 1, vertex)?;
        }
        for line in self.areas.lines() {
            placer.added.lines.try_push(line)?;
        }
        placer.place_near(inputs)?;
        Ok(placer.added)
    }
}

fn vertex_of(corner: &Corner, vertices: &[u32]) -> u32 {
    match corner.vertex {
        Vertex::Known(vertex) => vertex,
        Vertex::Candidate(candidate) => vertices[candidate as usize],
    }
}

/// Places vertices on edges and in facets.
struct Placer<'a> {
    points: &'a [[f64; 3]],
    pieces: &'a Pieces,
    owners: &'a Owners,
    added: Added,
}

impl Placer<'_> {
    /// Places the vertex at a corner in one of the two pieces there, and returns the edges of the
    /// piece that it is on.
    fn place(&mut self, corner: &Corner, which: usize, vertex: u32) -> AllocResult<u8> {
        let piece = &self.pieces.all[corner.pieces[which] as usize];
        let own = piece.vertices();
        if let Some(at) = own.iter().position(|&other| other == vertex) {
            return Ok(self.edges_at(own, at));
        }
        let x = &self.points[vertex as usize];
        let mut edges = 0;
        for at in 0..if own.len() == 2 { 1 } else { 3 } {
            let next = (at + 1) % own.len();
            let face: Face = 1 << at | 1 << next;
            for edge in self.owners.of(edge_of(own, face)) {
                let reach = self.owners.reach(self.points, edge, self.owners.facets_with(edge));
                let is_at = || {
                    face == corner.faces[which] && reach.is_between(x) && reach.may_go_through(x)
                };
                let is_on = is_at() || reach.holds(x);
                if is_on && !edge.contains(&vertex) {
                    self.added.on_edges.try_push((edge, vertex))?;
                }
                if is_on || edge.contains(&vertex) {
                    edges |= 1 << at;
                }
            }
        }
        if let (0, Some(facet)) = (edges, piece.facet()) {
            self.added.in_facets.try_push((facet, vertex))?;
        }
        Ok(edges)
    }

    /// Returns the edges at a vertex of a piece.
    fn edges_at(&self, own: &[u32], at: usize) -> u8 {
        let count = own.len();
        let last = (at + count - 1) % count;
        let is_owned = |from: usize| self.owners.has([own[from], own[(from + 1) % count]]);
        u8::from(is_owned(at)) << at | u8::from(is_owned(last)) << last
    }

    /// Joins the two corners of what two pieces share by a line in their facets, except along an
    /// edge.
    fn join(&mut self, pair: [u32; 2], placed: &mut Vec<Placed>) -> AllocResult<()> {
        placed.sort_unstable_by_key(|placed| placed.vertex);
        placed.dedup_by(|next, kept| {
            let is_same = next.vertex == kept.vertex;
            if is_same {
                (0..2).for_each(|which| kept.edges[which] |= next.edges[which]);
            }
            is_same
        });
        let [first, second] = &placed[..] else { return Ok(()) };
        let ends = [first.vertex, second.vertex];
        for (which, piece) in pair.into_iter().enumerate() {
            let facet = self.pieces.all[piece as usize].facet();
            let are_on_one = first.edges[which] & second.edges[which] != 0;
            if let (false, Some(facet)) = (are_on_one, facet) {
                self.added.lines.try_push((facet, ends))?;
            }
        }
        Ok(())
    }

    /// Places vertices on the lines that they are near, and those from `inputs` on, on the edges.
    fn place_near(&mut self, inputs: usize) -> AllocResult<()> {
        let mut new = Near::new(&self.points[inputs..])?;
        let mut found = Vec::new();
        for &edge in self.owners.edges() {
            let reach = self.owners.roundings.reach(self.points, edge);
            found.clear();
            new.collect(&reach, reach.ends.each_ref(), &mut found)?;
            found.iter_mut().for_each(|vertex| *vertex += inputs as u32);
            self.place_on(edge, &reach, &found)?;
        }
        let mut all = Near::new(self.points)?;
        let owners = self.owners;
        let mut place_near_line = |own: &mut Self, line: [u32; 2], reach: Reach<3>| {
            found.clear();
            all.collect(&reach, reach.ends.each_ref(), &mut found)?;
            own.place_on(line, &reach, &found)
        };
        for at in 0..self.added.lines.len() {
            let (facet, line) = self.added.lines[at];
            let reach = owners.reach(self.points, line, std::iter::once(facet));
            place_near_line(self, line, reach)?;
        }
        for line in owners.lines() {
            let reach = owners.reach(self.points, line, owners.facets_with(line));
            place_near_line(self, line, reach)?;
        }
        Ok(())
    }

    /// Places those of some vertices on an edge that are near it.
    fn place_on(&mut self, edge: [u32; 2], reach: &Reach<3>, vertices: &[u32]) -> AllocResult<()> {
        for &vertex in vertices {
            if !edge.contains(&vertex) && reach.holds(&self.points[vertex as usize]) {
                self.added.on_edges.try_push((edge, vertex))?;
            }
        }
        Ok(())
    }
}
