//! The sides of triangles, by edge.

use crate::arrangement::poll::Poll;
use crate::error::Result;
use crate::memory::{sorted_in_buckets, with_capacity};

/// Side of a triangle: the edge opposite one of its vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// Ends of the edge, the smaller vertex first.
    pub ends: [u32; 2],
    pub triangle: u32,
    pub opposite: u8,
}

/// Sides of triangles, sorted by edge and triangle.
pub(super) struct Sides(Vec<Side>);

impl Sides {
    /// Collects the sides of triangles, which are given by their vertices. O(n log n).
    pub fn of_triangles(triangles: &[[u32; 3]], poll: Poll<'_>) -> Result<Self> {
        let mut sides = with_capacity(3 * triangles.len())?;
        for (triangle, own) in (0u32..).zip(triangles) {
            for opposite in 0..3u8 {
                let [x, y] = ends(own, opposite);
                sides.push(Side { ends: [x.min(y), x.max(y)], triangle, opposite });
            }
        }
        Ok(Self(sorted_in_buckets(&sides, |side| side.ends[0], poll)?))
    }

    /// Returns the sides of each edge.
    pub fn groups(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| a.ends == b.ends)
    }

    /// Returns the edges that one of the triangles has alone; sorted.
    pub fn rim(&self) -> impl Iterator<Item = [u32; 2]> {
        self.groups().filter(|group| group.len() == 1).map(|one| one[0].ends)
    }
}

impl Side {
    /// Returns the ends of the side in the direction of its triangle, and the vertex opposite.
    pub fn within(&self, triangles: &[[u32; 3]]) -> ([u32; 2], u32) {
        let own = &triangles[self.triangle as usize];
        (ends(own, self.opposite), own[usize::from(self.opposite)])
    }

    /// Returns true if the triangle runs through the edge from the smaller vertex to the larger.
    pub fn runs_up(&self, triangles: &[[u32; 3]]) -> bool {
        self.within(triangles).0 == self.ends
    }
}

fn ends(triangle: &[u32; 3], opposite: u8) -> [u32; 2] {
    let k = usize::from(opposite);
    [triangle[(k + 1) % 3], triangle[(k + 2) % 3]]
}
