//! How a mesh gets its result: the one place between the arrays below and the algorithm above them.

use crate::arrangement::{Poll, arrange, check_closed, with_extent};
use crate::error::{Error, ErrorKind, Result, message};
use crate::memory::{TryGrow, copied, with_capacity};
use crate::mesh::{Arrangement, Inputs, Mesh, NONE};
use crate::netmesh::{self, Watch};
use crate::options::{Extent, Interior, Options, ProgressFn, SizeFn};
use crate::parameters::with_interior;
use crate::sizes::Field;

impl Mesh {
    /// Runs the algorithm and replaces the previous result; on any error the mesh is as it was.
    ///
    /// # Errors
    /// `InvalidArgument` (an option out of range; segments that cross; curves that do not close;
    /// a domain without a region), `DegenerateInput` (plain Delaunay of inputs of lower affine rank,
    /// a hull or box without area), `Limit`, `Cancelled`, `OutOfMemory`.
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
        let options = &with_interior(options, self.segments().has_polygons());
        let mut progress = progress;
        let mut watch = Watch::new(progress.as_deref_mut());
        let arrangement = self.arrangement(options, &mut |work| watch.poll_after(work))?;
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

    /// What the mesh must conform to, if there is something.
    fn arrangement(&self, options: &Options, poll: Poll<'_>) -> Result<Option<Arrangement>> {
        let Options { extent, crossings, interior, .. } = *options;
        self.check_extent(extent)?;
        self.check_interior(extent, interior)?;
        let mut arrangement = match extent {
            Extent::All if self.segments().count() == 0 => return Ok(None),
            Extent::All | Extent::Boundary => {
                arrange(self.inputs(), self.segments(), crossings, poll)?
            }
            Extent::Hull | Extent::Box => {
                let own = (self.inputs(), self.segments());
                let (inputs, segments) = with_extent(own.0, own.1, extent, poll)?;
                let arrangement = arrange(&inputs, &segments, crossings, poll)?;
                self.in_own_numbers(arrangement, &inputs)?
            }
        };
        arrangement.regions = copied(self.regions())?;
        Ok(Some(arrangement))
    }

    fn check_extent(&self, extent: Extent) -> Result<()> {
        let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
        let dim = self.inputs().dim();
        match extent {
            Extent::All => Ok(()),
            _ if dim != 2 => refuse(message!(
                "options.extent is {} and the mesh has dimension {dim}; above 2D it must be all",
                extent.word()
            )),
            Extent::Boundary if self.segments().count() == 0 => refuse(message!(
                "options.extent is boundary and the mesh has no segments; set them first"
            )),
            _ => Ok(()),
        }
    }

    fn check_interior(&self, extent: Extent, interior: Interior) -> Result<()> {
        let asks_for_curves = matches!(interior, Interior::Parity | Interior::Winding);
        if asks_for_curves && extent != Extent::Boundary {
            let message = message!(
                "options.interior is {} and options.extent is {}; what curves enclose is for the \
                 extent boundary",
                interior.word(),
                extent.word()
            );
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        check_closed(self.inputs(), self.segments(), interior)
    }

    /// The arrangement of `extended` inputs and segments: corners of the extent that are no inputs
    /// become the first crossings, and its edges belong to no segment ([`NONE`]).
    fn in_own_numbers(&self, arrangement: Arrangement, extended: &Inputs) -> Result<Arrangement> {
        let corners = self.inputs().distinct()..extended.distinct();
        let mut crossings = with_capacity(corners.len() + arrangement.crossings.len())?;
        crossings.extend(corners.map(|corner| {
            let corner = extended.distinct_point(corner);
            [corner[0], corner[1]]
        }));
        crossings.try_extend(&arrangement.crossings)?;
        let mut own = Arrangement { crossings, ..arrangement };
        for subsegment in &mut own.subsegments {
            if subsegment.segment as usize >= self.segments().count() {
                subsegment.segment = NONE;
            }
        }
        Ok(own)
    }
}
