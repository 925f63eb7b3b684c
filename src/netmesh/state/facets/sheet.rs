//! Changes of sheets: a vertex goes in, edges flip. They know no coordinates: whoever calls has
//! made sure that the triangles turn the right way.

use super::{Facets, Subfacet, bit_of};
use crate::complex::VertexId;
use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;

impl Facets {
    /// Splits a subfacet at `vertex` in its interior. Returns the three that replace it, each with
    /// the vertex as its number 0.
    pub fn split_inside(&mut self, subfacet: u32, vertex: VertexId) -> AllocResult<[u32; 3]> {
        let whole = self.subfacets[subfacet as usize];
        let parts = [subfacet, self.subfacets.len() as u32, self.subfacets.len() as u32 + 1];
        self.add_inside(vertex, whole.facet)?;
        self.subfacets.try_extend(&[whole; 2])?;
        self.faces.remove(&whole.vertices);
        for edge in 0..3 {
            let [a, b] = whole.ends(edge);
            let part = Subfacet {
                vertices: [vertex, a, b],
                neighbors: [whole.neighbors[edge], parts[(edge + 1) % 3], parts[(edge + 2) % 3]],
                subsegments: [whole.subsegments[edge], NONE, NONE],
                is_waiting: whole.is_waiting && edge == 0,
                ..whole
            };
            self.put(parts[edge], part, subfacet)?;
        }
        Ok(parts)
    }

    /// Splits an inner edge of a subfacet at `vertex`. Returns the four subfacets around it, each
    /// with the vertex as its number 0.
    pub fn split_inner_edge(
        &mut self,
        subfacet: u32,
        edge: usize,
        vertex: VertexId,
    ) -> AllocResult<[u32; 4]> {
        let (own, other) = (subfacet, self.get(subfacet).neighbors[edge]);
        let [a, b] = self.get(own).ends(edge);
        let beyond = self.get(other).edge_between(a, b).unwrap_or(0);
        self.add_inside(vertex, self.get(own).facet)?;
        let [first, second] = self.split_half(own, edge, vertex)?;
        let [third, fourth] = self.split_half(other, beyond, vertex)?;
        // The parts of one have the vertex between the same ends as those of the other, reversed.
        for (one, another) in [(first, fourth), (second, third)] {
            self.join_at(one, another, vertex);
        }
        Ok([first, second, third, fourth])
    }

    /// Splits a subsegment at `vertex` in all of its pages. `second`: the part of the subsegment
    /// behind the vertex, whose far end is `end`; the part before it keeps the number. Adds the
    /// subfacets that come of it to `made`, each with the vertex as its number 0.
    pub fn split_pages(
        &mut self,
        subsegment: u32,
        second: u32,
        [start, end]: [VertexId; 2],
        vertex: VertexId,
        made: &mut Vec<u32>,
    ) -> AllocResult<()> {
        self.pages.try_push(NONE)?;
        debug_assert_eq!(self.pages.len(), second as usize + 1);
        let Some(first_page) = self.page_of(subsegment) else { return Ok(()) };
        self.add_vertex(vertex)?;
        let before = made.len();
        let mut page = first_page;
        loop {
            let edge = self.get(page).edge_between(start, end);
            debug_assert!(edge.is_some(), "pages have the subsegment");
            let edge = edge.unwrap_or(0);
            let Subfacet { neighbors, facet, .. } = *self.get(page);
            let next = neighbors[edge];
            self.on[vertex] |= bit_of(facet);
            made.try_extend(&self.split_half(page, edge, vertex)?)?;
            if next == first_page {
                break;
            }
            page = next;
        }
        let parts = &made[before..];
        for (half, far) in [(subsegment, start), (second, end)] {
            let has_far = |&&part: &&u32| self.subfacets[part as usize].vertices.contains(&far);
            let first = parts.iter().copied().find(|part| has_far(&part)).unwrap_or(NONE);
            let mut last = first;
            for &part in parts {
                if !self.subfacets[part as usize].vertices.contains(&far) {
                    continue;
                }
                self.set_edge(last, [vertex, far], part, half);
                last = part;
            }
            self.set_edge(last, [vertex, far], first, half);
            self.pages[half as usize] = first;
        }
        Ok(())
    }

    fn set_edge(&mut self, subfacet: u32, [a, b]: [VertexId; 2], neighbor: u32, subsegment: u32) {
        let own = &mut self.subfacets[subfacet as usize];
        if let Some(edge) = own.edge_between(a, b) {
            (own.neighbors[edge], own.subsegments[edge]) = (neighbor, subsegment);
        }
    }

    /// Splits a subfacet from the middle of an edge, at `vertex`, to the vertex opposite. The edges
    /// that the old one becomes have no neighbours yet.
    fn split_half(
        &mut self,
        subfacet: u32,
        edge: usize,
        vertex: VertexId,
    ) -> AllocResult<[u32; 2]> {
        let whole = self.subfacets[subfacet as usize];
        let [a, b] = whole.ends(edge);
        let (apex, second) = (whole.vertices[edge], self.subfacets.len() as u32);
        let [at_b, at_a] = [(edge + 1) % 3, (edge + 2) % 3];
        self.subfacets.try_push(whole)?;
        self.faces.remove(&whole.vertices);
        let first_half = Subfacet {
            vertices: [vertex, apex, a],
            neighbors: [whole.neighbors[at_a], NONE, second],
            subsegments: [whole.subsegments[at_a], NONE, NONE],
            ..whole
        };
        let second_half = Subfacet {
            vertices: [vertex, b, apex],
            neighbors: [whole.neighbors[at_b], subfacet, NONE],
            subsegments: [whole.subsegments[at_b], NONE, NONE],
            is_waiting: false,
            ..whole
        };
        self.put(subfacet, first_half, subfacet)?;
        self.put(second, second_half, subfacet)?;
        Ok([subfacet, second])
    }

