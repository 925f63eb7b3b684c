//! A tree of boxes, and all pairs of them that meet.

use crate::error::Result;
use crate::memory::{AllocResult, TryGrow, collected, filled};
use crate::nearest::tree::Tree;
use crate::numerics::norm;
use std::borrow::Cow;

/// Smallest box that contains something: its least and its largest coordinates.
pub(crate) type Bounds = [[f64; 3]; 2];

/// Function that is told of work done, and may end the search by an error.
type Poll<'a> = &'a mut dyn FnMut(u32) -> Result<()>;

/// Number of pairs of boxes for which a poll counts one unit of work.
const PAIRS_OF_A_POLL: u32 = 16;

/// Tree of boxes. The centres of boxes make a k-d tree, whose nodes have bounds.
pub(crate) struct BoxTree<'a> {
    boxes: Cow<'a, [Bounds]>,
    tree: Tree,
    /// Node -> the bounds of all boxes below it; those of leaves follow those of inner nodes.
    bounds: Vec<Bounds>,
}

impl<'a> BoxTree<'a> {
    /// Builds the tree of all boxes. O(n log n).
    pub fn new(boxes: impl Into<Cow<'a, [Bounds]>>) -> AllocResult<Self> {
        let boxes = boxes.into();
        let centers = boxes.iter().map(|[low, high]| -> [f64; 3] {
            std::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k])
        });
        let centers = collected(centers)?;
        let tree = Tree::of_all::<3>(centers.as_flattened())?;
        let leaves = tree.leaf_count();
        let mut bounds = filled(2 * leaves, NOTHING)?;
        for node in (1..2 * leaves).rev() {
            bounds[node] = match node >= leaves {
                true => {
                    let members = tree.members::<3>(node - leaves);
                    union(members.map(|(member, _)| &boxes[member as usize]))
                }
                false => union([2 * node, 2 * node + 1].map(|half| &bounds[half])),
            };
        }
        Ok(Self { boxes, tree, bounds })
    }

    /// Calls `visit` with all pairs of boxes that meet, of which the first has the smaller number.
    /// O((n + k) log n) for k pairs, where boxes are not much larger than the gaps between them.
    pub fn each_pair(
        &self,
        poll: Poll<'_>,
        mut visit: impl FnMut([u32; 2], Poll<'_>) -> Result<()>,
    ) -> Result<()> {
        let leaves = self.tree.leaf_count();
        let mut waiting = Vec::new();
        waiting.try_push([1usize, 1])?;
        let mut work = 0;
        while let Some([one, other]) = waiting.pop() {
            work += 1;
            if !meet(&self.bounds[one], &self.bounds[other]) {
                continue;
            }
            if one < leaves && one == other {
                let [left, right] = [2 * one, 2 * one + 1];
                waiting.try_extend(&[[left, right], [right, right], [left, left]])?;
            } else if one < leaves {
                // Nodes of a pair are on one level, or one level apart.
                waiting.try_extend(&[[other, 2 * one + 1], [other, 2 * one]])?;
            } else if other < leaves {
                waiting.try_extend(&[[2 * other + 1, one], [2 * other, one]])?;
            } else {
                work += self.visit_leaves([one - leaves, other - leaves], poll, &mut visit)?;
            }
            if work >= PAIRS_OF_A_POLL {
                poll(work / PAIRS_OF_A_POLL)?;
                work %= PAIRS_OF_A_POLL;
            }
        }
        Ok(())
    }

    /// Calls `visit` with all boxes that meet something, given a test that may only be true too
    /// often for larger boxes. O(log n) for each box that is found, if the test is good.
    pub fn each_at(
        &self,
        meets: impl Fn(&Bounds) -> bool,
        mut visit: impl FnMut(u32) -> Result<()>,
    ) -> Result<()> {
        let leaves = self.tree.leaf_count();
        let mut waiting = Vec::new();
        waiting.try_push(1usize)?;
        while let Some(node) = waiting.pop() {
            if !meets(&self.bounds[node]) {
                continue;
            }
            if node < leaves {
                waiting.try_extend(&[2 * node + 1, 2 * node])?;
                continue;
            }
            for (member, _) in self.tree.members::<3>(node - leaves) {
                if meets(&self.boxes[member as usize]) {
                    visit(member)?;
                }
            }
        }
        Ok(())
    }

    /// Returns the least value of all boxes, infinite if there are none. `bound` tells for bounds
    /// what no value of a box within them is below. O(log n) if that tells much.
    pub fn least(&self, bound: &dyn Fn(&Bounds) -> f64, value: &dyn Fn(u32) -> f64) -> f64 {
        self.least_below(1, f64::INFINITY, bound, value)
    }

    /// Returns the least value of the boxes below a node, or `known` if that is less.
    fn least_below(
        &self,
        node: usize,
        known: f64,
        bound: &dyn Fn(&Bounds) -> f64,
        value: &dyn Fn(u32) -> f64,
    ) -> f64 {
        let leaves = self.tree.leaf_count();
        let may_be_less = bound(&self.bounds[node]) < known;
        if !may_be_less {
            return known;
        }
        if node >= leaves {
            let members = self.tree.members::<3>(node - leaves);
            return members.fold(known, |least, (member, _)| least.min(value(member)));
        }
        let mut halves = [2 * node, 2 * node + 1];
        halves.sort_unstable_by(|&a, &b| {
            bound(&self.bounds[a]).total_cmp(&bound(&self.bounds[b])).then(a.cmp(&b))
        });
        halves.iter().fold(known, |least, &half| self.least_below(half, least, bound, value))
    }

    /// Visits the pairs of boxes in two leaves, or in one. Returns the number of pairs tried.
    fn visit_leaves(
        &self,
        [one, other]: [usize; 2],
        poll: Poll<'_>,
        visit: &mut impl FnMut([u32; 2], Poll<'_>) -> Result<()>,
    ) -> Result<u32> {
        let mut tried = 0;
        for (rank, (first, _)) in self.tree.members::<3>(one).enumerate() {
            let skipped = if one == other { rank + 1 } else { 0 };
            for (second, _) in self.tree.members::<3>(other).skip(skipped) {
                tried += 1;
                let [a, b] = [first, second].map(|number| &self.boxes[number as usize]);
                if meet(a, b) {
                    visit([first.min(second), first.max(second)], poll)?;
                }
            }
        }
        Ok(tried)
    }
}

/// Bounds of nothing.
const NOTHING: Bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];

