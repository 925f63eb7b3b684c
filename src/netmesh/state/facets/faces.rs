//! The subfacet with given vertices.

use crate::complex::VertexId;
use crate::memory::{AllocError, AllocResult};
use crate::numerics::mixed;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hash, Hasher};

/// Positions of the vertices of a simplex's faces, counterclockwise as seen from the vertex
/// opposite, by the number of that vertex.
pub(in crate::netmesh) const FACES: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// Pairs of positions of a simplex's vertices: its edges.
pub(in crate::netmesh) const EDGES: [[usize; 2]; 6] =
    [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Three vertices of a face -> its subfacet.
#[derive(Default)]
pub(super) struct Faces {
    of: HashMap<Face, u32, BuildHasherDefault<Mixed>>,
}

/// Vertices of a face by rising number.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Face([u32; 3]);

impl Face {
    #[inline]
    fn new(vertices: &[VertexId; 3]) -> Self {
        let [a, b, c] = vertices.map(VertexId::number);
        let (low, high) = (a.min(b), a.max(b));
        Self([low.min(c), high.min(c).max(low), high.max(c)])
    }
}

impl Hash for Face {
    #[inline]
    fn hash<H: Hasher>(&self, state: &mut H) {
        let [a, b, c] = self.0.map(u64::from);
        state.write_u64(mixed(mixed(a << 32 | b) ^ c));
    }
}

/// Hasher of keys that are mixed already.
#[derive(Default)]
struct Mixed(u64);

impl Hasher for Mixed {
    fn write(&mut self, _: &[u8]) {
        unreachable!("faces are hashed as one number");
    }

    #[inline]
    fn write_u64(&mut self, number: u64) {
        self.0 = number;
    }

    #[inline]
    fn finish(&self) -> u64 {
        self.0
    }
}

impl Faces {
    #[inline]
    pub fn get(&self, vertices: &[VertexId; 3]) -> Option<u32> {
        self.of.get(&Face::new(vertices)).copied()
    }

    /// Reserves memory for so many more subfacets.
    pub fn reserve(&mut self, more: usize) -> AllocResult<()> {
        self.of.try_reserve(more).map_err(AllocError::from)
    }

    pub fn insert(&mut self, vertices: &[VertexId; 3], subfacet: u32) -> AllocResult<()> {
        self.reserve(1)?;
        self.of.insert(Face::new(vertices), subfacet);
        Ok(())
    }

    pub fn remove(&mut self, vertices: &[VertexId; 3]) {
        self.of.remove(&Face::new(vertices));
    }
}
