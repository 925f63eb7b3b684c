//! What a file has beside what a mesh has of it.

use super::Mesh;

/// Numbers of elements of a mesh or a surface that a file has beside its points, and that nothing
/// is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Elements with two ends.
    pub edges: u64,
    /// Triangles and other polygons.
    pub faces: u64,
    /// Tetrahedra and other elements of three dimensions or more.
    pub cells: u64,
}

impl LeftOut {
    /// Adds elements of a dimension; points are no elements.
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
    /// Returns what the file of the inputs has beside what this mesh has of it.
    pub fn left_out(&self) -> LeftOut {
        self.left_out
    }

    /// Keeps what the file of the inputs has beside what this mesh has of it.
    pub(crate) fn set_left_out(&mut self, left_out: LeftOut) {
        self.left_out = left_out;
    }
}
