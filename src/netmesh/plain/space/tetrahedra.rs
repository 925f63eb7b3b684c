//! Tetrahedra that share faces. What is outside of the hull is tetrahedra as well, with a vertex at
//! infinity as their last corner: each face of the hull has one.
//!
//! Threads that insert in parts of space of their own work on one and the same arrays, and so all
//! of them is atomic. No order is needed: a thread reads what others write only after they have
//! joined.

use crate::error::Result;
use crate::memory::{AllocError, AllocResult, prefetch, reserve, with_capacity};
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// The vertex at infinity.
pub(super) const INFINITE: u32 = u32::MAX;

/// Largest number of tetrahedra whose faces have ids.
const MOST: usize = (u32::MAX / 4) as usize;

/// A face of a tetrahedron: four times its tetrahedron, and the place of the corner opposite.
pub(super) type Face = u32;

/// Places of the corners of each face, so that with a vertex in the place of the opposite corner
/// the tetrahedron is an even permutation of the three and the vertex.
pub(super) const FACES: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [1, 0, 3], [0, 1, 2]];

/// Mark of a first corner: the tetrahedron is no more, or not yet.
const DEAD: u32 = 1 << 31;

/// Corners of a tetrahedron, and for each face that of the other one there.
#[repr(align(32))]
pub(super) struct Record {
    corners: [AtomicU32; 4],
    twins: [AtomicU32; 4],
}

impl Record {
    /// Returns the corners; of a dead tetrahedron those that it had.
    #[inline]
    pub fn corners(&self) -> [u32; 4] {
        let [a, b, c, d] = &self.corners;
        [a.load(Relaxed) & !DEAD, b.load(Relaxed), c.load(Relaxed), d.load(Relaxed)]
    }

    /// Returns the faces on the other sides of the faces opposite the corners.
    #[inline]
    pub fn twins(&self) -> [Face; 4] {
        let [a, b, c, d] = &self.twins;
        [a.load(Relaxed), b.load(Relaxed), c.load(Relaxed), d.load(Relaxed)]
    }

    #[inline]
    pub fn is_dead(&self) -> bool {
        self.corners[0].load(Relaxed) & DEAD != 0
    }

    /// Kills a tetrahedron, whose corners and twins stay until its place is needed.
    #[inline]
    pub fn kill(&self) {
        self.corners[0].store(self.corners[0].load(Relaxed) | DEAD, Relaxed);
    }

    /// Brings back a tetrahedron that was killed.
    pub fn revive(&self) {
        self.corners[0].store(self.corners[0].load(Relaxed) & !DEAD, Relaxed);
    }

    /// Makes a tetrahedron in the place of a dead one.
    #[inline]
    pub fn set(&self, corners: [u32; 4]) {
        for (place, corner) in self.corners.iter().zip(corners) {
            place.store(corner, Relaxed);
        }
    }

    /// Makes a face that of another tetrahedron, too.
    #[inline]
    pub fn join(&self, place: usize, other: Face) {
        self.twins[place].store(other, Relaxed);
    }
}

pub(super) struct Tetrahedra {
    records: Vec<Record>,
}

impl Tetrahedra {
    /// Makes a tetrahedron of corners with positive orientation and those beyond its faces, and
    /// room for what some `vertices` need if they are uniform.
    pub fn new(corners: [u32; 4], vertices: usize) -> Result<Self> {
        let expected = 7 * vertices + 64;
        let mut made = Self { records: with_capacity(expected)? };
        made.grow(5)?;
        made.at(0).set(corners);
        for (face, beyond) in (0..4).zip(1..5) {
            let [a, b, c] = FACES[face as usize].map(|place| corners[place]);
            made.at(beyond).set([b, a, c, INFINITE]);
            made.join(face, 4 * beyond + 3);
        }
        for (one, other) in (1..5).flat_map(|one| (one + 1..5).map(move |other| (one, other))) {
            made.join_infinite(one, other);
        }
        Ok(made)
    }

    /// Joins two of the first infinite tetrahedra at the face that they share.
    fn join_infinite(&self, one: u32, other: u32) {
        let (a, b) = (self.corners(one), self.corners(other));
        let alone = |of: &[u32; 4], from: &[u32; 4]| {
            of.iter().position(|corner| !from.contains(corner)).expect("they differ") as u32
        };
        self.join(4 * one + alone(&a, &b), 4 * other + alone(&b, &a));
    }

    /// Adds dead tetrahedra, at least so many.
    pub fn grow(&mut self, least: usize) -> AllocResult<Range<u32>> {
        let begin = self.records.len();
        reserve(&mut self.records, least)?;
        let end = (begin + least.max(begin / 8)).min(self.records.capacity()).min(MOST);
        if end < begin + least {
            return Err(AllocError::Ids);
        }
        let none = || [const { AtomicU32::new(DEAD) }; 4];
        self.records.resize_with(end, || Record { corners: none(), twins: none() });
        Ok(begin as u32..end as u32)
    }

    #[inline]
    pub fn at(&self, tetrahedron: u32) -> &Record {
        &self.records[tetrahedron as usize]
    }

    /// Prefetches the tetrahedra on the other sides of a tetrahedron's faces.
    #[inline]
    pub fn prefetch_neighbors(&self, record: &Record) {
        for twin in record.twins() {
            prefetch(&self.records, (twin / 4) as usize);
        }
    }

    /// Returns the array of all, with its spare memory.
    pub fn records(&mut self) -> &mut Vec<Record> {
        &mut self.records
    }

    pub fn all(&self) -> &[Record] {
        &self.records
    }

    #[inline]
    pub fn corners(&self, tetrahedron: u32) -> [u32; 4] {
        self.at(tetrahedron).corners()
    }

    #[inline]
    pub fn twin(&self, face: Face) -> Face {
        self.at(face / 4).twins[(face % 4) as usize].load(Relaxed)
    }

    pub fn has_finite_corners(&self, tetrahedron: u32) -> bool {
        self.corners(tetrahedron)[3] != INFINITE
    }

    /// Makes two faces the sides of one.
    fn join(&self, face: Face, other: Face) {
        self.at(face / 4).join((face % 4) as usize, other);
        self.at(other / 4).join((other % 4) as usize, face);
    }
}
