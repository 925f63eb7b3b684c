//! A tree of boxes over sibling balls, to find those near a point or a ball without trying all.

use crate::memory::{AllocResult, TryGrow, collected};
use crate::mesh::Domain;
use crate::quality::view::View;

const LEAF: usize = 4;

/// A box; both ends belong to it.
#[derive(Clone, Copy)]
pub(super) struct Bounds<const D: usize> {
    low: [f64; D],
    high: [f64; D],
}

impl<const D: usize> Bounds<D> {
    /// Returns a box that surely holds the closed ball, rounding included.
    pub fn of_ball(center: &[f64; D], radius: f64) -> Self {
        let reach = |x: f64| radius + radius * 1e-9 + x.abs() * 1e-15;
        Self { low: center.map(|x| x - reach(x)), high: center.map(|x| x + reach(x)) }
    }

    fn meets(&self, other: &Self) -> bool {
        (0..D).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    fn merged(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
        }
    }

    fn widest_axis(&self) -> usize {
        let extent = |k: &usize| self.high[*k] / 2.0 - self.low[*k] / 2.0;
        (0..D).max_by(|a, b| extent(a).total_cmp(&extent(b))).unwrap_or(0)
    }
}

struct Node<const D: usize> {
    bounds: Bounds<D>,
    start: usize,
    end: usize,
    /// The second half's node; the first half's is the next one. 0 for a leaf.
    second: usize,
}

/// The boxes of some domains' balls, halved recursively.
pub(super) struct BoxTree<const D: usize> {
    nodes: Vec<Node<D>>,
    items: Vec<(Bounds<D>, u32)>,
}

impl<const D: usize> BoxTree<D> {
    /// Builds the tree of the balls of `ids`, whose centres are vertices. O(n log n).
    pub fn new(view: View<'_, D>, domains: &[Domain], ids: &[u32]) -> AllocResult<Self> {
        let bounds = |&id: &u32| {
            let domain = &domains[id as usize];
            (Bounds::of_ball(view.point(domain.center), domain.radius), id)
        };
        let mut tree = Self { nodes: Vec::new(), items: collected(ids.iter().map(bounds))? };
        if !tree.items.is_empty() {
            tree.build(0, tree.items.len())?;
        }
        Ok(tree)
    }

    fn build(&mut self, start: usize, end: usize) -> AllocResult<()> {
        let node = self.nodes.len();
        let items = &mut self.items[start..end];
        let bounds = items[1..].iter().fold(items[0].0, |all, item| all.merged(&item.0));
        self.nodes.try_push(Node { bounds, start, end, second: 0 })?;
        if end - start <= LEAF {
            return Ok(());
        }
        let axis = bounds.widest_axis();
        let middle = (end - start) / 2;
        let key = |item: &(Bounds<D>, u32)| item.0.low[axis] / 2.0 + item.0.high[axis] / 2.0;
        items.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
        self.build(start, start + middle)?;
        self.nodes[node].second = self.nodes.len();
        self.build(start + middle, end)
    }

    /// Returns the first domain whose box meets `bounds` and that `accept` takes.
    pub fn find(&self, bounds: &Bounds<D>, mut accept: impl FnMut(u32) -> bool) -> Option<u32> {
        // One node waits per level; the tree is halved at each.
        let mut stack = [0; 2 * usize::BITS as usize];
        let mut waiting = usize::from(!self.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let index = stack[waiting];
            let node: &Node<D> = &self.nodes[index];
            if !node.bounds.meets(bounds) {
                continue;
            }
            if node.second != 0 {
                stack[waiting..waiting + 2].copy_from_slice(&[node.second, index + 1]);
                waiting += 2;
                continue;
            }
            let items = self.items[node.start..node.end].iter();
            let mut met = items.filter(|item| item.0.meets(bounds)).map(|item| item.1);
            if let Some(found) = met.find(|&id| accept(id)) {
                return Some(found);
            }
        }
        None
    }
}
