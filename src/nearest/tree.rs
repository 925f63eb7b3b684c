//! A balanced k-d tree of points: it bounds a search for the nearest one, brings queries into an
//! order of locality and names a vertex to walk from. Since it halves points instead of space, it
//! is O(log n) deep whatever the spread.

use crate::memory::{AllocResult, collected, filled, reserve, with_capacity};
use crate::numerics::coordinates;

/// Largest number of points in a leaf; a leaf has more than half of it unless it is the only one.
const LEAF: usize = 8;

/// Division of a range of points: no coordinate on this axis is larger than `value` in the first
/// half, and none is smaller in the second.
#[derive(Clone, Copy)]
pub(crate) struct Node {
    pub value: f64,
    pub axis: u32,
}

pub(crate) struct Tree {
    /// Number of divisions on the way to a leaf.
    levels: u32,
    /// Divisions: node 1 is the root, nodes 2 i and 2 i + 1 are the halves of node i.
    nodes: Vec<Node>,
    /// Ids of the points, leaf by leaf.
    ids: Vec<u32>,
    /// Coordinates of the points, in the order of `ids`.
    points: Vec<f64>,
}

impl Tree {
    /// Builds the tree of the points with the given ids. O(n log n).
    pub fn new<const D: usize>(points: &[f64], mut ids: Vec<u32>) -> AllocResult<Self> {
        let point = |id: u32| coordinates::<D>(points, id as usize);
        let mut levels = 0;
        while ids.len() >> levels > LEAF {
            levels += 1;
        }
        let mut nodes = filled(1 << levels, Node { value: 0.0, axis: 0 })?;
        for level in 0..levels {
            for at in 0..1usize << level {
                let begin = bound(ids.len(), at, level);
                let middle = bound(ids.len(), 2 * at + 1, level + 1);
                let end = bound(ids.len(), at + 1, level);
                let half = &mut ids[begin..end];
                let axis = widest_axis(point, half);
                let coordinate = |id: &u32| point(*id)[axis];
                let (_, &mut median, _) = half.select_nth_unstable_by(middle - begin, |a, b| {
                    coordinate(a).total_cmp(&coordinate(b))
                });
                let value = coordinate(&median);
                nodes[(1 << level) + at] = Node { value, axis: axis as u32 };
            }
        }
        let mut own = with_capacity(ids.len() * D)?;
        ids.iter().for_each(|&id| own.extend_from_slice(point(id)));
        Ok(Self { levels, nodes, ids, points: own })
    }

    /// Builds the tree of all points, of which there must be fewer than 2^32. O(n log n).
    pub fn of_all<const D: usize>(points: &[f64]) -> AllocResult<Self> {
        Self::new::<D>(points, collected(0..(points.len() / D) as u32)?)
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.ids) + size_of_val(&*self.points)
    }

    /// Returns the leaf to which a point belongs, numbered from 0 in the order of the tree.
    #[inline]
    pub fn leaf<const D: usize>(&self, point: &[f64; D]) -> usize {
        let mut node = 1;
        for _ in 0..self.levels {
            let Node { value, axis } = self.nodes[node];
            node = 2 * node + usize::from(point[axis as usize] >= value);
        }
        node - (1 << self.levels)
    }

    /// Returns the ids of a leaf's points with their coordinates.
    #[inline]
    pub fn members<const D: usize>(&self, leaf: usize) -> impl Iterator<Item = (u32, &[f64; D])> {
        let n = self.ids.len();
        let range = bound(n, leaf, self.levels)..bound(n, leaf + 1, self.levels);
        let points = self.points[range.start * D..range.end * D].chunks_exact(D);
        let points = points.map(|point| point.try_into().expect("D coordinates"));
        self.ids[range].iter().copied().zip(points)
    }

    /// Returns the division at `node`; `None` for a leaf.
    #[inline]
    pub fn node(&self, node: usize) -> Option<Node> {
        self.nodes.get(node).copied()
    }

    /// Returns the number of leaves, a power of two.
    pub fn leaf_count(&self) -> usize {
        1 << self.levels
    }

    /// Returns the leaf with a node's number: leaves are numbered on after the last division.
    #[inline]
    pub fn leaf_at(&self, node: usize) -> usize {
        node - (1 << self.levels)
    }

    /// Returns the id of a point of the leaf, one of those nearest to `point` in the maximum norm,
    /// which cannot underflow.
    #[inline]
    pub fn near<const D: usize>(&self, leaf: usize, point: &[f64; D]) -> Option<u32> {
        let (mut least, mut near) = (f64::INFINITY, None);
        for (id, other) in self.members::<D>(leaf) {
            let mut size = 0.0f64;
            for axis in 0..D {
                let x = (other[axis] - point[axis]).abs();
                size = if x > size { x } else { size };
            }
            if size < least || near.is_none() {
                (least, near) = (size, Some(id));
            }
        }
        near
    }
}

/// Returns the position where piece `at` of 2^`level` equal pieces of `count` begins.
#[inline]
fn bound(count: usize, at: usize, level: u32) -> usize {
    ((count as u64 * at as u64) >> level) as usize
}

fn widest_axis<'a, const D: usize>(point: impl Fn(u32) -> &'a [f64; D], ids: &[u32]) -> usize {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for &id in ids {
        for (axis, &x) in point(id).iter().enumerate() {
            low[axis] = low[axis].min(x);
            high[axis] = high[axis].max(x);
        }
    }
    // A width beyond the doubles is as good as any other.
    let width = |axis: usize| high[axis] - low[axis];
    (1..D).fold(0, |widest, axis| if width(axis) > width(widest) { axis } else { widest })
}

/// Sorts points by the leaves to which they belong: each of the `keys` becomes a leaf in its upper
/// half and the number of a point in its lower half.
pub(crate) fn sort_by_leaf<const D: usize>(
    tree: &Tree,
    points: &[f64],
    keys: &mut Vec<u64>,
) -> AllocResult<()> {
    keys.clear();
    reserve(keys, points.len() / D)?;
    let leaf = |at: usize| tree.leaf(coordinates::<D>(points, at));
    keys.extend((0..points.len() / D).map(|at| (leaf(at) as u64) << 32 | at as u64));
    keys.sort_unstable();
    Ok(())
}
