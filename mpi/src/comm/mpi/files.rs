//! Files that all ranks write into at once, by MPI-IO.

#![allow(unsafe_code)]
#![warn(clippy::undocumented_unsafe_blocks, unsafe_op_in_unsafe_fn)]

use super::ranks::{Ranks, RawRanks, checked};
use netmesh::{Error, ErrorKind, Result};
use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::null_mut;

/// The most bytes that are written at once.
const CHUNK: u64 = 1 << 26;

#[repr(C)]
struct RawFile {
    _private: [u8; 0],
}

unsafe extern "C" {
    fn netmesh_shared_file_create(
        ranks: *mut RawRanks,
        path: *const c_char,
        created: *mut *mut RawFile,
    ) -> c_int;
    fn netmesh_shared_file_write(
        file: *mut RawFile,
        offset: u64,
        bytes: *const c_void,
        size: u64,
        chunk: u64,
    ) -> c_int;
    fn netmesh_shared_file_close(file: *mut RawFile) -> c_int;
}

/// A file that all ranks have open. [`Self::close`] must be called, which is collective.
pub struct SharedFile {
    raw: *mut RawFile,
}

impl SharedFile {
    /// Collective. Creates a file; one that is there already is an error.
    pub fn create(ranks: &Ranks, path: &Path) -> Result<Self> {
        let text = CString::new(path.as_os_str().as_encoded_bytes());
        let text = text.map_err(|_| Error::new(ErrorKind::Io, "a path with a NUL"))?;
        let mut raw = null_mut();
        // SAFETY: open ranks, a C string.
        let code = unsafe { netmesh_shared_file_create(ranks.raw(), text.as_ptr(), &raw mut raw) };
        checked(&format!("{}: cannot create", path.display()), code)?;
        Ok(Self { raw })
    }

    /// Writes the bytes of this rank at a place that is no other rank's. Not collective.
    pub fn write(&mut self, offset: u64, bytes: &[u8]) -> Result<()> {
        let (pointer, size) = (bytes.as_ptr().cast(), bytes.len() as u64);
        // SAFETY: so many bytes.
        let code = unsafe { netmesh_shared_file_write(self.raw, offset, pointer, size, CHUNK) };
        checked("MPI_File_write_at", code)
    }

    pub fn close(self) -> Result<()> {
        // SAFETY: open, and not used afterwards.
        checked("MPI_File_close", unsafe { netmesh_shared_file_close(self.raw) })
    }
}
