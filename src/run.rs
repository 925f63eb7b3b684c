//! How a mesh gets its result: the one place between the arrays below and the algorithm above them.

use crate::arrangement::arrange;
use crate::error::Result;
use crate::memory::copied;
use crate::mesh::{Arrangement, Mesh};
use crate::netmesh;
use crate::options::{Crossings, Options, ProgressFn, SizeFn};
use crate::sizes::Field;

impl Mesh {
    /// Runs the algorithm and replaces the previous result; on any error the mesh is as it was.
    ///
    /// # Errors
    /// `InvalidArgument` (an option out of range; segments that cross), `DegenerateInput` (plain Delaunay of inputs of
    /// lower affine rank), `Limit`, `Cancelled`, `OutOfMemory`.
    pub fn run(&mut self, options: &Options, progress: Option<&mut ProgressFn<'_>>) -> Result<()> {
        self.run_sized(options, None, progress)
    }

    /// As [`Mesh::run`], with a size for each point, beside [`Options::max_edge`] and the sizes that
    /// the mesh was given by values: the least counts.
    ///
    /// # Errors
    /// As those of [`Mesh::run`]; `InvalidArgument` (an answer of `size` that is no size).
    pub fn run_sized(
        &mut self,
        options: &Options,
        size: Option<&SizeFn<'_>>,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<()> {
        let arrangement = self.arrangement()?;
        let (inputs, arrangement) = (self.inputs(), arrangement.as_ref());
        let triangulation = match Field::new(self, size)? {
            None => netmesh::run(inputs, arrangement, options, progress)?,
            Some(field) => {
                let size: &SizeFn<'_> = &|x| field.at(x);
                let made = netmesh::run_sized(inputs, arrangement, options, Some(size), progress);
                field.outcome(made)?
            }
        };
        self.set_triangulation(triangulation);
        Ok(())
    }

    /// `None` without segments.
    fn arrangement(&self) -> Result<Option<Arrangement>> {
        match self.segments().count() {
            0 => Ok(None),
            _ => {
                let mut arrangement =
                    arrange(self.inputs(), self.segments(), Crossings::default())?;
                arrangement.regions = copied(self.regions())?;
                Ok(Some(arrangement))
            }
        }
    }
}
