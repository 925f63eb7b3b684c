//! Search for the vertices near a piece of a segment, in a k-d tree with a box for each node. A
//! piece meets few boxes that hold no vertex near it, unless it passes between many vertices; then
//! the mesh has as many edges along it.

use super::reach::Reach;
use crate::memory::{AllocResult, TryGrow, filled};
use crate::nearest::Tree;

/// Tree of vertices with the bounding box of the vertices below each node.
pub(super) struct Near<const D: usize> {
    tree: Tree,
    /// Node -> its bounding box; those of leaves follow those of inner nodes.
    boxes: Vec<[[f64; D]; 2]>,
    /// Nodes that the search has yet to visit.
    waiting: Vec<usize>,
}

/// Piece of a segment in the form that a filter in doubles needs. Each axis has a scale of its own:
/// the coordinates of a point may be any powers of two apart.
struct Beam<const D: usize> {
    from: [f64; D],
    /// Half the vector to the other end, in units of `scale`.
    way: [f64; D],
    low: [f64; D],
    high: [f64; D],
    /// Half the margin along each axis.
    scale: [f64; D],
}

impl<const D: usize> Near<D> {
    /// Builds the tree of all vertices. O(n log n).
    pub fn new(vertices: &[[f64; D]]) -> AllocResult<Self> {
        let tree = Tree::of_all::<D>(vertices.as_flattened())?;
        let leaves = tree.leaf_count();
        let mut boxes = filled(2 * leaves, [[f64::INFINITY; D], [f64::NEG_INFINITY; D]])?;
        for node in (1..2 * leaves).rev() {
            boxes[node] = match node >= leaves {
                true => box_of(tree.members::<D>(node - leaves).map(|(_, x)| [x, x])),
                false => box_of([2 * node, 2 * node + 1].map(|half| boxes[half].each_ref())),
            };
        }
        Ok(Self { tree, boxes, waiting: Vec::new() })
    }

    /// Returns true if a vertex other than `x` itself is in the box about `x` that extends by these
    /// `widths` on both sides of each axis. Expected O(log n).
    pub fn has_beside(&mut self, x: &[f64; D], widths: &[f64; D]) -> AllocResult<bool> {
        let mut is_found = false;
        self.each_in_box(x, widths, |_, y| {
            is_found |= y != x;
            Ok(!is_found)
        })?;
        Ok(is_found)
    }

