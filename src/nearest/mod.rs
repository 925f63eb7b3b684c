//! The points nearest to others: a k-d tree, and the search in it; points that are as good as one.
//! Boxes that meet others, or come near.

mod boxes;
mod merging;
mod representatives;
mod search;
mod tree;

pub(crate) use boxes::{Bounds, BoxTree, bounds_of, distance_to_box};
pub use merging::merge_points;
pub use representatives::representatives;
pub use search::Stop;
pub(crate) use search::{nearest, nearest_until};
pub(crate) use tree::{Tree, sort_by_leaf};
