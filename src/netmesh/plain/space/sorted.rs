//! The tetrahedra of a triangulation in an order that depends on nothing but their corners.

use super::super::output::Simplices;
use super::tetrahedra::{INFINITE, Record, Tetrahedra};
use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, filled, prefetch_at};
use crate::mesh::NONE;
use crate::netmesh::state::order::InputId;
use crate::netmesh::state::watch::Watch;
use crate::netmesh::state::workers::{filled_on_threads, on_threads};
use std::mem::take;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Tetrahedra that are fetched while others are sorted.
const AHEAD: usize = 16;

/// Vertices whose tetrahedra a thread sorts in one go.
const PIECE: usize = 1 << 11;

impl Tetrahedra {
    /// Returns the finite tetrahedra, sorted by their corners, of which the least comes first and
    /// the least of the others second. `order`: the input that each vertex is.
    pub fn sorted(
        &self,
        order: &[InputId],
        threads: usize,
        watch: &mut Watch<'_, '_>,
    ) -> Result<Simplices> {
        let lists = self.by_least_corner(order.len(), watch)?;
        let rows = 4 * lists.tetrahedra.len();
        let none = || AtomicU32::new(NONE);
        let numbers = filled_on_threads(threads, watch, self.all().len(), none)?;
        let mut simplices = filled_on_threads(threads, watch, rows, || 0)?;
        let mut neighbors = filled_on_threads(threads, watch, rows, || 0)?;
        let pieces = Pieces {
            begin: 0,
            lists: &lists,
            simplices: &mut simplices,
            neighbors: &mut neighbors,
        };
        on_threads(threads, watch, pieces, |piece| {
            self.sort_lists(&lists, piece, order, &numbers)
        })?;
        on_threads(threads, watch, neighbors.chunks_mut(PIECE), |twins| {
            let number = |twin: u32| numbers[(twin / 4) as usize].load(Relaxed);
            twins.iter_mut().for_each(|twin| *twin = number(*twin));
            Ok(())
        })?;
        Ok(Simplices { vertices: simplices, neighbors })
    }

    /// Sorts the tetrahedra of some vertices, and writes the inputs at their corners, the faces
    /// that are twins of theirs, and their numbers.
    fn sort_lists(
        &self,
        lists: &Lists,
        piece: Piece<'_>,
        inputs: &[InputId],
        numbers: &[AtomicU32],
    ) -> AllocResult<()> {
        let (simplices, neighbors) =
            (piece.simplices.chunks_exact_mut(4), piece.neighbors.chunks_exact_mut(4));
        let mut rows = simplices.zip(neighbors).zip(lists.starts[piece.begin]..);
        let mut own = Vec::new();
        for ends in lists.starts[piece.begin..=piece.end].windows(2) {
            own.clear();
            for at in ends[0] as usize..ends[1] as usize {
                if let Some(&later) = lists.tetrahedra.get(at + AHEAD) {
                    prefetch_at(self.all(), later as usize, 1);
                }
                let tetrahedron = lists.tetrahedra[at];
                let corners = self.corners(tetrahedron);
                let [_, second, third, _] = order(&corners).map(|place| corners[place]);
                // A face has one tetrahedron on the side from which its corners turn left.
                own.try_push((u64::from(second) << 32 | u64::from(third), tetrahedron))?;
            }
            own.sort_unstable_by_key(|&(key, _)| key);
            for (&(_, tetrahedron), ((simplex, twins), number)) in own.iter().zip(&mut rows) {
                let record = self.at(tetrahedron);
                let (corners, faces) = (record.corners(), record.twins());
                let order = order(&corners);
                let input = |place: usize| inputs[corners[place] as usize].index() as u32;
                simplex.copy_from_slice(&order.map(input));
                twins.copy_from_slice(&order.map(|place| faces[place]));
                numbers[tetrahedron as usize].store(number, Relaxed);
            }
        }
        Ok(())
    }

    /// Returns the finite tetrahedra by their least corners.
    fn by_least_corner(&self, vertices: usize, watch: &mut Watch<'_, '_>) -> Result<Lists> {
        let mut starts = filled(vertices + 1, 0u32)?;
        for record in self.all() {
            watch.poll_after(1)?;
            if let Some(least) = least_corner(record) {
                starts[least as usize + 1] += 1;
            }
        }
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let mut tetrahedra = filled(starts[vertices] as usize, 0)?;
        for (record, tetrahedron) in self.all().iter().zip(0..) {
            watch.poll_after(1)?;
            if let Some(least) = least_corner(record) {
                // Beginnings are ends until their list is full.
                let end = &mut starts[least as usize + 1];
                *end -= 1;
                tetrahedra[*end as usize] = tetrahedron;
            }
        }
        starts.rotate_left(1);
        starts[vertices] = tetrahedra.len() as u32;
        Ok(Lists { starts, tetrahedra })
    }
}

/// Returns the least corner of a finite tetrahedron.
#[inline]
fn least_corner(record: &Record) -> Option<u32> {
    let [a, b, c, d] = record.corners();
    (d != INFINITE && !record.is_dead()).then(|| a.min(b).min(c.min(d)))
}

/// Tetrahedra of each vertex, one list after the other.
struct Lists {
    starts: Vec<u32>,
    tetrahedra: Vec<u32>,
}

/// Lists of some vertices, and the rows of their tetrahedra in the result.
struct Piece<'a> {
    begin: usize,
    end: usize,
    simplices: &'a mut [u32],
    neighbors: &'a mut [u32],
}

/// Pieces of the lists from some vertex on, with the rows that are left.
struct Pieces<'a> {
    begin: usize,
    lists: &'a Lists,
    simplices: &'a mut [u32],
    neighbors: &'a mut [u32],
}

impl<'a> Iterator for Pieces<'a> {
    type Item = Piece<'a>;

    fn next(&mut self) -> Option<Piece<'a>> {
        let (begin, starts) = (self.begin, &self.lists.starts);
        let end = (begin + PIECE).min(starts.len() - 1);
        if begin == end {
            return None;
        }
        let rows = 4 * (starts[end] - starts[begin]) as usize;
        let split = |left: &mut &'a mut [u32]| {
            let (own, rest) = take(left).split_at_mut(rows);
            *left = rest;
            own
        };
        self.begin = end;
        let (simplices, neighbors) = (split(&mut self.simplices), split(&mut self.neighbors));
        Some(Piece { begin, end, simplices, neighbors })
    }
}

/// Returns an even permutation of the places: that of the least corner, that of the least of the
/// others, and the other two.
#[inline]
fn order(corners: &[u32; 4]) -> [usize; 4] {
    const FIRST: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]];
    let lesser = |a: usize, b: usize| if corners[a] < corners[b] { a } else { b };
    let [first, a, b, c] = FIRST[lesser(lesser(0, 1), lesser(2, 3))];
    match lesser(a, lesser(b, c)) {
        second if second == a => [first, a, b, c],
        second if second == b => [first, b, c, a],
        _ => [first, c, a, b],
    }
}
