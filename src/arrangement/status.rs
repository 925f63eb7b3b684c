//! The lines that the sweep meets, from below to above: a treap with a list through its nodes. It
//! compares no lines itself: callers say where to insert.

use crate::memory::{AllocResult, TryGrow};
use crate::mesh::NONE;
use crate::numerics::SplitMix;

#[derive(Clone, Copy)]
struct Node {
    line: u32,
    parent: u32,
    /// Children in the tree, below and above.
    children: [u32; 2],
    /// Neighbours in the list, below and above.
    neighbors: [u32; 2],
}

/// Index of the direction downwards.
pub(super) const BELOW: usize = 0;
/// Index of the direction upwards.
pub(super) const ABOVE: usize = 1;

pub(super) struct Status {
    nodes: Vec<Node>,
    free: Vec<u32>,
    root: u32,
    /// Lowest and highest node.
    ends: [u32; 2],
}

impl Status {
    pub fn new() -> Self {
        Self { nodes: Vec::new(), free: Vec::new(), root: NONE, ends: [NONE; 2] }
    }

    pub fn is_empty(&self) -> bool {
        self.root == NONE
    }

    pub fn line(&self, node: u32) -> u32 {
        self.nodes[node as usize].line
    }

    pub fn set_line(&mut self, node: u32, line: u32) {
        self.nodes[node as usize].line = line;
    }

    /// Returns the next node in a direction, or [`NONE`].
    pub fn neighbor(&self, node: u32, direction: usize) -> u32 {
        self.nodes[node as usize].neighbors[direction]
    }

    /// Returns the lowest or the highest node, or [`NONE`] if there are none.
    pub fn extreme(&self, direction: usize) -> u32 {
        self.ends[direction]
    }

    /// Returns the lowest node whose line is not below the point that `is_below` asks about, or
    /// [`NONE`]. Calls `is_below` O(log n) times in expectation.
    pub fn lowest_not_below(&self, is_below: impl Fn(u32) -> bool) -> u32 {
        let (mut at, mut found) = (self.root, NONE);
        while at != NONE {
            let node = &self.nodes[at as usize];
            if is_below(node.line) {
                at = node.children[ABOVE];
            } else {
                (found, at) = (at, node.children[BELOW]);
            }
        }
        found
    }

    /// Inserts a line directly above a node, or below all of them if that is [`NONE`]. Expected
    /// O(1).
    pub fn insert_above(&mut self, lower: u32, line: u32) -> AllocResult<u32> {
        let upper = match lower {
            NONE => self.ends[BELOW],
            _ => self.neighbor(lower, ABOVE),
        };
        let node = Node { line, parent: NONE, children: [NONE; 2], neighbors: [lower, upper] };
        let new = match self.free.pop() {
            Some(free) => {
                self.nodes[free as usize] = node;
                free
            }
            None => {
                self.nodes.try_push(node)?;
                (self.nodes.len() - 1) as u32
            }
        };
        self.link(lower, ABOVE, new);
        self.link(upper, BELOW, new);
        // Of two neighbours, one has no child on the side of the other.
        if lower != NONE && self.nodes[lower as usize].children[ABOVE] == NONE {
            self.set_child(lower, ABOVE, new);
        } else if upper != NONE {
            self.set_child(upper, BELOW, new);
        } else {
            self.root = new;
        }
        while self.parent(new) != NONE && priority(new) > priority(self.parent(new)) {
            self.rotate_up(new);
        }
        Ok(new)
    }

    pub fn remove(&mut self, node: u32) -> AllocResult<()> {
        loop {
            let [lower, upper] = self.nodes[node as usize].children;
            let child = match (lower, upper) {
                (NONE, NONE) => break,
                (NONE, child) | (child, NONE) => child,
                _ if priority(lower) > priority(upper) => lower,
                _ => upper,
            };
            self.rotate_up(child);
        }
        match self.parent(node) {
            NONE => self.root = NONE,
            parent => {
                let side = self.side(parent, node);
                self.nodes[parent as usize].children[side] = NONE;
            }
        }
        let [lower, upper] = self.nodes[node as usize].neighbors;
        self.link(lower, ABOVE, upper);
        self.link(upper, BELOW, lower);
        self.free.try_push(node)
    }

