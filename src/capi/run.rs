//! `nm_run`, with the adapter between the core's progress and C's.

use super::enums::nm_status;
use super::environment::Environment;
use super::handle::{nm_mesh, with_mesh_mut};
use super::memory::read_struct;
use super::options::{decode_options, encode};
use super::structs::{nm_options, nm_progress};
use crate::error::Result;
use crate::options::{Options, Progress, ProgressFn, SizeFn};

/// Meshes the inputs. A second run replaces the first one's result. All or nothing: after any other
/// status than NM_OK and NM_PANIC the mesh is as it was before the call.
///
/// options: read during the call only; NULL means the defaults.
///
/// The result is a Delaunay triangulation of the inputs and O(n) further vertices
/// (NM_OUTPUT_HIERARCHICAL), every cell within options->quality_bound. It depends only on the
/// inputs and the options, not on threads, time or machine.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT (an option; the message names the field,
/// its value and the range; with segments also two that cross, an input where curves do not close,
/// segments that enclose nothing; a seed on a segment, in no region or in that of another),
/// NM_DEGENERATE_INPUT (NM_ALGORITHM_DELAUNAY, the message names the affine rank; a hull or box
/// without area or, in 3D, volume), NM_LIMIT (too many vertices, or coordinates above 3e306;
/// segments for which doubles have no room), NM_CANCELLED, NM_OUT_OF_MEMORY, NM_STATE (another call
/// is using the mesh, or it is poisoned).
///
/// O(n log n) expected time and O(n) memory for NM_OUTPUT_HIERARCHICAL, the constants growing
/// exponentially with the dimension; for NM_OUTPUT_WELL_SPACED plus the size of the result. Any
/// thread; different meshes may be run at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_run(mesh: *mut nm_mesh, options: *const nm_options) -> nm_status {
    let caller = Environment::current();
    let body = |mesh: &mut crate::mesh::Mesh| {
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let (given, options) = unsafe { read_options(options)? };
        // SAFETY: the caller's function, with the caller's `user_data`.
        let mut report = unsafe { report(&given, caller) };
        let size = given.size.map(|callback| {
            // SAFETY: the caller's function, with the caller's `size_user_data`.
            move |x: &[f64]| caller.run(|| unsafe { callback(x.as_ptr(), given.size_user_data) })
        });
        let size = size.as_ref().map(|size| size as &SizeFn<'_>);
        let report = report.as_mut().map(|report| report as &mut ProgressFn<'_>);
        mesh.run_sized(&options, size, report)
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh_mut(mesh, body) }
}

/// Returns the options that the caller asks for, as C's struct and as the core has them.
///
/// # Safety
/// `options` is NULL or as long as its `struct_size` says.
pub unsafe fn read_options(options: *const nm_options) -> Result<(nm_options, Options)> {
    let defaults = encode(&Options::default());
    let given = if options.is_null() {
        defaults
    } else {
        // SAFETY: not NULL, so as long as its `struct_size` says.
        unsafe { read_struct("options", options, defaults)? }
    };
    let options = decode_options(&given)?;
    Ok((given, options))
}

/// Returns the caller's progress callback as the core calls it, which runs in the caller's
/// floating-point environment.
///
/// # Safety
/// The function may be called with its `user_data` while the result lives.
pub unsafe fn report(
    given: &nm_options,
    caller: Environment,
) -> Option<impl FnMut(&Progress) -> bool + use<>> {
    let user_data = given.user_data;
    given.progress.map(|callback| {
        move |progress: &Progress| {
            let report = encode_progress(progress);
            // SAFETY: the caller's function, with the caller's `user_data`.
            caller.run(|| unsafe { callback(&report, user_data) == 0 })
        }
    })
}

fn encode_progress(progress: &Progress) -> nm_progress {
    nm_progress {
        struct_size: size_of::<nm_progress>() as u32,
        phase: progress.phase,
        fraction: progress.fraction,
        inputs_inserted: progress.inputs_inserted,
        vertices: progress.vertices,
        simplices: progress.simplices,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::getters::nm_mesh_counts;
    use crate::capi::structs::nm_counts;
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::mesh::Mesh;
    use crate::numerics::testing::Random;
    use crate::options::{Algorithm, Phase};
    use std::ffi::c_void;
    use std::ptr::{null, null_mut};

    #[test]
    fn a_progress_report_carries_its_fields() {
        let report = encode_progress(&Progress {
            phase: Phase::Finish,
            fraction: 0.5,
            inputs_inserted: 1,
            vertices: 2,
            simplices: 3,
        });
        assert_eq!((report.struct_size, report.phase as i32, report.fraction), (40, 2, 0.5));
        assert_eq!((report.inputs_inserted, report.vertices, report.simplices), (1, 2, 3));
    }

    #[test]
    fn options_are_checked_before_the_run() {
        let mut mesh = square();
        let mut refuse = |options: nm_options| {
            // SAFETY: a live handle and a whole struct.
            let status = unsafe { nm_run(&mut mesh, &options) };
            assert_eq!(status, nm_status::NM_INVALID_ARGUMENT);
            last_message()
        };
        let good = encode(&Options::default());
        let message = refuse(nm_options { output: from_c(5), ..good });
        assert!(message.starts_with("options.output is 5;"), "{message}");
        let message = refuse(nm_options { struct_size: 0, ..good });
        assert!(message.starts_with("options.struct_size is 0;"), "{message}");
        let message = refuse(nm_options { epsilon: f64::NAN, ..good });
        assert!(message.starts_with("options.epsilon is NaN;"), "{message}");
        // SAFETY: NULL is allowed.
        let status = unsafe { nm_run(null_mut(), null()) };
        assert_eq!((status, &*last_message()), (nm_status::NM_NULL_ARGUMENT, "mesh is NULL"));
    }
    /// Returns a handle with `n` points in a cube.
    fn cube(n: usize) -> nm_mesh {
        let mut random = Random(1);
        let points: Vec<f64> = (0..3 * n).map(|_| random.unit()).collect();
        nm_mesh::new(Mesh::new(3, n, &points, 0).expect("good points"))
    }

    fn counts(mesh: &nm_mesh) -> (nm_status, nm_counts) {
        let mut counts = nm_counts {
            struct_size: size_of::<nm_counts>() as u32,
            dim: 0,
            inputs: 0,
            duplicates: 0,
            vertices: 0,
            simplices: 0,
            domains: 0,
            segment_edges: 0,
            facet_triangles: 0,
        };
        // SAFETY: a live handle and a whole struct.
        (unsafe { nm_mesh_counts(mesh, &mut counts) }, counts)
    }

    /// Statuses of calls on the mesh from within its progress callback.
    struct Witness<'a> {
        mesh: &'a nm_mesh,
        statuses: Vec<nm_status>,
    }

    unsafe extern "C" fn use_the_mesh(_: *const nm_progress, user_data: *mut c_void) -> i32 {
        // SAFETY: the test passes a witness that nothing else uses during the run.
        let witness = unsafe { &mut *user_data.cast::<Witness>() };
        let mesh = witness.mesh;
        let try_calls = move || {
            // SAFETY: a live handle; the run is refused before it changes anything.
            [counts(mesh).0, unsafe { nm_run((&raw const *mesh).cast_mut(), null()) }]
        };
        witness.statuses.extend(try_calls());
        let elsewhere = std::thread::scope(|scope| scope.spawn(try_calls).join());
        witness.statuses.extend(elsewhere.unwrap());
        -1
    }

    #[test]
    fn a_run_has_the_mesh_alone_and_may_be_cancelled() {
        let mesh = cube(50);
        let before = counts(&mesh);
        let mut witness = Witness { mesh: &mesh, statuses: Vec::new() };
        let options = nm_options {
            progress: Some(use_the_mesh),
            user_data: (&raw mut witness).cast(),
            ..encode(&Options::default())
        };
        // SAFETY: a live handle and a whole struct; the callback keeps to the rules.
        let status = unsafe { nm_run((&raw const mesh).cast_mut(), &options) };
        assert_eq!(status, nm_status::NM_CANCELLED);
        assert_eq!(witness.statuses, [nm_status::NM_STATE; 4], "one report, then no more");
        assert_eq!(counts(&mesh), before);
    }

    #[test]
    #[cfg_attr(miri, ignore = "two meshes in space take too long there")]
    fn a_second_run_replaces_the_first() {
        let mesh = cube(100);
        let run = |algorithm| {
            let options = encode(&Options { algorithm, ..Options::default() });
            // SAFETY: a live handle and a whole struct.
            let status = unsafe { nm_run((&raw const mesh).cast_mut(), &options) };
            assert_eq!(status, nm_status::NM_OK, "{}", last_message());
            counts(&mesh).1
        };
        let refined = run(Algorithm::Netmesh);
        let plain = run(Algorithm::Delaunay);
        assert!(refined.domains > 0 && refined.vertices > 100);
        assert_eq!((plain.domains, plain.vertices), (0, 100));
        assert_eq!(run(Algorithm::Netmesh), refined);
    }
}
