//! The paper's algorithm (§6). Each group of files is read together, and its front page says what
//! it has:
//!
//! - [`rounds`]: the order of the inputs, the conflict lists that say where they are, the rounds
//!   that insert them, and the nets that choose what a round inserts.
//! - [`cages`]: domains and their tree, encroachment, where a cage goes, and the operations on
//!   cages.
//! - [`refinement`]: which simplices are bad, the list of them, Steiner points, CLEAN, FINISHMESH
//!   and the final refinement.
//! - [`segments`]: edges that the mesh conforms to, in the plane, and the regions between them.
//! - [`slivers`]: tetrahedra with small dihedral angles, and what mends them.
//! - [`partitions`]: large meshes made in partitions, and work that all threads share.
//! - [`distributed`]: the same for partitions of several processes, which no mesh has all of.
//!
//! Around them: `state` is what a run works on, `watch` reads the clock, `parameters` are the
//! options in full, `numbering` and `output` write the result, and `instruments` measures what the
//! theorems promise.

mod cages;
pub(crate) mod distributed;
mod instruments;
mod numbering;
mod output;
mod parameters;
mod partitions;
mod refinement;
mod rounds;
mod segments;
mod slivers;
mod state;
mod watch;

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::collected;
use crate::mesh::{Arrangement, Inputs, Triangulation, in_dimension};
use crate::options::{Algorithm, Options, Output, ProgressFn, SizeFn};
use crate::parameters::{Parameters, check_region_sizes, output_for, with_segments};
use refinement::size::Sizes;
use state::{Cell, Mesher, Scratch, Stage, State};
use std::time::Instant;
pub(crate) use watch::Watch;

/// Meshes `inputs`. The one place that picks the monomorphisation for the dimension.
///
/// # Errors
/// `InvalidArgument`, `DegenerateInput`, `Limit`, `Cancelled`, `OutOfMemory`.
pub fn run(
    inputs: &Inputs,
    arrangement: Option<&mut Arrangement>,
    options: &Options,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation> {
    run_sized(inputs, arrangement, options, None, progress)
}

/// As [`run`], with sizes.
///
/// # Errors
/// As those of [`run`]; `InvalidArgument` if `size` answers no size.
pub fn run_sized(
    inputs: &Inputs,
    arrangement: Option<&mut Arrangement>,
    options: &Options,
    size: Option<&SizeFn<'_>>,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation> {
    let by_region = arrangement.as_deref().is_some_and(Arrangement::has_sizes);
    let output = output_for(options, size.is_some() || by_region);
    let options = &Options { output, ..options.clone() };
    let parameters = match &arrangement {
        None => Parameters::resolve(inputs.dim(), options)?,
        Some(_) => Parameters {
            // What is outside is not refined, and a partition does not know what is.
            inputs_per_partition: usize::MAX / 2,
            ..Parameters::resolve(inputs.dim(), &with_segments(options)?)?
        },
    };
    if by_region {
        check_region_sizes(options)?;
    }
    in_dimension!(
        inputs.dim(),
        D => mesh::<D>(inputs, arrangement, parameters, size, progress),
        _ => unreachable!("inputs of other dimensions are refused when they are made")
    )
}

fn mesh<const D: usize>(
    inputs: &Inputs,
    mut arrangement: Option<&mut Arrangement>,
    parameters: Parameters,
    size: Option<&SizeFn<'_>>,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation> {
    let begun = Instant::now();
    let mut watch = Watch::new(progress);
    // Also the shortest run can be watched and cancelled.
    watch.report()?;
    let by_region = arrangement.as_deref().is_some_and(Arrangement::has_sizes);
    let sizes = Sizes::new(inputs, &parameters, size, by_region);
    let mut mesher = Mesher::<D>::new(inputs, parameters, watch)?;
    mesher.sizes = sizes;
    let made = mesher.mesh(arrangement.as_deref());
    if let Some(arrangement) = &mut arrangement {
        arrangement.crowded =
            collected(mesher.state.segments.crowded.iter().map(|crowded| crowded.at))?;
    }
    made?;
    mesher.into_triangulation(begun)
}

impl<const D: usize> Mesher<'_, '_, D> {
    /// Makes all of the mesh.
    fn mesh(&mut self, arrangement: Option<&Arrangement>) -> Result<()> {
        let mut cavity = Cavity::default();
        if self.state.parameters.algorithm == Algorithm::Delaunay {
            self.start_delaunay()?;
            return self.insert_rounds(&mut cavity);
        }
        match arrangement {
            Some(arrangement) => self.conform(arrangement, &mut cavity)?,
            None => self.mesh_points(&mut cavity)?,
        }
        self.refine_finally(&mut cavity)?;
        if arrangement.is_some() {
            self.coarsen()?;
        }
        self.refine_by_distance(&mut cavity)?;
        // What goes in for the one may break the other, where simplices reach out of the box.
        while self.refine_by_size(&mut cavity)? && self.state.parameters.distance_ratio > 0.0 {
            self.refine_by_distance(&mut cavity)?;
        }
        if D == 3 && self.state.parameters.min_dihedral > 0.0 {
            self.remove_slivers(&mut cavity)?;
        }
        Ok(())
    }

    /// The mesh of the inputs, with the loose bound.
    fn mesh_points(&mut self, cavity: &mut Cavity) -> Result<()> {
        self.start_netmesh(cavity)?;
        match self.state.parameters.algorithm {
            Algorithm::Svr => self.insert_sparsely(cavity)?,
            _ => {
                self.insert_coarse_rounds(cavity)?;
                self.insert_in_partitions(cavity)?;
                self.insert_rounds(cavity)?;
            }
        }
        match self.state.parameters.output {
            Output::WellSpaced => self.finish_mesh(cavity),
            Output::Auto | Output::Hierarchical => Ok(()),
        }
    }
}
