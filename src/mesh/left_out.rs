//! Counts of the elements that a file has and a mesh of it has not.

use super::Mesh;

/// Numbers of elements of a mesh or a surface that a file has beside its points, and that are not
/// used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Number of elements with two ends.
    pub edges: u64,
    /// Number of triangles and other polygons.
    pub faces: u64,
    /// Number of tetrahedra and other elements of three dimensions or more.
    pub cells: u64,
}

impl LeftOut {
    /// Adds `count` elements of a dimension; points do not count.
    pub(crate) fn add(&mut self, dimension: u64, count: u64) {
        match dimension {
            0 => {}
            1 => self.edges += count,
            2 => self.faces += count,
            _ => self.cells += count,
        }
    }

    /// Returns true if nothing was left out.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl Mesh {
    /// Returns the numbers of elements that the file of the inputs has and this mesh has not.
    pub fn left_out(&self) -> LeftOut {
        self.left_out
    }

    /// Records the numbers of elements that the file of the inputs has and this mesh has not.
    pub(crate) fn set_left_out(&mut self, left_out: LeftOut) {
        self.left_out = left_out;
    }
}
