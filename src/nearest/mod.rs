//! The points nearest to others: a k-d tree, and the search of it.

mod search;
mod tree;

pub(crate) use search::nearest;
pub(crate) use tree::{Tree, sort_by_leaf};