    /// Calls `visit` with the vertices in the box about `x` that extends by these `widths` on both
    /// sides of each axis, until it returns false. Expected O(log n) for each.
    pub fn each_in_box(
        &mut self,
        x: &[f64; D],
        widths: &[f64; D],
        mut visit: impl FnMut(u32, &[f64; D]) -> AllocResult<bool>,
    ) -> AllocResult<()> {
        let is_apart = |[low, high]: [&[f64; D]; 2]| {
            (0..D).any(|k| low[k] - x[k] > widths[k] || x[k] - high[k] > widths[k])
        };
        let leaves = self.tree.leaf_count();
        self.waiting.clear();
        self.waiting.try_push(1)?;
        while let Some(node) = self.waiting.pop() {
            if is_apart(self.boxes[node].each_ref()) {
                continue;
            }
            if node < leaves {
                self.waiting.try_extend(&[2 * node + 1, 2 * node])?;
                continue;
            }
            for (vertex, y) in self.tree.members::<D>(node - leaves) {
                if !is_apart([y, y]) && !visit(vertex, y)? {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Appends to `found` all vertices that are near the piece between two points, and perhaps some
    /// that are not.
    pub fn collect(
        &mut self,
        reach: &Reach<D>,
        piece: [&[f64; D]; 2],
        found: &mut Vec<u32>,
    ) -> AllocResult<()> {
        let beam = Beam::new(reach, piece);
        let leaves = self.tree.leaf_count();
        self.waiting.clear();
        self.waiting.try_push(1)?;
        while let Some(node) = self.waiting.pop() {
            if !beam.meets(self.boxes[node].each_ref()) {
                continue;
            }
            if node < leaves {
                self.waiting.try_extend(&[2 * node + 1, 2 * node])?;
                continue;
            }
            for (vertex, x) in self.tree.members::<D>(node - leaves) {
                if beam.meets([x, x]) {
                    found.try_push(vertex)?;
                }
            }
        }
        Ok(())
    }
}

/// Returns the smallest box that contains all `boxes`.
fn box_of<'a, const D: usize>(boxes: impl IntoIterator<Item = [&'a [f64; D]; 2]>) -> [[f64; D]; 2] {
    let mut all = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    for [low, high] in boxes {
        for k in 0..D {
            all[0][k] = all[0][k].min(low[k]);
            all[1][k] = all[1][k].max(high[k]);
        }
    }
    all
}

impl<const D: usize> Beam<D> {
    fn new(reach: &Reach<D>, [from, to]: [&[f64; D]; 2]) -> Self {
        let margin = reach.margin();
        let scale = margin.map(|width| 0.5 * width);
        Self {
            from: *from,
            way: std::array::from_fn(|k| (0.5 * to[k] - 0.5 * from[k]) / scale[k]),
            low: std::array::from_fn(|k| from[k].min(to[k]) - margin[k]),
            high: std::array::from_fn(|k| from[k].max(to[k]) + margin[k]),
            scale,
        }
    }

    /// Returns false only if no point of the box is near the piece.
    #[inline]
    fn meets(&self, [low, high]: [&[f64; D]; 2]) -> bool {
        for k in 0..D {
            if low[k] > self.high[k] || high[k] < self.low[k] {
                return false;
            }
        }
        // Quarters and halves of coordinates have sums that no double overflows.
        let half: [f64; D] =
            std::array::from_fn(|k| (0.25 * high[k] - 0.25 * low[k]) / self.scale[k]);
        let middle: [f64; D] = std::array::from_fn(|k| {
            ((0.25 * high[k] + 0.25 * low[k]) - 0.5 * self.from[k]) / self.scale[k]
        });
        for second in 1..D {
            for first in 0..second {
                let (u, v) = (self.way[first], self.way[second]);
                let area = (u * middle[second] - v * middle[first]).abs();
                let reach = u.abs() * (half[second] + 1.0) + v.abs() * (half[first] + 1.0);
                if area > reach {
                    return false;
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(vertices: &[[f64; 2]], ends: [&[f64; 2]; 2]) -> Vec<u32> {
        let mut found = Vec::new();
        Near::new(vertices).unwrap().collect(&Reach::of(ends), ends, &mut found).unwrap();
        found.sort_unstable();
        found
    }

    #[test]
    fn axes_may_differ_by_any_power_of_two() {
        for power in (-1000..=900).step_by(100) {
            let scale = 2f64.powi(power);
            let [from, to] = [[-1e300, 0.0], [1e200, -scale]];
            let vertices =
                [[-1e100, -scale], [1e100, -scale], [1e100, -2.0 * scale], [-1e299, scale]];
            assert_eq!(found(&vertices, [&from, &to]), [0, 1], "2^{power}");
        }
    }

    #[test]
    fn sums_that_overflow_lose_no_vertex() {
        let [from, to] = [[-1.7e308, 0.0], [-1.6e308, 1.0]];
        let mut vertices = vec![[-1.65e308, 0.5]];
        vertices.extend((0..40).map(|k| [-1.6e308 + f64::from(k) * 5e306, 0.5]));
        vertices.extend((0..40).map(|k| [1.79e308 - f64::from(k) * 5e306, 0.5]));
        assert_eq!(found(&vertices, [&from, &to]), [0]);
        assert_eq!(found(&vertices, [&[-1.7e308, 0.0], &[1.79e308, 0.0]]), []);
    }
}
