//! All faces of the simplices, each once.

use super::keys::{Entry, Key, bits_of_ids, sort};
use crate::arrays::Lists;
use crate::error::Result;
use crate::memory::{AllocError, AllocResult, collected, copied, filled, with_capacity};
use crate::mesh::{MAX_DIM, Triangulation};
use crate::query::check_arrays;
use crate::query::threads::{on_threads, threads as threads_of};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// The faces of all dimensions from some on up to that of the simplices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faces {
    /// The least dimension that is there.
    lowest: usize,
    /// Faces of each dimension, from the lowest.
    levels: Vec<Level>,
    /// The id that each simplex has as a face.
    of_simplices: Vec<u32>,
}

/// The faces of one dimension `k`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Level {
    k: usize,
    /// Vertices of the faces: `faces x (k + 1)` ids, ascending within a face; the faces in
    /// lexicographic order.
    pub vertices: Vec<u32>,
    /// Facets of the faces: `faces x (k + 1)` ids of faces of dimension `k - 1`, where entry `i` is
    /// the face without vertex `i`. Empty where those are not there.
    pub boundary: Vec<u32>,
}

impl Level {
    /// Returns the number of faces.
    pub fn count(&self) -> usize {
        self.vertices.len() / (self.k + 1)
    }

    /// Returns the vertices of a face.
    pub fn face(&self, at: usize) -> &[u32] {
        &self.vertices[at * (self.k + 1)..][..self.k + 1]
    }

    /// Returns for each of `below` faces of dimension `k - 1` the faces that have it as a facet,
    /// ascending.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn coboundary(&self, below: usize) -> Result<Lists> {
        let facets = || self.boundary.chunks_exact(self.k + 1).enumerate();
        let pairs = || {
            facets().flat_map(|(at, facets)| facets.iter().map(move |&facet| (facet, at as u32)))
        };
        Ok(Lists::of_pairs(below, pairs)?)
    }

    /// Returns the facets of a face.
    pub fn facets(&self, at: usize) -> &[u32] {
        &self.boundary[at * (self.k + 1)..][..self.k + 1]
    }
}

impl Faces {
    /// Finds the faces of dimension `lowest` and more. Those of dimension 0 are all vertices of the
    /// mesh, so that the id of each is its own. `threads` is the number of threads, 0 for all
    /// cores. O(faces x dim log(faces at a vertex)).
    ///
    /// # Errors
    /// `InvalidArgument` (arrays that do not fit together), `Limit` (more faces of a dimension, or
    /// of facets of them, than 32-bit ids can name), `OutOfMemory`.
    pub fn new(mesh: &Triangulation, lowest: usize, threads: u32) -> Result<Self> {
        check_arrays(mesh)?;
        Ok(Self::top_down(mesh, lowest.min(mesh.dim), threads_of(threads))?)
    }

    fn top_down(mesh: &Triangulation, lowest: usize, threads: usize) -> AllocResult<Self> {
        let (dim, count) = (mesh.dim, mesh.vertex_count());
        let mut levels = with_capacity(dim + 1 - lowest)?;
        let (simplices, of_simplices) = simplices(mesh, threads)?;
        levels.push(simplices);
        for k in (lowest..dim).rev() {
            let above = &mut levels[dim - k - 1];
            let (vertices, boundary) = facets(count, above, threads)?;
            above.boundary = boundary;
            levels.push(Level { k, vertices, boundary: Vec::new() });
        }
        levels.reverse();
        Ok(Self { lowest, levels, of_simplices })
    }

    /// Returns the faces of dimension `k`, which must be there.
    pub fn of_dimension(&self, k: usize) -> &Level {
        &self.levels[k - self.lowest]
    }

    /// Returns the dimension of the simplices.
    pub fn dim(&self) -> usize {
        self.lowest + self.levels.len() - 1
    }

    /// Returns for each simplex of the mesh its id among the faces of its dimension.
    pub fn of_simplices(&self) -> &[u32] {
        &self.of_simplices
    }