/// Returns the bounds of points.
pub(crate) fn bounds_of<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Bounds {
    points.fold(NOTHING, |[low, high], x| {
        [std::array::from_fn(|k| low[k].min(x[k])), std::array::from_fn(|k| high[k].max(x[k]))]
    })
}

/// Returns the distance of a point from a box, 0 inside.
pub(crate) fn distance_to_box(x: &[f64; 3], [low, high]: &Bounds) -> f64 {
    norm(&[0, 1, 2].map(|k| (low[k] - x[k]).max(x[k] - high[k]).max(0.0)))
}

fn union<'a>(boxes: impl IntoIterator<Item = &'a Bounds>) -> Bounds {
    bounds_of(boxes.into_iter().flatten())
}

/// Returns true if two boxes share a point.
#[inline]
fn meet(a: &Bounds, b: &Bounds) -> bool {
    (0..3).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    #[test]
    fn the_least_value_is_that_of_all_boxes() {
        let mut random = Random(7);
        for count in [0usize, 1, 2, 9, 64, 65, 300] {
            let mut point = || -> [f64; 3] { std::array::from_fn(|_| random.unit()) };
            let boxes: Vec<Bounds> = (0..count).map(|_| [point(); 2]).collect();
            let tree = BoxTree::new(&boxes).unwrap();
            for _ in 0..20 {
                let x = point();
                let beyond = |[low, high]: &Bounds| {
                    let beyond = |k: usize| (low[k] - x[k]).max(x[k] - high[k]).max(0.0);
                    (0..3).map(beyond).fold(0.0, f64::max)
                };
                let asked = std::cell::Cell::new(0);
                let least = tree.least(&beyond, &|at| {
                    asked.set(asked.get() + 1);
                    beyond(&boxes[at as usize])
                });
                assert_eq!(least, boxes.iter().map(beyond).fold(f64::INFINITY, f64::min));
                assert!(asked.get() <= 64, "{} of {count}", asked.get());
            }
        }
    }

    #[test]
    fn pairs_are_those_of_all_pairs() {
        let mut random = Random(42);
        for count in [1usize, 2, 3, 9, 17, 64, 65, 300] {
            let boxes: Vec<Bounds> = (0..count)
                .map(|_| {
                    let corner = || std::array::from_fn(|_| random.integer(0, 12) as f64);
                    let corners: Vec<[f64; 3]> = std::iter::repeat_with(corner).take(2).collect();
                    bounds_of(corners.iter())
                })
                .collect();
            let mut expected = Vec::new();
            for second in 0..count {
                for first in 0..second {
                    if meet(&boxes[first], &boxes[second]) {
                        expected.push([first as u32, second as u32]);
                    }
                }
            }
            let mut found = Vec::new();
            let visit = |pair: [u32; 2], _: Poll<'_>| {
                found.push(pair);
                Ok(())
            };
            BoxTree::new(&boxes).unwrap().each_pair(&mut |_| Ok(()), visit).unwrap();
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected);
        }
    }
}
