//! Options, from C and to C.

use super::enums::{
    decode_algorithm, decode_criterion, decode_ordering, decode_output, nm_algorithm, nm_criterion,
    nm_ordering, nm_output, nm_status,
};
use super::handle::barrier;
use super::memory::OutStruct;
use super::structs::nm_options;
use crate::error::Result;
use crate::options::{Algorithm, Criterion, NetOrdering, Options, Output};
use std::mem::MaybeUninit;
use std::ptr::null_mut;

/// Fills options with the defaults and sets its struct_size; bytes beyond this version's struct
/// become zero. Call it as nm_options_init(&options, sizeof options).
///
/// struct_size: the size of the caller's struct, 4..4096 bytes, not ending inside a field.
///
/// Errors: NM_NULL_ARGUMENT (options), NM_INVALID_ARGUMENT (struct_size). O(1); any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_options_init(options: *mut nm_options, struct_size: u32) -> nm_status {
    barrier(|| {
        // SAFETY: the caller gave NULL or `struct_size` writable bytes.
        let out = unsafe { OutStruct::with_size("options", options, struct_size)? };
        out.write(&encode(&Options::default()));
        out.write_size_and_clear_tail();
        Ok(())
    })
}

/// `options` as C sees them.
pub(super) fn encode(options: &Options) -> nm_options {
    nm_options {
        struct_size: size_of::<nm_options>() as u32,
        output: MaybeUninit::new(match options.output {
            Output::Hierarchical => nm_output::NM_OUTPUT_HIERARCHICAL,
            Output::WellSpaced => nm_output::NM_OUTPUT_WELL_SPACED,
        }),
        algorithm: MaybeUninit::new(match options.algorithm {
            Algorithm::Netmesh => nm_algorithm::NM_ALGORITHM_NETMESH,
            Algorithm::Svr => nm_algorithm::NM_ALGORITHM_SVR,
            Algorithm::Delaunay => nm_algorithm::NM_ALGORITHM_DELAUNAY,
        }),
        ordering: MaybeUninit::new(match options.ordering {
            NetOrdering::SampledNet => nm_ordering::NM_ORDERING_SAMPLED_NET,
            NetOrdering::DeterministicNet => nm_ordering::NM_ORDERING_DETERMINISTIC_NET,
        }),
        criterion: MaybeUninit::new(match options.criterion {
            Criterion::VoronoiAspect => nm_criterion::NM_CRITERION_VORONOI_ASPECT,
            Criterion::RadiusEdge => nm_criterion::NM_CRITERION_RADIUS_EDGE,
        }),
        threads: options.threads,
        quality_bound: options.quality_bound,
        epsilon: options.epsilon,
        delta: options.delta,
        gamma: options.gamma,
        yield_radius: options.yield_radius,
        encroachment: options.encroachment,
        cage_scale: options.cage_scale,
        root_scale: options.root_scale,
        seed: options.seed,
        max_vertices: options.max_vertices,
        progress: None,
        user_data: null_mut(),
    }
}

/// What C asks for, enums checked; the ranges of the numbers are the core's business.
pub(super) fn decode(options: &nm_options) -> Result<Options> {
    Ok(Options {
        output: decode_output(options.output)?,
        algorithm: decode_algorithm(options.algorithm)?,
        ordering: decode_ordering(options.ordering)?,
        criterion: decode_criterion(options.criterion)?,
        threads: options.threads,
        quality_bound: options.quality_bound,
        epsilon: options.epsilon,
        delta: options.delta,
        gamma: options.gamma,
        yield_radius: options.yield_radius,
        encroachment: options.encroachment,
        cage_scale: options.cage_scale,
        root_scale: options.root_scale,
        seed: options.seed,
        max_vertices: options.max_vertices,
    })
}