    /// Makes `other` the neighbour of `node` in a direction; for [`NONE`] it becomes the end there.
    fn link(&mut self, node: u32, direction: usize, other: u32) {
        match node {
            NONE => self.ends[1 - direction] = other,
            _ => self.nodes[node as usize].neighbors[direction] = other,
        }
    }

    fn parent(&self, node: u32) -> u32 {
        self.nodes[node as usize].parent
    }

    fn side(&self, parent: u32, child: u32) -> usize {
        usize::from(self.nodes[parent as usize].children[ABOVE] == child)
    }

    fn set_child(&mut self, parent: u32, side: usize, child: u32) {
        self.nodes[parent as usize].children[side] = child;
        if child != NONE {
            self.nodes[child as usize].parent = parent;
        }
    }

    /// Moves a node up to where its parent was; the parent becomes its child.
    fn rotate_up(&mut self, node: u32) {
        let parent = self.parent(node);
        let grandparent = self.parent(parent);
        let side = self.side(parent, node);
        let inner = self.nodes[node as usize].children[1 - side];
        self.set_child(parent, side, inner);
        if grandparent == NONE {
            self.root = node;
            self.nodes[node as usize].parent = NONE;
        } else {
            let above = self.side(grandparent, parent);
            self.set_child(grandparent, above, node);
        }
        self.set_child(node, 1 - side, parent);
    }
}

/// Returns a pseudo-random priority of a node by its number. No input can choose priorities, so the
/// treap stays balanced.
fn priority(node: u32) -> u64 {
    SplitMix(u64::from(node)).next_word()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::testing::Random;

    impl Status {
        fn lines(&self) -> Vec<u32> {
            let mut at = self.extreme(BELOW);
            let mut lines = Vec::new();
            while at != NONE {
                lines.push(self.line(at));
                at = self.neighbor(at, ABOVE);
            }
            lines
        }

        fn depth(&self, node: u32) -> usize {
            let children = |node: u32| self.nodes[node as usize].children;
            if node == NONE {
                0
            } else {
                1 + children(node).map(|c| self.depth(c)).into_iter().max().unwrap()
            }
        }
    }

    #[test]
    fn it_is_a_list_that_can_be_searched() {
        let mut random = Random(3);
        let (mut status, mut list) = (Status::new(), Vec::<(u32, u32)>::new());
        // Lines are numbers that rise; a new one is put between its neighbours.
        for step in 0..20_000 {
            let line = random.integer(0, 1 << 30) as u32;
            let at = list.partition_point(|&(other, _)| other < line);
            let found = status.lowest_not_below(|other| other < line);
            assert_eq!(found, list.get(at).map_or(NONE, |&(_, node)| node));
            if list.len() > 3000 || step % 3 == 2 {
                let (_, node) = list.remove(random.integer(0, list.len() as i64 - 1) as usize);
                status.remove(node).unwrap();
            } else if list.get(at).is_none_or(|&(other, _)| other != line) {
                let lower = if at == 0 { NONE } else { list[at - 1].1 };
                list.insert(at, (line, status.insert_above(lower, line).unwrap()));
            }
        }
        assert!(list.len() > 2000);
        assert_eq!(status.lines(), list.iter().map(|&(line, _)| line).collect::<Vec<_>>());
        assert_eq!(status.neighbor(status.extreme(ABOVE), ABOVE), NONE);
        assert!(status.depth(status.root) < 50, "{}", status.depth(status.root));
        for (_, node) in list {
            status.remove(node).unwrap();
        }
        assert!(status.is_empty() && status.lines().is_empty());
    }
}