    /// Replaces an inner edge of a subfacet by the other diagonal of the two triangles there.
    /// Returns them; both have the vertices at the ends of the new edge.
    pub fn flip(&mut self, subfacet: u32, edge: usize) -> AllocResult<[u32; 2]> {
        let own = self.subfacets[subfacet as usize];
        let beyond = own.neighbors[edge];
        let other = self.subfacets[beyond as usize];
        let [a, b] = own.ends(edge);
        let mirror = other.edge_between(a, b).unwrap_or(0);
        let (apex, opposite) = (own.vertices[edge], other.vertices[mirror]);
        self.faces.remove(&own.vertices);
        self.faces.remove(&other.vertices);
        let [own_b, own_a] = [(edge + 1) % 3, (edge + 2) % 3];
        let [other_a, other_b] = [(mirror + 1) % 3, (mirror + 2) % 3];
        let first = Subfacet {
            vertices: [apex, a, opposite],
            neighbors: [other.neighbors[other_a], beyond, own.neighbors[own_a]],
            subsegments: [other.subsegments[other_a], NONE, own.subsegments[own_a]],
            is_limited: false,
            ..own
        };
        let second = Subfacet {
            vertices: [apex, opposite, b],
            neighbors: [other.neighbors[other_b], own.neighbors[own_b], subfacet],
            subsegments: [other.subsegments[other_b], own.subsegments[own_b], NONE],
            is_limited: false,
            ..other
        };
        self.put(subfacet, first, subfacet)?;
        self.put(beyond, second, beyond)?;
        // Edges that went from one to the other.
        self.move_edge(subfacet, 0, beyond);
        self.move_edge(beyond, 1, subfacet);
        Ok([subfacet, beyond])
    }

    /// Puts `part` in place of a subfacet; its edge 0 was one of `whole`.
    fn put(&mut self, number: u32, part: Subfacet, whole: u32) -> AllocResult<()> {
        self.faces.insert(&part.vertices, number)?;
        self.subfacets[number as usize] = Subfacet { is_limited: false, ..part };
        if number != whole {
            self.move_edge(number, 0, whole);
        }
        Ok(())
    }

    /// Tells what is beyond an edge of a subfacet that it was one of another before.
    fn move_edge(&mut self, subfacet: u32, edge: usize, before: u32) {
        let own = self.subfacets[subfacet as usize];
        let ([a, b], neighbor) = (own.ends(edge), own.neighbors[edge]);
        match own.subsegments[edge] {
            NONE => {
                let beyond = &mut self.subfacets[neighbor as usize];
                if let Some(mirror) = beyond.edge_between(a, b) {
                    beyond.neighbors[mirror] = subfacet;
                }
            }
            subsegment => self.move_page(subfacet, edge, before, subsegment),
        }
    }

    /// Puts a subfacet in the place of another one in a circle of pages.
    fn move_page(&mut self, subfacet: u32, edge: usize, before: u32, subsegment: u32) {
        let [a, b] = self.get(subfacet).ends(edge);
        if self.pages[subsegment as usize] == before {
            self.pages[subsegment as usize] = subfacet;
        }
        if self.get(subfacet).neighbors[edge] == before {
            self.subfacets[subfacet as usize].neighbors[edge] = subfacet;
            return;
        }
        let mut page = subfacet;
        loop {
            let own = self.get(page);
            let Some(edge) = own.edge_between(a, b) else { return };
            let next = own.neighbors[edge];
            if next == before {
                self.subfacets[page as usize].neighbors[edge] = subfacet;
                return;
            }
            page = next;
        }
    }

    /// Makes two subfacets neighbours at the edge that they share, one end of which is `vertex`.
    fn join_at(&mut self, one: u32, another: u32, vertex: VertexId) {
        let (first, second) = (*self.get(one), *self.get(another));
        let shared = first
            .vertices
            .into_iter()
            .find(|&other| other != vertex && second.vertices.contains(&other));
        let Some(shared) = shared else { return };
        self.set_edge(one, [vertex, shared], another, NONE);
        self.set_edge(another, [vertex, shared], one, NONE);
    }

    /// Adds a vertex that is in a facet, between its lines.
    fn add_inside(&mut self, vertex: VertexId, facet: u32) -> AllocResult<()> {
        self.add_vertex(vertex)?;
        self.inside[vertex] = facet;
        self.on[vertex] = bit_of(facet);
        Ok(())
    }

    fn add_vertex(&mut self, vertex: VertexId) -> AllocResult<()> {
        self.inside.cover(vertex.index() + 1, NONE)?;
        self.on.cover(vertex.index() + 1, 0)
    }
}
