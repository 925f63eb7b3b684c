//! `nm_run`, with the adapter between the core's progress and C's.

use super::enums::nm_status;
use super::handle::{nm_mesh, with_mesh_mut};
use super::memory::read_struct;
use super::options::{decode, encode};
use super::structs::{nm_options, nm_progress};
use crate::options::{Options, Progress};

/// Meshes the inputs. A second run replaces the first one's result. All or nothing: after any other
/// status than NM_OK and NM_PANIC the mesh is as it was before the call.
///
/// options: read during the call only; NULL means the defaults.
///
/// The result is a Delaunay triangulation of the inputs and O(n) further vertices
/// (NM_OUTPUT_HIERARCHICAL), every cell within options->quality_bound. It depends only on the inputs
/// and the options, not on threads, time or machine.
///
/// Errors: NM_NULL_ARGUMENT (mesh), NM_INVALID_ARGUMENT (an option; the message names the field, its
/// value and the range), NM_DEGENERATE_INPUT (NM_ALGORITHM_DELAUNAY only; the message names the
/// affine rank), NM_LIMIT, NM_CANCELLED, NM_OUT_OF_MEMORY, NM_STATE (another call is using the mesh,
/// or it is poisoned).
///
/// O(n log n) expected time and O(n) memory for NM_OUTPUT_HIERARCHICAL, the constants growing
/// exponentially with the dimension; for NM_OUTPUT_WELL_SPACED plus the size of the result. Any
/// thread; different meshes may be run at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_run(mesh: *mut nm_mesh, options: *const nm_options) -> nm_status {
    let body = |mesh: &mut crate::mesh::Mesh| {
        let defaults = encode(&Options::default());
        let given = if options.is_null() {
            defaults
        } else {
            // SAFETY: not NULL, so as long as its `struct_size` says.
            unsafe { read_struct("options", options, defaults)? }
        };
        let options = decode(&given)?;
        match given.progress {
            None => mesh.run(&options, None),
            Some(callback) => {
                let mut report = |progress: &Progress| {
                    let report = encode_progress(progress);
                    // SAFETY: the caller's function, with the caller's `user_data`.
                    unsafe { callback(&report, given.user_data) == 0 }
                };
                mesh.run(&options, Some(&mut report))
            }
        }
    };
    // SAFETY: the caller gave NULL or a live handle.
    unsafe { with_mesh_mut(mesh, body) }
}

fn encode_progress(progress: &Progress) -> nm_progress {
    nm_progress {
        struct_size: size_of::<nm_progress>() as u32,
        phase: progress.phase.into(),
        fraction: progress.fraction,
        inputs_inserted: progress.inputs_inserted,
        vertices: progress.vertices,
        simplices: progress.simplices,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::test_support::{from_c, last_message, square};
    use crate::options::Phase;
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
}
