//! Points in the order in which a sweep meets them: by x, and where that is equal by y.

use crate::memory::{AllocResult, collected, filled};

/// The order of points, in which both zeros are equal.
pub(super) type Key = [u64; 2];

pub(super) fn key(point: &[f64; 2]) -> Key {
    point.map(ordered_bits)
}

/// Returns a number that is in the order of finite doubles; both zeros have the same.
pub(super) fn ordered_bits(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// Distinct points by their order; the place of a point in it is its rank.
pub(super) struct Places {
    /// Rank to point.
    pub points: Vec<[f64; 2]>,
    /// Rank to the vertex that the point is.
    pub vertices: Vec<u32>,
    /// Vertex to rank.
    pub ranks: Vec<u32>,
}

impl Places {
    /// Of vertices at distinct points, fewer than 2^32. O(n log n).
    pub fn new(points: &[[f64; 2]]) -> AllocResult<Self> {
        let keys = points.iter().zip(0u32..).map(|(point, vertex)| (key(point), vertex));
        let mut keys = collected(keys)?;
        keys.sort_unstable();
        let vertices = collected(keys.iter().map(|&(_, vertex)| vertex))?;
        let mut ranks = filled(vertices.len(), 0)?;
        for (&vertex, rank) in vertices.iter().zip(0u32..) {
            ranks[vertex as usize] = rank;
        }
        let points = collected(vertices.iter().map(|&vertex| points[vertex as usize]))?;
        Ok(Self { points, vertices, ranks })
    }

    pub fn point(&self, rank: u32) -> &[f64; 2] {
        &self.points[rank as usize]
    }

    /// The rank of a point that is here. O(log n).
    pub fn find(&self, point: &[f64; 2]) -> Option<u32> {
        let at = self.points.partition_point(|other| key(other) < key(point));
        self.points.get(at).filter(|other| *other == point).map(|_| at as u32)
    }
}

/// The order of points along a segment that falls in the axes that are so marked: by x, where that
/// is equal by y. Rounding keeps the order of points on a segment in each coordinate, so that
/// rounded points are in order too.
pub(super) fn key_along(point: &[f64; 2], falls: [bool; 2]) -> Key {
    let key = key(point);
    [0, 1].map(|axis| if falls[axis] { !key[axis] } else { key[axis] })
}
