//! The paper's algorithm (§6), in folders that depend downwards only (ARCHITECTURE.md has the
//! table):
//!
//! 1. [`state`]: the mesh in the making, and the run that works on it.
//! 2. [`questions`]: encroachment, quality, sites of cages, Steiner points, permissions.
//! 3. [`instruments`]: measurements of the theorems' constants.
//! 4. [`insertion`]: one vertex goes in, and all that the state learns from it.
//! 5. [`operations`]: NEWCAGE, GROWCAGE, RELEASECAGE, INSERTINPUT, CLEAN; segments are recovered.
//! 6. [`rounds`]: how inputs come into the mesh.
//! 7. [`refinement`]: FINISHMESH, the final refinement, and refinement by distance and size.
//! 8. [`segments`]: edges that the mesh conforms to, in the plane, and the regions between them.
//! 9. [`facets`]: faces that the mesh conforms to, in space.
//! 10. [`slivers`]: tetrahedra with small dihedral angles are mended.
//! 11. [`partitions`]: large meshes made in partitions, on several threads.
//! 12. [`result`]: the arrays of the result.
//! 13. [`plain`]: the plain Delaunay triangulation of the plane, which needs none of these.
//! 14. [`distributed`]: partitions on several processes, of meshes that none of them has all of.

pub(crate) mod distributed;
mod facets;
mod insertion;
mod instruments;
mod operations;
mod partitions;
mod plain;
mod questions;
mod refinement;
mod result;
mod rounds;
mod segments;
mod slivers;
mod state;

use crate::delaunay::Cavity;
use crate::error::Result;
use crate::memory::collected;
use crate::mesh::{Arrangement, Inputs, Triangulation, in_dimension};
use crate::netmesh::state::Mesher;
use crate::netmesh::state::sizes::Sizes;
use crate::options::{Algorithm, Options, Output, ProgressFn, SizeFn};
use crate::parameters::{
    Features, Parameters, check_region_sizes, conforming, in_space, output_for,
};
pub(crate) use state::watch::Watch;
use std::time::Instant;

/// Steps of a run that only one dimension has.
pub(in crate::netmesh) trait Dimension {
    /// Makes the mesh conform to segments and facets, which are in the plane or in space.
    fn conform_to(&mut self, _: &Arrangement, _: &mut Cavity) -> Result<()> {
        unreachable!("segments of other dimensions are refused when they are set")
    }

    /// Removes vertices beside segments of the plane that the bound does not need.
    fn coarsen_in_plane(&mut self) -> Result<()> {
        Ok(())
    }

    /// Mends slivers, which only tetrahedra are, if the caller asks for it.
    fn mend_in_space(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Dimension for Mesher<'_, '_, 2> {
    fn conform_to(&mut self, arrangement: &Arrangement, cavity: &mut Cavity) -> Result<()> {
        self.conform(arrangement, cavity)
    }

    fn coarsen_in_plane(&mut self) -> Result<()> {
        self.coarsen()
    }
}

impl Dimension for Mesher<'_, '_, 3> {
    fn conform_to(&mut self, arrangement: &Arrangement, cavity: &mut Cavity) -> Result<()> {
        self.conform_to_facets(arrangement, cavity)
    }

    fn mend_in_space(&mut self) -> Result<()> {
        match self.state.parameters.min_dihedral > 0.0 {
            true => self.remove_slivers(),
            false => Ok(()),
        }
    }
}

impl Dimension for Mesher<'_, '_, 4> {}
impl Dimension for Mesher<'_, '_, 5> {}
impl Dimension for Mesher<'_, '_, 6> {}
impl Dimension for Mesher<'_, '_, 7> {}
impl Dimension for Mesher<'_, '_, 8> {}

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

/// Meshes `inputs` as [`run`] does, with simplices no larger than `size` asks for.
///
/// # Errors
/// Fails as [`run`] does; `InvalidArgument` if `size` answers no size.
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
        Some(arrangement) => Parameters {
            // What is outside is not refined, and a partition does not know what is.
            inputs_per_partition: None,
            ..match inputs.dim() {
                // A hull or box has sides, too.
                3 if arrangement.facets.is_empty() => in_space(options, Features::Segments)?,
                3 => in_space(options, Features::Facets)?,
                dim => Parameters::resolve(dim, &conforming(options, Features::Segments)?)?,
            }
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

pub(in crate::netmesh) fn mesh<const D: usize>(
    inputs: &Inputs,
    mut arrangement: Option<&mut Arrangement>,
    parameters: Parameters,
    size: Option<&SizeFn<'_>>,
    progress: Option<&mut ProgressFn<'_>>,
) -> Result<Triangulation>
where
    for<'a, 'b> Mesher<'a, 'b, D>: Dimension,
{
    let begun = Instant::now();
    let mut watch = Watch::new(progress);
    // Also the shortest run can be watched and cancelled.
    watch.report()?;
    if plain::is_for(D) && parameters.algorithm == Algorithm::Delaunay {
        return plain_and_measured::<D>(inputs, parameters, watch);
    }
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

/// Makes the plain Delaunay triangulation of the plane or of space. Instruments, if there are any,
/// look at D-balls, which only a [`Mesher`] has.
fn plain_and_measured<const D: usize>(
    inputs: &Inputs,
    parameters: Parameters,
    mut watch: Watch<'_, '_>,
) -> Result<Triangulation>
where
    for<'a, 'b> Mesher<'a, 'b, D>: Dimension,
{
    let begun = Instant::now();
    let has_instruments = parameters.instruments;
    let mut made = plain::triangulate(inputs, parameters.clone(), &mut watch)?;
    if has_instruments {
        let mut mesher = Mesher::<D>::new(inputs, parameters, watch)?;
        mesher.mesh(None)?;
        let measured = mesher.into_triangulation(begun)?.stats;
        made.stats = made.stats.with_instruments_of(&measured);
    }
    Ok(made)
}

impl<const D: usize> Mesher<'_, '_, D>
where
    Self: Dimension,
{
    /// Makes all of the mesh.
    pub(in crate::netmesh) fn mesh(&mut self, arrangement: Option<&Arrangement>) -> Result<()> {
        let mut cavity = Cavity::default();
        if self.state.parameters.algorithm == Algorithm::Delaunay {
            self.start_delaunay()?;
            return self.insert_rounds(&mut cavity);
        }
        match arrangement {
            Some(arrangement) => self.conform_to(arrangement, &mut cavity)?,
            None => self.mesh_points(&mut cavity)?,
        }
        self.refine_finally(&mut cavity)?;
        if arrangement.is_some() {
            self.coarsen_in_plane()?;
        }
        self.refine_by_distance(&mut cavity)?;
        // What goes in for the one may break the other, where simplices reach out of the box.
        while self.refine_by_size(&mut cavity)? && self.state.parameters.distance_ratio > 0.0 {
            self.refine_by_distance(&mut cavity)?;
        }
        self.mend_in_space()
    }

    /// Makes the mesh of the inputs, with the loose bound.
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
