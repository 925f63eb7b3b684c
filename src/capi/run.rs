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