    /// Returns the least dimension that is there.
    pub fn lowest(&self) -> usize {
        self.lowest
    }
}

/// Expands to `body` with the type of keys of `k` vertices.
macro_rules! with_key {
    ($k:expr, $bits:expr, $K:ident => $body:expr) => {
        match $k as u32 * $bits {
            ..=64 => {
                type $K = u64;
                $body
            }
            ..=128 => {
                type $K = u128;
                $body
            }
            _ => {
                type $K = [u32; MAX_DIM];
                $body
            }
        }
    };
}

/// Returns the simplices, their vertices ascending, and the id of each.
fn simplices(mesh: &Triangulation, threads: usize) -> AllocResult<(Level, Vec<u32>)> {
    let (dim, count) = (mesh.dim, mesh.vertex_count());
    let mut sorted = copied(&mesh.simplices)?;
    sorted.chunks_exact_mut(dim + 1).for_each(<[u32]>::sort_unstable);
    let bits = bits_of_ids(count);
    let (vertices, ids) = with_key!(dim, bits, K => {
        let simplices = || sorted.chunks_exact(dim + 1);
        let mut given = Given::<K>::new(count, dim, simplices().map(|simplex| (simplex[0], 1)))?;
        for (at, simplex) in simplices().enumerate() {
            given.push(simplex[0], K::pack(&simplex[1..], bits), at as u32);
        }
        given.distinct(threads)?
    });
    Ok((Level { k: dim, vertices, boundary: Vec::new() }, ids))
}

/// Returns the facets of the faces of a dimension, and its boundary.
fn facets(count: usize, above: &Level, threads: usize) -> AllocResult<(Vec<u32>, Vec<u32>)> {
    let k = above.k - 1;
    u32::try_from(above.vertices.len()).map_err(|_| AllocError::Ids)?;
    let faces = || above.vertices.chunks_exact(k + 2);
    if k == 0 {
        // Without its first vertex an edge is its second.
        let boundary = collected(faces().flat_map(|ends| [ends[1], ends[0]]))?;
        return Ok((collected(0..count as u32)?, boundary));
    }
    let bits = bits_of_ids(count);
    with_key!(k + 1, bits, K => {
        // One facet of each face lacks its first vertex.
        let firsts = faces().flat_map(|face| [(face[0], k + 1), (face[1], 1)]);
        let mut given = Given::<K>::new(count, k, firsts)?;
        for (at, face) in faces().enumerate() {
            let (others, place) = (K::pack(&face[1..], bits), (at * (k + 2)) as u32);
            given.push(face[1], others.without(0, k + 1, bits), place);
            for i in 0..=k {
                given.push(face[0], others.without(i, k + 1, bits), place + i as u32 + 1);
            }
        }
        given.distinct(threads)
    })
}

/// Faces of one dimension, some of them more than once: for each vertex those of which it is the
/// first, as keys of the other vertices.
struct Given<K> {
    /// The dimension of the faces.
    k: usize,
    bits: u32,
    /// Position of the next entry of each vertex; in the end, the end of its list.
    ends: Vec<usize>,
    entries: Vec<Entry<K>>,
}

impl<K: Key> Given<K> {
    /// Lists of the lengths that `firsts` says: pairs of a vertex and a number of faces.
    fn new(
        count: usize,
        k: usize,
        firsts: impl Iterator<Item = (u32, usize)>,
    ) -> AllocResult<Self> {
        let mut starts = filled(count + 1, 0usize)?;
        firsts.for_each(|(vertex, faces)| starts[vertex as usize + 1] += faces);
        (0..count).for_each(|vertex| starts[vertex + 1] += starts[vertex]);
        let entries = filled(starts[count], (K::default(), 0))?;
        starts.truncate(count);
        Ok(Self { k, bits: bits_of_ids(count), ends: starts, entries })
    }

