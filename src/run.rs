//! How a mesh gets its result: the one place between the arrays below and the algorithm above them.

use crate::error::Result;
use crate::mesh::Mesh;
use crate::netmesh;
use crate::options::{Options, ProgressFn};

impl Mesh {
    /// Runs the algorithm and replaces the previous result; on any error the mesh is as it was.
    ///
    /// # Errors
    /// `InvalidArgument` (an option out of range), `DegenerateInput` (plain Delaunay of inputs of
    /// lower affine rank), `Limit`, `Cancelled`, `OutOfMemory`.
    pub fn run(&mut self, options: &Options, progress: Option<&mut ProgressFn<'_>>) -> Result<()> {
        let triangulation = netmesh::run(self.inputs(), options, progress)?;
        self.set_triangulation(triangulation);
        Ok(())
    }
}
