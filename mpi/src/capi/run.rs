//! The handle, and the run.

use crate::comm::mpi::Ranks;
use crate::comm::{Collective, Communicator, agreed};
use crate::distributed::DistributedMesh;
use netmesh::capi::shared::{Environment, barrier, null_argument, read_options, read_rows, report};
use netmesh::capi::{nm_options, nm_status};
use netmesh::options::ProgressFn;
use netmesh::{Error, Result};
use std::ffi::{c_char, c_void};

/// A rank's part of a mesh, and the ranks that have the others.
#[allow(non_camel_case_types)]
pub struct nm_mpi_mesh {
    pub(super) mesh: DistributedMesh,
    pub(super) comm: Collective<Ranks>,
}

/// Returns the handle behind a pointer.
///
/// # Safety
/// `mesh` is NULL or a live handle.
pub(super) unsafe fn handle<'a>(mesh: *const nm_mpi_mesh) -> Result<&'a nm_mpi_mesh> {
    // SAFETY: the caller's promise.
    unsafe { mesh.as_ref() }.ok_or_else(|| null_argument("mesh"))
}

/// Copies the calling thread's last message into buf, as nm_last_error does for netmesh.h: one
/// sentence about the last call of this header on this thread that did not answer NM_OK, in UTF-8,
/// "" if there was none. Where an error comes from one rank, all ranks have its message, with
/// " (rank R)" at the end.
///
/// buf: room for cap bytes, or NULL. At most cap bytes are written, the last one a NUL.
///
/// Returns the size in bytes of the whole message with its NUL (at least 1). Not collective; cannot
/// fail. O(size).
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_last_error(buf: *mut c_char, cap: usize) -> usize {
    // SAFETY: the caller's promise is the same.
    unsafe { netmesh::capi::nm_last_error(buf, cap) }
}

/// Frees a mesh, and the communicator that it talks through; NULL is allowed. Before MPI_Finalize
/// it is collective, after it is not.
/// cbindgen:prefix=NM_API
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_mesh_free(mesh: *mut nm_mpi_mesh) {
    if !mesh.is_null() {
        let _ = barrier(|| {
            // SAFETY: the caller gave a live handle, which was a Box.
            drop(unsafe { Box::from_raw(mesh) });
            Ok(())
        });
    }
}

/// Runs `nm_mpi_run`, behind the C function that knows MPI_Comm: `comm` points to one.
///
/// # Safety
/// The arguments are as the header says of `nm_mpi_run`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn netmesh_mpi_run(
    comm: *const c_void,
    dim: u32,
    local_count: u64,
    points: *const f64,
    options: *const nm_options,
    mesh: *mut *mut nm_mpi_mesh,
) -> nm_status {
    let caller = Environment::current();
    barrier(|| {
        // SAFETY: the C function's own argument.
        let comm = Collective::new(unsafe { Ranks::of(comm)? });
        // SAFETY: the caller's promises are the same.
        let made = unsafe { run(&comm, caller, dim, local_count, points, options, mesh)? };
        let made = Box::into_raw(Box::new(nm_mpi_mesh { mesh: made, comm }));
        // SAFETY: checked not to be NULL, so writable.
        unsafe { mesh.write(made) };
        Ok(())
    })
}

/// Reads the arguments, on which all ranks must agree, and runs.
///
/// # Safety
/// The arguments are as [`netmesh_mpi_run`] demands.
unsafe fn run(
    comm: &dyn Communicator,
    caller: Environment,
    dim: u32,
    local_count: u64,
    points: *const f64,
    options: *const nm_options,
    mesh: *mut *mut nm_mpi_mesh,
) -> Result<DistributedMesh> {
    let (points, given, options) = agreed(comm, || {
        if mesh.is_null() || !mesh.is_aligned() {
            return Err(null_argument("mesh"));
        }
        // SAFETY: the caller gave NULL or as many bytes as the `struct_size` says.
        let (given, options) = unsafe { read_options(options)? };
        if given.size.is_some() {
            let rule =
                "options.size is set; meshes of several ranks have no sizes, it must be NULL";
            return Err(Error::invalid(rule));
        }
        // SAFETY: the caller gave NULL or so many points.
        let points = unsafe { read_rows("points", points, local_count, dim as usize)? };
        Ok((points, given, options))
    })?;
    // SAFETY: the caller's function, with the caller's `user_data`.
    let mut report = unsafe { report(&given, caller) };
    let report = report.as_mut().map(|report| report as &mut ProgressFn<'_>);
    crate::run(comm, dim as usize, points, &options, report)
}