    /// Adds a face by its first vertex and the key of the others. It is number `place` of all.
    #[inline]
    fn push(&mut self, first: u32, others: K, place: u32) {
        let end = &mut self.ends[first as usize];
        self.entries[*end] = (others, place);
        *end += 1;
    }

    /// Returns the vertices of the distinct faces in lexicographic order, and the id of each that
    /// was added.
    fn distinct(mut self, threads: usize) -> AllocResult<(Vec<u32>, Vec<u32>)> {
        let counts = self.sort(threads)?;
        let total = counts.iter().sum::<usize>();
        u32::try_from(total).map_err(|_| AllocError::Ids)?;
        let (k, bits) = (self.k, self.bits);
        let mut faces = filled(total * (k + 1), 0u32)?;
        let ids = collected(self.entries.iter().map(|_| AtomicU32::new(0)))?;
        let (mut rest, mut first) = (&mut faces[..], 0);
        let pieces = self.pieces().zip(&counts).map(|(piece, &count)| {
            let (faces, others) = std::mem::take(&mut rest).split_at_mut(count * (k + 1));
            rest = others;
            let next = first + count as u32;
            (piece, faces, std::mem::replace(&mut first, next))
        });
        on_threads(threads, pieces, |(), (piece, faces, mut id)| {
            let mut faces = faces.chunks_exact_mut(k + 1);
            for (vertex, list) in piece.lists() {
                for (same, face) in list.chunk_by(|a, b| a.0 == b.0).zip(&mut faces) {
                    face[0] = vertex;
                    same[0].0.unpack(bits, &mut face[1..]);
                    // Places of different entries differ.
                    let write = |&(_, place): &Entry<K>| ids[place as usize].store(id, Relaxed);
                    same.iter().for_each(write);
                    id += 1;
                }
            }
            Ok(())
        })?;
        Ok((faces, collected(ids.into_iter().map(AtomicU32::into_inner))?))
    }

    /// Sorts each list. Returns how many distinct faces each piece has.
    fn sort(&mut self, threads: usize) -> AllocResult<Vec<usize>> {
        let bits = self.k as u32 * self.bits;
        let mut counts = filled(self.ends.len().div_ceil(PIECE), 0)?;
        let pieces = self.pieces().zip(&mut counts);
        on_threads(threads, pieces, |spare, (piece, count)| {
            for (_, list) in piece.lists() {
                sort(list, bits, spare)?;
                *count += list.chunk_by(|a, b| a.0 == b.0).count();
            }
            Ok(())
        })?;
        Ok(counts)
    }

    /// Splits the lists into pieces of work.
    fn pieces(&mut self) -> impl Iterator<Item = Piece<'_, K>> {
        let (mut rest, mut start) = (&mut self.entries[..], 0);
        self.ends.chunks(PIECE).enumerate().map(move |(at, ends)| {
            let end = ends[ends.len() - 1];
            let (entries, others) = std::mem::take(&mut rest).split_at_mut(end - start);
            rest = others;
            let first = std::mem::replace(&mut start, end);
            Piece { vertex: (at * PIECE) as u32, first, ends, entries }
        })
    }
}

/// The lists of some vertices.
struct Piece<'a, K> {
    /// The first vertex.
    vertex: u32,
    /// Position where the list of the first vertex begins.
    first: usize,
    /// Positions where the lists end.
    ends: &'a [usize],
    entries: &'a mut [Entry<K>],
}

impl<'a, K> Piece<'a, K> {
    /// Returns the vertices and their lists.
    fn lists(self) -> impl Iterator<Item = (u32, &'a mut [Entry<K>])> {
        let (mut rest, mut start) = (self.entries, self.first);
        (self.vertex..).zip(self.ends).map(move |(vertex, &end)| {
            let (list, others) = std::mem::take(&mut rest).split_at_mut(end - start);
            (rest, start) = (others, end);
            (vertex, list)
        })
    }
}

/// The lists of as many vertices make a piece of work.
const PIECE: usize = 64;
