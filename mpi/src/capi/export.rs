//! Files.

use super::run::{handle, nm_mpi_mesh};
use crate::comm::Communicator;
use crate::output::{self, Format};
use netmesh::capi::nm_status;
use netmesh::capi::shared::{barrier, utf8_path};
use netmesh::{Error, Result};
use std::ffi::c_char;
use std::mem::MaybeUninit;

/// Formats of meshes of several ranks.
#[allow(non_camel_case_types)]
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum nm_mpi_format {
    /// Format that the extension of the path names: .pvtu, .npy.
    NM_MPI_FORMAT_AUTO = 0,
    /// VTK's parallel unstructured grid: NAME.pvtu, and beside it NAME_RANK.vtu of each rank, with
    /// its ghosts (vtkGhostType 1) and all ids (GlobalNodeId, GlobalCellId). Dimensions 2 and 3.
    NM_MPI_FORMAT_PVTU = 1,
    /// NumPy arrays of the whole mesh: for NAME.npy the files NAME.points.npy (doubles, vertex_ids
    /// x dim: row v is vertex v, and row i input i, duplicates included) and NAME.simplices.npy
    /// (unsigned 64-bit ids of vertices, simplices x (dim + 1)).
    NM_MPI_FORMAT_NPY = 2,
}

/// Writes the mesh to files that all ranks see under the path, replacing what was there.
/// Collective. The files are written under other names and then renamed: after a failure there is
/// none of this call.
///
/// path_utf8, format: the same on all ranks, and the directory too. NM_MPI_FORMAT_AUTO goes by the
/// extension. Where a file is a symbolic link, what it leads to is written.
///
/// Errors, the same on all ranks: NM_NULL_ARGUMENT (mesh, path_utf8), NM_INVALID_ARGUMENT
/// (path_utf8 empty or not UTF-8, an unknown format or extension, a format that cannot hold the
/// mesh, a path or a format that differs between ranks), NM_IO (the message has the reason; so too
/// where ranks do not see the same directory, or a file that would be replaced is read-only),
/// NM_OUT_OF_MEMORY, NM_STATE (an earlier call on the mesh has failed).
///
/// A NULL for mesh is told to this rank alone: without it there is nothing to talk through.
///
/// O(local_vertices + local_simplices) on each rank.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn nm_mpi_export(
    mesh: *const nm_mpi_mesh,
    path_utf8: *const c_char,
    format: MaybeUninit<nm_mpi_format>,
) -> nm_status {
    barrier(|| {
        // SAFETY: the caller gave NULL or a live handle.
        let handle = unsafe { handle(mesh)? };
        let comm = handle.comm.again();
        // No word to the others before the call is compared with theirs.
        // SAFETY: the caller gave NULL or a C string.
        let path = unsafe { utf8_path(path_utf8) };
        let arguments = path.and_then(|path| Ok((path, decode_format(format)?)));
        let (path, format) = arguments.map_err(|error| comm.fail(error))?;
        output::write(&comm, &handle.mesh, path, format)
    })
}

fn decode_format(raw: MaybeUninit<nm_mpi_format>) -> Result<Format> {
    // SAFETY: C passes an int32_t by value, whatever it is.
    let value = unsafe { raw.as_ptr().cast::<i32>().read() };
    [Format::Auto, Format::Pvtu, Format::Npy]
        .into_iter()
        .find(|format| *format as i32 == value)
        .ok_or_else(|| {
            let message = format!("format is {value}; it must be one of nm_mpi_format, 0 to 2");
            Error::invalid(message)
        })
}
