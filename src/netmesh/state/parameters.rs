//! Values that the algorithm derives from its parameters (§4, end).

use crate::netmesh::state::hierarchy::{DomainId, ROOT};
use crate::options::{Algorithm, Criterion};
use crate::parameters::Parameters;
use crate::threads::usable;

/// Largest value of [`Parameters::corner_restriction`].
const CORNER_RESTRICTION: f64 = 0.85;

/// A cage surrounds its domain's inputs if they are within this fraction of its sphere's radius.
const SURROUNDED: f64 = 0.8;

/// Factors of the bound that the mesh keeps while inputs go in; the second one is for radius-edge
/// ratios (docs/decisions.md).
const LOOSE: f64 = 3.0;

const LOOSE_EDGES: f64 = 4.5;

impl Parameters {
    /// Returns the fraction of the radius of a domain's cage sphere within which Voronoi corners
    /// count for cells of the domain; corners beyond the hull of the cage are the cage's business.
    pub(in crate::netmesh) fn corner_restriction(&self) -> f64 {
        CORNER_RESTRICTION.min(self.hull_radius())
    }

    /// Returns the radius of a ball that the hull of a delta-net of the unit sphere holds.
    pub(in crate::netmesh) fn hull_radius(&self) -> f64 {
        1.0 - 0.5 * self.delta * self.delta
    }

    /// Returns the bound that CLEAN keeps while inputs go in. The refinement to `quality_bound`
    /// comes at the end: with all inputs in their places it needs fewer points, and redistributes
    /// no input.
    pub(in crate::netmesh) fn loose_bound(&self) -> f64 {
        let factor = match self.criterion {
            Criterion::VoronoiAspect => LOOSE,
            Criterion::RadiusEdge => LOOSE_EDGES,
        };
        factor * self.quality_bound
    }

    /// Returns true if the final refinement bounds the cells of `domain` over all their corners,
    /// not only over those within the corner restriction: the cage must surround the domain's
    /// inputs. The root's always does.
    pub(in crate::netmesh) fn counts_all_corners_in(&self, domain: DomainId) -> bool {
        domain == ROOT || self.counts_all_corners()
    }

    /// Returns true if the final refinement bounds the cells of every domain over all their
    /// corners.
    pub(in crate::netmesh) fn counts_all_corners(&self) -> bool {
        self.epsilon <= SURROUNDED * self.cage_scale
    }
}

/// Highest dimension in which meshes are divided: in higher ones most of the mesh is at interfaces.
const MAX_DIM: usize = 3;

/// Returns the number of partitions that a mesh of so many `inputs` is made in, if it is.
pub(super) fn partition_count<const D: usize>(
    parameters: &Parameters,
    inputs: usize,
) -> Option<usize> {
    let least = parameters.inputs_per_partition?;
    let is_large =
        parameters.algorithm == Algorithm::Netmesh && D <= MAX_DIM && inputs >= 2 * least;
    // Two threads, or four, do even numbers of partitions in the same time.
    is_large.then(|| inputs.div_ceil(least).next_multiple_of(2))
}

/// Returns the number of threads for work that changes nothing on a mesh of so many `inputs`, at
/// most the number of cores: the caller may allow any number. A mesh that is not partitioned is
/// made on one thread.
pub(in crate::netmesh) fn usable_threads<const D: usize>(
    parameters: &Parameters,
    inputs: usize,
) -> usize {
    match partition_count::<D>(parameters, inputs) {
        Some(_) => usable(parameters.threads),
        None => 1,
    }
}
