//! Runs of a mesh: the one place between the arrays below and the algorithm above them.

use crate::arrangement::{
    Poll, SharedVertices, Task, arrange, check_closed, encloses, with_extent,
};
use crate::error::{Choice, Error, ErrorKind, Name, Result, say};
use crate::memory::{TryGrow, copied, with_capacity};
use crate::mesh::{Arrangement, Inputs, Mesh, NONE, Triangulation};
use crate::netmesh::{self, Watch};
use crate::options::{Extent, Interior, Options, Progress, ProgressFn, SizeFn};
use crate::parameters::{check_sized, with_interior};
use crate::sizes::Field;

mod holes;
mod intersections;
mod space;
mod triangles;

/// Largest number of tries to lead segments through further vertices where doubles leave no room
/// between them.
const MOST_TRIES: usize = 64;

impl Mesh {
    /// Runs the algorithm and replaces the result. After an error the mesh is unchanged.
    ///
    /// # Errors
    /// `InvalidArgument` (an option out of range; segments that cross; curves that do not close; a
    /// domain without a region; a seed on a segment, in no region or in that of another),
    /// `DegenerateInput` (plain Delaunay of inputs of lower affine rank, a hull or box without
    /// area or, in space, volume), `Limit`, `Cancelled`, `OutOfMemory`.
    pub fn run(&mut self, options: &Options, progress: Option<&mut ProgressFn<'_>>) -> Result<()> {
        self.run_sized(options, None, progress)
    }

    /// Runs the algorithm as [`Mesh::run`] does, with a function that gives a size for each point.
    /// The smallest of its size, [`Options::max_edge`] and the sizes that the mesh was given by
    /// values applies.
    ///
    /// # Errors
    /// The errors of [`Mesh::run`], and `InvalidArgument` (an answer of `size` that is no size).
    pub fn run_sized(
        &mut self,
        options: &Options,
        size: Option<&SizeFn<'_>>,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<()> {
        let options = &match self.has_surface() {
            // Only its arrangement tells whether it is closed.
            true => options.clone(),
            false => with_interior(options, self.segments().has_polygons()),
        };
        self.check_sizes(options, size.is_some())?;
        let mut shared = SharedVertices::default();
        let mut least = -1.0;
        let mut progress = progress.map(|progress| forwards(&mut least, progress));
        let mut progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
        for tries in 1.. {
            let mut watch = Watch::new(progress.as_deref_mut());
            let poll: Poll<'_> = &mut |work| watch.poll_after(work);
            let (options, mut arrangement) = self.arrangement(options, &shared, poll)?;
            let arranged = arrangement.as_mut();
            let made = self.meshed(&options, arranged, size, progress.as_deref_mut());
            // In space there is no common vertex that two segments could go through instead.
            let lacks_room = self.inputs().dim() == 2
                && made.as_ref().is_err_and(|error| error.kind() == ErrorKind::Limit);
            let is_new = match arrangement.filter(|_| lacks_room && tries < MOST_TRIES) {
                Some(arrangement) => shared.add_all(&arrangement.crowded)?,
                None => false,
            };
            if !is_new {
                self.set_triangulation(made?);
                break;
            }
        }
        Ok(())
    }

    /// Makes a mesh that conforms to an arrangement.
    fn meshed(
        &self,
        options: &Options,
        arrangement: Option<&mut Arrangement>,
        size: Option<&SizeFn<'_>>,
        mut progress: Option<&mut ProgressFn<'_>>,
    ) -> Result<Triangulation> {
        let inputs = self.inputs();
        let mut watch = Watch::new(progress.as_deref_mut());
        let poll: Poll<'_> = &mut |work| watch.poll_after(work);
        let of_curvature = self.sizes_of_curvature(options, arrangement.as_deref(), poll)?;
        match Field::new(self, size, of_curvature)? {
            None => netmesh::run(inputs, arrangement, options, progress),
            Some(field) => {
                let size: &SizeFn<'_> = &|x| field.at(x);
                let made = netmesh::run_sized(inputs, arrangement, options, Some(size), progress);
                field.outcome(made)
            }
        }
    }

