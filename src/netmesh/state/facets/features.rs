//! Triangles of facets and segments without facets, as boxes of a tree, for the distance to the
//! nearest of them that does not go through a vertex. It does not matter how far they are split.

use crate::memory::{AllocResult, collected};
use crate::nearest::{Bounds, BoxTree, bounds_of, distance_to_box};
use crate::numerics::{distance_to_edge, distance_to_triangle};

/// Parts of the input in space.
pub(in crate::netmesh) struct Features {
    parts: Vec<Part>,
    boxes: BoxTree<'static>,
}

/// Triangle of a facet, or a line that no facet is at.
#[derive(Clone, Copy)]
pub(in crate::netmesh) enum Part {
    Triangle { facet: u32, corners: [[f64; 3]; 3] },
    Line { line: u32, ends: [[f64; 3]; 2] },
}

impl Part {
    fn distance_to(&self, x: &[f64; 3]) -> f64 {
        match self {
            Self::Triangle { corners, .. } => distance_to_triangle(x, corners.each_ref()),
            Self::Line { ends, .. } => distance_to_edge(x, ends.each_ref()),
        }
    }

    fn bounds(&self) -> Bounds {
        match self {
            Self::Triangle { corners, .. } => bounds_of(corners.iter()),
            Self::Line { ends, .. } => bounds_of(ends.iter()),
        }
    }
}

impl Features {
    /// Builds the tree of some parts. O(n log n).
    pub fn new(parts: Vec<Part>) -> AllocResult<Self> {
        let boxes: Vec<Bounds> = collected(parts.iter().map(Part::bounds))?;
        Ok(Self { parts, boxes: BoxTree::new(boxes)? })
    }

    /// Returns the distance from `x` to the nearest part that is none of its own, infinite without
    /// any. Expected O(log n).
    pub fn distance_to(&self, x: &[f64; 3], is_own: impl Fn(&Part) -> bool) -> f64 {
        let value = |part: u32| {
            let part = &self.parts[part as usize];
            if is_own(part) { f64::INFINITY } else { part.distance_to(x) }
        };
        self.boxes.least(&|bounds| distance_to_box(x, bounds), &value)
    }
}
