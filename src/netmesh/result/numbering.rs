//! The numbers that vertices and simplices have in the result: inputs first, in the caller's order.
//! Of a mesh with segments, what is of the domain comes before what is outside, so that a result
//! which is cut to the domain has the first numbers.

use crate::complex::{SimplexId, VertexId};
use crate::error::Result;
use crate::memory::{AllocError, collected, filled, with_capacity};
use crate::mesh::NONE;
use crate::netmesh::state::hierarchy::DomainId;
use crate::netmesh::state::workers::{PIECE, on_threads, pieces};
use crate::netmesh::state::{Mesher, State};

/// Side of the domain's boundary that a vertex is on.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    /// The vertex is in no simplex of the result.
    Nowhere,
    Outside,
    Inside,
}

pub(super) struct Numbering {
    /// Vertex -> its number, [`NONE`] if the result has it not.
    pub vertices: Vec<u32>,
    /// Number -> vertex.
    pub order: Vec<VertexId>,
    /// Simplex -> its number.
    pub simplices: Vec<u32>,
    /// Numbers of simplices inside in each piece, then those outside.
    pub counts: Vec<usize>,
    /// Numbers of vertices and of simplices inside.
    pub inside_vertices: usize,
    pub inside_simplices: usize,
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Assigns numbers to the vertices and simplices of the result. `is_outside`: simplex -> true
    /// if it is outside of the domain; empty if none is.
    pub(super) fn numbering(&mut self, is_outside: &[bool]) -> Result<Numbering> {
        let (simplices, counts) = self.simplex_numbers(is_outside)?;
        let inside_simplices = counts[..counts.len() / 2].iter().sum();
        let sides = self.sides_of_vertices(is_outside)?;
        let inputs = self.state.inputs;
        let mut order = filled(inputs, VertexId::NONE)?;
        order.try_reserve_exact(sides.len() - inputs).map_err(AllocError::from)?;
        for (vertex, &input) in self.order.iter().enumerate() {
            self.watch.poll_after(1)?;
            order[input.index()] = VertexId::new(vertex);
        }
        let others = || VertexId::range(inputs..sides.len());
        order.extend(others().filter(|&vertex| sides[vertex] == Side::Inside));
        let inside_vertices = order.len();
        order.extend(others().filter(|&vertex| sides[vertex] == Side::Outside));
        let mut vertices = filled(sides.len(), NONE)?;
        for (number, &vertex) in (0..).zip(&order) {
            self.watch.poll_after(1)?;
            vertices[vertex] = number;
        }
        Ok(Numbering { vertices, order, simplices, counts, inside_vertices, inside_simplices })
    }

    /// Assigns numbers to the finite simplices by rising ids, those inside first, and counts them
    /// in each piece.
    fn simplex_numbers(&mut self, is_outside: &[bool]) -> Result<(Vec<u32>, Vec<usize>)> {
        let threads = self.state.threads();
        let Self { state, watch, .. } = self;
        let complex = state.delaunay.complex();
        let bound = complex.simplex_bound();
        let side = |simplex: SimplexId| {
            let is_finite = complex.is_live(simplex) && !complex.is_infinite(simplex);
            let is_outside = is_outside.get(simplex.index()).copied().unwrap_or(false);
            is_finite.then_some(usize::from(is_outside))
        };
        let of_pieces = on_threads(threads, watch, pieces(bound), |piece| {
            let mut counts = [0; 2];
            piece.filter_map(side).for_each(|side| counts[side] += 1);
            Ok(counts)
        })?;
        let mut counts = with_capacity(2 * of_pieces.len())?;
        (0..2).for_each(|side| counts.extend(of_pieces.iter().map(|counts| counts[side])));
        let starts = collected(counts.iter().scan(0, |next, &count| {
            let start = *next;
            *next += count as u32;
            Some(start)
        }))?;
        let mut numbers = filled(bound, NONE)?;
        let own = pieces(bound).zip(numbers.chunks_mut(PIECE)).enumerate();
        on_threads(threads, watch, own, |(at, (piece, numbers))| {
            let mut next = [starts[at], starts[of_pieces.len() + at]];
            for (simplex, number) in piece.zip(numbers) {
                if let Some(side) = side(simplex) {
                    *number = next[side];
                    next[side] += 1;
                }
            }
            Ok(())
        })?;
        Ok((numbers, counts))
    }

    /// Returns the side of every vertex. Inputs and the centres of domains are inside, wherever
    /// their simplices are.
    fn sides_of_vertices(&mut self, is_outside: &[bool]) -> Result<Vec<Side>> {
        let count = self.state.delaunay.point_count();
        if !self.state.segments.is_active() {
            let mut sides = filled(count, Side::Inside)?;
            self.state.removed.iter().for_each(|&vertex| sides[vertex] = Side::Nowhere);
            return Ok(sides);
        }
        let mut sides = filled(count, Side::Nowhere)?;
        sides[..self.state.inputs].fill(Side::Inside);
        for domain in (0..self.state.hierarchy.len()).map(DomainId::new) {
            let node = self.state.hierarchy.node(domain);
            if node.alive {
                sides[node.center] = Side::Inside;
            }
        }
        for (simplex, &is_outside) in SimplexId::below(is_outside.len()).zip(is_outside) {
            self.watch.poll_after(1)?;
            let State { delaunay, .. } = &self.state;
            if !delaunay.complex().is_live(simplex) || delaunay.complex().is_infinite(simplex) {
                continue;
            }
            for &vertex in delaunay.complex().vertices(simplex) {
                match is_outside {
                    false => sides[vertex] = Side::Inside,
                    true if sides[vertex] == Side::Nowhere => sides[vertex] = Side::Outside,
                    true => {}
                }
            }
        }
        Ok(sides)
    }
}
