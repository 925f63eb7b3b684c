//! Points in the order in which a sweep meets them: by x, and by y where x is equal.

use crate::memory::{AllocResult, collected, filled};

/// Key that sorts points as the sweep meets them; both zeros are equal.
pub(super) type Key = [u64; 2];

pub(super) fn key(point: &[f64; 2]) -> Key {
    point.map(ordered_bits)
}

/// Returns an integer that sorts as finite doubles do; both zeros have the same.
pub(super) fn ordered_bits(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// Distinct points in the order of the sweep; the position of a point in it is its rank.
pub(super) struct RankedVertices {
    /// Rank -> point.
    pub points: Vec<[f64; 2]>,
    /// Rank -> the vertex at that point.
    pub vertices: Vec<u32>,
    /// Vertex -> its rank.
    pub ranks: Vec<u32>,
}

impl RankedVertices {
    /// Sorts vertices at distinct points, of which there are fewer than 2^32. O(n log n).
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

    /// Returns the rank of a point; `None` if no vertex is there. O(log n).
    pub fn find(&self, point: &[f64; 2]) -> Option<u32> {
        let at = self.points.partition_point(|other| key(other) < key(point));
        self.points.get(at).filter(|other| *other == point).map(|_| at as u32)
    }
}

/// Returns a key that sorts points along a segment, which descends on the axes where `falls` is
/// true: by x, and by y where x is equal. Rounding keeps the order of a segment's points in each
/// coordinate, so that rounded points are in order too.
pub(super) fn key_along(point: &[f64; 2], falls: [bool; 2]) -> Key {
    let key = key(point);
    [0, 1].map(|axis| if falls[axis] { !key[axis] } else { key[axis] })
}