    /// Returns the options with the extent that [`Extent::Auto`] stands for, and the arrangement
    /// that the mesh must conform to, if there is one.
    fn arrangement(
        &self,
        options: &Options,
        shared: &SharedVertices,
        poll: Poll<'_>,
    ) -> Result<(Options, Option<Arrangement>)> {
        if self.conforms_in_space(options.extent) {
            return self.arrangement_in_space(options, poll);
        }
        let Options { extent, crossings, interior, .. } = *options;
        self.check_extent(extent)?;
        self.check_interior(extent, interior)?;
        let mut options = options.clone();
        let mut arrangement = match extent {
            Extent::Auto | Extent::All if self.segments().count() == 0 => {
                self.refuse_seeds()?;
                return Ok((without_interior(options), None));
            }
            Extent::Auto => {
                let (inputs, segments) = (self.inputs(), self.segments());
                let own = segments.count();
                let task = Task { inputs, segments, own, shared, crossings };
                let arrangement = arrange(&task, poll)?;
                options = match encloses(inputs, segments, &arrangement, interior)? {
                    true => Options { extent: Extent::Boundary, ..options },
                    false => without_interior(options),
                };
                arrangement
            }
            Extent::All | Extent::Boundary => {
                let (inputs, segments) = (self.inputs(), self.segments());
                let own = segments.count();
                arrange(&Task { inputs, segments, own, shared, crossings }, poll)?
            }
            Extent::Hull | Extent::Box => {
                let own = (self.inputs(), self.segments());
                let (inputs, segments) = with_extent(own.0, own.1, extent, poll)?;
                let own = own.1.count();
                let task = Task { inputs: &inputs, segments: &segments, own, shared, crossings };
                self.in_own_numbers(arrange(&task, poll)?, &inputs)?
            }
        };
        arrangement.regions = copied(self.regions())?;
        Ok((options, Some(arrangement)))
    }

    /// Fails if the options contradict the sizes that the mesh was given, or a function that gives
    /// sizes.
    fn check_sizes(&self, options: &Options, has_function: bool) -> Result<()> {
        let given = self.given_sizes();
        let sources = [
            (has_function, Name::Size),
            (!given.at_inputs.is_empty(), Name::Sizes),
            (given.background.is_some(), Name::Background),
        ];
        let mut sources = sources.into_iter().filter(|&(is_given, _)| is_given);
        sources.try_for_each(|(_, name)| check_sized(options, name))
    }

    fn check_extent(&self, extent: Extent) -> Result<()> {
        let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
        let dim = self.inputs().dim();
        match extent {
            Extent::Auto | Extent::All => Ok(()),
            Extent::Boundary if dim == 3 => {
                refuse(say!(Choice::Extent(extent), " needs facets; the mesh has none"))
            }
            _ if dim != 2 => refuse(say!(
                Choice::Extent(extent),
                " is for 2D and 3D; the mesh has dimension {dim}"
            )),
            Extent::Boundary if self.segments().count() == 0 => {
                refuse(say!(Choice::Extent(extent), " needs segments; the mesh has none"))
            }
            _ => Ok(()),
        }
    }

    /// Fails if there are seeds of regions: called for runs without segments or an extent, which
    /// have no regions.
    fn refuse_seeds(&self) -> Result<()> {
        if self.regions().is_empty() {
            return Ok(());
        }
        let lacks = self.word_for_features();
        let message = say!(
            Name::Seed(0),
            " is in no region: the mesh has no {lacks}; set them first, or another extent"
        );
        Err(Error::new(ErrorKind::InvalidArgument, message))
    }

    /// Returns the word for what bounds regions in the dimension of the mesh.
    fn word_for_features(&self) -> &'static str {
        if self.inputs().dim() == 3 { "facets" } else { "segments" }
    }

    fn check_interior(&self, extent: Extent, interior: Interior) -> Result<()> {
        let refuse = |message| Err(Error::new(ErrorKind::InvalidArgument, message));
        let rule = Choice::Interior(interior);
        match extent {
            _ if matches!(interior, Interior::Auto | Interior::Seeds) => Ok(()),
            Extent::Auto if self.segments().count() == 0 => {
                let needed = self.word_for_features();
                refuse(say!(rule, " needs {needed}; the mesh has none"))
            }
            Extent::Auto => Ok(()),
            Extent::Boundary => check_closed(self.inputs(), self.segments(), interior),
            _ => Err(refused_rule(interior, extent)),
        }
    }

    /// Returns the arrangement of `extended` inputs and segments in terms of the caller's: corners
    /// of the extent that are no inputs become the first crossings, and its edges belong to no
    /// segment ([`NONE`]).
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

/// Returns a progress function whose fraction does not decrease when a run begins again.
fn forwards<'a>(
    least: &'a mut f64,
    progress: &'a mut ProgressFn<'_>,
) -> impl FnMut(&Progress) -> bool + 'a {
    move |now| {
        *least = least.max(now.fraction);
        progress(&Progress { fraction: *least, ..*now })
    }
}

/// Returns the refusal of a rule for what is inside with an extent that has no use for one.
fn refused_rule(interior: Interior, extent: Extent) -> Error {
    Error::invalid(say!(
        Choice::Interior(interior),
        " does not go with ",
        Choice::Extent(extent),
        ", but with ",
        Choice::Extent(Extent::Boundary)
    ))
}

/// Returns the options of a run that keeps the whole mesh, without a rule for the interior.
fn without_interior(options: Options) -> Options {
    Options { extent: Extent::All, interior: Interior::Seeds, ..options }
}
